#include "io/mesh/read_mesh.h"

#include <string_view>

#include "io/bytes/files.h"
#include "io/bytes/header_text.h"
#include "io/mesh/read/read_carp.h"
#include "io/mesh/read/read_medit.h"
#include "io/mesh/read/read_msh.h"
#include "io/mesh/read/read_vtu.h"
#include "io/mesh/shared/mesh_format.h"

namespace voxtet {
namespace {

constexpr const char* kMeshReader = "read_mesh";

bool contains_early(std::string_view text, std::string_view word) {
  return text.substr(0, 1024).find(word) != std::string_view::npos;
}

}  // namespace

Result<TetMesh> read_tet_mesh(const VolumeFile& file, MeshArrays* arrays) {
  const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
  if (contains_early(text, "<VTKFile")) return read_vtu(file, arrays);
  if (text.substr(0, 11) == "$MeshFormat") return read_msh(file, arrays);
  if (contains_early(text, "MeshVersionFormatted")) return read_medit(file, arrays);
  if (const Result<MeshFormat> format = mesh_format_of(file.name);
      format.ok() && *format == MeshFormat::kCarp)
    return read_carp(file, arrays);
  return Error{ErrorCode::kBadInput,
               kMeshReader,
               file.name + ": neither VTU, Gmsh MSH, MEDIT .mesh nor openCARP .elem with .pts",
               {}};
}

Result<TetMesh> read_tet_mesh_file(const std::string& path, MeshArrays* arrays) {
  const std::string ending = lower_case(mesh_ending_of(path));
  const std::string name = ending == ".carp" ? path.substr(0, path.size() - ending.size()) + ".elem" : path;
  const Result<Bytes> bytes = read_file(name);
  if (!bytes.ok()) return bytes.error();
  const std::size_t folder = name.find_last_of("/\\") + 1;
  return read_tet_mesh(
      {name, *bytes, [&](const std::string& sibling) { return read_file(name.substr(0, folder) + sibling); }},
      arrays);
}

}  // namespace voxtet
