// The formats of meshes, the options of their writers, and the format that a path stands for.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/bytes.h"
#include "types/field.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The stage in errors of the writers.
inline constexpr const char* kMeshWriter = "write_mesh";

enum class MeshFormat {
  kVtu,
  kVtk,  ///< legacy
  kMsh,  ///< 4.1
  kMsh22,
  kMedit,
  kCarp,
  kAbaqus,
  kNastran,
  kFebio,
  kXdmf,
  kTetgen,
  kStl,
  kLabelStl,  ///< an .stl for each label
  kPly
};
enum class PatientSpace { kRas, kLps };

struct WriteMeshOptions {
  PatientSpace space = PatientSpace::kRas;  ///< LPS flips x and y
  std::vector<LabelInfo> infos{};           ///< names and colours, used where the format has a place for them
  std::vector<Field> cell_data{};           ///< written with the tetrahedra; not with surfaces
  std::vector<Field> point_data{};          ///< written with the points of tetrahedra
  /// Named faces of tetrahedra, none of them in two sets; written besides the groups of all faces, by labels.
  std::vector<NamedSet> surfaces{};
  /// Makes the tetrahedra second-order, of ten nodes, and the triangles of six: has_second_order(). Values at
  /// a node on an edge are the mean of those at its ends.
  std::optional<MidsideNodes> midside{};
  std::string name = "mesh";  ///< base name of the files, where one refers to another
};

/// Whether files of a format have a place for fields on tetrahedra or points, of one or three components.
bool has_place_for(On on, int components, MeshFormat format);

/// Whether files of a format have a place for named surfaces.
bool has_place_for_surfaces(MeshFormat format);

/// Whether second-order tetrahedra can be written into files of a format.
bool has_second_order(MeshFormat format);
/// The endings of these formats, for messages.
inline constexpr std::string_view kSecondOrderEndings = ".vtu, .msh, .inp, .feb or .xdmf";

/// The cell data that are fibres to openCARP, unit vectors of three components: `fibre`, and across it
/// `sheet`.
inline constexpr std::string_view kFibreField = "fibre";
inline constexpr std::string_view kSheetField = "sheet";
bool has_fibres(const std::vector<Field>& cell_data);

/// Message for a mesh written for openCARP without fibres. A placeholder in .lon, whatever its direction,
/// would be simulated as if it were real; openCARP requires the file, so that its absence is noticed.
inline constexpr std::string_view kNoFibres =
    "no fibres are known, so no .lon file is written; openCARP requires one: make the fibres, a direction "
    "for each element of .elem, before simulating";

/// A file of an export: openCARP and TetGen make three, XDMF four, STL by labels one for each, every other
/// format one; cell and point data and surfaces may add more. `suffix` is appended to the base name.
struct OutputFile {
  std::string suffix;  ///< ".vtu", ".msh", "_data.msh", ".pts", ".fraction_5.dat", ...
  Bytes bytes;
};

/// Format of a file name by its ending (.vtu .vtk .msh .mesh .pts/.elem/.lon/.carp .inp .bdf/.nas .feb .xdmf
/// .node/.ele/.face .stl .ply), in any case; never kMsh22 or kLabelStl, which share an ending with another.
/// Errors: kUsage listing the known endings.
Result<MeshFormat> mesh_format_of(const std::string& path);

/// The ending of a path's last name with its dot (".vtu"); empty where it has none.
std::string_view mesh_ending_of(std::string_view path);

/// A path's last name without its ending: the WriteMeshOptions::name that write_files needs.
std::string mesh_name_of(std::string_view path);

}  // namespace voxtet
