#include "remesh/delaunay/suspect_voxels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "geometry/topology/simple_points_26.h"
#include "geometry/topology/simple_points_kuhn.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int kReach = 1;                ///< voxels around a suspect one
constexpr double kPlaneRounding = 1e-9;  ///< of a plane's distance, generously

Vector3i to_neighbour(std::size_t neighbour) {
  const auto [i, j, k] = step_to(neighbour);
  return {i, j, k};
}

constexpr std::size_t kUsualCrossings = 6;  ///< of a triangle about as large as a voxel

/// From a voxel to its neighbours: the edges of the Kuhn tetrahedra, then the other diagonals of faces.
constexpr std::size_t kSegments = kUp + 3;

Vector3i to_end(std::size_t segment) {
  static const std::array<Vector3i, 3> other_diagonals{Vector3i(1, -1, 0), Vector3i(1, 0, -1),
                                                       Vector3i(0, 1, -1)};
  return segment < kUp ? to_neighbour(segment) : other_diagonals[segment - kUp];
}

using Segments = std::array<Vector3d, kSegments>;

/// Where the segments, moved to a voxel, meet a triangle (Möller and Trumbore 1997).
class SegmentsThroughTriangle {
 public:
  SegmentsThroughTriangle(const Segments& segments, std::size_t count, const TriangleCorners& p)
      : segments_(segments), origin_(p[0]), e1_(p[1] - p[0]), e2_(p[2] - p[0]), normal_(e1_.cross(e2_)) {
    doubt_ = kPlaneRounding * normal_.cwiseAbs().sum();
    for (std::size_t segment = 0; segment < count; ++segment) {
      rises_[segment] = normal_.dot(segments[segment]);
      across_[segment] = segments[segment].cross(e2_);
      dets_[segment] = e1_.dot(across_[segment]);
      deepest_ = std::min(deepest_, rises_[segment]);
      highest_ = std::max(highest_, rises_[segment]);
    }
  }

  /// Whether a segment from there may reach the triangle's plane.
  bool begin_at(const Vector3d& from) {
    s_ = from - origin_;
    height_ = normal_.dot(s_);
    if (height_ + deepest_ > doubt_ || height_ + highest_ < -doubt_) return false;
    q_ = s_.cross(e1_);
    return true;
  }

  /// As a share of the segment from where begin_at() was.
  std::optional<double> at(std::size_t segment) const {
    // By far most segments end on the side of the triangle's plane where they begin.
    const double end = height_ + rises_[segment], det = dets_[segment];
    if (std::min(height_, end) > doubt_ || std::max(height_, end) < -doubt_ || det == 0) return std::nullopt;
    const double u = s_.dot(across_[segment]) / det;
    if (!(u >= 0 && u <= 1)) return std::nullopt;
    const double v = segments_[segment].dot(q_) / det, at = e2_.dot(q_) / det;
    if (!(v >= 0 && u + v <= 1 && at >= 0 && at <= 1)) return std::nullopt;
    return at;
  }

 private:
  const Segments& segments_;
  Vector3d origin_, e1_, e2_, normal_;
  double doubt_;
  Segments across_;
  std::array<double, kSegments> rises_, dets_;
  double deepest_ = 0, highest_ = 0;  ///< of the rises
  Vector3d s_, q_;                    ///< of Möller and Trumbore
  double height_ = 0;
};

/// A triangle on a segment.
struct WayCrossing {
  std::uint64_t voxel, end;  ///< offsets in the grid
  double at;                 ///< share of the segment
  std::uint32_t triangle;
  std::uint8_t segment;
  bool outwards;  ///< the voxel is behind the triangle
};

