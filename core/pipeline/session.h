// One case: its files, its recipe, the results of its stages, and which of them can be used again.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/volume/read_volume.h"
#include "pipeline/result_store.h"
#include "pipeline/results/stage_results.h"
#include "pipeline/sources/loaded_files.h"
#include "pipeline/stages/stage.h"
#include "recipe/recipe.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"
#include "volume/prepare_volume.h"
#include "walls/wall_field.h"
#include "walls/wall_layers.h"

namespace voxtet {

/// How far a run is.
struct RunProgress {
  bool done = false;
  Stage stage = Stage::kVolume;  ///< the stage under way; when done, the last one
  double fraction = 0;           ///< of that stage
};

/// A case being meshed. Its results are those of the current recipe; each is null until its stage has run.
/// Results of earlier recipes are kept, as far as the memory set aside for them goes, and are used again when
/// a recipe returns to them.
class Session {
 public:
  /// `spare_bytes`: memory for results that the current recipe does not need.
  explicit Session(std::size_t spare_bytes = kSpareBytes) : store_(spare_bytes) {}

  /// Takes the volume of a file, read by these options; the recipe's source becomes that file with them. Or a
  /// mesh of tetrahedra that was made elsewhere (sources/opened_mesh.h): then kOptimise gives that mesh, with
  /// the labels that the recipe keeps, the stages that would make one have no place, and the evidence is of
  /// the mesh alone. Nothing changes on failure.
  Status load_volume(const VolumeFile& file, const ReadOptions& options = {});

  /// Takes a file that an entry of sizing.masks or sizing.images refers to by its name; the recipe stays as
  /// it is. A file of the same name is replaced.
  Status load_mask(const VolumeFile& file);
  Status load_size_image(const VolumeFile& file);
  const LoadedFiles& files() const { return files_; }
  /// The mesh that the recipe's source is; null where it is an image.
  const OpenedMesh* opened_mesh() const { return voxtet::opened_mesh(recipe_, files_); }

  /// Replaces the recipe and ends a run that is under way. A `file` source keeps the volume that load_volume
  /// gave, and must match its digest; a run refuses it where it was read by other options.
  Status set_recipe(const Recipe& recipe);
  const Recipe& recipe() const { return recipe_; }

  /// Runs `last` and every stage it needs that has no result yet. On failure earlier results stay.
  Status run(Stage last, RunContext& ctx);
  /// The same in parts: begin() plans, each advance() works for about `budget_ms` and returns. A stage that
  /// cannot be cut is done in one advance(). A run ends when it is done, by an error, end(), set_recipe(),
  /// loading a file or the next begin(); complete results stay. Errors of advance(): kUsage if no run has
  /// begun; those of the stages.
  void begin(Stage last);
  Result<RunProgress> advance(double budget_ms, RunContext& ctx);
  void end();

  /// A stimulus for the simulation under way, `start_ms` after now. It becomes a part of the recipe, with its
  /// time in the run, which is given back; the run goes on, and its result is that of the new recipe. Errors:
  /// kUsage where no simulation is under way, and where it touches no point that conducts.
  Result<Stimulus> stimulate(const Stimulus& stimulus);
  /// The state of a simulation: of the one under way, else of the last one, which was ended or came to its
  /// end. Errors: kUsage where there was none.
  Result<Bytes> saved_state();
  /// The next simulation of that stage goes on from it. Without this one goes on from the last if it may:
  /// where only the end, or what comes later, has changed. The result is the same as from the start. Errors,
  /// of the run: those of StageTask::resume().
  void resume_from(Stage stage, Bytes state);

