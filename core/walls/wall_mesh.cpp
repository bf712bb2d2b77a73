#include "walls/wall_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <limits>

namespace voxtet {
namespace {

constexpr std::uint32_t kNoTet = TetFace::kNoTet;
constexpr std::uint32_t kNearSide = 2;  ///< edges
constexpr std::size_t kMostSteps = 1000;
constexpr double kCosine = 0.5;  ///< of 60 degrees
constexpr double kFlat = 0.05;   ///< a potential that rises less over the wall's thickness has no direction

}  // namespace

WallMesh::WallMesh(const TetMesh& mesh, const WallField& field)
    : mesh_(mesh), field_(field), step_(field.index_to_mm.topLeftCorner<3, 3>().colwise().norm().minCoeff()) {
  find_tets();
  find_faces();
  find_edges();
  from_inner_ = edges_through_from(Part::kInner);
  for (const std::uint32_t edges : edge_hops(edges_, points_of(Part::kSide)))
    near_side_.push_back(edges <= kNearSide);
}

void WallMesh::find_tets() {
  std::vector<double> balance(65536, 0);
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh_.tets[t];
    const Eigen::Vector3d& p = mesh_.points[a];
    const double volume = (mesh_.points[b] - p).cross(mesh_.points[c] - p).dot(mesh_.points[d] - p);
    balance[mesh_.labels[t]] += field_.holds(field_.to_index(centre_of(t))) ? volume : -volume;
  }
  in_wall_.resize(mesh_.tets.size());
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) in_wall_[t] = balance[mesh_.labels[t]] > 0;
}

void WallMesh::find_faces() {
  neighbours_.assign(mesh_.tets.size(), {kNoTet, kNoTet, kNoTet, kNoTet});
  for (const TetFace& face : tet_faces(mesh_.tets, mesh_.points.size())) {
    const bool first = in_wall_[face.first], second = face.second != kNoTet && in_wall_[face.second];
    if (first && second) {
      neighbours_[face.first][opposite(face.first, face.corners)] = face.second;
      neighbours_[face.second][opposite(face.second, face.corners)] = face.first;
    } else if (first || second) {
      add_face(face.corners, first ? face.first : face.second);
    }
  }
  std::sort(surface_of_tet_.begin(), surface_of_tet_.end());
}

void WallMesh::add_face(const Triangle& corners, std::uint32_t tet) {
  const Eigen::Vector3d &a = mesh_.points[corners[0]], &b = mesh_.points[corners[1]],
                        &c = mesh_.points[corners[2]];
  const Eigen::Vector3d centre = (a + b + c) / 3;
  Eigen::Vector3d normal = (b - a).cross(c - a) / 2;
  const double area = normal.norm();
  normal /= area;
  if (normal.dot(centre - centre_of(tet)) < 0) normal = -normal;
  const Eigen::Vector3d beneath = centre - 0.5 * step_ * normal;
  const Eigen::Vector3d slope = slope_at(beneath);
  const double rise = slope.norm(), cosine = rise > 0 ? slope.dot(normal) / rise : 0;
  const double potential = field_.potential_at(beneath);
  Part part = Part::kSide;
  if (rise * field_.thickness_at(beneath) > kFlat) {
    if (cosine > kCosine && potential > 0.5) part = Part::kOuter;
    if (cosine < -kCosine && potential < 0.5) part = Part::kInner;
  }
  surface_of_tet_.push_back({tet, static_cast<std::uint32_t>(faces_.size())});
  faces_.push_back({corners, tet, part, centre, area});
}

std::size_t WallMesh::opposite(std::size_t tet, const Triangle& corners) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (std::find(corners.begin(), corners.end(), mesh_.tets[tet][i]) == corners.end()) return i;
  return 3;
}

Eigen::Vector3d WallMesh::centre_of(std::size_t tet) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t v : mesh_.tets[tet]) sum += mesh_.points[v];
  return sum / 4;
}

Eigen::Vector3d WallMesh::slope_at(const Eigen::Vector3d& mm) const {
  Eigen::Vector3d slope;
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d half = 0.5 * step_ * Eigen::Vector3d::Unit(d);
    slope[d] = (field_.potential_at(mm + half) - field_.potential_at(mm - half)) / step_;
  }
  return slope;
}