/// On which side of a surface centres are, as the nearest crossing on a segment from them tells.
class LabelsBySurface {
 public:
  LabelsBySurface(const std::vector<Label>& centres, const SurfaceMesh& surface,
                  const std::vector<WayCrossing>& crossings)
      : centres_(centres), bits_(centres.size() / 64 + 1, 0), before_(bits_.size(), 0) {
    for (const WayCrossing& c : crossings)
      for (const std::uint64_t voxel : {c.voxel, c.end}) bits_[voxel / 64] |= std::uint64_t{1} << voxel % 64;
    std::size_t count = 0;
    for (std::size_t w = 0; w < bits_.size(); ++w) {
      before_[w] = static_cast<std::uint32_t>(count);
      count += static_cast<std::size_t>(std::popcount(bits_[w]));
    }
    nearest_.resize(count);
    for (const WayCrossing& c : crossings) {
      const auto& [behind, front] = surface.sides[c.triangle];
      look_at(c.voxel, {c.at, c.triangle, c.segment, c.outwards ? behind : front});
      const auto backwards = static_cast<std::uint8_t>(c.segment + kSegments);
      look_at(c.end, {1 - c.at, c.triangle, backwards, c.outwards ? front : behind});
    }
    find_passed_over();
  }

  Label at(std::uint64_t voxel) const {
    if (is_crossed(voxel)) return nearest_[rank(voxel)].label;
    const auto passed =
        std::lower_bound(passed_over_.begin(), passed_over_.end(), std::pair{voxel, Label{0}});
    return passed != passed_over_.end() && passed->first == voxel ? passed->second : centres_[voxel];
  }

  /// Calls visit(voxel, label) for every voxel whose centre has another label by the surface.
  template <class Visit>
  void for_each_moved(const Visit& visit) const {
    for (std::size_t w = 0; w < bits_.size(); ++w)
      for (std::uint64_t rest = bits_[w]; rest != 0; rest &= rest - 1) {
        const std::uint64_t voxel = 64 * w + static_cast<std::uint64_t>(std::countr_zero(rest));
        if (at(voxel) != centres_[voxel]) visit(voxel, at(voxel));
      }
    for (const auto& [voxel, label] : passed_over_) visit(voxel, label);
  }

 private:
  struct Nearest {
    double at = 2;
    std::uint32_t triangle = 0;
    std::uint8_t segment = 0;  ///< plus kSegments for backwards
    Label label = kBackground;
  };
  bool is_crossed(std::uint64_t voxel) const { return bits_[voxel / 64] >> voxel % 64 & 1; }
  /// A voxel with no triangle on its segments is on the same side as the one before it; the first is
  /// background.
  void find_passed_over() {
    Label before = kBackground;
    for (std::uint64_t voxel = 0; voxel < centres_.size(); ++voxel) {
      if (is_crossed(voxel))
        before = nearest_[rank(voxel)].label;
      else if (before != centres_[voxel])
        passed_over_.push_back({voxel, before});
    }
  }
  std::size_t rank(std::uint64_t voxel) const {
    const std::uint64_t lower = bits_[voxel / 64] & ((std::uint64_t{1} << voxel % 64) - 1);
    return before_[voxel / 64] + static_cast<std::size_t>(std::popcount(lower));
  }
  void look_at(std::uint64_t voxel, const Nearest& found) {
    Nearest& known = nearest_[rank(voxel)];
    if (std::tie(found.at, found.triangle, found.segment) < std::tie(known.at, known.triangle, known.segment))
      known = found;
  }

  const std::vector<Label>& centres_;
  std::vector<std::uint64_t> bits_;    ///< of voxels at the end of a crossed segment
  std::vector<std::uint32_t> before_;  ///< by word of bits_, how many bits are set before it
  std::vector<Nearest> nearest_;       ///< of the voxels in bits_, in their order
  std::vector<std::pair<std::uint64_t, Label>> passed_over_;  ///< other voxels with another label, ascending
};

bool is_one_of(Label label, const std::vector<Label>& labels) {
  return std::binary_search(labels.begin(), labels.end(), label);
}

}  // namespace

SuspectVoxels::SuspectVoxels(const SurfaceMesh& reference, const LabelField& field)
    : reference_(reference),
      field_(field),
      segments_(field.connectivity() == Connectivity::kFaces ? kSegments : kUp) {
  for (int d = 0; d < 3; ++d) last_[d] = field.grid().size[static_cast<std::size_t>(d)] - 1;
}

