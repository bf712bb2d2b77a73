#include "io/mesh/write_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "io/bytes/files.h"
#include "io/bytes/header_text.h"
#include "io/mesh/shared/element_nodes.h"
#include "io/mesh/write/text/write_msh22.h"
#include "io/mesh/write/text/write_nastran.h"
#include "io/mesh/write/text/write_tetgen.h"
#include "io/mesh/write/text/write_vtk.h"
#include "io/mesh/write/write_abaqus.h"
#include "io/mesh/write/write_carp.h"
#include "io/mesh/write/write_febio.h"
#include "io/mesh/write/write_medit.h"
#include "io/mesh/write/write_msh.h"
#include "io/mesh/write/write_ply.h"
#include "io/mesh/write/write_stl.h"
#include "io/mesh/write/write_vtu.h"
#include "io/mesh/write/write_xdmf.h"

namespace voxtet {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

std::optional<Error> broken(const std::string& message) {
  return Error{ErrorCode::kInternal, kMeshWriter, message, {}};
}

/// The invariants that the writers rely on to stay inside their arrays and to write files that can be read.
template <std::size_t kCorners>
std::optional<Error> check_elements(const std::vector<Eigen::Vector3d>& points,
                                    const std::vector<std::array<std::uint32_t, kCorners>>& elements,
                                    std::size_t attributes, const std::string& name) {
  if (elements.size() != attributes)
    return broken(std::to_string(elements.size()) + " " + name + " carry " + std::to_string(attributes) +
                  " labels, expected as many");
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const std::uint32_t corner : elements[e])
      if (corner >= points.size())
        return broken(name + ": element " + std::to_string(e) + " uses point " + std::to_string(corner) +
                      " of " + std::to_string(points.size()));
  return {};
}

std::optional<Error> check_points(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    return broken(std::to_string(points.size()) + " points, expected fewer than 2^31");
  for (std::size_t p = 0; p < points.size(); ++p)
    if (!points[p].allFinite())
      return broken("point " + std::to_string(p) + " has a coordinate that is not finite");
  return {};
}

/// The boundary faces as a surface of their own, with only the points that they use; with second-order
/// triangles where `options` have them, and then as they are for the surface.
struct Boundary {
  SurfaceMesh surface;
  WriteMeshOptions options;
};

Boundary boundary_of(const TetMesh& mesh, const WriteMeshOptions& options) {
  Boundary boundary{{}, options};
  SurfaceMesh& surface = boundary.surface;
  surface.sides = mesh.face_sides;
  std::vector<ElementNodes> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    faces.push_back(nodes_of_face(mesh.faces, f, mesh.points.size(), options));
  std::vector<std::uint32_t> place(mesh.points.size(), kUnused);
  for (const ElementNodes& face : faces)
    for (const std::uint32_t node : face) place[node] = 0;
  const std::size_t first_midside =
      mesh.points.size() - (options.midside ? options.midside->points.size() : 0);
  std::uint32_t corners = 0;
  for (std::size_t p = 0; p < place.size(); ++p) {
    if (place[p] == kUnused) continue;
    place[p] = static_cast<std::uint32_t>(surface.points.size());
    surface.points.push_back(mesh.points[p]);
    if (p < first_midside) ++corners;
  }
  if (options.midside)
    boundary.options.midside =
        MidsideNodes{{}, {surface.points.begin() + corners, surface.points.end()}, {}, {}};
  for (const ElementNodes& face : faces) {
    const auto& n = face.numbers;
    surface.triangles.push_back({place[n[0]], place[n[1]], place[n[2]]});
    if (options.midside)
      boundary.options.midside->faces.push_back(
          {place[n[3]] - corners, place[n[4]] - corners, place[n[5]] - corners});
  }
  return boundary;
}

std::optional<Error> check_surface(const SurfaceMesh& surface) {
  if (surface.triangles.empty())
    return Error{ErrorCode::kUsage,
                 kMeshWriter,
                 "no triangles to write (a mesh read from a file carries no faces)",
                 {}};
  if (auto error = check_points(surface.points)) return error;
  return check_elements(surface.points, surface.triangles, surface.sides.size(), "triangles");
}

std::optional<Error> check_mesh(const TetMesh& mesh) {
  if (mesh.tets.empty()) return Error{ErrorCode::kUsage, kMeshWriter, "no tetrahedra to write", {}};
  if (auto error = check_points(mesh.points)) return error;
  if (auto error = check_elements(mesh.points, mesh.tets, mesh.labels.size(), "tetrahedra")) return error;
  return check_elements(mesh.points, mesh.faces, mesh.face_sides.size(), "faces");
}

