#include "remesh/adapt/adapt_passes.h"

#include <cmath>
#include <utility>

#include "geometry/elements/triangle_measures.h"
#include "geometry/search/spread_order.h"
#include "remesh/complex/complex_measures.h"
#include "remesh/motion/volume_offsets.h"

namespace voxtet::remesh {
namespace {

constexpr double kCreaseCosine = 0.5;  ///< 60 degrees

}  // namespace

double cosine_of_deg(double deg) {
  const double x = deg * (EIGEN_PI / 180);
  double sum = 0, term = 1;
  for (int k = 0; k < 20; ++k) {
    sum += term;
    term *= -x * x / ((2 * k + 1) * (2 * k + 2));
  }
  return sum;
}

AdaptPasses::AdaptPasses(const ComplexMesh& mesh, const ComplexMesh& reference,
                         const Correspondence& correspondence, const SizingField& sizing,
                         const AdaptParams& params, RunContext& ctx)
    : params_(params),
      ctx_(ctx),
      editor_(mesh, reference, correspondence, sizing),
      operations_(editor_),
      volumes_(label_volumes(reference)) {
  operations_.shape_weight = params.shape_weight;
  EditLimits& limits = editor_.limits;
  limits.reach_mm = params.envelope_voxels * params.voxel_mm;
  limits.lattice_mm = 0.9 * params.voxel_mm;
  limits.angle_cosine = cosine_of_deg(params.min_angle_deg);
  limits.crease_cosine = std::min(kCreaseCosine, cosine_of_deg(params.min_dihedral_deg));
  limits.junction_cosine = cosine_of_deg(params.min_dihedral_deg);
  limits.verify = params.verify;
}

std::vector<Edge> AdaptPasses::edges() const {
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<Edge> out;
  std::vector<std::uint32_t> others;
  for (std::uint32_t a = 0; a < mesh.vertex_count(); ++a) {
    others.clear();
    for (const std::uint32_t t : mesh.star(a))
      for (const std::uint32_t b : mesh.triangle(t))
        if (b > a) others.push_back(b);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const std::uint32_t b : others) out.push_back({a, b});
  }
  return out;
}

void AdaptPasses::fit_cells() {
  constexpr double kMuch = 1.25;
  const ComplexMesh& mesh = editor_.mesh();
  if (cell_mm_ > 0 && fitted_at_ == editor_.attempts()) return;
  fitted_at_ = editor_.attempts();
  double sum = 0;
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t)) {
      const Corners p = mesh.corners(mesh.triangle(t));
      sum += (p[0] - p[1]).norm() + (p[1] - p[2]).norm() + (p[2] - p[0]).norm();
      count += 3;
    }
  const double cell_mm =
      std::max(2 * sum / static_cast<double>(std::max<std::size_t>(count, 1)), 1e-6 * params_.voxel_mm);
  if (cell_mm < kMuch * cell_mm_ && cell_mm_ < kMuch * cell_mm) return;
  cell_mm_ = cell_mm;
  editor_.set_cell(cell_mm);
}

bool AdaptPasses::refine() {
  std::vector<std::pair<double, Edge>> all;
  for (const Edge& e : edges())
    if (const double length = editor_.metric_length(e[0], e[1]); length > kLongest)
      all.push_back({length, e});
  std::stable_sort(all.begin(), all.end(), [](const auto& p, const auto& q) { return p.first > q.first; });
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (cancelled_at(i)) return false;
    const auto& [a, b] = all[i].second;
    if (editor_.mesh().edge_degree(a, b) > 0) operations_.split(a, b);
  }
  return true;
}

bool AdaptPasses::flip_all() {
  const std::vector<Edge> all = edges();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (cancelled_at(i)) return false;
    const auto& [a, b] = all[i];
    if (editor_.mesh().edge_degree(a, b) > 0 && operations_.valence_gain(a, b) > 0)
      operations_.flip(a, b, Demand::kAllowed);
  }
  return true;
}

bool AdaptPasses::relocate_all() {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < editor_.mesh().vertex_count(); ++v)
    if (alive(v)) vertices.push_back(v);
  return relocate(vertices);
}

bool AdaptPasses::relocate(const std::vector<std::uint32_t>& vertices) {
  return take_turns(
      editor_, ctx_.threads, spread(vertices),
      [&](std::uint32_t i, EditCheck& check, PlannedEdit& plan) {
        operations_.plan_relocation(vertices[i], check, plan);
      },
      [&](std::uint32_t i, const PlannedEdit* plan) {
        if (cancelled_at(i)) return false;
        operations_.relocate(vertices[i], plan);
        return true;
      });
}