template <class Found, class Wanted, class Find>
std::vector<Found> SuspectVoxels::crossings_of(const SurfaceMesh& surface, int threads, const Wanted& wanted,
                                               const Find& find) const {
  constexpr std::size_t kTriangles = 2048;  ///< of a task
  Segments segments;
  for (std::size_t segment = 0; segment < kSegments; ++segment)
    segments[segment] = to_end(segment).cast<double>();
  std::vector<Vector3d> points(surface.points.size());
  parallel_for(threads, points.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) points[v] = field_.to_index(surface.points[v]);
  });
  const auto look_at = [&](std::uint32_t t, std::vector<Found>& found) {
    TriangleCorners p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = points[surface.triangles[t][k]];
    const Vector3i low = p[0].cwiseMin(p[1]).cwiseMin(p[2]).array().floor().matrix().cast<int>().cwiseMax(0);
    const Vector3i high =
        p[0].cwiseMax(p[1]).cwiseMax(p[2]).array().ceil().matrix().cast<int>().cwiseMin(last_);
    std::optional<SegmentsThroughTriangle> through;
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i) {
          const Vector3i from(i, j, k);
          const std::uint64_t voxel = field_.grid().offset(from);
          if (!wanted(voxel)) continue;
          if (!through) through.emplace(segments, segments_, p);
          if (!through->begin_at(from.cast<double>())) continue;
          for (std::uint8_t segment = 0; segment < segments_; ++segment)
            if (const auto at = through->at(segment); at && inside(from + to_end(segment)))
              find(voxel, segment, *at, t, found);
        }
  };
  const std::size_t count = surface.triangles.size();
  std::vector<std::vector<Found>> by_task((count + kTriangles - 1) / kTriangles);
  run_tasks(threads, by_task.size(), [&](std::size_t task) {
    std::vector<Found>& found = by_task[task];
    found.reserve(kUsualCrossings * kTriangles);
    for (std::size_t t = task * kTriangles; t < std::min(count, (task + 1) * kTriangles); ++t)
      look_at(static_cast<std::uint32_t>(t), found);
  });
  std::size_t all = 0;
  for (const std::vector<Found>& found : by_task) all += found.size();
  std::vector<Found> crossings;
  crossings.reserve(all);
  for (std::vector<Found>& found : by_task) {
    crossings.insert(crossings.end(), found.begin(), found.end());
    std::vector<Found>().swap(found);
  }
  return crossings;
}

std::vector<bool> SuspectVoxels::of(const SurfaceMesh& surface, const std::vector<Label>& labels,
                                    const std::vector<Vector3d>& touching, int threads) const {
  const std::vector<Label>& centres = field_.centre_labels();
  std::array<Vector3d, kSegments> segments_mm;
  for (std::size_t segment = 0; segment < segments_; ++segment)
    segments_mm[segment] = field_.to_mm(to_end(segment).cast<double>()) - field_.to_mm(Vector3d::Zero());
  const std::vector<WayCrossing> crossings = crossings_of<WayCrossing>(
      surface, threads, [](std::uint64_t) { return true; },
      [&](std::uint64_t voxel, std::uint8_t segment, double at, std::uint32_t t,
          std::vector<WayCrossing>& found) {
        const auto& [a, b, c] = surface.triangles[t];
        const bool outwards = triangle_cross(surface.points[a], surface.points[b], surface.points[c])
                                  .dot(segments_mm[segment]) > 0;
        found.push_back({voxel, end_of(voxel, segment), at, t, segment, outwards});
      });
  const LabelsBySurface by_surface(centres, surface, crossings);
  std::vector<bool> marked;
  by_surface.for_each_moved([&](std::uint64_t voxel, Label label) {
    bool simple = true;
    for (const Label other : {label, centres[voxel]})
      if (is_one_of(other, labels))
        simple = simple && stays_simple(voxel, other, [&](std::uint64_t v) { return centres[v]; }) &&
                 stays_simple(voxel, other, [&](std::uint64_t v) { return by_surface.at(v); });
    if (!simple) mark_around(voxel, marked);
  });
  std::vector<std::uint64_t> closed;  // segments, by number
  for (const WayCrossing& c : crossings) {
    const Sides& sides = surface.sides[c.triangle];
    if (!is_one_of(sides[0], labels) && !is_one_of(sides[1], labels)) continue;
    const Label label = centres[c.voxel];
    if (centres[c.end] == label && by_surface.at(c.voxel) == label && by_surface.at(c.end) == label)
      closed.push_back(c.voxel * kSegments + c.segment);
  }
  for (const std::uint64_t segment : not_of_reference(std::move(closed), threads)) {
    mark_around(segment / kSegments, marked);
    mark_around(end_of(segment / kSegments, segment % kSegments), marked);
  }
  for (const Vector3d& p : touching) mark_around(field_.nearest_voxel(p), marked);
  return marked;
}