/// Fields on `count` elements of one kind.
std::optional<Error> check_data(const std::vector<Field>& fields, On on, std::size_t count) {
  for (const Field& data : fields) {
    if (!is_field_name(data.name))
      return broken("data \"" + data.name + "\": expected a name of letters, digits and _");
    if (data.on != on)
      return broken("data " + data.name + ": found values of " + std::string(name_of(data.on)) +
                    ", expected values of " + std::string(name_of(on)));
    if (data.values.size() != count * static_cast<std::size_t>(data.components))
      return broken("data " + data.name + ": " + std::to_string(data.values.size()) + " values for " +
                    std::to_string(count) + " " + std::string(name_of(on)));
  }
  return {};
}

std::optional<Error> check_cell_data(const std::vector<Field>& fields, std::size_t tets) {
  for (const Field& data : fields)
    if (!all_finite(data.values))
      return broken("cell data " + data.name + " hold a value that is not finite");
  return check_data(fields, On::kTets, tets);
}

/// Sets of `count` faces.
std::optional<Error> check_sets(const std::vector<NamedSet>& sets, std::size_t count) {
  std::vector<bool> taken(count, false);
  for (const NamedSet& set : sets) {
    if (!is_field_name(set.name))
      return broken("surface \"" + set.name + "\": expected a name of letters, digits and _");
    for (const std::uint32_t face : set.members) {
      if (face >= count)
        return broken("surface " + set.name + ": face " + std::to_string(face) + " of " +
                      std::to_string(count));
      if (taken[face])
        return broken("surface " + set.name + ": face " + std::to_string(face) +
                      " is in a surface already, expected it once");
      taken[face] = true;
    }
  }
  return {};
}

/// Surfaces are written without data, whatever there is.
std::optional<Error> check_places(const WriteMeshOptions& options, MeshFormat format) {
  for (const Field& data : options.cell_data)
    if (data.components != 1 && !has_place_for(data.on, data.components, format))
      return usage_error(kMeshWriter, "vectors on tetrahedra (" + data.name +
                                          "): this format has no place for them, expected .vtu, .vtk, .xdmf, "
                                          ".carp or .msh");
  for (const Field& data : options.point_data)
    if (!has_place_for(data.on, data.components, format))
      return usage_error(kMeshWriter,
                         "values at points (" + data.name +
                             "): this format has no place for them, expected .vtu, .vtk, .xdmf or .carp");
  return {};
}

std::optional<Error> check_second_order(const TetMesh& mesh, MeshFormat format, const MidsideNodes& midside) {
  if (!has_second_order(format))
    return usage_error(kMeshWriter,
                       "second-order tetrahedra: this format is not written with them, expected " +
                           std::string(kSecondOrderEndings));
  if (midside.edges.size() != midside.points.size() || midside.tets.size() != mesh.tets.size() ||
      midside.faces.size() != mesh.faces.size())
    return broken("second-order nodes are those of another mesh");
  if (auto error = check_points(midside.points)) return error;
  if (auto error = check_elements(mesh.points, midside.edges, midside.points.size(), "edges")) return error;
  if (auto error = check_elements(midside.points, midside.tets, mesh.tets.size(), "edges of tetrahedra"))
    return error;
  return check_elements(midside.points, midside.faces, mesh.faces.size(), "edges of faces");
}

/// The mesh as the writers of second-order elements see it: the points on edges come after the corners.
TetMesh with_midside_points(TetMesh mesh, const MidsideNodes& midside) {
  mesh.points.insert(mesh.points.end(), midside.points.begin(), midside.points.end());
  return mesh;
}

/// The mean of both ends at each point on an edge.
WriteMeshOptions with_midside_values(WriteMeshOptions options) {
  for (Field& field : options.point_data) {
    const auto components = static_cast<std::size_t>(field.components);
    for (const auto& [a, b] : options.midside->edges)
      for (std::size_t c = 0; c < components; ++c)
        field.values.push_back((field.values[components * a + c] + field.values[components * b + c]) / 2);
  }
  return options;
}

std::vector<OutputFile> write_vtu_files(const TetMesh& mesh, const WriteMeshOptions& options) {
  std::vector<OutputFile> files{{".vtu", write_vtu(mesh, options)}};
  if (options.surfaces.empty()) return files;
  const Boundary boundary = boundary_of(mesh, options);
  files.push_back({".surfaces.vtu", write_vtu(boundary.surface, boundary.options)});
  return files;
}

std::vector<OutputFile> write_vtk_files(const TetMesh& mesh, const WriteMeshOptions& options) {
  std::vector<OutputFile> files{{".vtk", write_vtk(mesh, options)}};
  if (!options.surfaces.empty())
    files.push_back({".surfaces.vtk", write_vtk(boundary_of(mesh, options).surface, options)});
  return files;
}

