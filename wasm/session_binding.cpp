// The browser's view of the engine: one class, JSON text for what has structure, typed views for arrays.
// web/src/engine/contract.ts holds the TypeScript types of the same surface.
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <deque>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "base/parallel.h"
#include "io/mesh/read_values.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/read_volume.h"
#include "pipeline/exports/carp_case.h"
#include "pipeline/exports/exported_fields.h"
#include "pipeline/exports/field_volume.h"
#include "pipeline/exports/mechanics_case.h"
#include "pipeline/exports/second_order.h"
#include "pipeline/forecast.h"
#include "pipeline/report.h"
#include "pipeline/results/stage_arrays.h"
#include "pipeline/session.h"
#include "pipeline/sources/source_volume.h"
#include "pipeline/version/engine_version.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using emscripten::val;
using nlohmann::json;

std::string reply(const json& value) {
  return json{{"ok", true}, {"value", value}}.dump();
}
std::string reply(const Error& error) {
  return json{{"ok", false}, {"error", error_json(error)}}.dump();
}

Bytes to_bytes(const val& typed_array) {
  return emscripten::convertJSArrayToNumberVector<std::uint8_t>(typed_array);
}

Result<MeshFormat> format_of(const std::string& name) {
  if (name == "msh22") return MeshFormat::kMsh22;
  if (name == "label_stl") return MeshFormat::kLabelStl;
  if (name == "tetgen") return MeshFormat::kTetgen;
  return mesh_format_of(name == "medit" ? "x.mesh" : "x." + name);
}

std::vector<float> to_float(std::span<const Eigen::Vector3d> points) {
  std::vector<float> out(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d)
      out[3 * i + d] = static_cast<float>(points[i][static_cast<Eigen::Index>(d)]);
  return out;
}

/// A file's bytes as the page gave them, with those beside it that its header may name.
class HeldFile {
 public:
  HeldFile(const std::string& name, const val& bytes, const val& siblings)
      : name_(name), content_(to_bytes(bytes)) {
    if (siblings.isUndefined() || siblings.isNull()) return;
    const val keys = val::global("Object").call<val>("keys", siblings);
    for (int i = 0; i < keys["length"].as<int>(); ++i)
      beside_[keys[i].as<std::string>()] = to_bytes(siblings[keys[i]]);
  }

  VolumeFile volume_file() const {
    return {name_, content_, [this](const std::string& wanted) -> Result<Bytes> {
              const auto found = beside_.find(wanted);
              if (found != beside_.end()) return found->second;
              return Error{ErrorCode::kBadInput,
                           "read_volume",
                           name_ + ": its data file '" + wanted + "' is not there; drop both files together",
                           {}};
            }};
  }

 private:
  std::string name_;
  Bytes content_;
  std::map<std::string, Bytes> beside_;
};

class SessionBinding {
 public:
  std::string schema() const { return schema_json().dump(); }
  std::string defaults() const { return recipe_to_json(Recipe{}).dump(); }
  std::string report() const { return report_json(session_).dump(); }

  /// `source`: JSON of the recipe's source, of which how the file is read counts.
  std::string load_volume(const std::string& name, const val& bytes, const val& siblings,
                          const std::string& source) {
    const HeldFile file(name, bytes, siblings);
    const Result<Recipe> recipe = parse_recipe(json{{"source", json::parse(source, nullptr, false)}});
    if (!recipe) return reply(recipe.error());
    if (Status loaded = session_.load_volume(file.volume_file(), recipe->source.read); !loaded)
      return reply(loaded.error());
    // Labels are known before they are prepared; what holds none is refused by the stage.
    if (session_.files().volume)
      if (json found = volume_json(session_); !found["labels"].empty()) return reply(found);
    RunContext ctx = context();
    if (Status ran = session_.run(Stage::kVolume, ctx); !ran) return reply(ran.error());
    return reply(volume_json(session_));
  }

