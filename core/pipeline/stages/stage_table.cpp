// The table of stages: what each reads, and what it runs.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/digest.h"
#include "phantom/make_phantom.h"
#include "pipeline/results/describe_results.h"
#include "pipeline/results/stage_results.h"
#include "pipeline/stages/diffusion_stage.h"
#include "pipeline/stages/heart_stages.h"
#include "pipeline/stages/layer_warnings.h"
#include "pipeline/stages/monodomain_stage.h"
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

using nlohmann::json;

template <class T>
Status put(Result<T>&& result, StageOutput& out) {
  if (!result) return result.error();
  out.put(std::move(result).value());
  return std::monostate{};
}

const LabelVolume& volume_of(const StageInputs& in) {
  return *in.get<VolumeResult>(Stage::kVolume).prepared.prepared;
}

std::vector<LayeredWall> layered(const Walls& walls, const std::vector<std::size_t>& numbers,
                                 const Recipe& recipe) {
  std::vector<LayeredWall> out;
  out.reserve(numbers.size());
  for (const std::size_t w : numbers) out.push_back({walls[w], recipe.sizing.thickness[w].layers});
  return out;
}

void say(const ReadRemarks& remarks, const char* stage, const RunContext& ctx) {
  for (const std::string& warning : remarks.warnings) ctx.warn(stage, warning);
  for (const std::string& note : remarks.notes) ctx.note(stage, note);
}

