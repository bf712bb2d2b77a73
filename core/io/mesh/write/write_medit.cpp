#include "io/mesh/write/write_medit.h"

#include <string>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {
namespace {

template <class Corners>
void write_element(ByteWriter& out, const Corners& corners, std::int64_t reference) {
  for (const std::uint32_t corner : corners) {
    out.integer(std::int64_t{corner} + 1);
    out.text(" ");
  }
  out.integer(reference);
  out.text("\n");
}

void write_legend(ByteWriter& out, const TetMesh& mesh, const FaceGroups& faces,
                  const WriteMeshOptions& options) {
  const std::vector<Label> labels = group_tets(mesh.labels).labels;
  const std::vector<std::string> names = group_names(labels, options.infos);
  out.text(std::string("# space ") + to_string(options.space) + "\n# unit mm\n");
  for (std::size_t i = 0; i < labels.size(); ++i)
    out.text("# tetrahedra " + std::to_string(labels[i]) + " " + names[i] + "\n");
  for (std::size_t i = 0; i < faces.pairs.size(); ++i)
    out.text("# triangles " + std::to_string(i + 1) + " " + pair_name(faces.pairs[i], labels, names) + "\n");
}

Bytes write_solution(const std::vector<Field>& cell_data) {
  const std::size_t tets = cell_data.front().values.size();
  ByteWriter out(20 * tets * cell_data.size() + 4096);
  out.text("MeshVersionFormatted 2\nDimension\n3\n# fields");
  for (const Field& data : cell_data) out.text(" " + data.name);
  out.text("\nSolAtTetrahedra\n" + std::to_string(tets) + "\n" + std::to_string(cell_data.size()));
  for (std::size_t i = 0; i < cell_data.size(); ++i) out.text(" 1");
  out.text("\n");
  for (std::size_t t = 0; t < tets; ++t)
    for (std::size_t i = 0; i < cell_data.size(); ++i) {
      out.real(cell_data[i].values[t]);
      out.text(i + 1 < cell_data.size() ? " " : "\n");
    }
  out.text("End\n");
  return out.take();
}

}  // namespace

std::vector<OutputFile> write_medit(const TetMesh& mesh, const WriteMeshOptions& options) {
  const FaceGroups faces = group_faces(mesh.face_sides);
  ByteWriter out(64 * mesh.points.size() + 36 * mesh.tets.size() + 28 * mesh.faces.size() + 4096);
  out.text("MeshVersionFormatted 2\nDimension\n3\n");
  write_legend(out, mesh, faces, options);
  out.text("Vertices\n" + std::to_string(mesh.points.size()) + "\n");
  for (const Eigen::Vector3d& ras : mesh.points) {
    const Eigen::Vector3d p = in_space(ras, options.space);
    for (int d = 0; d < 3; ++d) {
      out.real(p[d]);
      out.text(" ");
    }
    out.text("0\n");
  }
  out.text("Tetrahedra\n" + std::to_string(mesh.tets.size()) + "\n");
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) write_element(out, mesh.tets[t], mesh.labels[t]);
  if (!mesh.faces.empty()) {
    out.text("Triangles\n" + std::to_string(mesh.faces.size()) + "\n");
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      write_element(out, mesh.faces[f], std::int64_t{faces.of_face[f]} + 1);
  }
  out.text("End\n");
  std::vector<OutputFile> files{{".mesh", out.take()}};
  if (!options.cell_data.empty()) files.push_back({".sol", write_solution(options.cell_data)});
  return files;
}

}  // namespace voxtet