  /// Takes a file of the recipe's sizing.masks ("mask") or sizing.images ("image").
  std::string load_side_volume(const std::string& kind, const std::string& name, const val& bytes,
                               const val& siblings) {
    const HeldFile file(name, bytes, siblings);
    return kind == "mask" ? load_mask(file.volume_file()) : load_size_image(file.volume_file());
  }

  std::string set_recipe(const std::string& text) {
    Result<Recipe> recipe = parse_recipe(std::string_view(text));
    if (!recipe) return reply(recipe.error());
    if (Status set = session_.set_recipe(*recipe); !set) return reply(set.error());
    return reply({{"recipe", recipe_to_json(*recipe)}, {"minimal", recipe_to_json(*recipe, true)}});
  }

  /// The case with its volume within it: the recipe, all fields and without defaults.
  std::string inline_case() {
    const LabelVolume* volume = session_.files().volume.get();
    if (!volume) return reply(usage_error("inline_case", "no label volume has been loaded"));
    const Result<Recipe> inlined = with_inline_volume(session_.recipe(), *volume);
    if (!inlined) return reply(inlined.error());
    return reply({{"recipe", recipe_to_json(*inlined)}, {"minimal", recipe_to_json(*inlined, true)}});
  }

  /// Plans a run up to a stage; advance() works on it, end() gives it up and keeps what is complete.
  std::string begin(const std::string& stage_name) {
    const Result<Stage> last = stage_of(stage_name);
    if (!last) return reply(last.error());
    session_.begin(*last);
    snapshots_.clear();
    last_ = *last;
    return reply(nullptr);
  }

  /// Works for some `budget_ms`; a stage that cannot be cut is done whole. {done, stage, fraction}, and when
  /// done the summary of the stage that was begun.
  std::string advance(double budget_ms, const val& on_progress) {
    RunContext ctx = context();
    if (!on_progress.isUndefined() && !on_progress.isNull())
      ctx.on_progress = [&](const std::string& stage, double fraction) { on_progress(stage, fraction); };
    ctx.on_snapshot = [this](const Snapshot& frame) { snapshots_.push_back(frame); };
    const Result<RunProgress> progress = session_.advance(budget_ms, ctx);
    if (!progress) return reply(progress.error());
    json out{{"done", progress->done}, {"stage", name_of(progress->stage)}, {"fraction", progress->fraction}};
    if (progress->done) {
      out["summary"] = stage_json(session_, last_);
      out["summary"]["key"] = session_.record(last_).key;
    }
    return reply(out);
  }

  void end() { session_.end(); }

  /// A stimulus (JSON as in the recipe's physics.stimuli, start_ms after now) for the simulation under way:
  /// {stimulus}, with its time in the run, as it now stands in the recipe.
  std::string stimulate(const std::string& text) {
    json recipe = recipe_to_json(session_.recipe());
    recipe["physics"]["stimuli"].push_back(json::parse(text, nullptr, false));
    const Result<Recipe> parsed = parse_recipe(recipe);
    if (!parsed) return reply(parsed.error());
    const Result<Stimulus> given = session_.stimulate(parsed->physics->stimuli.back());
    if (!given) return reply(given.error());
    return reply({{"stimulus", recipe_to_json(session_.recipe())["physics"]["stimuli"].back()}});
  }

  /// The arrays of a stage's result.
  std::string describe(const std::string& stage_name) const {
    const Result<Stage> stage = stage_of(stage_name);
    if (!stage) return reply(stage.error());
    json list = json::array();
    for (const StageArray& array : arrays_of(*stage)) list.push_back(array_json(array));
    return reply(list);
  }

  /// A view of one of them; undefined where there is none of the name.
  val array(const std::string& stage_name, const std::string& name) {
    const Result<Stage> stage = stage_of(stage_name);
    if (stage)
      for (const StageArray& array : arrays_of(*stage))
        if (array.name == name)
          return std::visit([this](const auto& values) { return this->view_of(values); }, array.values);
    // The voxels of a file can be looked at before its stage has run.
    const LabelVolume* volume = session_.files().volume.get();
    if (stage_name == kVolumeStage && name == "labels" && volume && !session_.is_current(Stage::kVolume))
      return view_of(std::span<const Label>(volume->labels));
    return val::undefined();
  }

