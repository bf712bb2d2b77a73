#include "io/mesh/read/read_medit.h"

#include <algorithm>
#include <cctype>

#include "io/bytes/header_text.h"
#include "io/mesh/read/shared/found_labels.h"
#include "io/mesh/read/shared/mesh_cursor.h"

namespace voxtet {
namespace {

void read_vertices(MeshCursor& in, std::vector<Eigen::Vector3d>& points) {
  const std::int64_t count = in.integer("the number of vertices", 0, kMostItems);
  if (!in.can_hold(static_cast<std::uint64_t>(count), 8, "vertices")) return;
  points.reserve(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count && in.ok(); ++i) {
    const double x = in.real("a coordinate"), y = in.real("a coordinate"), z = in.real("a coordinate");
    points.emplace_back(x, y, z);
    in.real("a vertex reference");
  }
}

void read_tetrahedra(MeshCursor& in, TetMesh& mesh, std::vector<std::int64_t>& references) {
  const std::int64_t count = in.integer("the number of tetrahedra", 0, kMostItems);
  if (!in.can_hold(static_cast<std::uint64_t>(count), 10, "tetrahedra")) return;
  mesh.tets.reserve(static_cast<std::size_t>(count));
  references.reserve(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count && in.ok(); ++i) {
    Tet tet{};
    for (std::uint32_t& corner : tet)
      corner = static_cast<std::uint32_t>(in.integer("a vertex of a tetrahedron", 1, kMostItems) - 1);
    mesh.tets.push_back(tet);
    references.push_back(in.integer("the reference of a tetrahedron", INT32_MIN, INT32_MAX));
  }
}

/// Tetrahedra may stand before the vertices, so that their corners can be judged only at the end.
void check_corners(MeshCursor& in, const TetMesh& mesh) {
  for (std::size_t t = 0; t < mesh.tets.size() && in.ok(); ++t)
    for (const std::uint32_t corner : mesh.tets[t])
      if (corner >= mesh.points.size())
        in.fail("tetrahedron " + std::to_string(t + 1) + ": vertex " +
                std::to_string(std::uint64_t{corner} + 1) + ", expected 1 to " +
                std::to_string(mesh.points.size()));
}

bool starts_keyword(std::string_view word) {
  return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
}

/// Comments before the vertices may say the space.
bool says_lps(std::span<const std::uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.substr(0, text.find("\nVertices")).find("\n# space LPS\n") != std::string_view::npos;
}

/// "# tetrahedra 1 LV myocardium", as write_medit writes them.
std::vector<LabelInfo> names_of(std::span<const std::uint8_t> bytes) {
  std::vector<LabelInfo> infos;
  std::size_t at = 0;
  bool ended = false;
  while (const auto line = next_line(bytes, at, ended)) {
    if (*line == "Vertices") break;
    constexpr std::string_view kName = "# tetrahedra ";
    if (!line->starts_with(kName)) continue;
    const std::string_view rest = line->substr(kName.size());
    const std::size_t space = rest.find(' ');
    if (space != std::string_view::npos)
      add_label_name(parse_integer(rest.substr(0, space)).value_or(0), rest.substr(space + 1), infos);
  }
  return infos;
}

}  // namespace

Result<TetMesh> read_medit(const VolumeFile& file, MeshArrays* arrays) {
  MeshCursor in(file.bytes, file.name, "read_medit", '#');
  TetMesh mesh;
  std::vector<std::int64_t> references;
  in.expect("MeshVersionFormatted");
  in.integer("the version", 1, 4);
  bool ended = false, seen_vertices = false, seen_tetrahedra = false;
  while (in.ok() && !ended) {
    const std::string_view keyword = in.word("End");
    if (keyword == "End") {
      ended = true;
    } else if (keyword == "Dimension") {
      in.integer("Dimension", 3, 3);
    } else if (keyword == "Vertices" && !seen_vertices) {
      seen_vertices = true;
      read_vertices(in, mesh.points);
    } else if (keyword == "Tetrahedra" && !seen_tetrahedra) {
      seen_tetrahedra = true;
      read_tetrahedra(in, mesh, references);
    } else if (starts_keyword(keyword) && keyword != "Vertices" && keyword != "Tetrahedra") {
      while (!in.at_end() && !starts_keyword(in.peek_word())) in.word("a number");
    } else if (in.ok()) {
      in.fail("found " + in_quotes(keyword) + ", expected a keyword that has not come before");
    }
  }
  check_corners(in, mesh);
  set_labels(in, mesh, references, "reference", arrays);
  if (arrays) arrays->infos = names_of(file.bytes);
  return finish_mesh(in, std::move(mesh), says_lps(file.bytes));
}

}  // namespace voxtet
