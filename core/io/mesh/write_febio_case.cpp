#include "io/mesh/write_febio_case.h"

#include "io/mesh/shared/xml_text.h"
#include "io/mesh/write/write_febio.h"

namespace voxtet {
namespace {

constexpr double kDensity = 1.06e-6;  ///< of muscle, kg/mm^3

/// Newton's method on all of the tangent, in steps that FEBio may halve.
std::string control_text(const MechanicsCase& wanted) {
  const double step = 1.0 / wanted.steps;
  XmlText xml;
  xml.open("Control").set("analysis", "STATIC").set("time_steps", wanted.steps).set("step_size", step);
  xml.open("solver", "type=\"solid\"").set("symmetric_stiffness", 0).set("max_refs", 25);
  xml.open("qn_method", "type=\"BFGS\"").set("max_ups", 0).close("qn_method").close("solver");
  xml.open("time_stepper", "type=\"default\"").set("dtmin", step / 100).set("dtmax", step);
  xml.set("max_retries", 10).set("opt_iter", 11).close("time_stepper").close("Control");
  return xml.text();
}

/// The resistance to a change of volume is FEBio's "NIKE3D": p = k/2 (J - 1/J).
XmlText& set_volume(XmlText& xml, const MechanicsCase& wanted) {
  return xml.set("k", wanted.bulk_kpa).set("pressure_model", "NIKE3D");
}

std::string passive_text(const MechanicsCase& wanted) {
  XmlText xml;
  xml.set("density", kDensity).set("c1", wanted.c1_kpa).set("c2", wanted.c2_kpa);
  return "type=\"Mooney-Rivlin\">\n" + set_volume(xml, wanted).text();
}

std::string muscle_text(const MechanicsCase& wanted) {
  XmlText xml;
  set_volume(xml.set("density", kDensity), wanted);
  xml.open("solid", "type=\"Mooney-Rivlin\"")
      .set("c1", wanted.c1_kpa)
      .set("c2", wanted.c2_kpa)
      .close("solid");
  xml.open("solid", "type=\"fiber-exp-pow-uncoupled\"").set("ksi", wanted.a_kpa).set("alpha", wanted.b);
  xml.set("beta", 2).set("fiber", "1,0,0", "type=\"vector\"").close("solid");
  return "type=\"uncoupled solid mixture\">\n" + xml.text();
}

std::string end_text(const MechanicsCase& wanted, const std::string& name) {
  XmlText xml;
  xml.open("Boundary");
  xml.open("bc", "name=\"held\" type=\"zero displacement\" node_set=\"@surface:" + wanted.held + "\"");
  xml.set("x_dof", 1).set("y_dof", 1).set("z_dof", 1).close("bc").close("Boundary");
  xml.open("Loads");
  for (const std::string& surface : wanted.loaded) {
    xml.open("surface_load",
             "name=\"pressure_" + surface + "\" type=\"pressure\" surface=\"" + surface + "\"");
    xml.set("pressure", wanted.pressure_kpa, "lc=\"1\"").set("linear", 0).set("symmetric_stiffness", 0);
    xml.close("surface_load");
  }
  xml.close("Loads");
  xml.open("LoadData").open("load_controller", "id=\"1\" name=\"ramp\" type=\"loadcurve\"");
  xml.set("interpolate", "LINEAR").open("points").set("pt", "0,0").set("pt", "1,1").close("points");
  xml.close("load_controller").close("LoadData");
  xml.open("Output").open("plotfile", "type=\"febio\"");
  for (const char* variable : {"displacement", "stress", "relative volume"})
    xml.set("var", "", std::string("type=\"") + variable + "\"");
  xml.close("plotfile").open("logfile");
  xml.set("node_data", "",
          "data=\"ux;uy;uz\" delim=\",\" file=\"" + xml_escaped(name) + ".displacement.txt\"");
  xml.close("logfile").close("Output");
  return xml.text();
}

std::string febio_readme(const MechanicsCase& wanted, const WriteMeshOptions& options) {
  const std::string name = options.name;
  std::string surfaces;
  for (const std::string& surface : wanted.loaded) surfaces += (surfaces.empty() ? "" : ", ") + surface;
  std::string notes;
  for (const std::string& note : wanted.notes) notes += "- " + note + "\n";
  return "Passive inflation, for FEBio 4\n\n"
         "Run: febio4 -i " +
         name + ".feb. Displacements (mm) come into " + name +
         ".displacement.txt, a line a node. Lengths are in mm, stresses in kPa.\n"
         "The names of tags are those of FEBio's manual and sources; the file was not run in FEBio here.\n\n"
         "Parts are labels. Held: " +
         wanted.held + ". Loaded: " + surfaces + ", " + xml_number(wanted.pressure_kpa) + " kPa in " +
         std::to_string(wanted.steps) +
         " even steps; the pressure follows the surface.\n"
         "The material is a value to begin with, not a measurement, and the mesh as it is counts as free of "
         "stress.\n\n"
         "The same as in voxtet:\n"
         "- isotropic part: c1 (I1' - 3) + c2 (I2' - 3), FEBio's Mooney-Rivlin\n"
         "- change of volume: k/4 (J^2 - 1 - 2 ln J), FEBio's pressure_model NIKE3D\n"
         "- fibres resist stretch alone, a/2b (exp(b (I - 1)^2) - 1): fiber-exp-pow-uncoupled with beta 2, "
         "ksi "
         "a, alpha b\n"
         "- directions: of each tetrahedron the fibre (mat_axis a) and, with d, the sheet\n"
         "- elements: displacements alone (elastic-solid); " +
         (options.midside ? "quadratic tetrahedra in four places (TET10G4)\n"
                          : "linear tetrahedra, which lock when the bulk modulus is large: --order 2 writes "
                            "quadratic ones\n") +
         "\nNot the same:\n"
         "- I is the isochoric squared stretch of fibres in FEBio, J^-2/3 f . C f, and f . C f in voxtet. Of "
         "a "
         "small heart in linear tetrahedra,\n  whose volumes vary, the largest displacement was 1.2 % off\n" +
         (options.midside ? "- midside nodes lie on the smoothed label surface; voxtet's own mechanics has "
                            "straight edges\n"
                          : "") +
         "- Parts without fibres are isotropic, without them.\n" + notes;
}

}  // namespace

std::vector<OutputFile> write_febio_case(TetMesh mesh, const MechanicsCase& wanted,
                                         const WriteMeshOptions& options) {
  if (options.midside)
    mesh.points.insert(mesh.points.end(), options.midside->points.begin(), options.midside->points.end());
  FebioAnalysis analysis;
  analysis.fibre = find_field(options.cell_data, kFibreField);
  analysis.sheet = find_field(options.cell_data, kSheetField);
  analysis.control = control_text(wanted);
  analysis.passive = passive_text(wanted);
  analysis.muscle = wanted.a_kpa > 0 ? muscle_text(wanted) : analysis.passive;
  analysis.domain =
      std::string("type=\"elastic-solid\" elem_type=\"") + (options.midside ? "TET10G4" : "TET4G1") + "\"";
  analysis.end = end_text(wanted, options.name);
  const std::string readme = febio_readme(wanted, options);
  return {{".feb", write_febio(mesh, options, analysis)}, {".README.txt", {readme.begin(), readme.end()}}};
}

}  // namespace voxtet