/// By the triangles of each vertex.
Buckets<std::uint32_t> AdaptPasses::spread(const std::vector<std::uint32_t>& vertices) const {
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<Eigen::AlignedBox3d> zones;
  zones.reserve(vertices.size());
  for (const std::uint32_t v : vertices) {
    Eigen::AlignedBox3d& zone = zones.emplace_back(mesh.point(v));
    for (const std::uint32_t t : mesh.star(v))
      for (const std::uint32_t corner : mesh.triangle(t)) zone.extend(mesh.point(corner));
  }
  return spread_order(zones);
}

bool AdaptPasses::open_angles(double limit_cosine) {
  const ComplexMesh& mesh = editor_.mesh();
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
    if (cancelled_at(t)) return false;
    if (mesh.alive(t) && sharpest_cosine(mesh.corners(mesh.triangle(t))) > limit_cosine) open_angle(t);
  }
  return true;
}

bool AdaptPasses::open_angle(std::uint32_t t) {
  const ComplexMesh& mesh = editor_.mesh();
  const Triangle corners = mesh.triangle(t);
  std::array<std::pair<double, std::size_t>, 3> sides;  // by length; the second is the opposite corner
  for (std::size_t i = 0; i < 3; ++i)
    sides[i] = {(mesh.point(corners[(i + 1) % 3]) - mesh.point(corners[(i + 2) % 3])).squaredNorm(), i};
  std::sort(sides.begin(), sides.end());
  const auto end = [&](std::size_t side, std::size_t which) {
    return corners[(sides[side].second + which) % 3];
  };
  for (const std::size_t side : {2, 1})
    if (operations_.flip(end(side, 1), end(side, 2), Demand::kBetterAngle)) return true;
  for (const std::uint32_t v : corners)
    if (operations_.open(v, Demand::kBetterAngle)) return true;
  for (const std::size_t side : {0, 1, 2})
    if (operations_.collapse(end(side, 1), end(side, 2), kLongestPolished, Demand::kBetterAngle) ||
        operations_.collapse(end(side, 2), end(side, 1), kLongestPolished, Demand::kBetterAngle))
      return true;
  return false;
}

double AdaptPasses::sharpest_fold(std::uint32_t a, std::uint32_t b,
                                  std::vector<std::uint32_t>& around) const {
  const ComplexMesh& mesh = editor_.mesh();
  around.clear();
  for (const std::uint32_t t : mesh.star(a))
    if (has_corner(mesh.triangle(t), b)) around.push_back(third_corner(mesh.triangle(t), a, b));
  double sharpest = -1;
  for (std::size_t i = 0; i < around.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      sharpest = std::max(
          sharpest, fold_cosine(mesh.point(a), mesh.point(b), mesh.point(around[i]), mesh.point(around[j])));
  return sharpest;
}

bool AdaptPasses::open_folds() {
  std::vector<std::uint32_t> around;
  const std::vector<Edge> all = edges();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (cancelled_at(i)) return false;
    const auto& [a, b] = all[i];
    if (sharpest_fold(a, b, around) > editor_.fold_limit(a, b)) open_fold(a, b, around);
  }
  return true;
}

bool AdaptPasses::open_fold(std::uint32_t a, std::uint32_t b, const std::vector<std::uint32_t>& around) {
  if (operations_.flip(a, b, Demand::kBetterFold)) return true;
  for (const std::uint32_t v : {a, b})
    if (operations_.open(v, Demand::kBetterFold)) return true;
  for (const std::uint32_t v : around)
    if (operations_.open(v, Demand::kBetterFold)) return true;
  for (const std::uint32_t v : around)
    for (const std::uint32_t end : {a, b})
      if (operations_.collapse(v, end, kLongestPolished, Demand::kBetterFold) ||
          operations_.collapse(end, v, kLongestPolished, Demand::kBetterFold))
        return true;
  return false;
}

void AdaptPasses::offset_towards_volumes() {
  constexpr double kMostVoxels = 0.1;
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<double> lacking = volumes_;
  const std::vector<double> now = label_volumes(mesh);
  for (std::size_t l = 0; l < lacking.size(); ++l) lacking[l] -= now[l];
  const std::vector<double> more =
      volume_offsets(mesh.sides(), pair_areas(mesh), lacking, kMostVoxels * params_.voxel_mm);
  for (std::size_t pair = 0; pair < more.size(); ++pair) operations_.offsets[pair] += more[pair];
}

}  // namespace voxtet::remesh
