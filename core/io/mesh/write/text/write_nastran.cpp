#include "io/mesh/write/text/write_nastran.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/face_owners.h"
#include "io/mesh/shared/facet_tags.h"
#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {
namespace {

constexpr std::size_t kSmallField = 8, kLargeField = 16;
constexpr std::size_t kMostNumbers = 99999999;

/// A number or name at the left of its field.
void write_field(ByteWriter& out, std::string text, std::size_t width) {
  text.resize(width, ' ');
  out.text(text);
}
void write_field(ByteWriter& out, std::size_t number, std::size_t width = kSmallField) {
  write_field(out, std::to_string(number), width);
}

/// With a decimal point, as Nastran's reals must have, and at most 16 characters.
std::string nastran_real(double value) {
  std::array<char, 64> text;
  if (std::abs(value) >= 1e13) {
    std::snprintf(text.data(), text.size(), "%.8E", value);
    return text.data();
  }
  const int whole = std::snprintf(text.data(), text.size(), "%.0f", std::trunc(value));
  const int sign = value < 0 && text[0] != '-' ? 1 : 0;  // of -0.5
  const int decimals = static_cast<int>(kLargeField) - whole - sign - 1;
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  std::string real = text.data();
  if (real.size() > kLargeField) real.pop_back();  // 9.99... was rounded up to 10.00...
  real.erase(real.find_last_not_of('0') + 1);
  return real.back() == '.' ? real + "0" : real;
}

void write_grids(ByteWriter& out, const TetMesh& mesh, PatientSpace space) {
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const Eigen::Vector3d point = in_space(mesh.points[p], space);
    out.text("GRID*   ");
    write_field(out, p + 1, kLargeField);
    write_field(out, "", kLargeField);
    write_field(out, nastran_real(point.x()), kLargeField);
    write_field(out, nastran_real(point.y()), kLargeField);
    out.text("\n*       " + nastran_real(point.z()) + "\n");
  }
}

void write_loads(ByteWriter& out, const TetMesh& mesh, const FacetTags& facets,
                 const std::vector<FaceOwner>& owners) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Tet& tet = mesh.tets[owners[f].tet];
    out.text("PLOAD4  ");
    write_field(out, static_cast<std::size_t>(facets.of_face[f]));
    write_field(out, std::size_t{owners[f].tet} + 1);
    write_field(out, "1.0", 4 * kSmallField);
    write_field(out, std::size_t{mesh.faces[f][0]} + 1);
    out.integer(std::int64_t{tet[owners[f].opposite]} + 1);
    out.text("\n");
  }
}

}  // namespace

Result<std::vector<OutputFile>> write_nastran(const TetMesh& mesh, const WriteMeshOptions& options) {
  if (std::max(mesh.points.size(), mesh.tets.size()) > kMostNumbers)
    return usage_error(kMeshWriter, std::to_string(mesh.points.size()) + " points and " +
                                        std::to_string(mesh.tets.size()) +
                                        " tetrahedra: numbers in .bdf have eight digits, expected at most " +
                                        std::to_string(kMostNumbers));
  const Result<std::vector<FaceOwner>> owners = face_owners(mesh);
  if (!owners) return owners.error();
  const FacetTags facets = facet_tags(mesh, options);
  ByteWriter out(112 * mesh.points.size() + 57 * mesh.tets.size() + 73 * mesh.faces.size() + 4096);
  out.text("$ voxtet mesh\n$ " + coordinates_note(options.space) + "\n");
  for (const std::string& label : label_legend(mesh, options.infos))
    out.text("$ label " + in_ascii(label) + "\n");
  for (const std::string& tag : facet_legend(facets)) out.text("$ load " + in_ascii(tag) + "\n");
  out.text("BEGIN BULK\n");
  for (const Label label : group_tets(mesh.labels).labels) {
    out.text("PSOLID  ");
    write_field(out, std::size_t{label});
    out.text(std::to_string(label) + "\n");
  }
  write_grids(out, mesh, options.space);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    out.text("CTETRA  ");
    write_field(out, t + 1);
    write_field(out, std::size_t{mesh.labels[t]});
    for (std::size_t c = 0; c < 3; ++c) write_field(out, std::size_t{mesh.tets[t][c]} + 1);
    out.text(std::to_string(std::size_t{mesh.tets[t][3]} + 1) + "\n");
  }
  write_loads(out, mesh, facets, *owners);
  out.text("ENDDATA\n");
  return std::vector<OutputFile>{{".bdf", out.take()}};
}

}  // namespace voxtet
