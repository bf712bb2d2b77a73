#include "geometry/curved/curve_midsides.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "geometry/curved/jacobian.h"
#include "geometry/curved/label_targets.h"
#include "geometry/curved/midside_nodes.h"
#include "geometry/search/closest_point.h"

namespace voxtet {
namespace {

/// Shares of the way to the target: full, and after each time that a node goes back.
constexpr std::array<double, 5> kShares{1, 0.5, 0.25, 0.125, 0};

/// Where faces are measured, barycentric: on the edges, then inside.
constexpr double kThird = 1.0 / 3, kSixth = 1.0 / 6, kRest = 2.0 / 3;
constexpr std::array<std::array<double, 3>, 7> kSamples{{{0.5, 0.5, 0},
                                                         {0, 0.5, 0.5},
                                                         {0.5, 0, 0.5},
                                                         {kThird, kThird, kThird},
                                                         {kRest, kSixth, kSixth},
                                                         {kSixth, kRest, kSixth},
                                                         {kSixth, kSixth, kRest}}};
/// The distances of a face at kSamples.
using Distances = std::array<double, kSamples.size()>;

class EdgeCurver {
 public:
  EdgeCurver(const TetMesh& mesh, const SurfaceMesh& surface, int threads)
      : mesh_(mesh),
        threads_(threads),
        nodes_(straight_midside_nodes(mesh)),
        straight_(nodes_.points),
        targets_(label_targets(mesh, nodes_, surface, threads)),
        backs_(straight_.size(), 0),
        for_shape_(straight_.size(), false),
        scaled_(mesh.tets.size(), 1) {
    std::map<Sides, std::vector<Triangle>> members;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      members[surface.sides[t]].push_back(surface.triangles[t]);
    for (const auto& [sides, triangles] : members) interfaces_.try_emplace(sides, surface.points, triangles);
  }

  CurvedNodes run() {
    std::vector<Distances> straight(mesh_.faces.size());
    measure(straight, std::vector<bool>(mesh_.faces.size(), true));
    std::vector<Distances> curved = straight;
    std::vector<bool> moved(straight_.size());
    for (std::size_t e = 0; e < moved.size(); ++e) {
      moved[e] = targets_[e] != straight_[e];
      nodes_.points[e] = targets_[e];
    }
    while (std::find(moved.begin(), moved.end(), true) != moved.end()) {
      std::vector<bool> back(moved.size(), false);
      mark_tets(moved, back);
      for (std::size_t e = 0; e < back.size(); ++e)
        if (back[e]) for_shape_[e] = true;
      mark_faces(moved, straight, curved, back);
      moved = go_back(back);
    }
    return result(straight, curved);
  }

 private:
  template <class Edges>
  static std::vector<bool> at(const std::vector<bool>& moved, const std::vector<Edges>& elements) {
    std::vector<bool> found(elements.size());
    for (std::size_t i = 0; i < elements.size(); ++i)
      found[i] =
          std::any_of(elements[i].begin(), elements[i].end(), [&](std::uint32_t e) { return moved[e]; });
    return found;
  }

  /// Of the tetrahedra at `moved` nodes marks the nodes of those whose determinant is too small somewhere.
  void mark_tets(const std::vector<bool>& moved, std::vector<bool>& back) {
    const std::vector<bool> open = at(moved, nodes_.tets);
    std::vector<std::uint8_t> bad(open.size(), 0);
    parallel_for(threads_, open.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t) {
        if (!open[t]) continue;
        Tet10Points x;
        for (std::size_t i = 0; i < 4; ++i) x[i] = mesh_.points[mesh_.tets[t][i]];
        for (std::size_t e = 0; e < 6; ++e) x[4 + e] = straight_[nodes_.tets[t][e]];
        const double straight = determinant_bounds(x).least;
        for (std::size_t e = 0; e < 6; ++e) x[4 + e] = nodes_.points[nodes_.tets[t][e]];
        const DeterminantBounds bounds = determinant_bounds(x);
        scaled_[t] = bounds.least / bounds.greatest;
        bad[t] = !(bounds.least > kLeastDeterminant * straight);
      }
    });
    for (std::size_t t = 0; t < bad.size(); ++t)
      if (bad[t])
        for (const std::uint32_t e : nodes_.tets[t]) back[e] = true;
  }

