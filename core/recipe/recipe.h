// A case as data: everything that decides a mesh, apart from the volume's own voxels.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/find_heart_surfaces.h"
#include "phantom/make_phantom.h"
#include "physics/beat/beat_params.h"
#include "physics/diffusion/diffusion.h"
#include "physics/monodomain/monodomain.h"
#include "physics/tissue/make_tissue.h"
#include "physics/ventricles/fibre_params.h"
#include "quality/measure_quality.h"
#include "recipe/legend.h"
#include "recipe/migrate.h"
#include "remesh/remesh_params.h"
#include "sizing/build_sizing_field.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"
#include "tetra/fill/fill_tets.h"
#include "tetra/optimise/optimise_tets.h"
#include "transfer/transfer_labels.h"
#include "types/read_options.h"
#include "types/result.h"
#include "types/stimulus.h"
#include "volume/prepare_volume.h"

namespace voxtet {

/// A volume that the user holds, or a mesh that was made elsewhere. `sha256` is the digest of what was read,
/// so a re-compressed file still matches.
struct FileSource {
  std::string name;
  std::string sha256;  ///< empty: any file of that name
  std::string url;     ///< where it can be had, for whoever has no such file; nothing here fetches it
};

/// A label volume within the recipe, so that a link brings it along.
struct InlineSource {
  std::string name;  ///< of the file that it was read from
  std::string data;  ///< base64url of code_volume() (io/volume/coded)
};

/// Where the labels come from. At most one of phantom, inlined and file is set.
struct Source {
  std::optional<PhantomParams> phantom;
  std::optional<InlineSource> inlined;  ///< `inline` of the recipe
  std::optional<FileSource> file;
  ReadOptions read;  ///< how the file is read; of its fields each is one of `source`
};

/// Limits on what meshing may need. A case whose forecast is above one is refused before meshing. 0: no
/// limit.
struct Limits {
  double tets = 0;
  double memory_mb = 0;
  double seconds = 0;
};

/// What is simulated on the mesh.
struct PhysicsParams {
  std::optional<AnatomyParams> anatomy;
  std::optional<FibreParams> fibres;  ///< needs `anatomy`
  TissueParams tissue;
  std::vector<Stimulus> stimuli;
  std::optional<MonodomainParams> monodomain;
  std::optional<BeatParams> mechanics;  ///< needs `anatomy` and fibres
  std::optional<DiffusionParams> diffusion;
};

/// Digests of what simulations find.
struct ExpectedStages {
  std::string eikonal, monodomain, mechanics;
};

/// What a shared case promises; empty fields promise nothing.
struct Expected {
  std::string engine;  ///< engine_version()
  std::string digest;  ///< digest_of(TetMesh)
  std::uint32_t tets = 0;
  std::string physics = {};  ///< physics_version(), where a simulation is promised
  ExpectedStages stages = {};
};

enum class ViewLayout { kModel, kSlices };

struct ViewCamera {
  Eigen::Vector3d position_mm{0, 0, 0}, target_mm{0, 0, 0};
};

struct ViewCut {
  Eigen::Vector3d normal{0, 1, 0};
  double place = 0.5;
  bool flat = false;
};

/// What a page shows first of a shared case: "look at this". No stage reads it.
struct ViewParams {
  std::string stage;
  std::string colour;
  ViewLayout layout = ViewLayout::kModel;
  std::optional<ViewCamera> camera;
  std::optional<ViewCut> cut;
  Eigen::Vector3d crosshair{0.5, 0.5, 0.5};
  std::vector<Label> hidden;
  std::int32_t element = -1;
  bool edges = true;
  double explode = 0;
  double time_ms = 0;
};

/// The whole case. Field names, units, ranges and sentences are declared once, in recipe/fields.h.
struct Recipe {
  int version = kRecipeVersion;
  Source source;
  std::vector<LegendEntry> legend;
  std::vector<Label> labels;      ///< labels to mesh; empty: all
  std::vector<LabelGroup> merge;  ///< each group becomes one region that carries its smallest label
  VolumeParams volume;
  ExtractParams surface;
  SmoothParams smooth;
  SizingParams sizing;
  RemeshParams remesh;
  FillParams tetra;
  OptimiseParams optimise;
  TransferParams transfer;
  QualityParams quality;
  std::optional<PhysicsParams> physics;
  Limits limits;
  Expected expected;
  std::optional<ViewParams> view;
};

/// Parses strictly: unknown fields, wrong types and values out of range are errors that name the field's
/// path. Fields that are absent keep their default. Errors: kUsage.
Result<Recipe> parse_recipe(std::string_view json_text);
Result<Recipe> parse_recipe(const nlohmann::json& json);

/// Sets one field by its path ("sizing.edge_mm", "labels"; "sizing.regions[0].edge_mm" for lists) from JSON
/// text; text that is no JSON is taken as a string. Errors: kUsage.
Result<Recipe> with_field(const Recipe& recipe, const std::string& path, const std::string& value);

/// What a stack of thick slices is meshed by, to be merged into a recipe's JSON: shifted slices are put back,
/// thick ones interpolated, and the steps between them smoothed away.
nlohmann::json thick_stack_preset();

/// Usual cleaning of noise (kUsualCleaning), for the fields of a recipe's JSON that are 0.
nlohmann::json cleaning_preset();

/// Every field with its value, or (`minimal`) only the version and those that differ from their default.
nlohmann::json recipe_to_json(const Recipe& recipe, bool minimal = false);

/// The table of fields: {fields: [{path, type, unit, default, min, max, values, description, items}],
/// optional_groups: [path], presets: {thick_stack, cleaning}}. A recipe may leave out the optional groups.
nlohmann::json recipe_schema();

/// The same fields as a JSON Schema (draft 2020-12) of the present version, for editors and validators. What
/// it accepts may still be refused: a file's digest, or fields that contradict each other.
nlohmann::json recipe_json_schema();

}  // namespace voxtet
