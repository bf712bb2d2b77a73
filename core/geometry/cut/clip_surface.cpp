#include "geometry/cut/clip_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

#include "geometry/cut/cut_faces.h"
#include "geometry/cut/triangulate_section.h"
#include "geometry/repair/undo_intersections.h"
#include "geometry/topology/unused_points.h"

namespace voxtet {
namespace {

constexpr double kSnapShare = 0.25;  ///< of the shortest edge at a point
constexpr double kLeastArea = 0.2;   ///< of what a triangle has before its points are put into the plane
constexpr double kAtPlane = 1e-9;    ///< of the spacing
constexpr std::uint32_t kNotDivided = 0xffffffffU;

/// Gives triangles the sides that sides_of(index) says; those with one label on both go.
template <class SidesOf>
void give_sides(SurfaceMesh& surface, const SidesOf& sides_of) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    Triangle triangle = surface.triangles[t];
    Sides sides = sides_of(t);
    if (sides[0] == sides[1]) continue;
    if (sides[0] < sides[1]) {
      std::swap(sides[0], sides[1]);
      std::swap(triangle[1], triangle[2]);
    }
    surface.triangles[kept] = triangle;
    surface.sides[kept++] = sides;
  }
  surface.triangles.resize(kept);
  surface.sides.resize(kept);
}

class Clipper {
 public:
  Clipper(SurfaceMesh surface, const LabelVolume& volume, const CutPlane& cut)
      : surface_(std::move(surface)),
        volume_(volume),
        to_index_(volume.linear().inverse()),
        cut_(cut),
        spacing_mm_(volume.smallest_spacing_mm()) {}

  bool concerns(const Sides& sides) const { return cut_.cuts(sides[0]) || cut_.cuts(sides[1]); }

