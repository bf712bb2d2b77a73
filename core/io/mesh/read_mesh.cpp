#include "io/mesh/read_mesh.h"

#include <optional>
#include <string_view>

#include "io/bytes/files.h"
#include "io/bytes/header_text.h"
#include "io/mesh/read/read_carp.h"
#include "io/mesh/read/read_medit.h"
#include "io/mesh/read/read_msh.h"
#include "io/mesh/read/read_vtu.h"
#include "io/mesh/read/text/read_abaqus.h"
#include "io/mesh/read/text/read_febio.h"
#include "io/mesh/read/text/read_nastran.h"
#include "io/mesh/read/text/read_tetgen.h"
#include "io/mesh/read/text/read_vtk.h"
#include "io/mesh/read/xdmf/read_xdmf.h"
#include "io/mesh/shared/mesh_format.h"

namespace voxtet {
namespace {

constexpr const char* kMeshReader = "read_mesh";

bool contains_early(std::string_view text, std::string_view word) {
  return text.substr(0, 1024).find(word) != std::string_view::npos;
}

/// Whether a keyword of Abaqus begins the file, behind comments.
bool is_abaqus(std::string_view text) {
  while (text.starts_with("**") || text.starts_with('\n') || text.starts_with('\r')) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return false;
    text.remove_prefix(end + 1);
  }
  const std::string start = lower_case(text.substr(0, 16));
  return start.starts_with("*heading") || start.starts_with("*node") || start.starts_with("*part") ||
         start.starts_with("*include");
}

bool is_nastran(std::string_view text) {
  const std::string start = lower_case(text.substr(0, 1 << 16));
  return start.starts_with("$ voxtet mesh") || start.find("begin bulk") != std::string::npos;
}

/// By the content, which tells most formats; the rest by the name.
std::optional<MeshFormat> format_in(std::string_view text, const std::string& name) {
  if (contains_early(text, "<VTKFile")) return MeshFormat::kVtu;
  if (text.starts_with("# vtk DataFile")) return MeshFormat::kVtk;
  if (text.starts_with("$MeshFormat")) return MeshFormat::kMsh;
  if (contains_early(text, "MeshVersionFormatted")) return MeshFormat::kMedit;
  if (contains_early(text, "<febio_spec")) return MeshFormat::kFebio;
  if (contains_early(text, "<Xdmf")) return MeshFormat::kXdmf;
  if (is_abaqus(text)) return MeshFormat::kAbaqus;
  if (is_nastran(text)) return MeshFormat::kNastran;
  const Result<MeshFormat> format = mesh_format_of(name);
  if (format && (*format == MeshFormat::kCarp || *format == MeshFormat::kTetgen ||
                 *format == MeshFormat::kNastran || *format == MeshFormat::kAbaqus))
    return *format;
  return std::nullopt;
}

/// The formats whose labels are an array with a name.
bool has_label_arrays(MeshFormat format) {
  return format == MeshFormat::kVtu || format == MeshFormat::kVtk || format == MeshFormat::kMsh ||
         format == MeshFormat::kXdmf;
}

}  // namespace

Result<TetMesh> read_tet_mesh(const VolumeFile& file, MeshArrays* arrays, const std::string& label_array) {
  const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
  const std::optional<MeshFormat> format = format_in(text, file.name);
  if (!format)
    return Error{
        ErrorCode::kBadInput,
        kMeshReader,
        file.name +
            ": found neither VTU, legacy VTK, Gmsh MSH, MEDIT .mesh, XDMF, Abaqus .inp, Nastran .bdf, "
            "FEBio .feb, TetGen .ele with .node nor openCARP .elem with .pts",
        {}};
  if (!label_array.empty() && !has_label_arrays(*format))
    return usage_error(kMeshReader,
                       file.name + ": found the array of labels " + in_quotes(label_array) +
                           " asked for, but only .vtu, .vtk, .xdmf and .msh have arrays with names");
  switch (*format) {
    case MeshFormat::kVtu: return read_vtu(file, arrays, label_array);
    case MeshFormat::kVtk: return read_vtk(file, arrays, label_array);
    case MeshFormat::kMedit: return read_medit(file, arrays);
    case MeshFormat::kFebio: return read_febio(file, arrays);
    case MeshFormat::kXdmf: return read_xdmf(file, arrays, label_array);
    case MeshFormat::kAbaqus: return read_abaqus(file, arrays);
    case MeshFormat::kNastran: return read_nastran(file, arrays);
    case MeshFormat::kTetgen: return read_tetgen(file, arrays);
    case MeshFormat::kCarp: return read_carp(file, arrays);
    default: return read_msh(file, arrays, label_array);
  }
}

Result<TetMesh> read_tet_mesh_file(const std::string& path, MeshArrays* arrays,
                                   const std::string& label_array) {
  const std::string ending = lower_case(mesh_ending_of(path));
  const std::string name = ending == ".carp" ? path.substr(0, path.size() - ending.size()) + ".elem" : path;
  const Result<Bytes> bytes = read_file(name);
  if (!bytes.ok()) return bytes.error();
  const std::size_t folder = name.find_last_of("/\\") + 1;
  return read_tet_mesh(
      {name, *bytes, [&](const std::string& sibling) { return read_file(name.substr(0, folder) + sibling); }},
      arrays, label_array);
}

}  // namespace voxtet
