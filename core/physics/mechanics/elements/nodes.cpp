#include "physics/mechanics/elements/nodes.h"

#include <algorithm>

#include "geometry/elements/tet_measures.h"

namespace voxtet::mechanics {
namespace {

using Edge = std::array<std::uint32_t, 2>;

Edge edge_between(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// The four places of a quadrature that is exact for polynomials of degree 2: one corner's share, and that of
/// the three others. Hammer, Marlowe and Stroud, Mathematical Tables and Other Aids to Computation 10 (1956).
constexpr double kNear = 0.58541019662496845446, kFar = 0.13819660112501051518;

}  // namespace

std::array<double, 4> Nodes::shares_of(std::size_t samples_per_tet, std::size_t sample) {
  if (samples_per_tet == 1) return {0.25, 0.25, 0.25, 0.25};
  std::array<double, 4> shares{kFar, kFar, kFar, kFar};
  shares[sample] = kNear;
  return shares;
}

Nodes::Nodes(const TetMesh& mesh, Formulation formulation, bool finely)
    : samples_(finely || formulation == Formulation::kQuadratic ? 4 : 1), places_(mesh.points) {
  tets_.reserve(mesh.tets.size());
  elements_.reserve(mesh.tets.size());
  for (const Tet& tet : mesh.tets) {
    tets_.push_back({tet[0], tet[1], tet[2], tet[3]});
    elements_.push_back(fem::element_of(mesh.points, tet));
  }
  if (formulation != Formulation::kQuadratic) return;
  for (const Tet& tet : mesh.tets)
    for (const auto& [a, b] : kEdgesOfTet)
      edges_.push_back(edge_between(tet[static_cast<std::size_t>(a)], tet[static_cast<std::size_t>(b)]));
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  for (const auto& [a, b] : edges_) places_.emplace_back((mesh.points[a] + mesh.points[b]) / 2);
  for (auto& tet : tets_)
    for (std::size_t e = 0; e < 6; ++e)
      tet[4 + e] = middle(tet[static_cast<std::size_t>(kEdgesOfTet[e].first)],
                          tet[static_cast<std::size_t>(kEdgesOfTet[e].second)]);
}

Eigen::VectorXd Nodes::places_after(const Eigen::VectorXd& u) const {
  Eigen::VectorXd x(3 * static_cast<Eigen::Index>(places_.size()));
  for (std::size_t i = 0; i < places_.size(); ++i)
    x.segment<3>(3 * static_cast<Eigen::Index>(i)) = places_[i];
  if (u.size() > 0) x += u.head(x.size());
  return x;
}

std::uint32_t Nodes::middle(std::uint32_t end, std::uint32_t other) const {
  const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge_between(end, other));
  return static_cast<std::uint32_t>(places_.size() - edges_.size()) +
         static_cast<std::uint32_t>(found - edges_.begin());
}

Eigen::Vector3d Nodes::sample_place(std::size_t t, std::size_t sample) const {
  const auto shares = shares_of(samples_, sample);
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) place += shares[i] * places_[tets_[t][i]];
  return place;
}

void Nodes::shapes_at(std::size_t t, std::size_t sample, Shape* shapes) const {
  const auto& gradient = elements_[t].gradient;
  const auto share = shares_of(samples_, sample);
  if (!quadratic()) {
    for (std::size_t i = 0; i < 4; ++i) shapes[i] = {share[i], gradient[i]};
    return;
  }
  for (std::size_t i = 0; i < 4; ++i)
    shapes[i] = {share[i] * (2 * share[i] - 1), (4 * share[i] - 1) * gradient[i]};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto a = static_cast<std::size_t>(kEdgesOfTet[e].first);
    const auto b = static_cast<std::size_t>(kEdgesOfTet[e].second);
    shapes[4 + e] = {4 * share[a] * share[b], 4 * (share[a] * gradient[b] + share[b] * gradient[a])};
  }
}

Eigen::Matrix3d Nodes::deformation(const Eigen::VectorXd& u, std::size_t t, const Shape* shapes) const {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  for (std::size_t a = 0; a < per_tet(); ++a)
    f += u.segment<3>(3 * static_cast<Eigen::Index>(tets_[t][a])) * shapes[a].gradient.transpose();
  return f;
}

}  // namespace voxtet::mechanics