  /// False when cancelled.
  bool snap(const CutPlanes& cuts, std::size_t cut, const RunContext& ctx) {
    std::vector<double> shortest(surface_.points.size(), std::numeric_limits<double>::max());
    std::vector<bool> concerned(surface_.points.size(), false);
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t a = surface_.triangles[t][c], b = surface_.triangles[t][(c + 1) % 3];
        const double length = (surface_.points[a] - surface_.points[b]).norm();
        shortest[a] = std::min(shortest[a], length);
        shortest[b] = std::min(shortest[b], length);
        if (concerns(surface_.sides[t])) concerned[a] = true;
      }
    const std::vector<CutBits> others =
        cuts_of_points(surface_.points.size(), surface_.triangles, surface_.sides, cuts);
    const std::vector<Eigen::Vector3d> before = surface_.points;
    for (std::size_t p = 0; p < before.size(); ++p) {
      if (!concerned[p]) continue;
      const double distance = cut_.distance_mm(before[p]), near = kSnapShare * shortest[p];
      const bool is_stray = cut_.beyond != kBackground && distance > near && !is_near_beyond(before[p]);
      if (std::abs(distance) > near && !is_stray) continue;
      const Eigen::Vector3d place = in_planes(before[p], others[p] | static_cast<CutBits>(1U << cut), cuts);
      if (is_stray || (place - before[p]).norm() < 2 * near) surface_.points[p] = place;
    }
    keep_areas(before);
    return !undo_intersections(surface_, before, ctx).cancelled;
  }

  /// Takes points back that would leave a triangle too little of its area, the farthest moved of each first.
  void keep_areas(const std::vector<Eigen::Vector3d>& before) {
    const auto area = [](const std::vector<Eigen::Vector3d>& points, const Triangle& t) {
      return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
    };
    for (bool good = false; !good;) {
      good = true;
      for (const Triangle& t : surface_.triangles) {
        const auto moved = [&](std::uint32_t p) { return (surface_.points[p] - before[p]).squaredNorm(); };
        const std::uint32_t farthest =
            *std::max_element(t.begin(), t.end(), [&](auto a, auto b) { return moved(a) < moved(b); });
        if (moved(farthest) == 0 || area(surface_.points, t) >= kLeastArea * area(before, t)) continue;
        surface_.points[farthest] = before[farthest];
        good = false;
      }
    }
  }

  /// Divides the triangles that the plane passes through.
  void divide() {
    find_sides();
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
      if (concerns(surface_.sides[t]))
        for (std::size_t c = 0; c < 3; ++c)
          divide_edge(surface_.triangles[t][c], surface_.triangles[t][(c + 1) % 3]);
    std::vector<Triangle> triangles;
    std::vector<Sides> sides;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const std::size_t first = triangles.size();
      divide_triangle(surface_.triangles[t], triangles);
      sides.insert(sides.end(), triangles.size() - first, surface_.sides[t]);
    }
    surface_.triangles = std::move(triangles);
    surface_.sides = std::move(sides);
  }

  /// Triangles in the plane, from what is beyond to the labels. False where surfaces meet in it.
  bool close() {
    std::vector<std::uint32_t> number(surface_.points.size(), kNotDivided), point_of;
    std::vector<Eigen::Vector2d> points;
    std::vector<SectionEdge> edges;
    const Eigen::Vector3d u = cut_.normal.unitOrthogonal(), v = cut_.normal.cross(u);
    const auto number_of = [&](std::uint32_t p) {
      if (number[p] == kNotDivided) {
        number[p] = static_cast<std::uint32_t>(points.size());
        points.emplace_back(u.dot(surface_.points[p]), v.dot(surface_.points[p]));
        point_of.push_back(p);
      }
      return number[p];
    };
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      if (!concerns(surface_.sides[t])) continue;
      const Triangle& triangle = surface_.triangles[t];
      const auto [behind, front] = surface_.sides[t];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t a = triangle[c], b = triangle[(c + 1) % 3];
        if (side_[a] != 0 || side_[b] != 0) continue;
        // Beyond the plane what lies behind a triangle is on the left of its edges there, before it what is
        // in front.
        const int rest = side_[triangle[(c + 2) % 3]];
        if (rest > 0)
          edges.push_back({number_of(a), number_of(b), behind, front, SectionEdge::Of::kAbove});
        else if (rest < 0)
          edges.push_back({number_of(a), number_of(b), front, behind, SectionEdge::Of::kBelow});
        else if (faces_beyond(triangle))
          edges.push_back({number_of(a), number_of(b), behind, front, SectionEdge::Of::kWithin});
        else
          edges.push_back({number_of(b), number_of(a), behind, front, SectionEdge::Of::kWithin});
      }
    }
    const std::optional<SectionTriangles> section = triangulate_section(
        points, edges, [&](Label label) { return cut_.cuts(label); }, spacing_mm_);
    if (!section) return false;
    relabel();
    for (const Eigen::Vector2d& p : section->added) {
      point_of.push_back(static_cast<std::uint32_t>(surface_.points.size()));
      surface_.points.push_back(p.x() * u + p.y() * v + cut_.offset_mm * cut_.normal);
    }
    for (std::size_t t = 0; t < section->triangles.size(); ++t) {
      const auto [a, b, c] = section->triangles[t];
      const Label label = section->labels[t];
      if (cut_.beyond > label) {
        surface_.triangles.push_back({point_of[a], point_of[c], point_of[b]});
        surface_.sides.push_back({cut_.beyond, label});
      } else {
        surface_.triangles.push_back({point_of[a], point_of[b], point_of[c]});
        surface_.sides.push_back({label, cut_.beyond});
      }
    }
    return true;
  }

  SurfaceMesh take() {
    drop_unused_points(surface_);
    return std::move(surface_);
  }

 private:
  /// Whether one of the 27 voxels around a point lies beyond the cut.
  bool is_near_beyond(const Eigen::Vector3d& point) const {
    const Eigen::Vector3i at = (to_index_ * (point - volume_.origin())).array().round().matrix().cast<int>();
    for (int n = 0; n < 27; ++n)
      if (volume_.at_or_background(at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1) ==
          cut_.beyond)
        return true;
    return false;
  }

  /// 1 beyond the plane, 0 in it.
  void find_sides() {
    side_.resize(surface_.points.size());
    for (std::size_t p = 0; p < side_.size(); ++p) {
      const double distance = cut_.distance_mm(surface_.points[p]);
      side_[p] = std::abs(distance) <= kAtPlane * spacing_mm_ ? 0 : distance > 0 ? 1 : -1;
    }
  }

  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  void divide_edge(std::uint32_t a, std::uint32_t b) {
    if (side_[a] * side_[b] >= 0 || between_.contains(key(a, b))) return;
    if (a > b) std::swap(a, b);
    const double low = cut_.distance_mm(surface_.points[a]), high = cut_.distance_mm(surface_.points[b]);
    Eigen::Vector3d p = surface_.points[a] + low / (low - high) * (surface_.points[b] - surface_.points[a]);
    p -= cut_.distance_mm(p) * cut_.normal;
    between_.emplace(key(a, b), static_cast<std::uint32_t>(surface_.points.size()));
    surface_.points.push_back(p);
    side_.push_back(0);
  }

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) const {
    const auto found = between_.find(key(a, b));
    return found == between_.end() ? kNotDivided : found->second;
  }

  void divide_triangle(const Triangle& triangle, std::vector<Triangle>& out) const {
    // At most two edges are divided, after which one corner is alone.
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = triangle[c], b = triangle[(c + 1) % 3], d = triangle[(c + 2) % 3];
      const std::uint32_t ab = middle(a, b), ad = middle(a, d);
      if (ab != kNotDivided && ad != kNotDivided) {
        out.push_back({a, ab, ad});
        const bool across_b = (surface_.points[b] - surface_.points[ad]).squaredNorm() <
                              (surface_.points[d] - surface_.points[ab]).squaredNorm();
        if (across_b)
          out.insert(out.end(), {{ab, b, ad}, {b, d, ad}});
        else
          out.insert(out.end(), {{ab, b, d}, {ab, d, ad}});
        return;
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = triangle[c], b = triangle[(c + 1) % 3], d = triangle[(c + 2) % 3];
      if (const std::uint32_t ab = middle(a, b); ab != kNotDivided) {
        out.insert(out.end(), {{a, ab, d}, {ab, b, d}});
        return;
      }
    }
    out.push_back(triangle);
  }

  bool faces_beyond(const Triangle& t) const {
    const Eigen::Vector3d& a = surface_.points[t[0]];
    return cut_.normal.dot((surface_.points[t[1]] - a).cross(surface_.points[t[2]] - a)) > 0;
  }

  /// Which sides of a triangle lie beyond the plane.
  std::array<bool, 2> sides_beyond(const Triangle& t) const {
    const auto is = [&](int side) {
      return side_[t[0]] == side || side_[t[1]] == side || side_[t[2]] == side;
    };
    if (is(1)) return {true, true};
    if (is(-1)) return {false, false};
    return {!faces_beyond(t), faces_beyond(t)};
  }

  void relabel() {
    give_sides(surface_, [&](std::size_t t) {
      Sides sides = surface_.sides[t];
      if (!concerns(sides)) return sides;
      const std::array<bool, 2> beyond = sides_beyond(surface_.triangles[t]);
      for (std::size_t s = 0; s < 2; ++s)
        if (beyond[s] && cut_.cuts(sides[s])) sides[s] = cut_.beyond;
      return sides;
    });
  }

  SurfaceMesh surface_;
  const LabelVolume& volume_;
  Eigen::Matrix3d to_index_;
  const CutPlane& cut_;
  double spacing_mm_;
  std::vector<int> side_;  ///< by point
  std::unordered_map<std::uint64_t, std::uint32_t> between_;
};

