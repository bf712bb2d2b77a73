#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "physics/cavities/cavity.h"
#include "physics/cavities/enclosure.h"

namespace voxtet {
namespace {

/// An edge of a triangle, from the lower point to the higher one.
struct TriangleEdge {
  std::uint32_t low, high;
  std::uint32_t triangle;
  bool forwards;  ///< whether the triangle runs along it from low to high

  bool same_edge(const TriangleEdge& other) const { return low == other.low && high == other.high; }
};

std::vector<TriangleEdge> sorted_edges(std::span<const Triangle> triangles) {
  std::vector<TriangleEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const TriangleEdge& a, const TriangleEdge& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  return edges;
}

/// A neighbour over an edge, and whether both run along it in the same direction, so that one is to be
/// turned.
struct Neighbour {
  std::uint32_t triangle;
  bool turned;
};

class CavityCloser {
 public:
  CavityCloser(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
               std::string_view name)
      : points_(points), name_(name), edges_(sorted_edges(triangles)) {
    cavity_.triangles.assign(triangles.begin(), triangles.end());
  }

  Result<Cavity> close() && {
    if (cavity_.triangles.empty()) return error("no triangle", "a surface around the cavity", {});
    for (auto step : {&CavityCloser::find_neighbours, &CavityCloser::orient, &CavityCloser::find_rims})
      if (auto fault = (this->*step)()) return *std::move(fault);
    const double volume = volume_mm3(cavity_, points_);
    if (!(std::abs(volume) > kFlat * std::pow(area(), 1.5)))
      return error("a flat surface", "one that encloses a volume", cavity_.rims[0]);
    if (volume < 0) {
      for (Triangle& triangle : cavity_.triangles) std::swap(triangle[1], triangle[2]);
      for (auto& rim : cavity_.rims) std::reverse(rim.begin(), rim.end());
    }
    return std::move(cavity_);
  }

 private:
  static constexpr double kFlat = 1e-9;  ///< a volume for an area of 1, without unit
  using Fault = std::optional<Error>;

  Error error(const std::string& found, const std::string& expected,
              const std::vector<std::uint32_t>& places) const {
    Error error{ErrorCode::kMeshing,
                "mechanics",
                "cavity " + std::string(name_) + ": found " + found + ", expected " + expected,
                {}};
    for (const std::uint32_t point : places) error.where.points.push_back(points_[point]);
    return error;
  }

  double area() const {
    double twice = 0;
    for (const auto& [a, b, c] : cavity_.triangles)
      twice += (points_[b] - points_[a]).cross(points_[c] - points_[a]).norm();
    return twice / 2;
  }

  /// Edges of one triangle are borders, those of two join them.
  Fault find_neighbours() {
    neighbours_.resize(cavity_.triangles.size());
    for (std::size_t first = 0, last = 0; first < edges_.size(); first = last) {
      while (last < edges_.size() && edges_[last].same_edge(edges_[first])) ++last;
      const TriangleEdge& a = edges_[first];
      if (last - first == 1) borders_.push_back(a);
      if (last - first > 2)
        return error("an edge with " + std::to_string(last - first) + " triangles", "at most 2",
                     {a.low, a.high});
      if (last - first != 2) continue;
      const TriangleEdge& b = edges_[first + 1];
      const bool turned = a.forwards == b.forwards;
      neighbours_[a.triangle].push_back({b.triangle, turned});
      neighbours_[b.triangle].push_back({a.triangle, turned});
    }
    return std::nullopt;
  }

  /// Turns triangles as the first one is oriented.
  Fault orient() {
    turned_.assign(cavity_.triangles.size(), false);
    std::vector<bool> reached = turned_;
    std::vector<std::uint32_t> queue{0};
    reached[0] = true;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const std::uint32_t from = queue[head];
      for (const Neighbour& to : neighbours_[from]) {
        const bool turned = turned_[from] != to.turned;
        if (!reached[to.triangle]) {
          reached[to.triangle] = true;
          turned_[to.triangle] = turned;
          queue.push_back(to.triangle);
        } else if (turned_[to.triangle] != turned) {
          const Triangle& at = cavity_.triangles[to.triangle];
          return error("a surface that has only one side", "one with two sides", {at.begin(), at.end()});
        }
      }
    }
    const auto apart = std::find(reached.begin(), reached.end(), false);
    if (apart != reached.end()) {
      const Triangle& at = cavity_.triangles[static_cast<std::size_t>(apart - reached.begin())];
      return error(std::to_string(reached.size() - queue.size()) + " of " + std::to_string(reached.size()) +
                       " triangles apart from the others",
                   "one connected surface", {at.begin(), at.end()});
    }
    for (std::size_t t = 0; t < turned_.size(); ++t)
      if (turned_[t]) std::swap(cavity_.triangles[t][1], cavity_.triangles[t][2]);
    return std::nullopt;
  }

  /// Rings of border edges, each followed against its triangle's direction.
  Fault find_rims() {
    if (borders_.empty()) {
      const Triangle& at = cavity_.triangles[0];
      return error("a surface without a rim", "one that is open at its base", {at.begin(), at.end()});
    }
    constexpr std::uint32_t kNone = 0xffffffffU;
    std::vector<std::uint32_t> next(points_.size(), kNone);
    for (const TriangleEdge& edge : borders_) {
      const bool forwards = edge.forwards != turned_[edge.triangle];
      const std::uint32_t from = forwards ? edge.high : edge.low, to = forwards ? edge.low : edge.high;
      if (next[from] != kNone) return error("rims that meet in a point", "rims that are rings", {from});
      next[from] = to;
    }
    for (const TriangleEdge& edge : borders_) {
      std::vector<std::uint32_t> rim;
      for (std::uint32_t point = edge.low; next[point] != kNone;) {
        rim.push_back(point);
        point = std::exchange(next[point], kNone);
      }
      if (!rim.empty()) cavity_.rims.push_back(std::move(rim));
    }
    return std::nullopt;
  }

  std::span<const Eigen::Vector3d> points_;
  std::string_view name_;
  std::vector<TriangleEdge> edges_, borders_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<bool> turned_;
  Cavity cavity_;
};

}  // namespace

Result<Cavity> close_cavity(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
                            std::string_view name) {
  return CavityCloser(points, triangles, name).close();
}

Result<Cavity> ventricle_cavity(const TetMesh& mesh, const HeartSurfaces& surfaces, Ventricle ventricle) {
  const bool left = ventricle == Ventricle::kLeft;
  const std::string_view name = name_of(left ? HeartSurface::kLvEndocardium : HeartSurface::kRvEndocardium);
  if (surfaces.faces.size() != mesh.faces.size())
    return Error{ErrorCode::kInternal,
                 "mechanics",
                 "cavity " + std::string(name) + ": found names of " + std::to_string(surfaces.faces.size()) +
                     " faces, expected " + std::to_string(mesh.faces.size()) + ", those of the mesh",
                 {}};
  std::vector<Triangle> triangles;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const HeartSurface surface = surfaces.faces[f];
    if (left ? surface == HeartSurface::kLvEndocardium
             : surface == HeartSurface::kRvEndocardium || surface == HeartSurface::kRvSeptum)
      triangles.push_back(mesh.faces[f]);
  }
  return close_cavity(mesh.points, triangles, name);
}

}  // namespace voxtet