  /// The value of a stage, of that stage's own type (stage_results.h).
  template <class T>
  const T* result(Stage stage) const {
    const StageResult* found = current(stage);
    return found ? std::any_cast<const std::shared_ptr<const T>&>(found->value).get() : nullptr;
  }
  const LabelVolume* source_volume() const;  ///< all labels, as read
  std::string source_digest() const;         ///< of the mesh that was loaded, else of *source_volume()
  /// The labels to be meshed, on the source's voxels: the reference for fidelity.
  const LabelVolume* selected_volume() const;
  /// The labels to be meshed, thick slices interpolated and small components removed: what the later stages
  /// see. Its axes are in the order of mesh_order(), not in that of the source.
  const LabelVolume* volume() const;
  std::vector<LabelInfo> label_infos() const;  ///< names and colours of volume(), with the recipe's legend
  const SurfaceMesh* surface() const { return surface_of(Stage::kSurface); }
  const SurfaceMesh* smooth() const { return surface_of(Stage::kSmooth); }
  const SizingField* sizing() const { return result<SizingField>(Stage::kSizing); }
  const Walls& walls() const;  ///< none before they are measured
  const SurfaceMesh* remeshed() const { return surface_of(Stage::kRemesh); }
  const TetMesh* filled() const;
  /// The optimised tetrahedra. Until there are any, also if kOptimise failed, those that fill the surface.
  const TetMesh* mesh() const;
  const LabelTransfer* transfer() const { return result<LabelTransfer>(Stage::kTransfer); }
  const QualityReport* quality() const { return result<QualityReport>(Stage::kQuality); }
  const EikonalResult* eikonal() const { return result<EikonalResult>(Stage::kEikonal); }
  const Trajectory* monodomain() const { return result<Trajectory>(Stage::kMonodomain); }
  const MechanicsResult* mechanics() const { return result<MechanicsResult>(Stage::kMechanics); }
  const Trajectory* diffusion() const { return result<Trajectory>(Stage::kDiffusion); }

  /// Whether the result of a stage is at hand.
  bool is_current(Stage stage) const { return current(stage) != nullptr; }
  /// Whether everything that the sizing field is made from is there.
  bool may_size() const { return is_current(Stage::kWalls); }
  /// The sizing field for other rules, with the recipe's masks, images and walls; no result of a stage
  /// changes. Needs may_size().
  Result<SizingField> size_by(const SizingParams& sizing, RunContext& ctx) const;
  /// The record of a stage's result. Its key is empty if the stage has no result.
  const StageRecord& record(Stage stage) const;
  bool cached(Stage stage) const;  ///< the last run reused an earlier result
  const StageResult* current(Stage stage) const {
    return store_.find(stage, keys_[static_cast<std::size_t>(stage)]);
  }
  std::vector<std::string> warnings() const;  ///< of all results at hand, in the order of stages

 private:
#ifdef __EMSCRIPTEN__
  static constexpr std::size_t kSpareBytes = std::size_t{400} << 20U;
#else
  static constexpr std::size_t kSpareBytes = std::size_t{1} << 30U;
#endif
  /// A stage under way.
  struct Running {
    std::unique_ptr<StageTask> task;  ///< null: it has not begun
    StageRecord record;
    StageOutput output;
  };

  const SurfaceMesh* surface_of(Stage stage) const;
  void files_changed();
  Status admit(const StageSpec& spec, RunContext& ctx);
  StageInputs results_for(const StageSpec& spec) const;
  /// A simulation that has come to some time.
  struct SavedState {
    Stage stage;
    Bytes state;
    bool asked;  ///< by resume_from()
  };
  void save_state();
  void drop_run();
  Status resume(Stage stage, StageTask& task);
  /// Works on the stage under way; true when it is complete.
  Result<bool> work(RunContext& ctx);
  Result<bool> work_guarded(RunContext& ctx);

  LoadedFiles files_;
  Recipe recipe_;
  StageKeys keys_ = keys_of(recipe_, files_);
  ResultStore store_;
  std::array<std::string, kStageCount> admitted_;  ///< by stage: what admit() has let pass
  std::array<bool, kStageCount> cached_{};
  std::vector<Stage> plan_;  ///< what is still to be done, the next one last
  std::optional<Running> running_;
  std::optional<SavedState> saved_;
};

}  // namespace voxtet
