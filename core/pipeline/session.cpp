#include "pipeline/session.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "base/digest.h"
#include "pipeline/admission.h"
#include "pipeline/memory.h"
#include "pipeline/stages/side_sizes.h"
#include "pipeline/version/engine_version.h"

namespace voxtet {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// `stage` after everything that it needs.
void collect(Stage stage, const Recipe& recipe, const LoadedFiles& files, std::vector<Stage>& order) {
  for (const Stage input : inputs_of(stage, recipe, files)) collect(input, recipe, files, order);
  if (std::find(order.begin(), order.end(), stage) == order.end()) order.push_back(stage);
}

}  // namespace

Status Session::load_volume(const VolumeFile& file, const ReadOptions& options) {
  ReadRemarks remarks;
  if (is_mesh_name(file.name)) {
    Result<OpenedMesh> mesh = open_mesh(file, remarks.warnings);
    if (!mesh) return mesh.error();
    files_.volume = std::make_shared<const LabelVolume>(voxels_of(mesh->mesh));
    files_.digest = digest_of(*mesh);
    files_.mesh = std::make_shared<const OpenedMesh>(std::move(mesh).value());
  } else {
    Result<LabelVolume> read = read_volume(file, options, &remarks);
    if (!read) return read.error();
    files_.volume = std::make_shared<const LabelVolume>(std::move(read).value());
    files_.digest = digest_of(*files_.volume);
    files_.mesh.reset();
  }
  files_.options = options;
  files_.remarks = std::move(remarks);
  recipe_.source = {};
  recipe_.source.file = FileSource{file.name, files_.digest, ""};
  recipe_.source.read = options;
  files_changed();
  return std::monostate{};
}

Status Session::load_mask(const VolumeFile& file) {
  ReadRemarks remarks;
  Result<LabelVolume> read = read_volume(file, {}, &remarks);
  if (!read) return read.error();
  std::string digest = digest_of(*read);
  files_.masks[file.name] = {std::move(read).value(), std::move(digest), std::move(remarks)};
  files_changed();
  return std::monostate{};
}

Status Session::load_size_image(const VolumeFile& file) {
  ReadRemarks remarks;
  Result<ScalarVolume> read = read_scalar_volume(file, &remarks);
  if (!read) return read.error();
  std::string digest = digest_of(*read);
  files_.images[file.name] = {std::move(read).value(), std::move(digest), std::move(remarks)};
  files_changed();
  return std::monostate{};
}

void Session::files_changed() {
  end();
  keys_ = keys_of(recipe_, files_);
}

Status Session::set_recipe(const Recipe& recipe) {
  const std::optional<FileSource>& file = recipe.source.file;
  if (file && files_.volume && !file->sha256.empty() && file->sha256 != files_.digest)
    return Error{ErrorCode::kBadInput,
                 "session",
                 "source.file: the case was made with '" + file->name + "' of digest " +
                     file->sha256.substr(0, 12) + "..., the volume loaded has " +
                     files_.digest.substr(0, 12) + "...: these are different volumes",
                 {}};
  end();
  recipe_ = recipe;
  keys_ = keys_of(recipe_, files_);
  return std::monostate{};
}

const LabelVolume* Session::source_volume() const {
  const VolumeResult* found = result<VolumeResult>(Stage::kVolume);
  return found ? found->source.get() : nullptr;
}

std::string Session::source_digest() const {
  const VolumeResult* found = result<VolumeResult>(Stage::kVolume);
  return found ? found->digest : "";
}

const LabelVolume* Session::selected_volume() const {
  const VolumeResult* found = result<VolumeResult>(Stage::kVolume);
  return found ? found->prepared.selected.get() : nullptr;
}

const LabelVolume* Session::volume() const {
  const VolumeResult* found = result<VolumeResult>(Stage::kVolume);
  return found ? found->prepared.prepared.get() : nullptr;
}

std::vector<LabelInfo> Session::label_infos() const {
  return with_legend(volume()->infos, recipe_.legend);
}

const Walls& Session::walls() const {
  static const Walls none;
  const auto* found = result<WallsResult>(Stage::kWalls);
  return found ? found->walls : none;
}

const SurfaceMesh* Session::surface_of(Stage stage) const {
  const auto* found = result<Built<SurfaceMesh>>(stage);
  return found ? &found->mesh : nullptr;
}

const TetMesh* Session::filled() const {
  const auto* found = result<Built<TetMesh>>(Stage::kTetra);
  return found ? &found->mesh : nullptr;
}

const TetMesh* Session::mesh() const {
  const TetMesh* optimised = result<TetMesh>(Stage::kOptimise);
  return optimised ? optimised : filled();
}

Result<SizingField> Session::size_by(const SizingParams& sizing, RunContext& ctx) const {
  return build_sizing_field_of(files_, sizing, *volume(), *smooth(), walls(), ctx);
}

const StageRecord& Session::record(Stage stage) const {
  static const StageRecord none;
  const StageResult* found = current(stage);
  return found ? found->record : none;
}

bool Session::cached(Stage stage) const {
  return cached_[static_cast<std::size_t>(stage)];
}

std::vector<std::string> Session::warnings() const {
  std::vector<std::string> all;
  for (const StageSpec& spec : stage_table()) {
    const StageRecord& of_stage = record(spec.stage);
    all.insert(all.end(), of_stage.warnings.begin(), of_stage.warnings.end());
  }
  return all;
}

Status Session::run(Stage last, RunContext& ctx) {
  begin(last);
  for (;;) {
    const Result<RunProgress> progress = advance(std::numeric_limits<double>::infinity(), ctx);
    if (!progress) return progress.error();
    if (progress->done) return std::monostate{};
  }
}

