#include "pipeline/stages/mesh_stages.h"
#include "pipeline/sources/source_volume.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "base/digest.h"
#include "geometry/cut/clip_surface.h"
#include "geometry/cut/cut_faces.h"
#include "geometry/repair/undo_intersections.h"
#include "pipeline/results/stage_results.h"
#include "pipeline/stages/side_sizes.h"
#include "pipeline/stages/stage.h"
#include "pipeline/stages/wall_values.h"
#include "quality/measure_quality.h"
#include "remesh/remesh_surface.h"
#include "sizing/build_sizing_field.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"
#include "tetra/fill/fill_tets.h"
#include "tetra/optimise/deepen_walls.h"
#include "tetra/optimise/optimise_tets.h"
#include "transfer/transfer_labels.h"
#include "types/stage_names.h"
#include "volume/select_labels.h"
#include "walls/measure_wall.h"

namespace voxtet {
namespace {

template <class T>
Status put(Result<T>&& result, StageOutput& out) {
  if (!result) return result.error();
  out.put(std::move(result).value());
  return std::monostate{};
}

/// How far faces of a cut may be off its plane.
constexpr double kFlatVoxels = 0.05;

using BuiltSurface = Built<SurfaceMesh>;
using BuiltTets = Built<TetMesh>;

const PreparedVolume& prepared_of(const StageInputs& in) {
  return in.get<VolumeResult>(Stage::kVolume).prepared;
}

/// With what is beyond cuts.
BuiltSurface built(SurfaceMesh surface, const CutPlanes& cuts) {
  if (cuts.empty()) return {std::move(surface), {}};
  BuiltSurface out{without_beyond(surface, cuts), {}};
  out.whole = std::move(surface);
  return out;
}

/// A surface cut at the planes of volume.cut.
Result<SurfaceMesh> clipped(SurfaceMesh surface, const PreparedVolume& volume, const char* stage,
                            const RunContext& ctx) {
  for (std::size_t c = 0; c < volume.cuts.size(); ++c) {
    if (!volume.cuts[c].is_given()) continue;
    std::optional<SurfaceMesh> cut = clip_surface(std::move(surface), *volume.meshed, volume.cuts, c, ctx);
    if (ctx.cancelled()) return cancelled_error(stage);
    if (!cut)
      return Error{ErrorCode::kMeshing,
                   stage,
                   "volume.cut: found surfaces that meet in the plane " + volume.cuts[c].name +
                       ", expected them apart there: move it by a part of a voxel",
                   {}};
    surface = std::move(*cut);
  }
  if (!volume.cuts.empty()) drop_lost_labels(surface, *volume.meshed);
  return surface;
}

std::vector<LayeredWall> layered(const Walls& walls, const std::vector<std::size_t>& numbers,
                                 const Recipe& recipe) {
  std::vector<LayeredWall> out;
  out.reserve(numbers.size());
  for (const std::size_t w : numbers) {
    const ThicknessSize& rule = recipe.sizing.thickness[w];
    out.push_back({walls[w], rule.layers, rule.layering == Layering::kExact});
  }
  return out;
}

void say(const ReadRemarks& remarks, const char* stage, const RunContext& ctx) {
  for (const std::string& warning : remarks.warnings) ctx.warn(stage, warning);
  for (const std::string& note : remarks.notes) ctx.note(stage, note);
}

bool has_sheets(const BuiltSurface& surface, const WallLayers& layers) {
  const std::vector<Sides>& sides = surface.as_built().sides;
  return std::any_of(sides.begin(), sides.end(), [&](const Sides& of) { return layers.is_layer(of[0]); });
}

/// Flat cuts, and nothing beyond them.
TetMesh cut_off(TetMesh mesh, const CutPlanes& cuts, double voxel_mm, RunContext& ctx) {
  if (cuts.empty()) return mesh;
  if (const double off = flatten_cuts(mesh, cuts); off > kFlatVoxels * voxel_mm)
    ctx.warn(kOptimiseStage, "volume: faces of a cut are up to " + std::to_string(off) + " mm off its plane");
  return without_beyond(std::move(mesh), cuts);
}

/// Warns if layers could not be counted, and if those that shall be exact were given up. `wall`: index of the
/// wall in sizing.thickness.
void warn_about_layers(std::size_t wall, const LayerCount& found, const RunContext& ctx) {
  const std::string name = "sizing.thickness[" + std::to_string(wall) + "].layers: ";
  if (!found.counted()) {
    ctx.warn(kQualityStage, name + "not counted, as no label of the wall has an outer surface in the mesh" +
                                " two edges off the wall's sides");
    return;
  }
  if (!found.given_up()) return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "exactly %u on %.1f %% of the wall's area, by edges, expected %.0f %%: triangles much smaller "
      "than the layers are thick leave no room for them",
      found.target_layers, 100 * found.by_edges.exact, 100 * LayerCount::kNearlyAll);
  ctx.warn(kQualityStage, name + text);
}

/// Warns where facets that exact layers need are much farther off the labels than was allowed.
void warn_about_coarse_layers(const QualityReport& report, double allowed_mm, const RunContext& ctx) {
  constexpr double kMuchFarther = 2;
  const double farthest_mm = std::max(report.mesh_to_surface.max_mm, report.surface_to_mesh.max_mm);
  if (farthest_mm <= kMuchFarther * allowed_mm ||
      std::none_of(report.layers.begin(), report.layers.end(),
                   [](const LayerCount& count) { return count.shall_be_exact; }))
    return;
  char text[256];
  std::snprintf(text, sizeof text,
                "exact layers: facets as large as they need are up to %.2g mm off the labels, "
                "remesh.max_distance_voxels allows %.2g mm elsewhere; more layers, or a smaller "
                "max_distance_voxels, bring them nearer",
                farthest_mm, allowed_mm);
  ctx.warn(kQualityStage, text);
}

}  // namespace

