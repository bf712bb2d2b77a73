#include "pipeline/session.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <stdexcept>

#include "geometry/digest.h"
#include "pipeline/memory.h"

namespace voxtet {
namespace {

/// Stages whose results a stage reads.
std::vector<Stage> inputs_of(Stage stage) {
  switch (stage) {
    case Stage::kVolume: return {};
    case Stage::kSurface: return {Stage::kVolume};
    case Stage::kSmooth: return {Stage::kSurface};
    case Stage::kSizing: return {Stage::kVolume, Stage::kSmooth};
    case Stage::kRemesh: return {Stage::kVolume, Stage::kSmooth, Stage::kSizing};
    case Stage::kTetra: return {Stage::kRemesh, Stage::kSizing};
    case Stage::kOptimise: return {Stage::kSmooth, Stage::kSizing, Stage::kTetra};
    case Stage::kLookup: return {Stage::kVolume, Stage::kOptimise};
    case Stage::kQuality: return {Stage::kSmooth, Stage::kOptimise, Stage::kLookup};
  }
  return {};
}

void collect(Stage stage, std::vector<Stage>& order) {
  for (const Stage input : inputs_of(stage)) collect(input, order);
  if (std::find(order.begin(), order.end(), stage) == order.end()) order.push_back(stage);
}

}  // namespace

std::string engine_version() {
  return VOXTET_VERSION;
}

Result<Stage> stage_of(std::string_view name) {
  std::string names;
  for (int i = 0; i < kStageCount; ++i) {
    if (kStageNames[static_cast<std::size_t>(i)] == name) return static_cast<Stage>(i);
    names += (names.empty() ? "" : ", ") + std::string(kStageNames[static_cast<std::size_t>(i)]);
  }
  return Error{
      ErrorCode::kUsage, "session", "no stage '" + std::string(name) + "'; the stages are " + names, {}};
}

Status Session::load_volume(const VolumeFile& file) {
  std::vector<std::string> warnings;
  Result<LabelVolume> read = read_volume(file, &warnings);
  if (!read) return read.error();
  file_warnings_ = std::move(warnings);
  // Another file may have the same labels, but other names and warnings.
  records_[static_cast<std::size_t>(Stage::kVolume)].key.clear();
  file_volume_ = std::make_shared<const LabelVolume>(std::move(read).value());
  file_digest_ = digest_of(*file_volume_);
  recipe_.source = {};
  recipe_.source.file = FileSource{file.name, file_digest_};
  return std::monostate{};
}

Status Session::load_mask(const VolumeFile& file) {
  std::vector<std::string> warnings;
  Result<LabelVolume> read = read_volume(file, &warnings);
  if (!read) return read.error();
  std::string digest = digest_of(*read);
  masks_[file.name] = {std::move(read).value(), std::move(digest), std::move(warnings)};
  return std::monostate{};
}

Status Session::load_size_image(const VolumeFile& file) {
  Result<ScalarVolume> read = read_scalar_volume(file);
  if (!read) return read.error();
  std::string digest = digest_of(*read);
  images_[file.name] = {std::move(read).value(), std::move(digest), {}};
  return std::monostate{};
}

Status Session::set_recipe(const Recipe& recipe) {
  const std::optional<FileSource>& file = recipe.source.file;
  if (file && file_volume_ && !file->sha256.empty() && file->sha256 != file_digest_)
    return Error{ErrorCode::kBadInput,
                 "session",
                 "source.file: the case was made with '" + file->name + "' of digest " +
                     file->sha256.substr(0, 12) + "..., the volume loaded has " + file_digest_.substr(0, 12) +
                     "...: these are different volumes",
                 {}};
  recipe_ = recipe;
  return std::monostate{};
}

std::string Session::key_of(Stage stage) const {
  const nlohmann::json recipe = recipe_to_json(recipe_);
  const std::string name(kStageNames[static_cast<std::size_t>(stage)]);
  Sha256 sha;
  sha.update(engine_version() + name);
  if (stage == Stage::kVolume) {
    sha.update(recipe_.source.phantom ? recipe["source"]["phantom"].dump() : file_digest_);
    sha.update(recipe["labels"].dump() + recipe["merge"].dump() + recipe["volume"].dump());
  } else {
    for (const Stage input : inputs_of(stage)) sha.update(key_of(input));
    sha.update(recipe[name].dump());
  }
  if (stage == Stage::kSizing) {
    for (const MaskSize& mask : recipe_.sizing.masks)
      if (const auto found = masks_.find(mask.name); found != masks_.end()) sha.update(found->second.digest);
    for (const ImageSize& image : recipe_.sizing.images)
      if (const auto found = images_.find(image.name); found != images_.end())
        sha.update(found->second.digest);
  }
  return sha.hex();
}

void Session::forget(Stage stage) {
  switch (stage) {
    case Stage::kVolume: source_.reset(), volume_ = {}; break;
    case Stage::kSurface: surface_.reset(); break;
    case Stage::kSmooth: smooth_.reset(), walls_.clear(), walls_key_.clear(); break;
    case Stage::kSizing: sizing_.reset(); break;
    case Stage::kRemesh: remeshed_.reset(), layered_surface_.reset(), layers_ = {}; break;
    case Stage::kTetra: filled_.reset(), layered_tets_.reset(); break;
    case Stage::kOptimise: optimised_.reset(); break;
    case Stage::kLookup: lookup_.reset(); break;
    case Stage::kQuality: quality_.reset(); break;
  }
  records_[static_cast<std::size_t>(stage)] = {};
}

std::string Session::key_of_walls() const {
  Sha256 sha;
  sha.update(key_of(Stage::kSmooth));
  for (const ThicknessSize& wish : recipe_.sizing.thickness)
    sha.update(nlohmann::json{wish.wall, wish.inner, wish.layering}.dump());
  return sha.hex();
}

bool Session::may_size() const {
  return smooth_ && walls_key_ == key_of_walls();
}

Status Session::run(Stage last, RunContext& ctx) {
  std::vector<Stage> order;
  collect(last, order);
  // What the recipe no longer describes goes, so that results never mix two cases.
  for (int i = 0; i < kStageCount; ++i)
    if (!is_current(static_cast<Stage>(i))) forget(static_cast<Stage>(i));
  for (const Stage stage : order) {
    StageRecord& record = records_[static_cast<std::size_t>(stage)];
    record.cached = !record.key.empty();
    if (record.cached) continue;
    if (ctx.cancelled()) return cancelled_error("session");
    const std::string name(kStageNames[static_cast<std::size_t>(stage)]);
    std::vector<std::string> warnings, notes;
    RunContext watched = ctx;
    watched.on_warning = [&](const std::string& from, const std::string& message) {
      warnings.push_back(from + ": " + message);
      ctx.warn(from, message);
    };
    watched.on_note = [&](const std::string& from, const std::string& message) {
      notes.push_back(message);
      ctx.note(from, message);
    };
    watched.progress(name, 0);
    reset_peak_memory();
    const auto start = std::chrono::steady_clock::now();
    try {
      if (Status done = run_stage(stage, watched); !done) {
        forget(stage);
        return done;
      }
    } catch (const std::bad_alloc&) {
      return Error{ErrorCode::kOutOfMemory, name, "out of memory in stage " + name, {}};
    } catch (const std::exception& error) {
      return Error{ErrorCode::kInternal, name, "stage " + name + " failed: " + error.what(), {}};
    }
    record = {
        key_of(stage),       std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
        peak_memory_mb(),    false,
        std::move(warnings), std::move(notes)};
    watched.progress(name, 1);
  }
  return std::monostate{};
}

std::vector<std::string> Session::warnings() const {
  std::vector<std::string> all;
  for (const StageRecord& record : records_)
    all.insert(all.end(), record.warnings.begin(), record.warnings.end());
  return all;
}

}  // namespace voxtet
