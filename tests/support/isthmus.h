// A slab with a disc of scar that a narrow channel crosses, and how well current flows through it: on the
// true shape, on voxels, and on meshes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/volume/write_volume.h"
#include "physics/fem/assemble.h"
#include "physics/fem/element.h"
#include "physics/fem/solve_held.h"
#include "pipeline/session.h"
#include "support/bricks.h"
#include "support/uniform_tissue.h"

namespace voxtet::test {

/// 60 x 60 x 10.5 mm of tissue (label 1), the middle at the origin. In it a disc of scar (label 5) of 30 mm,
/// through the whole thickness, crossed by a channel at 27 degrees to x.
struct Isthmus {
  static constexpr double kHalfWidth = 30, kThickness = 10.5, kDiscRadius = 15;
  static constexpr double kVoxel = 1.5;
  static constexpr double kAngle = 27 * 3.14159265358979323846 / 180;
  double width_mm = 4;

  /// Along the channel and across it.
  static Eigen::Vector2d in_channel(const Eigen::Vector3d& p) {
    const double c = std::cos(kAngle), s = std::sin(kAngle);
    return {c * p.x() + s * p.y(), c * p.y() - s * p.x()};
  }
  Label label_at(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d at = in_channel(p);
    return at.norm() < kDiscRadius && std::abs(at.y()) > width_mm / 2 ? 5 : 1;
  }
};

/// Voxels of 1.5 mm, with two of background around them.
inline LabelVolume volume_of(const Isthmus& isthmus) {
  constexpr int kPadding = 2;
  LabelVolume volume;
  const Eigen::Vector3d size(2 * Isthmus::kHalfWidth, 2 * Isthmus::kHalfWidth, Isthmus::kThickness);
  for (int d = 0; d < 3; ++d) {
    const int inside = static_cast<int>(std::lround(size[d] / Isthmus::kVoxel));
    volume.size[d] = inside + 2 * kPadding;
    volume.index_to_mm(d, d) = Isthmus::kVoxel;
    volume.index_to_mm(d, 3) = -Isthmus::kVoxel * (inside - 1 + 2 * kPadding) / 2;
  }
  volume.labels.resize(volume.voxel_count());
  volume.visit([&](int i, int j, int k, std::size_t at) {
    const Eigen::Vector3d p = volume.to_mm(i, j, k);
    const bool inside = (p.cwiseAbs() - size / 2).maxCoeff() < 0;
    volume.labels[at] = inside ? isthmus.label_at(p) : kBackground;
  });
  return volume;
}

/// Current through a slab between whose ends in x there is a potential difference of 1, over that of the same
/// slab without scar.
struct Conductance {
  double whole = 0;
  double channel = 0;  ///< the current that goes through the channel
};

/// div (c grad phi) = 0 by linear elements: `coefficient` of each tetrahedron; points within `end_mm` of the
/// slab's ends are held at 0 and 1.
inline Result<Conductance> conductance(const TetMesh& mesh, const std::vector<double>& coefficient,
                                       double thickness_mm, double end_mm) {
  const Result<fem::SparseMatrix> stiffness = fem::assemble_stiffness(mesh, coefficient);
  if (!stiffness) return stiffness.error();
  std::vector<bool> held(mesh.points.size(), true);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (coefficient[t] > 0)
      for (const std::uint32_t point : mesh.tets[t]) held[point] = false;
  const Eigen::Index n = static_cast<Eigen::Index>(mesh.points.size());
  Eigen::VectorXd start = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd ramp(n);
  constexpr double kHalfRamp = 8;  // mm along the channel, inside of the disc
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const double x = mesh.points[p].x();
    const auto i = static_cast<Eigen::Index>(p);
    if (std::abs(x) > Isthmus::kHalfWidth - end_mm) {
      held[p] = true;
      start[i] = x > 0;
    }
    const double along = Isthmus::in_channel(mesh.points[p]).x();
    ramp[i] = std::clamp(along / (2 * kHalfRamp) + 0.5, 0.0, 1.0);
  }
  const RunContext ctx;
  const auto phi = fem::solve_held(*stiffness, Eigen::VectorXd::Zero(n), held, start, "conductance", ctx);
  if (!phi) return phi.error();
  Eigen::VectorXd load;
  fem::multiply(*stiffness, *phi, load);
  Conductance found;
  found.whole = fem::dot(*phi, load) / thickness_mm;
  // Whatever weights fall from 1 to 0 across the channel, the flow that they see is the same: no current ends
  // between.
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (coefficient[t] <= 0) continue;
    const Eigen::Vector2d at = Isthmus::in_channel(centroid(mesh, mesh.tets[t]));
    if (std::abs(at.y()) > 9 || at.norm() > Isthmus::kDiscRadius) continue;
    const fem::Element element = fem::element_of(mesh, t);
    Eigen::Vector3d slope = Eigen::Vector3d::Zero(), weight = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < 4; ++c) {
      slope += (*phi)[mesh.tets[t][c]] * element.gradient[c];
      weight += ramp[mesh.tets[t][c]] * element.gradient[c];
    }
    found.channel += coefficient[t] * element.volume * slope.dot(weight) / thickness_mm;
  }
  return found;
}

