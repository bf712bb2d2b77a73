// What each stage runs.
#include <algorithm>
#include <cstdio>
#include <set>

#include "geometry/digest.h"
#include "lookup/look_up_labels.h"
#include "phantom/make_phantom.h"
#include "pipeline/forecast.h"
#include "pipeline/session.h"
#include "quality/measure_quality.h"
#include "remesh/remesh_surface.h"
#include "sizing/build_sizing_field.h"
#include "sizing/measure_wall.h"
#include "surface/extract_surface.h"
#include "surface/smooth_surface.h"
#include "tetra/deepen_walls.h"
#include "tetra/fill_tets.h"
#include "tetra/optimise_tets.h"
#include "volume/select_labels.h"

namespace voxtet {
namespace {

template <class T>
Status keep(Result<T>&& result, std::optional<T>& slot) {
  if (!result) return result.error();
  slot = std::move(result).value();
  return std::monostate{};
}

/// The loaded volume of each wish, in order. Errors: kBadInput for one that is missing or another.
template <class Wish, class Loaded, class Volume>
Status find_side_volumes(const std::vector<Wish>& wishes, const Loaded& loaded, const std::string& list,
                         std::vector<const Volume*>& out) {
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const Wish& wish = wishes[i];
    const std::string name = list + "[" + std::to_string(i) + "]: ";
    const auto found = loaded.find(wish.name);
    if (found == loaded.end())
      return Error{
          ErrorCode::kBadInput, "sizing", name + "the file '" + wish.name + "' has not been loaded", {}};
    const std::string& digest = found->second.digest;
    if (!wish.sha256.empty() && wish.sha256 != digest)
      return Error{ErrorCode::kBadInput,
                   "sizing",
                   name + "the case was made with '" + wish.name + "' of digest " +
                       wish.sha256.substr(0, 12) + "..., the file loaded has " + digest.substr(0, 12) +
                       "...: these are different volumes",
                   {}};
    out.push_back(&found->second.volume);
  }
  return std::monostate{};
}

}  // namespace

Status Session::run_volume(RunContext& ctx) {
  if (recipe_.source.phantom) {
    Result<LabelVolume> made = make_phantom(*recipe_.source.phantom);
    if (!made) return made.error();
    source_ = std::make_shared<const LabelVolume>(std::move(made).value());
    source_digest_ = digest_of(*source_);
  } else if (file_volume_) {
    source_ = file_volume_;
    source_digest_ = file_digest_;
    for (const std::string& warning : file_warnings_) ctx.warn("volume", warning);
  } else if (recipe_.source.file) {
    return Error{ErrorCode::kBadInput,
                 "volume",
                 "source.file: the volume '" + recipe_.source.file->name + "' has not been loaded",
                 {}};
  } else {
    return Error{ErrorCode::kUsage, "volume", "source: no volume; give a phantom or load a file", {}};
  }
  Result<PreparedVolume> prepared =
      prepare_volume(source_, recipe_.labels, recipe_.merge, recipe_.volume, ctx);
  if (!prepared) return prepared.error();
  volume_ = std::move(prepared).value();
  return std::monostate{};
}

Status Session::run_surface(RunContext& ctx) {
  // Before a mesh is made for it.
  if (Status can_look_up = check_look_up(*source_, recipe_.lookup); !can_look_up) return can_look_up;
  if (recipe_.surface.method == ExtractMethod::kMarchingCubes)
    if (const std::size_t labels = count_labels(*volume()).size(); labels > 1)
      return usage_error("surface",
                         "surface.method: found marching_cubes for " + std::to_string(labels) +
                             " labels, expected auto or marching_tets, or all labels merged to one");
  return keep(extract_surface(*volume(), recipe_.surface, ctx), surface_);
}

Status Session::measure_walls(RunContext& ctx) {
  const std::string key = key_of_walls();
  if (key == walls_key_) return std::monostate{};
  walls_.clear();
  walls_key_.clear();
  for (const ThicknessSize& wish : recipe_.sizing.thickness) {
    const std::string name = "sizing.thickness[" + std::to_string(walls_.size()) + "]";
    Result<WallField> wall =
        measure_wall({*anatomy(), *volume(), *smooth_},
                     {wish.wall, wish.inner, wish.layering == Layering::kExact}, name, ctx);
    if (!wall) return wall.error();
    walls_.push_back(std::move(wall).value());
  }
  walls_key_ = key;
  return std::monostate{};
}

Result<SizingField> Session::size_by(const SizingParams& sizing, RunContext& ctx) const {
  std::vector<const LabelVolume*> masks;
  std::vector<const ScalarVolume*> images;
  if (Status found = find_side_volumes(sizing.masks, masks_, "sizing.masks", masks); !found)
    return found.error();
  if (Status found = find_side_volumes(sizing.images, images_, "sizing.images", images); !found)
    return found.error();
  return build_sizing_field(*volume(), sizing, ctx, {walls_, masks, images, &*smooth_});
}

Status Session::run_sizing(RunContext& ctx) {
  if (Status measured = measure_walls(ctx); !measured) return measured;
  std::set<std::string> warned;
  for (const MaskSize& mask : recipe_.sizing.masks)
    if (const auto found = masks_.find(mask.name); found != masks_.end() && warned.insert(mask.name).second)
      for (const std::string& warning : found->second.warnings) ctx.warn("sizing", warning);
  return keep(size_by(recipe_.sizing, ctx), sizing_);
}

