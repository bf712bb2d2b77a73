// The only place that knows the order of the stages: one case, its results, and what can be reused.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/wall_layers.h"
#include "io/read_volume.h"
#include "recipe/recipe.h"
#include "types/label_lookup.h"
#include "types/quality_report.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"
#include "types/wall_field.h"
#include "volume/prepare_volume.h"

namespace voxtet {

/// Version of the engine, as it stands in reports and links.
std::string engine_version();

enum class Stage { kVolume, kSurface, kSmooth, kSizing, kRemesh, kTetra, kOptimise, kLookup, kQuality };
inline constexpr int kStageCount = 9;
inline constexpr std::array<std::string_view, kStageCount> kStageNames{
    "volume", "surface", "smooth", "sizing", "remesh", "tetra", "optimise", "lookup", "quality"};
/// Stage of a name. Errors: kUsage listing the names.
Result<Stage> stage_of(std::string_view name);

/// What one stage did.
struct StageRecord {
  std::string key;     ///< digest of everything the stage depends on
  double seconds = 0;  ///< wall time of the run that made the result
  double peak_mb =
      0;  ///< native: peak resident memory during the stage; wasm: size of the linear memory after it
  bool cached = false;  ///< the last run() reused an earlier result
  std::vector<std::string> warnings, notes;
};

/// A case being meshed. Results stay valid until a run replaces them; each is null before its stage has run.
class Session {
 public:
  /// A volume beside the one that is meshed, the digest of it, and what its reader warned of.
  template <class Volume>
  struct SideVolume {
    Volume volume;
    std::string digest;
    std::vector<std::string> warnings;
  };

  /// Takes the volume of a file; the recipe's source becomes that file. Nothing changes on failure.
  Status load_volume(const VolumeFile& file);

  /// Takes what an entry of sizing.masks or sizing.images names by the file's name; the recipe stays as it
  /// is. A file of the same name is replaced.
  Status load_mask(const VolumeFile& file);
  Status load_size_image(const VolumeFile& file);
  /// By the file's name: those that were taken.
  const std::map<std::string, SideVolume<LabelVolume>>& masks() const { return masks_; }
  const std::map<std::string, SideVolume<ScalarVolume>>& size_images() const { return images_; }

  /// Replaces the recipe. A `file` source keeps the volume that load_volume gave, and must match its digest.
  Status set_recipe(const Recipe& recipe);
  const Recipe& recipe() const { return recipe_; }

  /// Runs `last` and whatever it needs that is not there yet. On failure earlier results stay.
  Status run(Stage last, RunContext& ctx);

  const LabelVolume* source_volume() const { return source_.get(); }   ///< all labels, as read
  const std::string& source_digest() const { return source_digest_; }  ///< digest_of(*source_volume())
  /// The labels to be meshed on the source's voxels: what fidelity is measured against.
  const LabelVolume* selected_volume() const { return volume_.selected.get(); }
  /// The labels to be meshed, thick slices interpolated and specks removed: what the later stages see. Its
  /// axes are in the order of mesh_order(), not in the source's.
  const LabelVolume* volume() const { return volume_.prepared.get(); }
  /// All labels of the source on the grid of volume().
  const LabelVolume* anatomy() const { return volume_.anatomy.get(); }
  const SurfaceMesh* surface() const { return surface_ ? &*surface_ : nullptr; }
  const SurfaceMesh* smooth() const { return smooth_ ? &*smooth_ : nullptr; }
  const SizingField* sizing() const { return sizing_ ? &*sizing_ : nullptr; }
  /// The walls of the recipe's sizing.thickness, in its order.
  const std::vector<WallField>& walls() const { return walls_; }
  const SurfaceMesh* remeshed() const { return remeshed_ ? &*remeshed_ : nullptr; }
  const TetMesh* filled() const { return filled_ ? &*filled_ : nullptr; }
  /// The optimised tetrahedra; while there are none, also when kOptimise failed, those that fill the surface.
  const TetMesh* mesh() const { return optimised_ ? &*optimised_ : filled(); }
  const LabelLookUp* lookup() const { return lookup_ ? &*lookup_ : nullptr; }
  const QualityReport* quality() const { return quality_ ? &*quality_ : nullptr; }
  /// Whether the result of a stage is at hand, and that of the recipe as it stands.
  bool is_current(Stage stage) const {
    return !record(stage).key.empty() && record(stage).key == key_of(stage);
  }
  /// Whether what stages before kSizing gave, and walls measured, are those of the recipe as it stands.
  bool may_size() const;
  /// The field of sizes with the recipe's masks, images and walls, beside what stages have given. Needs
  /// may_size().
  Result<SizingField> size_by(const SizingParams& sizing, RunContext& ctx) const;
  const StageRecord& record(Stage stage) const { return records_[static_cast<std::size_t>(stage)]; }
  std::vector<std::string> warnings() const;  ///< of all results at hand, in the order of stages

 private:
  std::string key_of(Stage stage) const;
  std::string key_of_walls() const;
  Status run_stage(Stage stage, RunContext& ctx);
  /// Numbers of the walls whose layers are to be exact.
  std::vector<std::size_t> exact_walls() const;
  /// Walls by their numbers, with the layers that the recipe wishes.
  std::vector<LayeredWall> layered(const std::vector<std::size_t>& walls) const;
  Status run_volume(RunContext& ctx);
  /// Measures the walls of the recipe, which takes seconds: only where those that stand are not the same.
  Status measure_walls(RunContext& ctx);
  Status run_surface(RunContext& ctx);
  Status run_sizing(RunContext& ctx);
  Status run_remesh(RunContext& ctx);
  Status run_tetra(RunContext& ctx);
  Status run_optimise(RunContext& ctx);
  /// Where fewer than nearly all of a wall has the exact layers that were wished.
  void warn_about_layers(std::size_t wall, const LayerCount& found, RunContext& ctx) const;
  Status run_quality(RunContext& ctx);
  void forget(Stage stage);

  Recipe recipe_;
  std::map<std::string, SideVolume<LabelVolume>> masks_;
  std::map<std::string, SideVolume<ScalarVolume>> images_;
  std::shared_ptr<const LabelVolume> file_volume_;
  std::string file_digest_;
  std::vector<std::string> file_warnings_;  ///< of its reader
  std::shared_ptr<const LabelVolume> source_;
  std::string source_digest_;
  PreparedVolume volume_;
  std::optional<SurfaceMesh> surface_, smooth_, remeshed_;
  std::vector<WallField> walls_;
  std::string walls_key_;  ///< of what walls_ were measured on; empty: not measured
  std::optional<SizingField> sizing_;
  WallLayers layers_;  ///< of walls whose layers are to be exact
  /// With a label for each layer; only where there are layers.
  std::optional<SurfaceMesh> layered_surface_;
  std::optional<TetMesh> layered_tets_;
  std::optional<TetMesh> filled_, optimised_;
  std::optional<LabelLookUp> lookup_;
  std::optional<QualityReport> quality_;
  std::array<StageRecord, kStageCount> records_;
};

}  // namespace voxtet
