#include "anatomy/find_heart_surfaces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

#include "anatomy/check_anatomy.h"
#include "anatomy/labels_across.h"
#include "anatomy/name_faces.h"
#include "anatomy/wall_surface.h"
#include "types/stage_names.h"
#include "walls/find_cavities.h"
#include "walls/wall_grid.h"

namespace voxtet {
namespace {

using anatomy::anatomy_error;
using anatomy::FaceKinds;
using anatomy::list_of;
using anatomy::WallSurface;
using wall::WallGrid;

constexpr std::uint8_t kLeft = wall::kInner, kRight = wall::kInner + 1;

/// The wall's voxels, and around them those of the left and the right pool, or of the cavities.
struct Spaces {
  WallGrid grid;
  std::size_t count = 0;
};

Result<Spaces> find_spaces(const LabelVolume& image, const std::vector<Label>& wall_labels,
                           const AnatomyParams& params) {
  std::vector<Label> pools = params.lv_pool;
  pools.insert(pools.end(), params.rv_pool.begin(), params.rv_pool.end());
  Spaces spaces{wall::wall_grid(image, wall_labels, pools), 0};
  if (pools.empty()) {
    spaces.count = wall::find_cavities(spaces.grid);
    if (spaces.count < 1 || spaces.count > 2)
      return anatomy_error("wall",
                           std::to_string(spaces.count) + " cavities in the wall of " + list_of(params.wall),
                           "one or two; or name what fills them, lv_pool and rv_pool");
    return spaces;
  }
  for (std::uint8_t& kind : spaces.grid.kind)
    if (kind >= wall::kInner)
      kind = kind - wall::kInner < static_cast<int>(params.lv_pool.size()) ? kLeft : kRight;
  spaces.count = params.rv_pool.empty() ? 1 : 2;
  return spaces;
}

std::optional<Error> check_kinds(const FaceKinds& kinds, std::size_t count, const AnatomyParams& params) {
  for (std::size_t space = 0; space < count; ++space) {
    if (std::count(kinds.begin(), kinds.end(), wall::kInner + space) > 0) continue;
    if (params.lv_pool.empty())
      return anatomy_error("wall", "a cavity that no face of the mesh looks into",
                           "the image from which the mesh was made");
    const std::vector<Label>& pool = space == 0 ? params.lv_pool : params.rv_pool;
    return anatomy_error(space == 0 ? "lv_pool" : "rv_pool",
                         list_of(pool) + ", which no face of the wall looks at",
                         "a pool that the wall surrounds");
  }
  if (std::count(kinds.begin(), kinds.end(), wall::kSide) == 0)
    return anatomy_error("wall",
                         "no base: no rim between the inside and the outside of " + list_of(params.wall),
                         "ventricles that are cut off or open into valves");
  if (std::count(kinds.begin(), kinds.end(), wall::kOuter) == 0)
    return anatomy_error("wall", "no epicardium", "a wall with an outside");
  return std::nullopt;
}

/// The thicker of two ventricles becomes the left one.
void put_left_first(const anatomy::Points& points, const WallSurface& surface, RunContext& ctx,
                    FaceKinds& kinds, WallGrid& grid) {
  const std::vector<double> thickness = anatomy::free_wall_mm(points, surface, kinds, 2, ctx.threads);
  std::ostringstream note;
  note.precision(3);
  note << "left and right by their free walls of " << std::max(thickness[0], thickness[1]) << " and "
       << std::min(thickness[0], thickness[1]) << " mm";
  ctx.note(kAnatomyStage, note.str());
  if (thickness[0] >= thickness[1]) return;
  for (std::vector<std::uint8_t>* list : {&kinds, &grid.kind})
    for (std::uint8_t& kind : *list)
      if (kind == kLeft || kind == kRight) kind = kind == kLeft ? kRight : kLeft;
}

HeartSurface surface_of(std::uint8_t kind, bool septum) {
  switch (kind) {
    case wall::kOuter: return HeartSurface::kEpicardium;
    case wall::kSide: return HeartSurface::kBase;
    case kLeft: return HeartSurface::kLvEndocardium;
    case kRight: return septum ? HeartSurface::kRvSeptum : HeartSurface::kRvEndocardium;
    default: return HeartSurface::kNone;
  }
}

/// The image's labels that lie in the wall's tetrahedra, also those that the mesh holds under another label.
Result<std::vector<Label>> wall_of_image(const TetMesh& mesh, const LabelVolume& image,
                                         const std::vector<bool>& is_wall, const AnatomyParams& params) {
  const std::vector<bool> within =
      anatomy::labels_within(mesh, image, [&](Label label) { return is_wall[label]; });
  std::vector<Label> labels;
  for (std::size_t label = 0; label < within.size(); ++label)
    if (within[label]) labels.push_back(static_cast<Label>(label));
  if (labels.empty())
    return anatomy_error("wall", list_of(params.wall) + ", in whose tetrahedra no label of the image lies",
                         "the image from which the mesh was made");
  for (const auto& [field, pool] :
       {std::pair("lv_pool", &params.lv_pool), std::pair("rv_pool", &params.rv_pool)})
    for (const Label label : *pool)
      if (within[label])
        return anatomy_error(field, std::to_string(label) + ", most of which lies in the wall",
                             "what fills a cavity");
  return labels;
}

void note_areas(const WallSurface& surface, const HeartSurfaces& found, RunContext& ctx) {
  std::array<double, 6> area_cm2{};
  for (const anatomy::WallFace& face : surface.faces)
    area_cm2[static_cast<std::size_t>(found.faces[face.index])] += face.area_mm2 / 100;
  std::ostringstream note;
  note.precision(3);
  for (std::size_t s = 1; s < area_cm2.size(); ++s)
    if (area_cm2[s] > 0)
      note << (s > 1 ? ", " : "") << name_of(static_cast<HeartSurface>(s)) << ' ' << area_cm2[s] << " cm2";
  ctx.note(kAnatomyStage, note.str());
}

}  // namespace

Result<HeartSurfaces> find_heart_surfaces(const TetMesh& mesh, const LabelVolume& image,
                                          const AnatomyParams& params, RunContext& ctx) {
  if (auto error = anatomy::check_labels(mesh, image, params)) return *std::move(error);
  std::vector<bool> is_wall(65536, false);
  for (const Label label : params.wall) is_wall[label] = true;
  const Result<std::vector<Label>> wall_labels = wall_of_image(mesh, image, is_wall, params);
  if (!wall_labels) return wall_labels.error();
  Result<Spaces> spaces = find_spaces(image, *wall_labels, params);
  if (!spaces) return spaces.error();
  if (ctx.cancelled()) return cancelled_error(kAnatomyStage);
  ctx.progress(kAnatomyStage, 0.3);

  WallGrid& grid = spaces->grid;
  const WallSurface surface = anatomy::wall_surface(mesh, is_wall);
  const auto name_faces = [&] {
    FaceKinds kinds = anatomy::look_at_sides(mesh.points, surface, grid, ctx.threads);
    anatomy::find_base(mesh.points, surface, ctx.threads, kinds);
    return kinds;
  };
  FaceKinds kinds = name_faces();
  for (int round = 0; round < 2; ++round)
    if (params.lv_pool.empty() && anatomy::end_at_base(surface, kinds, grid)) kinds = name_faces();
  if (auto error = check_kinds(kinds, spaces->count, params)) return *std::move(error);
  if (ctx.cancelled()) return cancelled_error(kAnatomyStage);
  ctx.progress(kAnatomyStage, 0.5);

  HeartSurfaces found;
  found.right = spaces->count == 2;
  std::vector<bool> septum(kinds.size(), false);
  if (found.right) {
    if (params.lv_pool.empty()) put_left_first(mesh.points, surface, ctx, kinds, grid);
    septum = anatomy::find_septum(mesh.points, surface, kinds, std::move(grid), ctx.threads);
  }
  found.faces.assign(mesh.faces.size(), HeartSurface::kNone);
  for (std::size_t f = 0; f < kinds.size(); ++f)
    found.faces[surface.faces[f].index] = surface_of(kinds[f], septum[f]);
  found.wall.reserve(mesh.tets.size());
  for (const Label label : mesh.labels) found.wall.push_back(is_wall[label]);
  found.apex = anatomy::find_apex(mesh.points, surface, kinds);
  note_areas(surface, found, ctx);
  return found;
}

}  // namespace voxtet