std::vector<std::size_t> Session::exact_walls() const {
  std::vector<std::size_t> exact;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (recipe_.sizing.thickness[w].layering == Layering::kExact) exact.push_back(w);
  return exact;
}

std::vector<LayeredWall> Session::layered(const std::vector<std::size_t>& walls) const {
  std::vector<LayeredWall> out;
  for (const std::size_t w : walls) out.push_back({walls_[w], recipe_.sizing.thickness[w].layers});
  return out;
}

Status Session::run_remesh(RunContext& ctx) {
  if (Status within = check_limits(*this, ctx); !within) return within;
  const std::vector<std::size_t> exact = exact_walls();
  layers_ = WallLayers(*volume(), layered(exact));
  if (layers_.lacks_labels())
    return Error{
        ErrorCode::kUsage,
        "remesh",
        "sizing.thickness: exact layers are labels of their own, above the volume's highest: found " +
            std::to_string(*std::max_element(volume()->labels.begin(), volume()->labels.end())) +
            ", expected one that leaves enough of 65535 for them",
        {}};
  for (std::size_t e = 0; e < exact.size(); ++e)
    if (!layers_.has_wall(e))
      return Error{ErrorCode::kUsage,
                   "remesh",
                   "sizing.thickness[" + std::to_string(exact[e]) +
                       "].wall: found no meshed label of which most lies in this wall and in none before it, "
                       "expected one for its exact layers",
                   {}};
  Result<SurfaceMesh> surface = remesh_surface(*volume(), *smooth_, *sizing_, recipe_.remesh, ctx, layers_);
  if (!surface) return surface.error();
  // The method remesh may have had to help out, without sheets.
  if (std::none_of(surface->sides.begin(), surface->sides.end(),
                   [this](const Sides& sides) { return layers_.is_layer(sides[0]); }))
    layers_ = {};
  if (layers_.empty()) return keep(std::move(surface), remeshed_);
  remeshed_ = merge_layers(*surface, layers_);
  layered_surface_ = std::move(surface).value();
  return std::monostate{};
}

Status Session::run_tetra(RunContext& ctx) {
  if (layers_.empty()) return keep(fill_tets(*remeshed_, *sizing_, recipe_.tetra, ctx), filled_);
  Status filled = keep(fill_tets(*layered_surface_, *sizing_, recipe_.tetra, ctx, layers_), layered_tets_);
  if (filled) filled_ = merge_layers(*layered_tets_, layers_);
  return filled;
}

Status Session::run_optimise(RunContext& ctx) {
  if (layers_.empty())
    return keep(optimise_tets(*filled_, *smooth_, *sizing_, recipe_.optimise, ctx), optimised_);
  const SurfaceMesh reference = with_layers(*smooth_, *layered_surface_, layers_);
  Result<TetMesh> optimised =
      optimise_tets(*layered_tets_, reference, *sizing_, recipe_.optimise, ctx, layers_);
  if (!optimised) return optimised.error();
  const std::vector<std::size_t> worked_on =
      recipe_.optimise.rounds > 0 ? exact_walls() : std::vector<std::size_t>{};
  return keep(
      deepen_walls(merge_layers(std::move(optimised).value(), layers_), layered(worked_on), *sizing_, ctx),
      optimised_);
}

void Session::warn_about_layers(std::size_t wall, const LayerCount& found, RunContext& ctx) const {
  constexpr double kNearlyAll = 0.95;
  const std::string name = "sizing.thickness[" + std::to_string(wall) + "].layers: ";
  const std::vector<double>& areas = found.by_edges.area_mm2;
  if (std::all_of(areas.begin(), areas.end(), [](double area) { return area == 0; })) {
    ctx.warn("quality", name + "not counted, as no label of the wall has an outer surface in the mesh");
    return;
  }
  if (recipe_.sizing.thickness[wall].layering != Layering::kExact || found.by_edges.exact >= kNearlyAll)
    return;
  char share[16];
  std::snprintf(share, sizeof share, "%.0f %%", 100 * found.by_edges.exact);
  ctx.warn("quality", name + "exactly " + std::to_string(found.wished) + " on " + share +
                          " of the wall's area, by edges: the others have no room there");
}

Status Session::run_quality(RunContext& ctx) {
  std::vector<std::size_t> wished;
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (recipe_.sizing.thickness[w].layers > 0) wished.push_back(w);
  const std::vector<LayeredWall> walls = layered(wished);
  Status measured =
      keep(measure_quality(*mesh(), {*volume(), *selected_volume(), *smooth_, *remeshed_, *sizing_, walls},
                           recipe_.quality, ctx),
           quality_);
  if (measured)
    for (std::size_t w = 0; w < wished.size(); ++w) warn_about_layers(wished[w], quality_->layers[w], ctx);
  return measured;
}

Status Session::run_stage(Stage stage, RunContext& ctx) {
  switch (stage) {
    case Stage::kVolume: return run_volume(ctx);
    case Stage::kSurface: return run_surface(ctx);
    case Stage::kSmooth: return keep(smooth_surface(*surface_, *volume(), recipe_.smooth, ctx), smooth_);
    case Stage::kSizing: return run_sizing(ctx);
    case Stage::kRemesh: return run_remesh(ctx);
    case Stage::kTetra: return run_tetra(ctx);
    case Stage::kOptimise: return run_optimise(ctx);
    case Stage::kLookup: return keep(look_up_labels(*mesh(), *source_, recipe_.lookup, ctx), lookup_);
    case Stage::kQuality: return run_quality(ctx);
  }
  return Error{ErrorCode::kInternal, "session", "unknown stage", {}};
}

}  // namespace voxtet