/// `mesh` and `options` as the writers see them.
Result<std::vector<OutputFile>> write_checked(const TetMesh& mesh, MeshFormat format,
                                              const WriteMeshOptions& options) {
  switch (format) {
    case MeshFormat::kVtu: return write_vtu_files(mesh, options);
    case MeshFormat::kVtk: return write_vtk_files(mesh, options);
    case MeshFormat::kMsh: return write_msh(mesh, options);
    case MeshFormat::kMsh22: return write_msh22(mesh, options);
    case MeshFormat::kMedit: return write_medit(mesh, options);
    case MeshFormat::kCarp: return write_carp(mesh, options);
    case MeshFormat::kAbaqus: return write_abaqus(mesh, options);
    case MeshFormat::kFebio: return std::vector<OutputFile>{{".feb", write_febio(mesh, options)}};
    case MeshFormat::kNastran: return write_nastran(mesh, options);
    case MeshFormat::kTetgen: return write_tetgen(mesh, options);
    case MeshFormat::kXdmf: return write_xdmf(mesh, options);
    case MeshFormat::kStl:
    case MeshFormat::kLabelStl:
    case MeshFormat::kPly: break;
  }
  return write_surface(boundary_of(mesh, options).surface, format, options);
}

}  // namespace

std::vector<std::string> files_of_mesh(const std::string& path) {
  const Result<MeshFormat> format = mesh_format_of(path);
  if (!format) return {path};
  const std::string base = path.substr(0, path.size() - mesh_ending_of(path).size());
  if (*format == MeshFormat::kCarp) return {base + ".pts", base + ".elem", base + ".lon", base + ".lon.txt"};
  if (*format == MeshFormat::kXdmf)
    return {base + ".xdmf", base + ".h5", base + ".facets.xdmf", base + ".facets.h5"};
  if (*format == MeshFormat::kTetgen) return {base + ".node", base + ".ele", base + ".face"};
  return {path};
}

Result<std::vector<OutputFile>> write_tet_mesh(const TetMesh& mesh, MeshFormat format,
                                               const WriteMeshOptions& options) {
  if (auto error = check_mesh(mesh)) return *std::move(error);
  if (auto error = check_cell_data(options.cell_data, mesh.tets.size())) return *std::move(error);
  if (auto error = check_data(options.point_data, On::kPoints, mesh.points.size())) return *std::move(error);
  if (auto error = check_places(options, format)) return *std::move(error);
  if (auto error = check_sets(options.surfaces, mesh.faces.size())) return *std::move(error);
  if (!options.midside) return write_checked(mesh, format, options);
  if (auto error = check_second_order(mesh, format, *options.midside)) return *std::move(error);
  return write_checked(with_midside_points(mesh, *options.midside), format, with_midside_values(options));
}

Result<std::vector<OutputFile>> write_surface(const SurfaceMesh& surface, MeshFormat format,
                                              const WriteMeshOptions& options) {
  if (options.midside)
    return usage_error(kMeshWriter, "a surface is written with first-order triangles only");
  if (auto error = check_surface(surface)) return *std::move(error);
  if (auto error = check_sets(options.surfaces, surface.triangles.size())) return *std::move(error);
  switch (format) {
    case MeshFormat::kVtu: return std::vector<OutputFile>{{".vtu", write_vtu(surface, options)}};
    case MeshFormat::kVtk: return std::vector<OutputFile>{{".vtk", write_vtk(surface, options)}};
    case MeshFormat::kStl: return std::vector<OutputFile>{{".stl", write_stl(surface, options)}};
    case MeshFormat::kLabelStl: return write_label_stls(surface, options);
    case MeshFormat::kPly: return std::vector<OutputFile>{{".ply", write_ply(surface, options)}};
    case MeshFormat::kMsh:
    case MeshFormat::kMsh22:
    case MeshFormat::kMedit:
    case MeshFormat::kCarp:
    case MeshFormat::kAbaqus:
    case MeshFormat::kNastran:
    case MeshFormat::kFebio:
    case MeshFormat::kXdmf:
    case MeshFormat::kTetgen: break;
  }
  return Error{ErrorCode::kUsage, kMeshWriter, "a surface is written as .stl, .ply, .vtu or .vtk only", {}};
}

Status write_files(const std::string& path, const std::vector<OutputFile>& files) {
  if (const Result<MeshFormat> format = mesh_format_of(path); !format.ok()) return format.error();
  const std::string base = path.substr(0, path.size() - mesh_ending_of(path).size());
  std::vector<TargetFile> targets;
  const std::string ending = lower_case(mesh_ending_of(path));
  for (const OutputFile& file : files) {
    // The ending that was asked for keeps its case; .nas is another one of .bdf.
    const bool asked = ending == file.suffix || (ending == ".nas" && file.suffix == ".bdf");
    targets.push_back({asked ? path : base + file.suffix, file.bytes});
  }
  return place_files(targets);
}

}  // namespace voxtet