/// Another file may have the same labels, but other names, colours and remarks.
void add_volume(const LoadedFiles& files, const Recipe& recipe, std::string& key) {
  if (!needs_file(recipe.source) || !files.volume) return;
  key += files.digest;
  for (const LabelInfo& info : files.volume->infos) {
    key += "\n" + std::to_string(info.label) + " " + info.name;
    for (const float part : info.colour) key += " " + std::to_string(part);
  }
  for (const auto* lines : {&files.remarks.warnings, &files.remarks.notes})
    for (const std::string& line : *lines) key += "\n" + line;
}

Status run_volume(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  VolumeResult result;
  if (!needs_file(recipe.source)) {
    Result<LabelVolume> made = make_volume(recipe.source);
    if (!made) return made.error();
    result.source = std::make_shared<const LabelVolume>(std::move(made).value());
    result.digest = digest_of(*result.source);
  } else if (in.files.volume) {
    if (!(recipe.source.read == in.files.options))
      return usage_error(kVolumeStage,
                         "source: found a unit, precedence, background, frame or threshold by which "
                         "the volume was not read, expected it to be loaded again");
    result.source = in.files.volume;
    result.digest = in.files.digest;
    say(in.files.remarks, kVolumeStage, ctx);
  } else if (recipe.source.file) {
    return Error{ErrorCode::kBadInput,
                 kVolumeStage,
                 "source.file: the volume '" + recipe.source.file->name + "' has not been loaded",
                 {}};
  } else {
    return usage_error(kVolumeStage, "source: no volume; give a phantom or load a file");
  }
  Result<PreparedVolume> prepared =
      prepare_volume(result.source, recipe.labels, recipe.merge, recipe.volume, ctx);
  if (!prepared) return prepared.error();
  result.surroundings = label_surroundings(*result.source);
  result.prepared = std::move(prepared).value();
  out.put(std::move(result));
  return std::monostate{};
}

Status run_surface(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const PreparedVolume& volume = prepared_of(in);
  if (recipe.surface.method == ExtractMethod::kMarchingCubes) {
    if (const std::size_t labels = count_labels(*volume.prepared).size(); labels > 1)
      return usage_error(kSurfaceStage,
                         "surface.method: found marching_cubes for " + std::to_string(labels) +
                             " labels, expected auto or marching_tets, or all labels merged to one");
    if (!volume.cuts.empty())
      return usage_error(kSurfaceStage,
                         "surface.method: found marching_cubes where the image or a plane cuts the body off, "
                         "expected auto or marching_tets, or no volume.cut and volume.flat_border false");
  }
  ExtractParams params = recipe.surface;
  if (!volume.cuts.empty()) params.method = ExtractMethod::kMarchingTets;
  Result<SurfaceMesh> surface = extract_surface(*volume.extracted, params, ctx);
  if (!surface) return surface.error();
  if (volume.cuts.empty()) {
    out.put(BuiltSurface{std::move(surface).value(), {}});
    return std::monostate{};
  }
  if (const CutPlanes border = cuts_of_border(volume.cuts); !border.empty()) {
    const std::vector<Eigen::Vector3d> before = surface->points;
    settle_cuts(*surface, *volume.extracted, border);
    if (undo_intersections(*surface, before, ctx).cancelled) return cancelled_error(kSurfaceStage);
  }
  // Smoothing goes on from the surface that passes through the planes.
  const Result<SurfaceMesh> shown = clipped(*surface, volume, kSurfaceStage, ctx);
  if (!shown) return shown.error();
  out.put(BuiltSurface{without_beyond(*shown, volume.cuts), std::move(surface).value()});
  return std::monostate{};
}

