// Problems of Land et al., "Verification of cardiac mechanics software: benchmark problems and solutions for
// testing active and passive material behaviour", Proceedings of the Royal Society A 471 (2015).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "physics/mechanics/solve/load_steps.h"
#include "support/bricks.h"
#include "support/ellipsoid.h"
#include "types/tet_mesh.h"

namespace voxtet::test {

/// The faces of a mesh for which `is_wanted` holds at all three points.
template <class IsWanted>
std::vector<Triangle> faces_where(const TetMesh& mesh, IsWanted&& is_wanted) {
  std::vector<Triangle> faces;
  for (const Triangle& face : mesh.faces)
    if (is_wanted(face[0]) && is_wanted(face[1]) && is_wanted(face[2])) faces.push_back(face);
  return faces;
}

/// Of each displacement, whether it belongs to a node for whose place `is_held` holds.
template <class IsHeld>
std::vector<bool> held_where(const mechanics::Nodes& nodes, IsHeld&& is_held) {
  std::vector<bool> held;
  for (const Eigen::Vector3d& place : nodes.places()) held.insert(held.end(), 3, is_held(place));
  return held;
}

/// How far the pressures of nodes jump from one to the next: the root of the mean square of what a pressure
/// and the mean of its neighbours' differ by, over that of the pressures. 0 where nodes have none.
inline double pressure_oscillation(const mechanics::Body& body, const Eigen::VectorXd& u) {
  const mechanics::Nodes& nodes = body.nodes();
  const Eigen::VectorXd pressure = body.node_pressures_kpa(u);
  std::vector<mechanics::NodeGroup> tets;
  for (std::size_t t = 0; t < nodes.tets(); ++t) tets.emplace_back(nodes.of_tet(t), 4);
  const mechanics::NodeGraph graph(nodes.places().size(), tets);
  double jumps = 0;
  for (Eigen::Index i = 0; i < pressure.size(); ++i) {
    const auto around = graph.of(static_cast<std::size_t>(i));
    double others = -pressure[i];
    for (const std::uint32_t other : around) others += pressure[other];
    const double jump = pressure[i] - others / static_cast<double>(around.size() - 1);
    jumps += jump * jump;
  }
  return jumps > 0 ? std::sqrt(jumps / pressure.squaredNorm()) : 0;
}

/// What a solve of a problem gave.
struct LandResult {
  Eigen::VectorXd u;
  std::size_t unknowns = 0;
  int iterations = 0, factorisations = 0;
  double oscillation = 0;  ///< pressure_oscillation()
};

inline Result<LandResult> solve_all(const mechanics::Body& body, mechanics::Loads loads,
                                    std::vector<bool> held, const mechanics::NewtonParams& params) {
  held.resize(static_cast<std::size_t>(body.unknowns()));
  auto steps = mechanics::LoadSteps::start(body, std::move(loads), std::move(held), params);
  if (!steps) return steps.error();
  for (;;) {
    const Result<bool> done = steps->advance();
    if (!done) return done.error();
    if (*done) break;
  }
  return LandResult{steps->displacement(), static_cast<std::size_t>(body.unknowns()), steps->iterations(),
                    steps->factorisations(), pressure_oscillation(body, steps->displacement())};
}

/// Problem 1: a beam of 10 x 1 x 1 mm with fibres along it, clamped at x = 0, bent by 0.004 kPa on its
/// underside. Returns how far the point (10, 1/2, 1) rises, mm: the mean of the nodes that are nearest to it.
struct LandBeam {
  double deflection_mm = 0;
  LandResult result;
};
inline Result<LandBeam> land_beam(const std::array<int, 3>& bricks_along, mechanics::Formulation formulation,
                                  double bulk_kpa, int steps,
                                  const mechanics::Guccione& material = {2, 8, 2, 4}) {
  const TetMesh mesh = bricks({10, 1, 1}, bricks_along);
  mechanics::Muscle muscle;
  muscle.materials = {material};
  muscle.bulk_kpa = bulk_kpa;
  const auto body = mechanics::Body::make(mesh, formulation, std::move(muscle));
  if (!body) return body.error();
  const auto under = faces_where(mesh, [&](std::uint32_t i) { return mesh.points[i].z() == 0; });
  mechanics::NewtonParams params;
  params.steps = steps;
  auto result = solve_all(*body, {{{mechanics::Surface(body->nodes(), under), 0.004}}, {}, {}},
                          held_where(body->nodes(), [](const auto& p) { return p.x() == 0; }), params);
  if (!result) return result.error();
  LandBeam beam{0, *std::move(result)};
  double nearest = 1e9;
  int count = 0;
  const auto& places = body->nodes().places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double distance = (places[i] - Eigen::Vector3d(10, 0.5, 1)).norm();
    if (distance < nearest - 1e-9) {
      nearest = distance;
      beam.deflection_mm = count = 0;
    }
    if (distance > nearest + 1e-9) continue;
    ++count;
    beam.deflection_mm += (beam.result.u[3 * static_cast<Eigen::Index>(i) + 2] - beam.deflection_mm) / count;
  }
  return beam;
}

