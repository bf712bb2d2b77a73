#include "io/mesh/write_svmultiphysics_case.h"

#include <algorithm>
#include <cstdint>

#include "io/mesh/shared/face_owners.h"
#include "io/mesh/shared/mesh_groups.h"
#include "io/mesh/shared/xml_text.h"
#include "io/mesh/write/vtk_xml.h"
#include "io/mesh/write/write_vtu.h"

namespace voxtet {
namespace {

constexpr double kSeconds = 1;  ///< in which the load grows
/// A thousandth of muscle's (kg/mm^3), so that inertia hardly counts.
constexpr double kLightDensity = 1.06e-9;
constexpr int kStepsPerLoadStep = 10;
/// How steep the model's switch is, between fibres that are shortened and those that are stretched.
constexpr double kSwitch = 100;

/// What is in one file: points, cells of some of them, and the tetrahedra that cells are or belong to.
struct CellGrid {
  std::vector<std::uint32_t> points;   ///< of the mesh
  std::vector<std::uint32_t> corners;  ///< of cells, by place in `points`
  std::size_t per_cell = 4;
  std::vector<std::uint32_t> tets;  ///< one for each cell
};

CellGrid grid_of(const TetMesh& mesh) {
  CellGrid grid;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) grid.points.push_back(p);
  for (const Tet& tet : mesh.tets) grid.corners.insert(grid.corners.end(), tet.begin(), tet.end());
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) grid.tets.push_back(t);
  return grid;
}

CellGrid grid_of(const TetMesh& mesh, const NamedSet& faces, const std::vector<FaceOwner>& owners) {
  CellGrid grid;
  grid.per_cell = 3;
  for (const std::uint32_t face : faces.members) {
    grid.points.insert(grid.points.end(), mesh.faces[face].begin(), mesh.faces[face].end());
    grid.tets.push_back(owners[face].tet);
  }
  std::sort(grid.points.begin(), grid.points.end());
  grid.points.erase(std::unique(grid.points.begin(), grid.points.end()), grid.points.end());
  for (const std::uint32_t face : faces.members)
    for (const std::uint32_t corner : mesh.faces[face])
      grid.corners.push_back(static_cast<std::uint32_t>(
          std::lower_bound(grid.points.begin(), grid.points.end(), corner) - grid.points.begin()));
  return grid;
}

/// Numbers from 1, as svMultiPhysics has them.
void append_ids(ByteWriter& out, const std::vector<std::uint32_t>& of) {
  out.raw(std::uint64_t{4 * of.size()});
  for (const std::uint32_t i : of) out.raw(static_cast<std::int32_t>(i + 1));
}

/// Triangles as PolyData, or tetrahedra as UnstructuredGrid; with `direction` these have it as FIB_DIR
/// instead of numbers.
Bytes write_grid(const TetMesh& mesh, const CellGrid& grid, PatientSpace space,
                 const Field* direction = nullptr) {
  const std::size_t cells = grid.tets.size();
  const bool solid = grid.per_cell == 4;
  const std::string count = std::to_string(cells);
  VtkXml xml(solid ? "UnstructuredGrid" : "PolyData", coordinates_note(space), "",
             "NumberOfPoints=\"" + std::to_string(grid.points.size()) + "\" " +
                 (solid ? "NumberOfCells" : "NumberOfPolys") + "=\"" + count + "\"");
  const std::string vectors = " NumberOfComponents=\"3\"";
  if (!direction) {
    xml.open("PointData");
    xml.array("Int32", "GlobalNodeID", 4 * grid.points.size());
    xml.open("/PointData");
  }
  xml.open("CellData");
  if (direction)
    xml.array("Float64", "FIB_DIR", 24 * cells, vectors);
  else
    xml.array("Int32", "GlobalElementID", 4 * cells);
  xml.open("/CellData");
  xml.open("Points");
  xml.array("Float64", "Points", 24 * grid.points.size(), vectors);
  xml.open("/Points");
  xml.open(solid ? "Cells" : "Polys");
  xml.array("Int64", "connectivity", 8 * grid.corners.size());
  xml.array("Int64", "offsets", 8 * cells);
  if (solid) xml.array("UInt8", "types", cells);
  xml.open(solid ? "/Cells" : "/Polys");

  ByteWriter out = xml.finish();
  if (!direction) append_ids(out, grid.points);
  if (direction) {
    out.raw(std::uint64_t{24 * cells});
    for (const float value : in_space(*direction, space)) out.raw(double{value});
  } else {
    append_ids(out, grid.tets);
  }
  out.raw(std::uint64_t{24 * grid.points.size()});
  for (const std::uint32_t p : grid.points)
    for (const double x : in_space(mesh.points[p], space)) out.raw(x);
  out.raw(std::uint64_t{8 * grid.corners.size()});
  for (const std::uint32_t corner : grid.corners) out.raw(std::int64_t{corner});
  out.raw(std::uint64_t{8 * cells});
  for (std::size_t i = 1; i <= cells; ++i) out.raw(static_cast<std::int64_t>(grid.per_cell * i));
  if (solid) {
    out.raw(std::uint64_t{cells});
    for (std::size_t i = 0; i < cells; ++i) out.raw(kVtkTetra);
  }
  out.text(VtkXml::kFooter);
  return out.take();
}

