#include "io/mesh/write/text/write_tetgen.h"

#include <string>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/facet_tags.h"
#include "io/mesh/shared/mesh_groups.h"
#include "io/mesh/write/text/numbered_points.h"

namespace voxtet {
namespace {

/// The number of an element and one more than each corner.
template <class Corners>
void write_corners(ByteWriter& out, std::size_t number, const Corners& corners) {
  out.integer(static_cast<std::int64_t>(number));
  for (const std::uint32_t corner : corners) {
    out.text(" ");
    out.integer(std::int64_t{corner} + 1);
  }
  out.text(" ");
}

Bytes write_node(const TetMesh& mesh, PatientSpace space) {
  ByteWriter out(72 * mesh.points.size() + 256);
  out.text("# voxtet mesh, " + coordinates_note(space) + "\n" + std::to_string(mesh.points.size()) +
           " 3 0 0\n");
  write_numbered_points(out, mesh.points, space);
  return out.take();
}

Bytes write_ele(const TetMesh& mesh, const WriteMeshOptions& options) {
  ByteWriter out(48 * mesh.tets.size() + 4096);
  for (const std::string& label : label_legend(mesh, options.infos))
    out.text("# label " + in_ascii(label) + "\n");
  out.text(std::to_string(mesh.tets.size()) + " 4 1\n");
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    write_corners(out, t + 1, mesh.tets[t]);
    out.integer(mesh.labels[t]);
    out.text("\n");
  }
  return out.take();
}

Bytes write_face(const TetMesh& mesh, const WriteMeshOptions& options) {
  const FacetTags facets = facet_tags(mesh, options);
  ByteWriter out(40 * mesh.faces.size() + 4096);
  for (const std::string& tag : facet_legend(facets)) out.text("# marker " + in_ascii(tag) + "\n");
  out.text(std::to_string(mesh.faces.size()) + " 1\n");
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    write_corners(out, f + 1, mesh.faces[f]);
    out.integer(facets.of_face[f]);
    out.text("\n");
  }
  return out.take();
}

}  // namespace

std::vector<OutputFile> write_tetgen(const TetMesh& mesh, const WriteMeshOptions& options) {
  return {{".node", write_node(mesh, options.space)},
          {".ele", write_ele(mesh, options)},
          {".face", write_face(mesh, options)}};
}

}  // namespace voxtet
