#include "io/mesh/write/write_abaqus.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/element_nodes.h"
#include "io/mesh/shared/face_owners.h"
#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {
namespace {

constexpr std::ptrdiff_t kLongestNumber = 20;

/// The element face opposite each node: S1 is 1-2-3, S2 1-4-2, S3 2-4-3, S4 3-4-1.
constexpr std::array<const char*, 4> kFaceOpposite{"S3", "S4", "S2", "S1"};

void write_real(ByteWriter& out, double value) {
  std::array<char, kRealChars> text;
  char* end = format_real(text.data(), value);
  if (end - text.data() > kLongestNumber)
    end =
        text.data() + std::snprintf(text.data(), text.size(), std::abs(value) < 1 ? "%.15f" : "%.12e", value);
  out.text({text.data(), static_cast<std::size_t>(end - text.data())});
}

void write_abaqus_nodes(ByteWriter& out, const TetMesh& mesh, PatientSpace space) {
  out.text("*NODE\n");
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    out.integer(static_cast<std::int64_t>(p + 1));
    const Eigen::Vector3d point = in_space(mesh.points[p], space);
    for (int d = 0; d < 3; ++d) {
      out.text(", ");
      write_real(out, point[d]);
    }
    out.text("\n");
  }
}

void write_elements(ByteWriter& out, const TetMesh& mesh, const WriteMeshOptions& options) {
  const std::string type = options.midside ? "C3D10" : "C3D4";
  const LabelGroups groups = group_tets(mesh.labels);
  const auto members = group_members(groups.of_tet, groups.labels.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    out.text("*ELEMENT, TYPE=" + type + ", ELSET=" + word_name(groups.labels[i], options.infos) + "\n");
    for (const std::uint32_t tet : members[i]) {
      out.integer(std::int64_t{tet} + 1);
      for (const std::uint32_t node : nodes_of_tet(mesh, tet, options)) {
        out.text(", ");
        out.integer(std::int64_t{node} + 1);
      }
      out.text("\n");
    }
  }
}

void write_surface(ByteWriter& out, const std::string& name, const std::vector<std::uint32_t>& faces,
                   const std::vector<FaceOwner>& owners) {
  out.text("*SURFACE, NAME=" + name + ", TYPE=ELEMENT\n");
  for (const std::uint32_t face : faces) {
    out.integer(std::int64_t{owners[face].tet} + 1);
    out.text(", ");
    out.text(kFaceOpposite[owners[face].opposite]);
    out.text("\n");
  }
}

void write_surfaces(ByteWriter& out, const TetMesh& mesh, const std::vector<FaceOwner>& owners,
                    const WriteMeshOptions& options) {
  const FaceGroups groups = group_faces(mesh.face_sides);
  const auto members = group_members(groups.of_face, groups.pairs.size());
  for (std::size_t i = 0; i < members.size(); ++i)
    write_surface(out, word_name(groups.pairs[i], options.infos), members[i], owners);
  for (const NamedSet& set : options.surfaces) write_surface(out, set.name, set.members, owners);
}

Bytes write_distribution(const Field& data) {
  ByteWriter out(24 * data.values.size() + 128);
  out.text("** " + data.name + ": data lines of *DISTRIBUTION, LOCATION=ELEMENT\n, 0\n");
  for (std::size_t t = 0; t < data.values.size(); ++t) {
    out.integer(static_cast<std::int64_t>(t + 1));
    out.text(", ");
    write_real(out, data.values[t]);
    out.text("\n");
  }
  return out.take();
}

}  // namespace

Result<std::vector<OutputFile>> write_abaqus(const TetMesh& mesh, const WriteMeshOptions& options) {
  const Result<std::vector<FaceOwner>> owners = face_owners(mesh);
  if (!owners) return owners.error();
  ByteWriter out(72 * mesh.points.size() + 44 * mesh.tets.size() + 28 * mesh.faces.size() + 4096);
  out.text("*HEADING\nvoxtet mesh\n** " + coordinates_note(options.space) + "\n** " +
           std::to_string(mesh.points.size()) + " nodes, " + std::to_string(mesh.tets.size()) +
           " elements\n");
  write_abaqus_nodes(out, mesh, options.space);
  write_elements(out, mesh, options);
  write_surfaces(out, mesh, *owners, options);
  std::vector<OutputFile> files{{".inp", out.take()}};
  for (const Field& data : options.cell_data)
    files.push_back({"." + data.name + ".inp", write_distribution(data)});
  return files;
}

}  // namespace voxtet
