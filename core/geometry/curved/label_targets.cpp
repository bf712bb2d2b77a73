#include "geometry/curved/label_targets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "base/parallel.h"
#include "geometry/search/closest_point.h"

namespace voxtet {
namespace {

constexpr double kRimCosine = 0.5;
constexpr double kFarthestShare = 0.25;

/// The sides of all triangles at an edge, ascending. A lone pair of sides stands for the triangles of an
/// interface, inside of it.
using Meeting = std::vector<Sides>;

struct MeetingEdge {
  std::array<std::uint32_t, 2> ends;
  Meeting meeting;
  Eigen::Vector3d normal;  ///< of all triangles together; of any length
};

Eigen::Vector3d normal_of(const std::vector<Eigen::Vector3d>& points, const Triangle& t) {
  return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).normalized();
}

/// The edges of triangles, in ascending order.
std::vector<MeetingEdge> meeting_edges(const std::vector<Eigen::Vector3d>& points,
                                       const std::vector<Triangle>& triangles,
                                       const std::vector<Sides>& sides) {
  struct Side {
    std::uint32_t low, high, triangle;
  };
  std::vector<Side> all;
  all.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(triangles[t][c], triangles[t][(c + 1) % 3]);
      all.push_back({low, high, t});
    }
  std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  std::vector<MeetingEdge> edges;
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    MeetingEdge edge{{all[first].low, all[first].high}, {}, Eigen::Vector3d::Zero()};
    for (; last < all.size() && all[last].low == edge.ends[0] && all[last].high == edge.ends[1]; ++last) {
      edge.meeting.push_back(sides[all[last].triangle]);
      edge.normal += normal_of(points, triangles[all[last].triangle]);
    }
    std::sort(edge.meeting.begin(), edge.meeting.end());
    if (edge.meeting.size() == 2 && edge.meeting[0] == edge.meeting[1] &&
        normal_of(points, triangles[all[first].triangle])
                .dot(normal_of(points, triangles[all[first + 1].triangle])) > kRimCosine)
      edge.meeting.pop_back();
    edges.push_back(std::move(edge));
  }
  return edges;
}

/// What in a surface meets alike: triangles of an interface, or edges as triangles without area.
struct Alike {
  std::vector<Triangle> triangles;
  std::optional<ClosestPointTree> tree{};
};

std::map<Meeting, Alike> alike_in(const SurfaceMesh& surface) {
  std::map<Meeting, Alike> members;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    members[{surface.sides[t]}].triangles.push_back(surface.triangles[t]);
  for (const MeetingEdge& edge : meeting_edges(surface.points, surface.triangles, surface.sides))
    if (edge.meeting.size() > 1)
      members[edge.meeting].triangles.push_back({edge.ends[0], edge.ends[1], edge.ends[1]});
  for (auto& [meeting, alike] : members) alike.tree.emplace(surface.points, alike.triangles);
  return members;
}

}  // namespace

std::vector<Eigen::Vector3d> label_targets(const TetMesh& mesh, const MidsideNodes& nodes,
                                           const SurfaceMesh& surface, int threads) {
  std::vector<Eigen::Vector3d> targets;
  targets.reserve(nodes.edges.size());
  for (const auto& [a, b] : nodes.edges) targets.emplace_back((mesh.points[a] + mesh.points[b]) / 2);
  const std::map<Meeting, Alike> members = alike_in(surface);
  const std::vector<MeetingEdge> edges = meeting_edges(mesh.points, mesh.faces, mesh.face_sides);
  parallel_for(threads, edges.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto& [ends, meeting, normal] = edges[i];
      const auto alike = members.find(meeting);
      if (alike == members.end()) continue;
      const auto at = std::lower_bound(nodes.edges.begin(), nodes.edges.end(), ends) - nodes.edges.begin();
      Eigen::Vector3d& target = targets[static_cast<std::size_t>(at)];
      const ClosestPointTree::Hit hit = alike->second.tree->closest(target);
      const double length = (mesh.points[ends[1]] - mesh.points[ends[0]]).norm();
      const bool faces_alike =
          meeting.size() > 1 ||
          normal_of(surface.points, alike->second.triangles[hit.triangle]).dot(normal) > 0;
      if (faces_alike && hit.distance_mm <= kFarthestShare * length) target = hit.point;
    }
  });
  return targets;
}

}  // namespace voxtet
