// The sections of a Gmsh MSH file, read for their nodes, tetrahedra and physical groups.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/mesh/read/shared/mesh_cursor.h"
#include "io/mesh/read/shared/numbered_mesh.h"

namespace voxtet {

/// Content of the sections, in file order and with the tags of the file. Tags are at most 2^53.
struct MshFile {
  int version = 0;  ///< 41 or 22
  bool binary = false;
  bool lps = false;
  std::vector<std::pair<std::int32_t, std::int32_t>>
      volumes;                         ///< 4.1: entity, its first physical group or 0; ascending
  NumberedMesh mesh;                   ///< labels: the (first) physical group, or 0
  std::vector<std::int64_t> entities;  ///< the geometric entity of each tetrahedron
  std::vector<LabelInfo> infos;        ///< the named groups of volumes
};

void read_msh_names(MeshCursor& in, MshFile& file);
void read_msh41_entities(MeshCursor& in, MshFile& file);
void read_msh41_nodes(MeshCursor& in, MshFile& file);
void read_msh41_elements(MeshCursor& in, MshFile& file);
void read_msh22_nodes(MeshCursor& in, MshFile& file);
void read_msh22_elements(MeshCursor& in, MshFile& file);

/// Whether a Gmsh type is a tetrahedron of any order; its corners are the first four nodes.
bool is_msh_tetrahedron(std::int64_t type);

/// Nodes of an element of a Gmsh type; fails for a type that is not in the manual.
int msh_corners(MeshCursor& in, std::int64_t type);

/// One field, as text or as the binary type that the format gives it.
inline std::int32_t msh_int(MeshCursor& in, bool binary, const char* what) {
  return binary ? in.raw<std::int32_t>(what)
                : static_cast<std::int32_t>(in.integer(what, INT32_MIN, INT32_MAX));
}
inline std::uint64_t msh_size(MeshCursor& in, bool binary, const char* what) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  if (!binary) return static_cast<std::uint64_t>(in.integer(what, 0, kMost));
  const auto value = in.raw<std::uint64_t>(what);
  if (value <= static_cast<std::uint64_t>(kMost)) return value;
  in.fail(std::string(what) + " is " + std::to_string(value) + ", expected at most 2^53");
  return 0;
}
inline double msh_real(MeshCursor& in, bool binary, const char* what) {
  return binary ? in.raw<double>(what) : in.real(what);
}

}  // namespace voxtet