void set_times(XmlText& xml, const MechanicsCase& wanted, const std::string& name) {
  const int steps = wanted.steps * kStepsPerLoadStep;
  xml.open("GeneralSimulationParameters").set("Continue_previous_simulation", 0);
  xml.set("Number_of_spatial_dimensions", 3).set("Number_of_time_steps", steps);
  xml.set("Time_step_size", kSeconds / steps).set("Spectral_radius_of_infinite_time_step", 0.5);
  xml.set("Searched_file_name_to_trigger_stop", "STOP_SIM").set("Save_results_to_VTK_format", 1);
  xml.set("Name_prefix_of_saved_VTK_files", name).set("Increment_in_saving_VTK_files", kStepsPerLoadStep);
  xml.set("Start_saving_after_time_step", 1).set("Increment_in_saving_restart_files", steps);
  xml.set("Convert_BIN_to_VTK_format", 0).set("Verbose", 1).set("Warning", 1).set("Debug", 0);
  xml.close("GeneralSimulationParameters");
}

void set_mesh(XmlText& xml, const WriteMeshOptions& options, const std::string& name) {
  xml.open("Add_mesh", "name=\"wall\"").set("Mesh_file_path", name + ".mesh.vtu");
  for (const NamedSet& surface : options.surfaces)
    xml.open("Add_face", "name=\"" + surface.name + "\"")
        .set("Face_file_path", name + "." + surface.name + ".vtp")
        .close("Add_face");
  xml.set("Fiber_direction_file_path", name + ".fibersLong.vtu");
  xml.set("Fiber_direction_file_path", name + ".fibersSheet.vtu");
  xml.set("Mesh_scale_factor", 1).close("Add_mesh");
}

/// Young's modulus and Poisson's ratio as they are near rest; stabilization alone uses them.
void set_elasticity(XmlText& xml, const MechanicsCase& wanted) {
  const double shear = 2 * (wanted.c1_kpa + wanted.c2_kpa), bulk = wanted.bulk_kpa;
  xml.set("Density", kLightDensity).set("Elasticity_modulus", 9 * bulk * shear / (3 * bulk + shear));
  xml.set("Poisson_ratio", (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear));
}

void set_material(XmlText& xml, const MechanicsCase& wanted) {
  set_elasticity(xml, wanted);
  xml.open("Constitutive_model", "type=\"HolzapfelOgden-ModifiedAnisotropy\"");
  xml.set("a", 2 * (wanted.c1_kpa + wanted.c2_kpa)).set("b", 0);
  xml.set("a4f", wanted.a_kpa).set("b4f", wanted.b).set("a4s", 0).set("b4s", 1).set("afs", 0).set("bfs", 1);
  xml.set("k", kSwitch).close("Constitutive_model");
  xml.set("Dilational_penalty_model", "ST91").set("Penalty_parameter", wanted.bulk_kpa);
}

void set_solver(XmlText& xml) {
  xml.open("Output", "type=\"Spatial\"").set("Displacement", "true").set("Jacobian", "true");
  xml.set("Cauchy_stress", "true").close("Output");
  xml.open("LS", "type=\"GMRES\"").open("Linear_algebra", "type=\"fsils\"").set("Preconditioner", "fsils");
  xml.close("Linear_algebra").set("Tolerance", "1e-9").set("Max_iterations", 1000);
  xml.set("Krylov_space_dimension", 250).close("LS");
}

void set_boundary(XmlText& xml, const MechanicsCase& wanted, const std::string& name) {
  xml.open("Add_BC", "name=\"" + wanted.held + "\"").set("Type", "Dirichlet").set("Value", 0).close("Add_BC");
  for (const std::string& surface : wanted.loaded) {
    xml.open("Add_BC", "name=\"" + surface + "\"").set("Type", "Neu").set("Time_dependence", "Unsteady");
    xml.set("Temporal_values_file_path", name + ".pressure.dat").set("Ramp_function", "true");
    xml.set("Follower_pressure_load", "true").close("Add_BC");
  }
}

