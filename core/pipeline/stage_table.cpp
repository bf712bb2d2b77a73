// The table of stages: what each reads, and what it runs.
#include <nlohmann/json.hpp>

#include "pipeline/results/describe_results.h"
#include "pipeline/results/stage_results.h"
#include "pipeline/simulations/diffusion_stage.h"
#include "pipeline/simulations/mechanics_stage.h"
#include "pipeline/simulations/monodomain_stage.h"
#include "pipeline/stages/heart_stages.h"
#include "pipeline/stages/mesh_stages.h"
#include "pipeline/stages/stage.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using nlohmann::json;
using BuiltSurface = Built<SurfaceMesh>;
using BuiltTets = Built<TetMesh>;

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
       .reads = {"source.phantom", "source.inline", "source.unit", "source.precedence", "source.background",
                 "source.frame", "source.threshold", "labels", "merge", "volume"},
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
       .counts = counts<BuiltSurface>,
       .arrays = arrays<BuiltSurface>,
       .digest = digest<BuiltSurface>},
      {.stage = Stage::kSmooth,
       .name = kSmoothStage,
       .title = "Smoothed surface",
       .inputs = {Stage::kVolume, Stage::kSurface},
       .reads = {"smooth"},
       .run = run_smooth,
       .counts = counts<BuiltSurface>,
       .arrays = arrays<BuiltSurface>,
       .digest = digest<BuiltSurface>},
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
       .counts = counts<BuiltSurface>,
       .arrays = arrays<BuiltSurface>,
       .digest = digest<BuiltSurface>},
      {.stage = Stage::kTetra,
       .name = kTetraStage,
       .title = "Filled tetrahedra",
       .shown = false,
       .inputs = {Stage::kVolume, Stage::kSizing, Stage::kLayers, Stage::kRemesh},
       .reads = {"tetra"},
       .run = run_tetra,
       .counts = counts<BuiltTets>,
       .arrays = arrays<BuiltTets>,
       .digest = digest<BuiltTets>},
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
      {.stage = Stage::kMechanics,
       .name = kMechanicsStage,
       .title = "Beating heart",
       .shown = false,
       .inputs = {Stage::kOptimise, Stage::kAnatomy, Stage::kFibres, Stage::kEikonal, Stage::kMonodomain},
       .wants = mechanics_wants,
       .reads = {"physics.mechanics"},
       .start = start_mechanics,
       .counts = counts<MechanicsResult>,
       .arrays = arrays<MechanicsResult>,
       .digest = digest<MechanicsResult>},
  }};
  return table;
}

}  // namespace voxtet