void WallMesh::find_edges() {
  std::vector<Tet> tets;
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
    if (in_wall_[t]) tets.push_back(mesh_.tets[t]);
  edges_ = tet_edges(tets, mesh_.points.size());
  std::vector<Edge> on_surface;
  for (const Face& face : faces_)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(face.corners[i], face.corners[(i + 1) % 3]);
      on_surface.push_back({a, b});
    }
  std::sort(on_surface.begin(), on_surface.end());
  for (const Edge& edge : edges_)
    if (!std::binary_search(on_surface.begin(), on_surface.end(), edge)) edges_through_.push_back(edge);
}

std::vector<bool> WallMesh::points_of(Part part) const {
  std::vector<bool> points(mesh_.points.size(), false);
  for (const Face& face : faces_)
    if (face.part == part)
      for (const std::uint32_t v : face.corners) points[v] = true;
  return points;
}

std::vector<std::uint32_t> WallMesh::from_judged_outer() const {
  std::vector<bool> judged = points_of(Part::kOuter);
  for (std::size_t v = 0; v < judged.size(); ++v) judged[v] = judged[v] && !near_side_[v];
  return edge_hops(edges_through_, judged);
}

std::uint32_t WallMesh::layer_of(std::size_t tet, std::uint32_t layers) const {
  const double place = layers * field_.potential_at(centre_of(tet));
  return static_cast<std::uint32_t>(std::clamp(place, 0.0, layers - 1.0));
}

std::uint32_t WallMesh::layers_met(const Face& start, std::uint32_t layers) const {
  std::uint64_t met = 0;
  std::uint32_t tet = start.tet;
  std::size_t entry = opposite(tet, start.corners);
  Eigen::Vector3d at = start.centre;
  for (std::size_t step = 0; step < kMostSteps; ++step) {
    met |= std::uint64_t{1} << layer_of(tet, layers);
    const std::size_t exit = leave(tet, entry, at);
    if (exit == 4) return 0;
    const std::uint32_t next = neighbours_[tet][exit];
    if (next == kNoTet) return ends_inside(tet, exit) ? static_cast<std::uint32_t>(std::popcount(met)) : 0;
    entry = static_cast<std::size_t>(std::find(neighbours_[next].begin(), neighbours_[next].end(), tet) -
                                     neighbours_[next].begin());
    tet = next;
  }
  return 0;
}

/// Moves a point on a tetrahedron's surface down the potential to where it leaves; the corner opposite to
/// the face there, or 4 where nothing leads on.
std::size_t WallMesh::leave(std::uint32_t tet, std::size_t entry, Eigen::Vector3d& at) const {
  const Eigen::Vector3d down = -slope_at(at).normalized();
  std::size_t exit = 4;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == entry) continue;
    const Tet& t = mesh_.tets[tet];
    const Eigen::Vector3d &a = mesh_.points[t[(i + 1) % 4]], &b = mesh_.points[t[(i + 2) % 4]],
                          &c = mesh_.points[t[(i + 3) % 4]];
    Eigen::Vector3d normal = (b - a).cross(c - a);
    if (normal.dot(mesh_.points[t[i]] - a) > 0) normal = -normal;
    const double speed = normal.dot(down);
    if (!(speed > 0)) continue;
    const double time = std::max(normal.dot(a - at) / speed, 0.0);
    if (time < least) least = time, exit = i;
  }
  if (exit < 4) at += least * down;
  return exit;
}

bool WallMesh::ends_inside(std::uint32_t tet, std::size_t corner) const {
  const auto last = std::upper_bound(surface_of_tet_.begin(), surface_of_tet_.end(), std::array{tet, kNoTet});
  auto first = std::lower_bound(surface_of_tet_.begin(), surface_of_tet_.end(), std::array{tet, 0U});
  for (; first != last; ++first) {
    const Face& face = faces_[(*first)[1]];
    if (opposite(tet, face.corners) == corner) return face.part == Part::kInner;
  }
  return false;
}

}  // namespace voxtet