  /// What snapshot_json() says of the earliest frame that has not been taken, whose values snapshot_array()
  /// gives until the next is taken; null where there is none.
  std::string take_snapshot() {
    if (snapshots_.empty()) return reply(nullptr);
    snapshot_ = std::move(snapshots_.front());
    snapshots_.pop_front();
    return reply(snapshot_json(snapshot_));
  }

  val snapshot_array(const std::string& name) const {
    const Field* field = find_field(snapshot_.fields, name);
    return field ? view_of(std::span<const float>(field->values)) : val::undefined();
  }

  /// Takes values that were found elsewhere on the mesh of this session: {frames}. Whether points
  /// conduct is found out where only that may explain how many values there are.
  std::string open_values(const std::string& name, const val& bytes) {
    if (!session_.mesh())
      return reply(Error{ErrorCode::kUsage, "values", name + ": no mesh yet: run the stage optimise", {}});
    Result<PointValues> opened = PointValues::open(name, to_bytes(bytes));
    if (!opened) return reply(opened.error());
    RunContext ctx = context();
    if (opened->count() != session_.mesh()->points.size() && session_.recipe().physics)
      if (Status done = session_.run(Stage::kTissue, ctx); !done) return reply(done.error());
    values_ = std::move(opened).value();
    return reply(json{{"frames", values_->frames()}});
  }

  /// A frame of these, as take_snapshot() gives one.
  std::string values_frame(int frame) {
    const auto k = static_cast<std::size_t>(frame);
    Result<Field> field = values_on_mesh(session_, *values_, k);
    if (!field) return reply(field.error());
    snapshot_ = {values_->times_ms().empty() ? 0 : values_->times_ms()[k], {std::move(field).value()}};
    return reply(snapshot_json(snapshot_));
  }

  void close_values() { values_.reset(); }

  /// What meshing will take; with `elements` > 0 also the edge lengths that give so many tetrahedra, as
  /// "fitting". Where only sizes have changed, a mesh of the earlier ones stays: they may come back.
  std::string forecast(double elements) {
    RunContext ctx = context();
    if (!session_.may_size())
      if (Status done = session_.run(Stage::kSizing, ctx); !done) return reply(done.error());
    const Result<json> found = forecast_json(session_, elements, ctx);
    return found ? reply(*found) : reply(found.error());
  }

  /// `name`: of the files without their endings. `order`: of the elements, 1 or 2.
  std::string export_mesh(const std::string& format, const std::string& space, const std::string& name,
                          bool measures, int order) {
    exported_.clear();
    if (!session_.mesh())
      return reply(Error{ErrorCode::kUsage, "export", "no mesh yet: run the stage optimise", {}});
    WriteMeshOptions options{.space = space == "lps" ? PatientSpace::kLps : PatientSpace::kRas, .name = name};
    if (order == 2) options.midside = second_order_nodes(session_, context().threads).nodes;
    Result<std::vector<OutputFile>> files = written_files(format, options, measures);
    if (!files) return reply(files.error());
    exported_ = std::move(files).value();
    json list = json::array();
    for (const OutputFile& file : exported_)
      list.push_back({{"suffix", file.suffix}, {"bytes", file.bytes.size()}});
    return reply({{"files", list}});
  }

  val export_bytes(int index) {
    const OutputFile& file = exported_.at(static_cast<std::size_t>(index));
    return view_of(std::span<const std::uint8_t>(file.bytes));
  }

 private:
  static RunContext context() {
    RunContext ctx;
    ctx.threads = hardware_threads();
    return ctx;
  }

