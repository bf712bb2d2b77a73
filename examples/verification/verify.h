// The parts of verify_physics: each prints a table of what was measured beside what is expected.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "physics/mechanics/elements/nodes.h"
#include "physics/monodomain/monodomain.h"
#include "types/stimulus.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet::verify {

/// `all`: the long parts too.
void print_plane_wave(bool all);
void print_slab(bool all);
void print_eikonal(bool all);
void print_isthmus(bool all);
void print_speed(bool all);
void print_land(bool all);
/// Active stress, pressure curves and the closed loop, as checks.
void print_circulation(bool all);
/// A ventricle under pressure by element and material, a line of JSON each: its mesh, fibres and
/// displacements.
void print_inflation(bool all);

/// Ejection fractions by layers, elements and fibres.
void print_layers(bool all);
/// The benchmark of elastodynamics.
void print_elastodynamics(bool all);
/// Energy and the wall's volume over a beat, as checks.
void print_beat(bool all);

/// Short checks, a line of JSON each: {check, case, measured, unit, expected, source, agrees}.
void print_checks();
/// A line of them: what was measured, what is expected, and whether it lies in [low, high].
void print_check(const char* check, const std::string& what, double measured, const char* unit, double low,
                 double high, const std::string& expected, const char* source);
/// As tables have it: "P1", "P1 ANP", "P1-P1", "P2".
const char* name_of(mechanics::Formulation formulation);
/// A number as printf writes it.
std::string text(const char* format, double value);

/// Of the times by the eikonal equation and by the monodomain model in the generated heart, with these
/// speeds.
double heart_correlation(double along, double across);

/// The value, or else the program ends with the error's message.
template <class T>
T value_or_exit(Result<T> result) {
  if (result) return std::move(result).value();
  std::fprintf(stderr, "verify_physics: %s\n", result.error().message.c_str());
  std::exit(1);
}

/// A box of unstructured tetrahedra by TetGen: from the origin, of so many squares of `square_mm` along x, y
/// and z. Its edges are some 1.2 squares long.
std::shared_ptr<const TetMesh> box_of_tets(const std::array<int, 3>& squares, double square_mm);
/// Of all edges, each once, mm.
double mean_edge_mm(const TetMesh& mesh);

/// The box between the origin's corner and this one.
Stimulus at_corner(const Eigen::Vector3d& size_mm);

/// One way to integrate.
struct Way {
  const char* name;
  Integration integration;
  double consistent_mass;
};
/// With an end that no activation here comes near to.
MonodomainParams params_of(const Way& way, double step_ms);

/// A bar along x for plane waves, with edges of some `edge_mm`: 8 squares wide, 60 mm long, 30 mm if they are
/// shorter than 1 mm.
std::shared_ptr<const TetMesh> bar_of_tets(double edge_mm);
/// mm/ms, of a wave from one end in tissue of 0.5 mm/ms: of the line of least squares through the times of
/// all points of the bar's middle.
double speed_along(const std::shared_ptr<const TetMesh>& bar, const MonodomainParams& params);
/// The same in the limit of short edges: along one row of bricks.
double fine_speed(const MonodomainParams& params);

/// One step of the model, however many parts it has.
void step(Monodomain& heart);

/// The first activation of each point, ms, from a run that ends when all have one, or at params.end_ms.
std::vector<float> activations_ms(const std::shared_ptr<const TetMesh>& mesh, const Tissue& tissue,
                                  const Stimulus& stimulus, const MonodomainParams& params);

}  // namespace voxtet::verify