  Eigen::Vector3d on_face(std::size_t f, const std::array<double, 3>& l) const {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) x += l[i] * (2 * l[i] - 1) * mesh_.points[mesh_.faces[f][i]];
    for (std::size_t e = 0; e < 3; ++e)
      x += 4 * l[kMidsidesOfTet[e].first] * l[kMidsidesOfTet[e].second] * nodes_.points[nodes_.faces[f][e]];
    return x;
  }

  /// 0 for faces between labels that the surface does not have side by side.
  void measure(std::vector<Distances>& distances, const std::vector<bool>& which) const {
    parallel_for(threads_, which.size(), [&](std::size_t first, std::size_t last) {
      std::uint32_t hint = 0;
      const ClosestPointTree* before = nullptr;
      for (std::size_t f = first; f < last; ++f) {
        if (!which[f]) continue;
        distances[f] = {};
        const auto tree = interfaces_.find(mesh_.face_sides[f]);
        if (tree == interfaces_.end()) continue;
        if (&tree->second != before) hint = 0;
        before = &tree->second;
        for (std::size_t i = 0; i < kSamples.size(); ++i) {
          const ClosestPointTree::Hit hit = before->closest(on_face(f, kSamples[i]), hint);
          hint = hit.triangle;
          distances[f][i] = hit.distance_mm;
        }
      }
    });
  }

  /// The same for faces that are farther from the surface than with straight edges.
  void mark_faces(const std::vector<bool>& moved, const std::vector<Distances>& straight,
                  std::vector<Distances>& curved, std::vector<bool>& back) const {
    const std::vector<bool> open = at(moved, nodes_.faces);
    measure(curved, open);
    const double farthest = summary(straight).max_mm;
    for (std::size_t f = 0; f < open.size(); ++f)
      if (open[f] && (sum(curved[f]) > sum(straight[f]) ||
                      *std::max_element(curved[f].begin(), curved[f].end()) > farthest))
        for (const std::uint32_t e : nodes_.faces[f]) back[e] = true;
  }

  /// Returns the nodes that have moved.
  std::vector<bool> go_back(const std::vector<bool>& back) {
    std::vector<bool> moved(back.size(), false);
    for (std::size_t e = 0; e < back.size(); ++e) {
      if (!back[e] || nodes_.points[e] == straight_[e]) continue;
      nodes_.points[e] = straight_[e] + kShares[++backs_[e]] * (targets_[e] - straight_[e]);
      moved[e] = true;
    }
    return moved;
  }

  static double sum(const Distances& face) { return std::accumulate(face.begin(), face.end(), 0.0); }

  static FaceDistance summary(const std::vector<Distances>& distances) {
    FaceDistance out;
    for (const Distances& face : distances)
      for (const double distance : face) {
        out.mean_mm += distance / static_cast<double>(kSamples.size() * distances.size());
        out.max_mm = std::max(out.max_mm, distance);
      }
    return out;
  }

  CurvedNodes result(const std::vector<Distances>& straight, const std::vector<Distances>& curved) {
    CurvedNodes out{.nodes = std::move(nodes_), .straight = summary(straight), .curved = summary(curved)};
    for (std::size_t e = 0; e < straight_.size(); ++e) {
      if (out.nodes.points[e] != straight_[e]) ++out.moved;
      if (backs_[e] > 0) ++(for_shape_[e] ? out.pulled_back : out.held);
    }
    for (const double scaled : scaled_) out.min_scaled_jacobian = std::min(out.min_scaled_jacobian, scaled);
    return out;
  }

  const TetMesh& mesh_;
  int threads_;
  MidsideNodes nodes_;
  std::vector<Eigen::Vector3d> straight_, targets_;
  std::vector<std::uint8_t> backs_;  ///< how often each node has gone back
  std::vector<bool> for_shape_;      ///< whether ever for an element's determinant
  std::vector<double> scaled_;       ///< per tet
  std::map<Sides, ClosestPointTree> interfaces_;
};

}  // namespace

CurvedNodes curve_midsides(const TetMesh& mesh, const SurfaceMesh& surface, int threads) {
  return EdgeCurver(mesh, surface, threads).run();
}

}  // namespace voxtet
