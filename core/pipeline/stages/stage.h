// The stages in their order, and the table that describes them.
#pragma once

#include <any>
#include <array>
#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/bytes.h"
#include "pipeline/results/stage_arrays.h"
#include "pipeline/sources/loaded_files.h"
#include "pipeline/sources/source_volume.h"
#include "recipe/recipe.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/stimulus.h"

namespace voxtet {

/// In the order in which they run; the number is the row of stage_table().
enum class Stage {
  kVolume,
  kSurface,
  kSmooth,
  kWalls,
  kSizing,
  kLayers,
  kRemesh,
  kTetra,
  kOptimise,
  kTransfer,
  kQuality,
  kAnatomy,
  kFibres,
  kTissue,
  kEikonal,
  kMonodomain,
  kDiffusion,
  kMechanics
};
inline constexpr int kStageCount = 18;

/// For each stage, the digest of everything that it depends on.
using StageKeys = std::array<std::string, kStageCount>;

/// The results that a stage reads: those named in its row of stage_table(), and no others.
class StageInputs {
 public:
  explicit StageInputs(const LoadedFiles& files) : files(files) {}

  void add(Stage stage, const std::any& value) { values_[static_cast<std::size_t>(stage)] = value; }
  /// The value of a stage that the row names and that runs, of its own type (stage_results.h).
  template <class T>
  const std::shared_ptr<const T>& share(Stage stage) const {
    return std::any_cast<const std::shared_ptr<const T>&>(values_[static_cast<std::size_t>(stage)]);
  }
  template <class T>
  const T& get(Stage stage) const {
    return *share<T>(stage);
  }

  const LoadedFiles& files;

 private:
  std::array<std::any, kStageCount> values_;
};

/// The result of a stage.
class StageOutput {
 public:
  template <class T>
  void put(T value) {
    bytes = memory_bytes(value);
    this->value = std::make_shared<const T>(std::move(value));
  }

  std::any value;
  std::size_t bytes = 0;
};

/// Work that is done in short steps, so that its caller can handle other requests between them.
class StageTask {
 public:
  virtual ~StageTask() = default;
  /// Works for some milliseconds; true when all is done. Emits frames by ctx.snapshot.
  virtual Result<bool> step(RunContext& ctx) = 0;
  virtual double fraction() const = 0;  ///< part of the work that is done
  virtual void finish(StageOutput& out) = 0;

  /// One more stimulus, `start_ms` after now; it is given back with its time in the run. A run whose recipe
  /// had it from the beginning gives the same result. Errors: kUsage where the stage has no stimuli, and
  /// where it touches no point.
  virtual Result<Stimulus> stimulate(Stimulus stimulus);
  /// All that a run with the same inputs, of this recipe or of one that differs in its end or in what comes
  /// later, needs to go on from here; empty where the stage cannot. May work for some milliseconds.
  virtual Result<Bytes> checkpoint() { return Bytes{}; }
  /// Goes on from a checkpoint; to be called before the first step. Nothing changes on failure. Errors:
  /// kBadInput for bytes that are none, kUsage naming what differs.
  virtual Status resume(const Bytes& checkpoint);
};

/// Everything that the pipeline knows about a stage. Its key is made of its inputs and of the fields and
/// files that it reads: with the same key its result is the same.
struct StageSpec {
  Stage stage;
  std::string_view name;   ///< as it stands in reports, recipes and links
  std::string_view title;  ///< for people
  bool shown = true;       ///< shown in the app; one that is not runs automatically before the next that is
  std::vector<Stage> inputs;
  /// Whether a recipe makes the stage read one of them. Null: it reads all.
  bool (*wants)(Stage input, const Recipe&) = nullptr;
  /// Fields of the recipe by their path; "list[].field" is that field of each entry of a list.
  std::vector<std::string_view> reads;
  /// Adds the digests of files that the stage reads. Null: it reads none.
  void (*add_files)(const LoadedFiles&, const Recipe&, std::string& key) = nullptr;
  /// Runs the stage at once. One of `run` and `start` is given.
  Status (*run)(const StageInputs&, const Recipe&, StageOutput&, RunContext&) = nullptr;
  /// Starts a stage that runs in steps. The inputs' values outlive the task.
  Result<std::unique_ptr<StageTask>> (*start)(const StageInputs&, const Recipe&) = nullptr;
  /// Makes {counts} of the report from the stage's value.
  nlohmann::json (*counts)(const std::any& value) = nullptr;
  /// Adds the arrays that a viewer may ask for. Null: there are none.
  void (*arrays)(const std::any& value, StageArrays& out) = nullptr;
  /// Digest of the stage's value. Null: its key is used instead.
  std::string (*digest)(const std::any& value) = nullptr;
};

const std::array<StageSpec, kStageCount>& stage_table();
inline const StageSpec& spec_of(Stage stage) {
  return stage_table()[static_cast<std::size_t>(stage)];
}
inline std::string name_of(Stage stage) {
  return std::string(spec_of(stage).name);
}

/// The mesh that a recipe's source is; null where it is an image.
inline const OpenedMesh* opened_mesh(const Recipe& recipe, const LoadedFiles& files) {
  return needs_file(recipe.source) ? files.mesh.get() : nullptr;
}
/// Whether a stage has a place in a case: where its source is a mesh, no stage makes one.
bool has_place(Stage stage, const Recipe& recipe, const LoadedFiles& files);
/// Those of a stage's inputs that have one and that the recipe makes it read.
std::vector<Stage> inputs_of(Stage stage, const Recipe& recipe, const LoadedFiles& files);

/// Whether a run to `stage` gives the result of `input`.
bool needs(Stage stage, Stage input);

/// Whether a run to `stage` gives fibres: it needs them, and the recipe asks for them.
inline bool gives_fibres(const Recipe& recipe, Stage stage) {
  return recipe.physics && recipe.physics->fibres && needs(stage, Stage::kFibres);
}

/// The stage with this name. Errors: kUsage, with a list of the names.
Result<Stage> stage_of(std::string_view name);

/// The key of every stage for a recipe and the files that were loaded.
StageKeys keys_of(const Recipe& recipe, const LoadedFiles& files);
/// The part of a recipe's JSON at these paths (StageSpec::reads), as text.
std::string fields_text(const nlohmann::json& recipe, const std::vector<std::string_view>& paths);

/// {name, title, shown, inputs, reads, in_steps} of every stage, in order.
nlohmann::json stages_schema();

}  // namespace voxtet