/// The same on bricks from the origin, of which those conduct whose label is 1. They lie `times` one over the
/// other.
inline Result<Conductance> conductance_of_bricks(TetMesh mesh, double thickness_mm, int times,
                                                 const auto& label_at) {
  const Eigen::Vector3d middle(Isthmus::kHalfWidth, Isthmus::kHalfWidth, 0);
  for (Eigen::Vector3d& p : mesh.points) p -= middle;
  std::vector<double> coefficient;
  for (const Tet& tet : mesh.tets) coefficient.push_back(label_at(centroid(mesh, tet)) == 1);
  return conductance(mesh, coefficient, thickness_mm * times, 1e-6);
}

/// Of the true shape: as it is the same at all heights, one layer of bricks of `edge_mm`.
inline Result<Conductance> true_conductance(const Isthmus& isthmus, double edge_mm) {
  const int n = static_cast<int>(std::lround(2 * Isthmus::kHalfWidth / edge_mm));
  const Eigen::Vector3d size(2 * Isthmus::kHalfWidth, 2 * Isthmus::kHalfWidth, edge_mm);
  return conductance_of_bricks(bricks(size, {n, n, 1}), edge_mm, 1,
                               [&](const Eigen::Vector3d& p) { return isthmus.label_at(p); });
}

/// Of the voxels, each cut into `cuts` bricks along x and y: 1 is what a solver on voxels would give.
inline Result<Conductance> voxel_conductance(const Isthmus& isthmus, int cuts) {
  const LabelVolume volume = volume_of(isthmus);
  const int n = cuts * (volume.size[0] - 4);
  const Eigen::Vector3d size(2 * Isthmus::kHalfWidth, 2 * Isthmus::kHalfWidth, Isthmus::kVoxel);
  const auto label_at = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d at = (p - volume.origin()) / Isthmus::kVoxel;
    return volume.at(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())),
                     volume.size[2] / 2);
  };
  return conductance_of_bricks(bricks_cut_all_ways(size, {n, n, 1}), Isthmus::kVoxel, 4, label_at);
}

/// How a mesh of the slab is made.
struct IsthmusMesh {
  double scar_mm = 1, rest_mm = 3;  ///< edge lengths within 16 mm of the disc's middle, and elsewhere
  std::string by = "mesh";          ///< as physics.tissue.by; all but "mesh" take one region, without scar
};

struct MeshConductance : Conductance {
  std::size_t tets = 0;
};

inline Result<MeshConductance> mesh_conductance(const Isthmus& isthmus, const IsthmusMesh& how) {
  const Result<Bytes> file = write_nifti(volume_of(isthmus), false);
  if (!file) return file.error();
  Session session;
  if (const Status read = session.load_volume({"slab.nii", *file, {}}); !read) return read.error();
  nlohmann::json json = nlohmann::json::parse(R"({"physics": {"tissue": {"kinds": [{"labels": [1]}]}}})");
  json["sizing"]["edge_mm"] = how.rest_mm;
  if (how.scar_mm < how.rest_mm)
    json["sizing"]["regions"] = {{{"shape", "sphere"}, {"radius_mm", 16}, {"edge_mm", how.scar_mm}}};
  json["physics"]["tissue"]["by"] = how.by;
  if (how.by != "mesh") {
    json["merge"] = {{1, 5}};
    json["transfer"]["labels"] = {5};
  }
  Result<Recipe> recipe = parse_recipe(json);
  if (!recipe) return recipe.error();
  recipe->source = session.recipe().source;
  if (const Status set = session.set_recipe(*recipe); !set) return set.error();
  RunContext ctx;
  if (const Status done = session.run(Stage::kTissue, ctx); !done) return done.error();
  const Tissue& tissue = session.result<TissueResult>(Stage::kTissue)->tissue;
  std::vector<double> coefficient(tissue.kind.size(), 0);
  for (std::size_t t = 0; t < coefficient.size(); ++t)
    if (tissue.kind[t] != Tissue::kNone) coefficient[t] = tissue.share.empty() ? 1.0 : tissue.share[t];
  const Result<Conductance> found =
      conductance(*session.mesh(), coefficient, Isthmus::kThickness, Isthmus::kVoxel / 2);
  if (!found) return found.error();
  return MeshConductance{*found, coefficient.size()};
}

}  // namespace voxtet::test