Status run_smooth(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const PreparedVolume& volume = prepared_of(in);
  Result<SurfaceMesh> surface =
      smooth_surface(in.get<BuiltSurface>(Stage::kSurface).as_built(), *volume.extracted, recipe.smooth, ctx,
                     cuts_of_border(volume.cuts), volume.planes);
  if (surface) surface = clipped(std::move(surface).value(), volume, kSmoothStage, ctx);
  if (!surface) return surface.error();
  out.put(built(std::move(surface).value(), volume.cuts));
  return std::monostate{};
}

Status run_walls(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const PreparedVolume& volume = prepared_of(in);
  WallsResult result;
  Walls& walls = result.walls;
  for (const ThicknessSize& rule : recipe.sizing.thickness) {
    const std::string name = "sizing.thickness[" + std::to_string(walls.size()) + "]";
    Result<WallField> wall =
        measure_wall({*volume.anatomy, *volume.prepared, in.get<BuiltSurface>(Stage::kSmooth).mesh},
                     {rule.wall, rule.inner, rule.layering == Layering::kExact}, name, ctx);
    if (!wall) return wall.error();
    walls.push_back(std::move(wall).value());
  }
  if (!walls.empty())
    result.fields.push_back({"thickness_mm", "Wall thickness", "mm", On::kVoxels, Scale::kSequential, 1,
                             wall_values(walls, *volume.prepared, WallValue::kThickness)});
  out.put(std::move(result));
  return std::monostate{};
}

void add_side_volumes(const LoadedFiles& files, const Recipe& recipe, std::string& key) {
  for (const MaskSize& mask : recipe.sizing.masks)
    if (const auto found = files.masks.find(mask.name); found != files.masks.end())
      key += found->second.digest;
  for (const ImageSize& image : recipe.sizing.images)
    if (const auto found = files.images.find(image.name); found != files.images.end())
      key += found->second.digest;
}

Status run_sizing(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  std::set<std::string> warned;
  for (const MaskSize& mask : recipe.sizing.masks)
    if (const auto found = in.files.masks.find(mask.name);
        found != in.files.masks.end() && warned.insert(mask.name).second)
      say(found->second.remarks, kSizingStage, ctx);
  return put(build_sizing_field_of(in.files, recipe.sizing, *prepared_of(in).prepared,
                                   in.get<BuiltSurface>(Stage::kSmooth).mesh,
                                   in.get<WallsResult>(Stage::kWalls).walls, ctx),
             out);
}

Status run_layers(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext&) {
  LayersResult result{in.share<WallsResult>(Stage::kWalls), {}, {}};
  for (std::size_t w = 0; w < result.walls->walls.size(); ++w)
    if (recipe.sizing.thickness[w].layering == Layering::kExact) result.exact.push_back(w);
  const LabelVolume& volume = *prepared_of(in).prepared;
  result.layers = WallLayers(volume, layered(result.walls->walls, result.exact, recipe));
  if (result.layers.lacks_labels())
    return usage_error(
        kLayersStage,
        "sizing.thickness: exact layers are labels of their own, above the volume's highest: found " +
            std::to_string(*std::max_element(volume.labels.begin(), volume.labels.end())) +
            ", expected one that leaves enough of 65535 for them");
  for (std::size_t e = 0; e < result.exact.size(); ++e)
    if (!result.layers.has_wall(e))
      return usage_error(
          kLayersStage,
          "sizing.thickness[" + std::to_string(result.exact[e]) +
              "].wall: found no meshed label of which most lies in this wall and in none before "
              "it, expected one for its exact layers");
  out.put(std::move(result));
  return std::monostate{};
}

Status run_remesh(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const PreparedVolume& volume = prepared_of(in);
  const WallLayers& layers = in.get<LayersResult>(Stage::kLayers).layers;
  Result<SurfaceMesh> surface =
      remesh_surface(*volume.meshed, in.get<BuiltSurface>(Stage::kSmooth).as_built(),
                     in.get<SizingField>(Stage::kSizing), recipe.remesh, ctx, layers, volume.cuts);
  if (!surface) return surface.error();
  BuiltSurface result = built(std::move(surface).value(), volume.cuts);
  // The method adapt may have had to help out, without sheets.
  if (has_sheets(result, layers)) {
    if (!result.whole) result.whole = result.mesh;
    result.mesh = without_beyond(merge_layers(*result.whole, layers), volume.cuts);
  }
  out.put(std::move(result));
  return std::monostate{};
}