void Session::begin(Stage last) {
  end();
  store_.trim(keys_);
  collect(last, recipe_, files_, plan_);
  std::reverse(plan_.begin(), plan_.end());
}

void Session::end() {
  save_state();
  drop_run();
}

void Session::drop_run() {
  plan_.clear();
  running_.reset();
}

void Session::save_state() {
  if (!running_ || !running_->task) return;
  Result<Bytes> state = running_->task->checkpoint();
  if (state && !state->empty()) saved_ = {plan_.back(), *std::move(state), false};
}

Result<Bytes> Session::saved_state() {
  save_state();
  if (!saved_) return usage_error("session", "state: found no simulation, expected one that has begun");
  return saved_->state;
}

void Session::resume_from(Stage stage, Bytes state) {
  saved_ = {stage, std::move(state), true};
}

Status Session::resume(Stage stage, StageTask& task) {
  if (!saved_ || saved_->stage != stage) return std::monostate{};
  Status resumed = task.resume(saved_->state);
  const bool asked = std::exchange(saved_->asked, false);
  return asked ? resumed : Status(std::monostate{});
}

Result<Stimulus> Session::stimulate(const Stimulus& stimulus) {
  if (!running_ || !running_->task)
    return usage_error("session", "stimulus: found no simulation under way, expected one");
  Result<Stimulus> given = running_->task->stimulate(stimulus);
  if (!given) return given.error();
  recipe_.physics->stimuli.push_back(*given);
  keys_ = keys_of(recipe_, files_);
  return given;
}

Result<RunProgress> Session::advance(double budget_ms, RunContext& ctx) {
  if (plan_.empty()) return usage_error("session", "nothing has begun: begin a stage first");
  const Clock::time_point start = Clock::now();
  RunProgress progress;
  do {
    progress = {false, plan_.back(), 0};
    Result<bool> done = work_guarded(ctx);
    if (!done) {
      if (done.error().code == ErrorCode::kCancelled) save_state();
      drop_run();
      return done.error();
    }
    progress.fraction = *done ? 1 : running_->task->fraction();
    if (!*done) continue;
    running_.reset();
    plan_.pop_back();
  } while (!plan_.empty() && 1000 * seconds_since(start) < budget_ms);
  progress.done = plan_.empty();
  return progress;
}

Status Session::admit(const StageSpec& spec, RunContext& ctx) {
  for (const Admission& admission : admissions()) {
    if (admission.stage != spec.stage) continue;
    std::string asked = fields_text(recipe_to_json(recipe_), admission.reads);
    for (const Stage input : inputs_of(spec.stage, recipe_, files_))
      asked += keys_[static_cast<std::size_t>(input)];
    std::string& admitted = admitted_[static_cast<std::size_t>(spec.stage)];
    if (admitted == asked) continue;
    if (Status passes = admission.admit(*this, ctx); !passes) return passes;
    admitted = asked;
  }
  return std::monostate{};
}

StageInputs Session::results_for(const StageSpec& spec) const {
  StageInputs inputs(files_);
  for (const Stage input : inputs_of(spec.stage, recipe_, files_)) inputs.add(input, current(input)->value);
  return inputs;
}

Result<bool> Session::work_guarded(RunContext& ctx) {
  const std::string name = name_of(plan_.back());
  try {
    return work(ctx);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, name, "out of memory in stage " + name, {}};
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, name, "stage " + name + " failed: " + error.what(), {}};
  }
}

Result<bool> Session::work(RunContext& ctx) {
  const StageSpec& spec = spec_of(plan_.back());
  const std::string name(spec.name);
  const Clock::time_point start = Clock::now();
  if (!has_place(spec.stage, recipe_, files_))
    return usage_error(name, "source.file: found the mesh '" + recipe_.source.file->name +
                                 "', which is taken as it is, expected a volume of labels");
  if (!running_) {
    if (Status admitted = admit(spec, ctx); !admitted) return admitted.error();
    bool& reused = cached_[static_cast<std::size_t>(spec.stage)];
    reused = is_current(spec.stage);
    if (reused) return true;
    running_.emplace();
    reset_peak_memory();
    ctx.progress(name, 0);
  }
  if (ctx.cancelled()) return cancelled_error("session");
  StageRecord& record = running_->record;
  RunContext watched = ctx;
  watched.on_warning = [&](const std::string& from, const std::string& message) {
    record.warnings.push_back(from + ": " + message);
    ctx.warn(from, message);
  };
  watched.on_note = [&](const std::string& from, const std::string& message) {
    record.notes.push_back(message);
    ctx.note(from, message);
  };
  if (spec.run) {
    if (Status done = spec.run(results_for(spec), recipe_, running_->output, watched); !done)
      return done.error();
  } else {
    if (!running_->task) {
      Result<std::unique_ptr<StageTask>> task = spec.start(results_for(spec), recipe_);
      if (!task) return task.error();
      if (Status resumed = resume(spec.stage, **task); !resumed) return resumed.error();
      running_->task = std::move(task).value();
    }
    const Result<bool> done = running_->task->step(watched);
    record.seconds += seconds_since(start);
    if (!done) return done.error();
    ctx.progress(name, running_->task->fraction());
    if (!*done) return false;
    save_state();
    running_->task->finish(running_->output);
  }
  if (spec.run) record.seconds = seconds_since(start);
  record.peak_mb = peak_memory_mb();
  record.key = keys_[static_cast<std::size_t>(spec.stage)];
  store_.keep(spec.stage, std::make_shared<const StageResult>(StageResult{
                              std::move(running_->output.value), running_->output.bytes, std::move(record)}));
  ctx.progress(name, 1);
  return true;
}

}  // namespace voxtet