std::optional<SurfaceMesh> clip_once(SurfaceMesh surface, const LabelVolume& volume, const CutPlanes& cuts,
                                     std::size_t cut, const RunContext& ctx) {
  Clipper clipper(std::move(surface), volume, cuts[cut]);
  if (!clipper.snap(cuts, cut, ctx)) return std::nullopt;
  clipper.divide();
  if (!clipper.close()) return std::nullopt;
  return clipper.take();
}

}  // namespace

std::optional<SurfaceMesh> clip_surface(SurfaceMesh surface, const LabelVolume& volume, const CutPlanes& cuts,
                                        std::size_t cut, const RunContext& ctx) {
  CutPlanes far = cuts;
  far[cut].offset_mm += cuts[cut].reach_mm;
  far[cut].beyond = kBackground;
  std::optional<SurfaceMesh> near = clip_once(std::move(surface), volume, far, cut, ctx);
  if (!near) return std::nullopt;
  return clip_once(std::move(*near), volume, cuts, cut, ctx);
}

void drop_lost_labels(SurfaceMesh& surface, const LabelVolume& volume) {
  std::vector<bool> is_left(std::size_t{1} << 16, false);
  is_left[kBackground] = true;
  for (const Label label : volume.labels) is_left[label] = true;
  give_sides(surface, [&](std::size_t t) {
    Sides sides = surface.sides[t];
    for (Label& label : sides)
      if (!is_left[label]) label = kBackground;
    return sides;
  });
  drop_unused_points(surface);
}

}  // namespace voxtet
