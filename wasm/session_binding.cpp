// The browser's view of the engine: one class, JSON text for what has structure, typed views for arrays.
// web/src/engine/contract.ts holds the TypeScript types of the same surface.
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "base/parallel.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/read_volume.h"
#include "lookup/look_up_labels.h"
#include "pipeline/engine_version.h"
#include "pipeline/field_volume.h"
#include "pipeline/forecast.h"
#include "pipeline/report.h"
#include "pipeline/session.h"
#include "quality/measure_quality.h"
#include "quality/surface_distance.h"

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

template <class T>
val view_of(const T* data, std::size_t count) {
  return val(emscripten::typed_memory_view(count, data));
}

Result<MeshFormat> format_of(const std::string& name) {
  return mesh_format_of(name == "medit" ? "x.mesh" : "x." + name);
}

std::vector<float> to_float(const std::vector<Eigen::Vector3d>& points) {
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
  std::string schema() const {
    return json{{"version", engine_version()}, {"fields", recipe_schema()}}.dump();
  }
  std::string defaults() const { return recipe_to_json(Recipe{}).dump(); }
  std::string report() const { return report_json(session_).dump(); }

  std::string load_volume(const std::string& name, const val& bytes, const val& siblings) {
    const HeldFile file(name, bytes, siblings);
    if (Status loaded = session_.load_volume(file.volume_file()); !loaded) return reply(loaded.error());
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

  std::string run(const std::string& stage_name, const val& on_progress) {
    Result<Stage> last = stage_of(stage_name);
    if (!last) return reply(last.error());
    RunContext ctx = context();
    if (!on_progress.isUndefined() && !on_progress.isNull())
      ctx.on_progress = [&](const std::string& stage, double fraction) { on_progress(stage, fraction); };
    if (Status done = session_.run(*last, ctx); !done) return reply(done.error());
    json stage = stage_json(session_, *last);
    stage["key"] = session_.record(*last).key;
    return reply(stage);
  }

  /// What meshing will take; with `elements` > 0 also the edge lengths that give so many tetrahedra, as
  /// "fitting". Where only sizes have changed, a mesh of the earlier ones stays: they may come back.
  std::string forecast(double elements) {
    RunContext ctx = context();
    if (!session_.may_size())
      if (Status done = session_.run(Stage::kSizing, ctx); !done) return reply(done.error());
    const Result<json> found = forecast_json(session_, elements, ctx);
    return found ? reply(*found) : reply(found.error());
  }

  val view(const std::string& stage, const std::string& array) {
    Result<Stage> which = stage_of(stage);
    if (!which) return val::undefined();
    switch (*which) {
      case Stage::kVolume:
        if (const LabelVolume* v = session_.source_volume(); v && array == "labels")
          return view_of(v->labels.data(), v->labels.size());
        break;
      case Stage::kSurface: return surface_view(session_.surface(), array);
      case Stage::kSmooth: return surface_view(session_.smooth(), array);
      case Stage::kRemesh: return surface_view(session_.remeshed(), array);
      case Stage::kSizing:
        if (const SizingField* s = session_.sizing(); s && array == "h_mm")
          return view_of(s->h_mm.data(), s->h_mm.size());
        if (array == "thickness_mm" && !session_.walls().empty())
          if (Result<ScalarVolume> field = field_volume(session_, "thickness"); field)
            return keep_view(floats_, std::move(field->values));
        break;
      case Stage::kTetra: break;
      case Stage::kOptimise: return mesh_view(array);
      case Stage::kLookup:
        if (session_.lookup())
          for (CellData& data : cell_data_of(*session_.lookup()))
            if (data.name == array) return keep_view(floats_, std::move(data.values));
        break;
      case Stage::kQuality: return quality_view(array);
    }
    return val::undefined();
  }

  /// `name`: of the files without their endings.
  std::string export_mesh(const std::string& format, const std::string& space, const std::string& name) {
    exported_.clear();
    if (!session_.mesh())
      return reply(Error{ErrorCode::kUsage, "export", "no mesh yet: run the stage optimise", {}});
    Result<MeshFormat> which = format_of(format);
    if (!which) return reply(which.error());
    const PatientSpace patient = space == "lps" ? PatientSpace::kLps : PatientSpace::kRas;
    Result<std::vector<OutputFile>> files = write_tet_mesh(
        *session_.mesh(), *which,
        {patient, session_.volume()->infos,
         session_.lookup() ? cell_data_of(*session_.lookup()) : std::vector<CellData>{}, name});
    if (!files) return reply(files.error());
    exported_ = std::move(files).value();
    json list = json::array();
    for (const OutputFile& file : exported_)
      list.push_back({{"suffix", file.suffix}, {"bytes", file.bytes.size()}});
    return reply({{"files", list}});
  }

  val export_bytes(int index) {
    const OutputFile& file = exported_.at(static_cast<std::size_t>(index));
    return view_of(file.bytes.data(), file.bytes.size());
  }

 private:
  static RunContext context() {
    RunContext ctx;
    ctx.threads = hardware_threads();
    return ctx;
  }

  std::string load_mask(const VolumeFile& file) {
    if (Status loaded = session_.load_mask(file); !loaded) return reply(loaded.error());
    const auto& [mask, digest] = session_.masks().at(file.name);
    std::vector<bool> found(std::numeric_limits<Label>::max() + std::size_t{1});
    for (const Label label : mask.labels) found[label] = true;
    json labels = json::array();
    for (std::size_t label = 1; label < found.size(); ++label)
      if (found[label]) labels.push_back(label);
    return reply({{"name", file.name}, {"digest", digest}, {"labels", labels}});
  }

  std::string load_size_image(const VolumeFile& file) {
    if (Status loaded = session_.load_size_image(file); !loaded) return reply(loaded.error());
    const std::string& digest = session_.size_images().at(file.name).digest;
    return reply({{"name", file.name}, {"digest", digest}, {"labels", json::array()}});
  }

  /// Keeps what was made for a view alive until the next one is asked for.
  template <class T>
  val keep_view(std::vector<T>& slot, std::vector<T>&& values) {
    slot = std::move(values);
    return view_of(slot.data(), slot.size());
  }

  val surface_view(const SurfaceMesh* surface, const std::string& array) {
    if (!surface) return val::undefined();
    if (array == "points") return keep_view(floats_, to_float(surface->points));
    if (array == "triangles")
      return view_of(reinterpret_cast<const std::uint32_t*>(surface->triangles.data()),
                     3 * surface->triangles.size());
    if (array == "sides")
      return view_of(reinterpret_cast<const std::uint16_t*>(surface->sides.data()),
                     2 * surface->sides.size());
    return val::undefined();
  }

  val mesh_view(const std::string& array) {
    const TetMesh* mesh = session_.mesh();
    if (!mesh) return val::undefined();
    if (array == "points") return keep_view(floats_, to_float(mesh->points));
    if (array == "tets")
      return view_of(reinterpret_cast<const std::uint32_t*>(mesh->tets.data()), 4 * mesh->tets.size());
    if (array == "labels") return view_of(mesh->labels.data(), mesh->labels.size());
    if (array == "faces")
      return view_of(reinterpret_cast<const std::uint32_t*>(mesh->faces.data()), 3 * mesh->faces.size());
    if (array == "face_sides")
      return view_of(reinterpret_cast<const std::uint16_t*>(mesh->face_sides.data()),
                     2 * mesh->face_sides.size());
    return val::undefined();
  }

  val quality_view(const std::string& array) {
    if (!session_.mesh()) return val::undefined();
    if (array == "distance_mm") return keep_view(floats_, distances_to_labels());
    if (array == "layer" || array == "layers_across") return layer_view(array == "layer");
    TetMeasures m = measure_tets(*session_.mesh(), session_.sizing());
    if (array == "min_dihedral_deg") return keep_view(floats_, std::move(m.min_dihedral_deg));
    if (array == "max_dihedral_deg") return keep_view(floats_, std::move(m.max_dihedral_deg));
    if (array == "radius_ratio") return keep_view(floats_, std::move(m.radius_ratio));
    if (array == "mean_ratio") return keep_view(floats_, std::move(m.mean_ratio));
    if (array == "aspect_ratio") return keep_view(floats_, std::move(m.aspect_ratio));
    if (array == "edge_mm") return keep_view(floats_, std::move(m.edge_mm));
    if (array == "size_log2") return keep_view(floats_, std::move(m.size_log2));
    return val::undefined();
  }

  val layer_view(bool own) const {
    const QualityReport* quality = session_.quality();
    if (!quality || quality->layers.empty()) return val::undefined();
    const std::vector<float>& layers = own ? quality->layer_map.layer : quality->layer_map.layers_across;
    return view_of(layers.data(), layers.size());
  }

  /// Of the mesh's points, mm; -1 inside.
  std::vector<float> distances_to_labels() const {
    const TetMesh& mesh = *session_.mesh();
    const SurfaceMesh& surface = *session_.smooth();
    return distances_of_points({mesh.points, mesh.faces, mesh.face_sides},
                               {surface.points, surface.triangles, surface.sides});
  }

  Session session_;
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
      .function("run", &SessionBinding::run)
      .function("forecast", &SessionBinding::forecast)
      .function("view", &SessionBinding::view)
      .function("exportMesh", &SessionBinding::export_mesh)
      .function("exportBytes", &SessionBinding::export_bytes)
      .function("report", &SessionBinding::report);
}