/// Another file may have the same labels, but other names, colours and remarks.
void add_volume(const LoadedFiles& files, const Recipe& recipe, std::string& key) {
  if (recipe.source.phantom || !files.volume) return;
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
  if (recipe.source.phantom) {
    Result<LabelVolume> made = make_phantom(*recipe.source.phantom);
    if (!made) return made.error();
    result.source = std::make_shared<const LabelVolume>(std::move(made).value());
    result.digest = digest_of(*result.source);
  } else if (in.files.volume) {
    if (!(recipe.source.read == in.files.options))
      return usage_error(kVolumeStage,
                         "source: found a unit, precedence, background or frame by which the "
                         "volume was not read, expected it to be loaded again");
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
  result.prepared = std::move(prepared).value();
  out.put(std::move(result));
  return std::monostate{};
}

Status run_surface(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const LabelVolume& volume = volume_of(in);
  if (recipe.surface.method == ExtractMethod::kMarchingCubes)
    if (const std::size_t labels = count_labels(volume).size(); labels > 1)
      return usage_error(kSurfaceStage,
                         "surface.method: found marching_cubes for " + std::to_string(labels) +
                             " labels, expected auto or marching_tets, or all labels merged to one");
  return put(extract_surface(volume, recipe.surface, ctx), out);
}

Status run_smooth(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  return put(smooth_surface(in.get<SurfaceMesh>(Stage::kSurface), volume_of(in), recipe.smooth, ctx), out);
}

Status run_walls(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const PreparedVolume& volume = in.get<VolumeResult>(Stage::kVolume).prepared;
  WallsResult result;
  Walls& walls = result.walls;
  for (const ThicknessSize& rule : recipe.sizing.thickness) {
    const std::string name = "sizing.thickness[" + std::to_string(walls.size()) + "]";
    Result<WallField> wall =
        measure_wall({*volume.anatomy, *volume.prepared, in.get<SurfaceMesh>(Stage::kSmooth)},
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
  return put(
      build_sizing_field_of(in.files, recipe.sizing, volume_of(in), in.get<SurfaceMesh>(Stage::kSmooth),
                            in.get<WallsResult>(Stage::kWalls).walls, ctx),
      out);
}

Status run_layers(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext&) {
  LayersResult result{in.share<WallsResult>(Stage::kWalls), {}, {}};
  for (std::size_t w = 0; w < result.walls->walls.size(); ++w)
    if (recipe.sizing.thickness[w].layering == Layering::kExact) result.exact.push_back(w);
  const LabelVolume& volume = volume_of(in);
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

using LayeredSurface = Layered<SurfaceMesh>;
using LayeredTets = Layered<TetMesh>;

Status run_remesh(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const WallLayers& layers = in.get<LayersResult>(Stage::kLayers).layers;
  Result<SurfaceMesh> surface =
      remesh_surface(volume_of(in), in.get<SurfaceMesh>(Stage::kSmooth), in.get<SizingField>(Stage::kSizing),
                     recipe.remesh, ctx, layers);
  if (!surface) return surface.error();
  // The method adapt may have had to help out, without sheets.
  if (std::none_of(surface->sides.begin(), surface->sides.end(),
                   [&](const Sides& sides) { return layers.is_layer(sides[0]); })) {
    out.put(LayeredSurface{std::move(surface).value(), {}});
    return std::monostate{};
  }
  LayeredSurface result{merge_layers(*surface, layers), {}};
  result.with_layers = std::move(surface).value();
  out.put(std::move(result));
  return std::monostate{};
}

Status run_tetra(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const LayeredSurface& surface = in.get<LayeredSurface>(Stage::kRemesh);
  const SizingField& sizing = in.get<SizingField>(Stage::kSizing);
  const WallLayers& layers = in.get<LayersResult>(Stage::kLayers).layers;
  Result<TetMesh> filled = surface.with_layers
                               ? fill_tets(*surface.with_layers, sizing, recipe.tetra, ctx, layers)
                               : fill_tets(surface.mesh, sizing, recipe.tetra, ctx);
  if (!filled) {
    Error error = filled.error();
    error.where.stage = name_of(Stage::kRemesh);
    error.where.on = On::kTriangles;
    if (surface.with_layers)
      error.where.elements = merged_triangles(error.where.elements, *surface.with_layers, layers);
    return error;
  }
  LayeredTets result;
  if (surface.with_layers) {
    result.mesh = merge_layers(*filled, layers);
    result.with_layers = std::move(filled).value();
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
  const LayeredTets& tets = in.get<LayeredTets>(Stage::kTetra);
  const SurfaceMesh& smooth = in.get<SurfaceMesh>(Stage::kSmooth);
  const SizingField& sizing = in.get<SizingField>(Stage::kSizing);
  if (!tets.with_layers) return put(optimise_tets(tets.mesh, smooth, sizing, recipe.optimise, ctx), out);
  const auto& [walls, exact, layers] = in.get<LayersResult>(Stage::kLayers);
  const SurfaceMesh reference =
      with_layers(smooth, *in.get<LayeredSurface>(Stage::kRemesh).with_layers, layers);
  Result<TetMesh> optimised =
      optimise_tets(*tets.with_layers, reference, sizing, recipe.optimise, ctx, layers);
  if (!optimised) return optimised.error();
  const std::vector<std::size_t> worked_on = recipe.optimise.rounds > 0 ? exact : std::vector<std::size_t>{};
  return put(deepen_walls(merge_layers(std::move(optimised).value(), layers),
                          layered(walls->walls, worked_on, recipe), sizing, ctx),
             out);
}

Status run_transfer(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  return put(transfer_labels(in.get<TetMesh>(Stage::kOptimise), *in.get<VolumeResult>(Stage::kVolume).source,
                             recipe.transfer, ctx),
             out);
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
                      {volume_of(in), *in.get<VolumeResult>(Stage::kVolume).prepared.selected,
                       in.get<SurfaceMesh>(Stage::kSmooth), in.get<LayeredSurface>(Stage::kRemesh).mesh,
                       in.get<SizingField>(Stage::kSizing), walls},
                      recipe.quality, ctx);
  if (!report) {
    Error error = report.error();
    error.where.stage = name_of(Stage::kOptimise);
    error.where.on = On::kTets;
    return error;
  }
  for (std::size_t w = 0; w < counted.size(); ++w)
    warn_about_layers(counted[w], recipe.sizing.thickness[counted[w]].layering, report->layers[w], ctx);
  return put(std::move(report), out);
}

template <class T>
const T& value_of(const std::any& value) {
  return *std::any_cast<const std::shared_ptr<const T>&>(value);
}

template <class T>
json counts(const std::any& value) {
  return counts_of(value_of<T>(value));
}

template <class T>
void arrays(const std::any& value, StageArrays& out) {
  add_arrays(value_of<T>(value), out);
}

template <class T>
std::string digest(const std::any& value) {
  return digest_of(value_of<T>(value));
}

}  // namespace

const std::array<StageSpec, kStageCount>& stage_table() {
  static const std::array<StageSpec, kStageCount> table{{
      {.stage = Stage::kVolume,
       .name = kVolumeStage,
       .title = "Volume",
       .inputs = {},
       .reads = {"source.phantom", "source.unit", "source.precedence", "source.background", "source.frame",
                 "labels", "merge", "volume"},
       .add_files = add_volume,
       .run = run_volume,
       .counts = counts<VolumeResult>,
       .arrays = arrays<VolumeResult>,
       .digest = digest<VolumeResult>},
      {.stage = Stage::kSurface,
       .name = kSurfaceStage,
       .title = "Label surface",
       .inputs = {Stage::kVolume},
       .reads = {"surface"},
       .run = run_surface,
       .counts = counts<SurfaceMesh>,
       .arrays = arrays<SurfaceMesh>,
       .digest = digest<SurfaceMesh>},
      {.stage = Stage::kSmooth,
       .name = kSmoothStage,
       .title = "Smoothed surface",
       .inputs = {Stage::kVolume, Stage::kSurface},
       .reads = {"smooth"},
       .run = run_smooth,
       .counts = counts<SurfaceMesh>,
       .arrays = arrays<SurfaceMesh>,
       .digest = digest<SurfaceMesh>},
      {.stage = Stage::kWalls,
       .name = kWallsStage,
       .title = "Walls",
       .shown = false,
       .inputs = {Stage::kVolume, Stage::kSmooth},
       .reads = {"sizing.thickness[].wall", "sizing.thickness[].inner", "sizing.thickness[].layering"},
       .run = run_walls,
       .counts = counts<WallsResult>,
       .arrays = arrays<WallsResult>},
      {.stage = Stage::kSizing,
       .name = kSizingStage,
       .title = "Sizing field",
       .inputs = {Stage::kVolume, Stage::kSmooth, Stage::kWalls},
       .reads = {"sizing"},
       .add_files = add_side_volumes,
       .run = run_sizing,
       .counts = counts<SizingField>,
       .arrays = arrays<SizingField>},
      {.stage = Stage::kLayers,
       .name = kLayersStage,
       .title = "Layers of walls",
       .shown = false,
       .inputs = {Stage::kVolume, Stage::kWalls},
       .reads = {"sizing.thickness[].layers", "sizing.thickness[].layering"},
       .run = run_layers,
       .counts = counts<LayersResult>},
      {.stage = Stage::kRemesh,
       .name = kRemeshStage,
       .title = "Adapted surface",
       .inputs = {Stage::kVolume, Stage::kSmooth, Stage::kSizing, Stage::kLayers},
       .reads = {"remesh"},
       .run = run_remesh,
       .counts = counts<LayeredSurface>,
       .arrays = arrays<LayeredSurface>,
       .digest = digest<LayeredSurface>},
      {.stage = Stage::kTetra,
       .name = kTetraStage,
       .title = "Filled tetrahedra",
       .shown = false,
       .inputs = {Stage::kSizing, Stage::kLayers, Stage::kRemesh},
       .reads = {"tetra"},
       .run = run_tetra,
       .counts = counts<LayeredTets>,
       .arrays = arrays<LayeredTets>,
       .digest = digest<LayeredTets>},
      {.stage = Stage::kOptimise,
       .name = kOptimiseStage,
       .title = "Tetrahedra",
       .inputs = {Stage::kVolume, Stage::kSmooth, Stage::kSizing, Stage::kLayers, Stage::kRemesh,
                  Stage::kTetra},
       .reads = {"optimise"},
       .run = run_optimise,
       .counts = counts<TetMesh>,
       .arrays = arrays<TetMesh>,
       .digest = digest<TetMesh>},
      {.stage = Stage::kTransfer,
       .name = kTransferStage,
       .title = "Label transfer",
       .shown = false,
       .inputs = {Stage::kVolume, Stage::kOptimise},
       .reads = {"transfer"},
       .run = run_transfer,
       .counts = counts<LabelTransfer>,
       .arrays = arrays<LabelTransfer>},
      // What was transferred stands in the evidence, though no figure of it.
      {.stage = Stage::kQuality,
       .name = kQualityStage,
       .title = "Evidence",
       .inputs = {Stage::kVolume, Stage::kSmooth, Stage::kWalls, Stage::kSizing, Stage::kRemesh,
                  Stage::kOptimise, Stage::kTransfer},
       .reads = {"quality"},
       .run = run_quality,
       .counts = counts<QualityReport>,
       .arrays = arrays<QualityReport>},
      {.stage = Stage::kAnatomy,
       .name = kAnatomyStage,
       .title = "Anatomy",
       .shown = false,
       .inputs = {Stage::kVolume, Stage::kOptimise},
       .reads = {"physics.anatomy"},
       .run = run_anatomy,
       .counts = counts<AnatomyResult>,
       .arrays = arrays<AnatomyResult>},
      {.stage = Stage::kFibres,
       .name = kFibresStage,
       .title = "Fibres",
       .shown = false,
       .inputs = {Stage::kOptimise, Stage::kAnatomy},
       .reads = {"physics.fibres"},
       .run = run_fibres,
       .counts = counts<FibresResult>,
       .arrays = arrays<FibresResult>},
      {.stage = Stage::kTissue,
       .name = kTissueStage,
       .title = "Tissue",
       .shown = false,
       .inputs = {Stage::kOptimise, Stage::kTransfer, Stage::kFibres},
       .reads = {"physics.tissue", "physics.monodomain.integration", "physics.monodomain.consistent_mass",
                 "physics.monodomain.correct_speed"},
       .run = run_tissue,
       .counts = counts<TissueResult>,
       .arrays = arrays<TissueResult>},
      {.stage = Stage::kEikonal,
       .name = kEikonalStage,
       .title = "Activation map",
       .shown = false,
       .inputs = {Stage::kOptimise, Stage::kTissue},
       .reads = {"physics.stimuli"},
       .run = run_eikonal,
       .counts = counts<EikonalResult>,
       .arrays = arrays<EikonalResult>,
       .digest = digest<EikonalResult>},
      {.stage = Stage::kMonodomain,
       .name = kMonodomainStage,
       .title = "Excitation wave",
       .shown = false,
       .inputs = {Stage::kOptimise, Stage::kTissue},
       .reads = {"physics.stimuli", "physics.monodomain"},
       .start = start_monodomain,
       .counts = counts<Trajectory>,
       .arrays = arrays<Trajectory>,
       .digest = digest<Trajectory>},
      {.stage = Stage::kDiffusion,
       .name = kDiffusionStage,
       .title = "Heat diffusion",
       .shown = false,
       .inputs = {Stage::kOptimise},
       .reads = {"physics.diffusion"},
       .start = start_diffusion,
       .counts = counts<Trajectory>,
       .arrays = arrays<Trajectory>,
       .digest = digest<Trajectory>},
  }};
  return table;
}

}  // namespace voxtet