template <class LabelAt>
bool SuspectVoxels::stays_simple(std::uint64_t voxel, Label label, const LabelAt& label_at) const {
  const Vector3i middle = voxel_of(voxel);
  const auto is_of = [&](const std::array<int, 3>& step) {
    const Vector3i next = middle + Vector3i(step[0], step[1], step[2]);
    return (inside(next) ? label_at(field_.grid().offset(next)) : kBackground) == label;
  };
  std::uint32_t around = 0;
  if (field_.connectivity() == Connectivity::kFaces) {
    for (std::size_t n = 0; n < kCube; ++n)
      if (is_of(cube_step(n))) around |= 1U << n;
    return is_simple_in_cube(around);
  }
  for (std::size_t n = 0; n < kNeighbours; ++n)
    if (is_of(step_to(n))) around |= 1U << n;
  return is_simple(around);
}

std::vector<std::uint64_t> SuspectVoxels::not_of_reference(std::vector<std::uint64_t> segments,
                                                           int threads) const {
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  if (segments.empty()) return segments;
  std::vector<bool> begins(field_.centre_labels().size(), false), crossed(segments.size(), false);
  for (const std::uint64_t segment : segments) begins[segment / kSegments] = true;
  for (const std::size_t w : crossings_of<std::size_t>(
           reference_, threads, [&](std::uint64_t voxel) { return begins[voxel]; },
           [&](std::uint64_t voxel, std::uint8_t segment, double, std::uint32_t,
               std::vector<std::size_t>&found) {
             const auto at = std::lower_bound(segments.begin(), segments.end(), voxel * kSegments + segment);
             if (at != segments.end() && *at == voxel * kSegments + segment)
               found.push_back(static_cast<std::size_t>(at - segments.begin()));
           }))
    crossed[w] = true;
  std::vector<std::uint64_t> others;
  for (std::size_t w = 0; w < segments.size(); ++w)
    if (!crossed[w]) others.push_back(segments[w]);
  return others;
}

std::uint64_t SuspectVoxels::end_of(std::uint64_t voxel, std::size_t segment) const {
  return field_.grid().offset(voxel_of(voxel) + to_end(segment));
}

Vector3i SuspectVoxels::voxel_of(std::uint64_t offset) const {
  const auto nx = static_cast<std::uint64_t>(field_.grid().size[0]),
             ny = static_cast<std::uint64_t>(field_.grid().size[1]);
  return {static_cast<int>(offset % nx), static_cast<int>(offset / nx % ny),
          static_cast<int>(offset / nx / ny)};
}

bool SuspectVoxels::inside(const Vector3i& voxel) const {
  return (voxel.array() >= 0).all() && (voxel.array() <= last_.array()).all();
}

void SuspectVoxels::mark_around(std::uint64_t voxel, std::vector<bool>& marked) const {
  marked.resize(field_.centre_labels().size(), false);
  const Vector3i middle = voxel_of(voxel);
  for (int k = -kReach; k <= kReach; ++k)
    for (int j = -kReach; j <= kReach; ++j)
      for (int i = -kReach; i <= kReach; ++i)
        if (const Vector3i next = middle + Vector3i(i, j, k); inside(next))
          marked[field_.grid().offset(next)] = true;
}

}  // namespace voxtet::remesh