  /// For openCARP a case, where a wave has been simulated. `feb_case` and `svmultiphysics`: cases of
  /// mechanics.
  Result<std::vector<OutputFile>> written_files(const std::string& format, WriteMeshOptions options,
                                                bool measures) const {
    if (format == "feb_case") return mechanics_case_files(session_, MechanicsProgram::kFebio, options);
    if (format == "svmultiphysics")
      return mechanics_case_files(session_, MechanicsProgram::kSvMultiPhysics, options);
    const Result<MeshFormat> which = format_of(format);
    if (!which) return which.error();
    if (*which == MeshFormat::kCarp && has_wave(session_))
      return carp_case_files(session_, options.space, options.name);
    WriteMeshOptions with_fields = exported_fields(session_, *which, measures).options;
    with_fields.space = options.space;
    with_fields.name = options.name;
    with_fields.midside = std::move(options.midside);
    return write_tet_mesh(*session_.mesh(), *which, with_fields);
  }

  std::string load_mask(const VolumeFile& file) {
    if (Status loaded = session_.load_mask(file); !loaded) return reply(loaded.error());
    const SideVolume<LabelVolume>& mask = session_.files().masks.at(file.name);
    std::vector<bool> found(std::numeric_limits<Label>::max() + std::size_t{1});
    for (const Label label : mask.volume.labels) found[label] = true;
    json labels = json::array();
    for (std::size_t label = 1; label < found.size(); ++label)
      if (found[label]) labels.push_back(label);
    return reply({{"name", file.name}, {"digest", mask.digest}, {"labels", labels}});
  }

  std::string load_size_image(const VolumeFile& file) {
    if (Status loaded = session_.load_size_image(file); !loaded) return reply(loaded.error());
    const std::string& digest = session_.files().images.at(file.name).digest;
    return reply({{"name", file.name}, {"digest", digest}, {"labels", json::array()}});
  }

  StageArrays arrays_of(Stage stage) const {
    StageArrays arrays;
    const StageResult* result = session_.current(stage);
    if (result && spec_of(stage).arrays) spec_of(stage).arrays(result->value, arrays);
    return arrays;
  }

  /// Points in single precision live until the next are asked for.
  val view_of(std::span<const Eigen::Vector3d> points) {
    floats_ = to_float(points);
    return view_of(std::span<const float>(floats_));
  }
  template <class T>
  val view_of(std::span<const T> values) const {
    return val(emscripten::typed_memory_view(values.size(), values.data()));
  }

  Session session_;
  Stage last_ = Stage::kVolume;     ///< that begin() named
  std::deque<Snapshot> snapshots_;  ///< that were not taken
  Snapshot snapshot_;
  std::optional<PointValues> values_;  ///< that open_values() took
  std::vector<OutputFile> exported_;
  std::vector<float> floats_;
};

}  // namespace
}  // namespace voxtet

EMSCRIPTEN_BINDINGS(voxtet) {
  using voxtet::SessionBinding;
  emscripten::class_<SessionBinding>("Session")
      .constructor<>()
      .function("schema", &SessionBinding::schema)
      .function("defaults", &SessionBinding::defaults)
      .function("loadVolume", &SessionBinding::load_volume)
      .function("loadSideVolume", &SessionBinding::load_side_volume)
      .function("setRecipe", &SessionBinding::set_recipe)
      .function("inlineCase", &SessionBinding::inline_case)
      .function("begin", &SessionBinding::begin)
      .function("advance", &SessionBinding::advance)
      .function("end", &SessionBinding::end)
      .function("stimulate", &SessionBinding::stimulate)
      .function("describe", &SessionBinding::describe)
      .function("array", &SessionBinding::array)
      .function("takeSnapshot", &SessionBinding::take_snapshot)
      .function("snapshotArray", &SessionBinding::snapshot_array)
      .function("openValues", &SessionBinding::open_values)
      .function("valuesFrame", &SessionBinding::values_frame)
      .function("closeValues", &SessionBinding::close_values)
      .function("forecast", &SessionBinding::forecast)
      .function("exportMesh", &SessionBinding::export_mesh)
      .function("exportBytes", &SessionBinding::export_bytes)
      .function("report", &SessionBinding::report);
}