Status run_tetra(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const CutPlanes& cuts = prepared_of(in).cuts;
  const BuiltSurface& surface = in.get<BuiltSurface>(Stage::kRemesh);
  const WallLayers& layers = in.get<LayersResult>(Stage::kLayers).layers;
  const WallLayers laid = has_sheets(surface, layers) ? layers : WallLayers();
  Result<TetMesh> filled =
      fill_tets(surface.as_built(), in.get<SizingField>(Stage::kSizing), recipe.tetra, ctx, laid);
  if (!filled) {
    Error error = filled.error();
    error.where.stage = name_of(Stage::kRemesh);
    error.where.on = On::kTriangles;
    error.where.elements = shown_triangles(merged_triangles(error.where.elements, surface.as_built(), laid),
                                           merge_layers(surface.as_built(), laid), cuts);
    return error;
  }
  flatten_cuts(*filled, cuts);
  BuiltTets result;
  if (surface.whole) {
    result.mesh = without_beyond(merge_layers(*filled, laid), cuts);
    result.whole = std::move(filled).value();
  } else {
    result.mesh = std::move(filled).value();
  }
  out.put(std::move(result));
  return std::monostate{};
}

Status run_optimise(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  if (const OpenedMesh* opened = opened_mesh(recipe, in.files)) {
    out.put(mesh_of_labels(opened->mesh, recipe.labels, recipe.merge));
    return std::monostate{};
  }
  const PreparedVolume& volume = prepared_of(in);
  const SurfaceMesh& smooth = in.get<BuiltSurface>(Stage::kSmooth).as_built();
  const SizingField& sizing = in.get<SizingField>(Stage::kSizing);
  const BuiltSurface& adapted = in.get<BuiltSurface>(Stage::kRemesh);
  const auto& [walls, exact, layers] = in.get<LayersResult>(Stage::kLayers);
  const bool sheets = has_sheets(adapted, layers);
  SurfaceMesh layered_reference;
  if (sheets) layered_reference = with_layers(smooth, adapted.as_built(), layers);
  Result<TetMesh> optimised =
      optimise_tets(in.get<BuiltTets>(Stage::kTetra).as_built(), sheets ? layered_reference : smooth, sizing,
                    recipe.optimise, ctx, sheets ? layers : WallLayers(), volume.cuts);
  if (!optimised) return optimised.error();
  TetMesh mesh =
      cut_off(std::move(optimised).value(), volume.cuts, volume.meshed->smallest_spacing_mm(), ctx);
  if (!sheets) {
    out.put(std::move(mesh));
    return std::monostate{};
  }
  const std::vector<std::size_t> worked_on = recipe.optimise.rounds > 0 ? exact : std::vector<std::size_t>{};
  return put(deepen_walls(merge_layers(std::move(mesh), layers), layered(walls->walls, worked_on, recipe),
                          sizing, ctx),
             out);
}

Status run_transfer(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  return put(
      transfer_labels(in.get<TetMesh>(Stage::kOptimise), *prepared_of(in).placed, recipe.transfer, ctx), out);
}

Status run_quality(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  if (opened_mesh(recipe, in.files))
    return put(measure_mesh(in.get<TetMesh>(Stage::kOptimise), recipe.quality, ctx), out);
  const Walls& all = in.get<WallsResult>(Stage::kWalls).walls;
  std::vector<std::size_t> counted;
  for (std::size_t w = 0; w < all.size(); ++w)
    if (recipe.sizing.thickness[w].layers > 0) counted.push_back(w);
  const std::vector<LayeredWall> walls = layered(all, counted, recipe);
  Result<QualityReport> report =
      measure_quality(in.get<TetMesh>(Stage::kOptimise),
                      {*prepared_of(in).prepared, *prepared_of(in).selected,
                       in.get<BuiltSurface>(Stage::kSmooth).mesh, in.get<BuiltSurface>(Stage::kRemesh).mesh,
                       in.get<SizingField>(Stage::kSizing), walls, prepared_of(in).divided_mm3},
                      recipe.quality, ctx);
  if (!report) {
    Error error = report.error();
    error.where.stage = name_of(Stage::kOptimise);
    error.where.on = On::kTets;
    return error;
  }
  for (std::size_t w = 0; w < counted.size(); ++w) warn_about_layers(counted[w], report->layers[w], ctx);
  warn_about_coarse_layers(
      *report, recipe.remesh.max_distance_voxels * prepared_of(in).prepared->smallest_spacing_mm(), ctx);
  return put(std::move(report), out);
}

}  // namespace voxtet