/// Problems 2 and 3: an ellipsoid of 7 and 17 mm inside and 10 and 20 mm outside, cut off at z = 5 mm and
/// held there, under a pressure from inside. 2: isotropic, 10 kPa. 3: 15 kPa and a stress of 60 kPa along
/// fibres of +90 degrees inside to -90 outside. Returns where the apex is inside and outside, mm.
struct LandVentricle {
  double endo_mm = 0, epi_mm = 0;
  LandResult result;
};
inline Result<LandVentricle> land_ventricle(bool contracts, std::uint32_t layers, std::uint32_t rings,
                                            mechanics::Formulation formulation, double bulk_kpa, int steps) {
  const Ellipsoid shape;
  const HeartBody heart = left_ventricle(layers, rings, shape);
  const TetMesh& mesh = heart.mesh;
  mechanics::Muscle muscle;
  muscle.bulk_kpa = bulk_kpa;
  muscle.materials = {contracts ? mechanics::Guccione{2, 8, 2, 4} : mechanics::Guccione{10, 1, 1, 1}};
  const mechanics::Nodes nodes(mesh, formulation);
  for (std::size_t t = 0; contracts && t < nodes.tets(); ++t)
    for (std::size_t s = 0; s < nodes.samples_per_tet(); ++s) {
      const Eigen::Vector3d place = nodes.sample_place(t, s);
      Eigen::Matrix3d frame;
      frame.col(0) = shape.fibre(place, (0.5 - shape.depth(place)) * EIGEN_PI);
      frame.col(1) = frame.col(0).unitOrthogonal();
      frame.col(2) = frame.col(0).cross(frame.col(1));
      muscle.frames.push_back(frame);
    }
  const auto body = mechanics::Body::make(mesh, formulation, std::move(muscle));
  if (!body) return body.error();
  std::vector<Triangle> inside;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    if (heart.surfaces.faces[i] == HeartSurface::kLvEndocardium) inside.push_back(mesh.faces[i]);
  mechanics::Loads loads{{{mechanics::Surface(body->nodes(), inside), contracts ? 15.0 : 10.0}}, {}, {}};
  if (contracts) loads.tension_kpa.assign(mesh.tets.size(), 60);
  mechanics::NewtonParams params;
  params.steps = steps;
  auto result = solve_all(
      *body, std::move(loads),
      held_where(body->nodes(), [&](const auto& p) { return p.z() > shape.base_z - 1e-5; }), params);
  if (!result) return result.error();
  LandVentricle out{0, 0, *std::move(result)};
  const auto apex_z = [&](double z) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      if ((mesh.points[i] - Eigen::Vector3d(0, 0, z)).norm() < 1e-5)
        return z + out.result.u[3 * static_cast<Eigen::Index>(i) + 2];
    return 0.0;
  };
  out.endo_mm = apex_z(-shape.long_in);
  out.epi_mm = apex_z(-shape.long_out);
  return out;
}

}  // namespace voxtet::test