std::string solver_text(const MechanicsCase& wanted, const WriteMeshOptions& options) {
  const std::string name = xml_escaped(options.name);
  XmlText xml;
  xml.open("svMultiPhysicsFile", "version=\"0.1\"").comment("lengths mm, stresses kPa, density kg/mm^3");
  set_times(xml, wanted, name);
  set_mesh(xml, options, name);
  xml.open("Add_equation", "type=\"struct\"").set("Coupled", "true");
  xml.set("Min_iterations", 1).set("Max_iterations", 20).set("Tolerance", "1e-6");
  set_material(xml, wanted);
  set_solver(xml);
  set_boundary(xml, wanted, name);
  xml.close("Add_equation").close("svMultiPhysicsFile");
  return "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n" + xml.text();
}

std::string svmultiphysics_readme(const MechanicsCase& wanted, const WriteMeshOptions& options) {
  std::string surfaces;
  for (const std::string& surface : wanted.loaded) surfaces += (surfaces.empty() ? "" : ", ") + surface;
  std::string notes;
  for (const std::string& note : wanted.notes) notes += "- " + note + "\n";
  return "Passive inflation, for svMultiPhysics\n\n"
         "Run: svmultiphysics " +
         options.name +
         ".xml, in the folder of these files. Lengths are in mm, times in s, stresses in kPa.\n"
         "The names of tags are those of svMultiPhysics' sources and of its case struct/"
         "LV_HolzapfelOgden_active; the\nfiles were not run in svMultiPhysics here.\n\n"
         "Held: " +
         wanted.held + ". Loaded: " + surfaces + ", up to " + xml_number(wanted.pressure_kpa) +
         " kPa, evenly over " + xml_number(kSeconds) +
         " s; the pressure follows the surface.\n"
         "The material is a value to begin with, not a measurement, and the mesh as it is counts as free of "
         "stress.\n\n"
         "The same as in voxtet:\n"
         "- change of volume: k/4 (J^2 - 1 - 2 ln J), the penalty model ST91\n"
         "- fibres: a/2b (exp(b (f . C f - 1)^2) - 1), a4f and b4f\n"
         "- elements: linear tetrahedra of displacements alone, which lock when the bulk modulus is large\n"
         "- directions: of each tetrahedron the fibre and the sheet\n\n"
         "Not the same:\n"
         "- isotropic part: (c1 + c2) (I1' - 3), of the same shear modulus, in the place of c1 (I1' - 3) + "
         "c2 "
         "(I2' - 3):\n  a = 2 (c1 + c2), b = 0\n"
         "- fibres: that they resist stretch alone is a smooth switch, 1 / (1 + exp(-k (f . C f - 1))) with "
         "k "
         "= " +
         xml_number(kSwitch) +
         "\n- time: svMultiPhysics has inertia; with a thousandth of muscle's density it hardly counts\n" +
         notes + "\nOf a small heart, the largest displacement was 1.3 % off for the first two.\n";
}

}  // namespace

Result<std::vector<OutputFile>> write_svmultiphysics_case(const TetMesh& mesh, const MechanicsCase& wanted,
                                                          const WriteMeshOptions& options) {
  const Result<std::vector<FaceOwner>> owners = face_owners(mesh);
  if (!owners) return owners.error();
  const CellGrid wall = grid_of(mesh);
  const Field* fibre = find_field(options.cell_data, kFibreField);
  const Field* sheet = find_field(options.cell_data, kSheetField);
  const std::string solver = solver_text(wanted, options), readme = svmultiphysics_readme(wanted, options);
  const std::string ramp = "2 1\n0 0\n" + xml_number(kSeconds) + " " + xml_number(wanted.pressure_kpa) + "\n";
  std::vector<OutputFile> files{{".xml", {solver.begin(), solver.end()}},
                                {".mesh.vtu", write_grid(mesh, wall, options.space)},
                                {".fibersLong.vtu", write_grid(mesh, wall, options.space, fibre)},
                                {".fibersSheet.vtu", write_grid(mesh, wall, options.space, sheet)},
                                {".pressure.dat", {ramp.begin(), ramp.end()}},
                                {".README.txt", {readme.begin(), readme.end()}}};
  for (const NamedSet& surface : options.surfaces)
    files.push_back(
        {"." + surface.name + ".vtp", write_grid(mesh, grid_of(mesh, surface, *owners), options.space)});
  return files;
}

}  // namespace voxtet
