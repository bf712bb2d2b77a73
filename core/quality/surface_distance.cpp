#include "quality/surface_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "geometry/search/closest_point.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

constexpr double kMaxSamples = 250'000;
constexpr int kMaxDivisions = 50'000;
constexpr std::uint32_t kPollEvery = 4096;
constexpr double kNoBound = std::numeric_limits<double>::max();

/// The boundary of every label as a tree.
class Boundaries {
 public:
  explicit Boundaries(const TriangleSet& set) : set_(set) {
    std::map<Label, std::vector<Triangle>> members;
    for (std::size_t t = 0; t < set.triangles.size(); ++t)
      for (const Label label : set.sides[t])
        if (label != kBackground) members[label].push_back(set.triangles[t]);
    for (const auto& [label, triangles] : members) trees_.try_emplace(label, set.points, triangles);
  }

  const std::map<Label, ClosestPointTree>& trees() const { return trees_; }

  /// What the boundary of a label is measured to: that of the same label, or everything.
  const ClosestPointTree& opposite(Label label) {
    if (const auto own = trees_.find(label); own != trees_.end()) return own->second;
    if (!whole_) whole_.emplace(set_.points, set_.triangles);
    return *whole_;
  }

 private:
  const TriangleSet set_;
  std::map<Label, ClosestPointTree> trees_;
  std::optional<ClosestPointTree> whole_;
};

/// A point and the closest triangle to it.
struct Sample {
  Eigen::Vector3d point;
  double distance_mm = 0;
  std::uint32_t triangle = 0;
};

/// A triangle, or a part of one, with no point farther than `bound_mm`.
struct Piece {
  std::array<Sample, 3> corners;
  double longest_mm = 0;  ///< of its edges
  double bound_mm = 0;
  const ClosestPointTree* to = nullptr;
  std::uint32_t id = 0;  ///< settles which of two equal bounds comes first
  bool operator<(const Piece& other) const {
    return bound_mm != other.bound_mm ? bound_mm < other.bound_mm : id > other.id;
  }
};

/// Distances one way. Two of them may run at once: neither changes what the other reads.
class DirectedDistance {
 public:
  /// `ctx` is asked now and then whether to stop; `cancelled` tells both ways.
  DirectedDistance(const Boundaries& from, Boundaries& to, const DistanceParams& params,
                   const RunContext& ctx, std::atomic<bool>& cancelled)
      : from_(from), to_(to), params_(params), ctx_(ctx), cancelled_(cancelled) {}

  /// Meaningless once cancelled.
  DistanceSummary measure() {
    for (const auto& [label, part] : from_.trees())
      corners_.push_back(at_points(part.points(), to_.opposite(label)));
    const double spacing = affordable_spacing();
    std::size_t i = 0;
    for (const auto& [label, part] : from_.trees()) sample(part, to_.opposite(label), corners_[i++], spacing);
    for (int divisions = 0; !open_.empty() && divisions < kMaxDivisions && !cancelled_; ++divisions) divide();
    return cancelled_ ? DistanceSummary{} : summary();
  }

  /// Raises the value of each point of the set (NaN: none) to its largest distance, once that is measured.
  void raise_to_points(std::vector<float>& values) const {
    auto samples = corners_.begin();
    for (const auto& [label, part] : from_.trees()) {
      for (std::size_t i = 0; i < samples->size(); ++i) {
        float& value = values[part.given_points()[i]];
        value = std::fmax(value, static_cast<float>((*samples)[i].distance_mm));
      }
      ++samples;
    }
  }

 private:
  Sample closest(const Eigen::Vector3d& point, const ClosestPointTree& to) {
    if (++queries_ % kPollEvery == 0 && ctx_.cancelled()) cancelled_ = true;
    const ClosestPointTree::Hit hit = to.closest(point, hint_);
    hint_ = hit.triangle;
    largest_ = std::max(largest_, hit.distance_mm);
    return {point, hit.distance_mm, hit.triangle};
  }

  std::vector<Sample> at_points(const std::vector<Eigen::Vector3d>& points, const ClosestPointTree& to) {
    std::vector<Sample> samples;
    samples.reserve(points.size());
    for (std::size_t i = 0; i < points.size() && !cancelled_; ++i) samples.push_back(closest(points[i], to));
    return samples;
  }

  /// The spacing asked for, or a larger one that needs about kMaxSamples.
  double affordable_spacing() const {
    std::vector<double> longest;
    for (const auto& [label, part] : from_.trees())
      for (const auto& [a, b, c] : part.triangles())
        longest.push_back(longest_edge_mm({part.points()[a], part.points()[b], part.points()[c]}));
    double spacing = params_.spacing_mm;
    while (true) {
      double samples = 0;
      for (const double length : longest) {
        const double rows = std::ceil(length / spacing);
        if (rows > 1) samples += (rows * rows + 3 * rows) / 2 - 2;
      }
      if (samples <= kMaxSamples) return spacing;
      spacing *= std::max(1.05, std::sqrt(samples / kMaxSamples));
    }
  }

  /// Samples every triangle on the corners of its n^2 sub-triangles, and keeps those that may hold more.
  void sample(const ClosestPointTree& part, const ClosestPointTree& to, const std::vector<Sample>& corners,
              double spacing) {
    std::vector<double> weights(corners.size(), 0.0);
    std::vector<Sample> lattice;
    for (const Triangle& v : part.triangles()) {
      if (cancelled_) return;
      const Eigen::Vector3d &a = corners[v[0]].point, &b = corners[v[1]].point, &c = corners[v[2]].point;
      const double longest = longest_edge_mm({a, b, c});
      const int n = std::max(1, static_cast<int>(std::ceil(longest / spacing)));
      spacing_ = std::max(spacing_, longest / n);
      const double weight = triangle_area_mm2(a, b, c) / (3.0 * n * n);
      for (const std::uint32_t corner : v) weights[corner] += weight;
      if (n == 1) {
        consider(corners[v[0]], corners[v[1]], corners[v[2]], longest, kNoBound, to);
        continue;
      }
      // Row i has n + 1 - i points, from the edge ab towards c.
      lattice.clear();
      for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j) {
          const bool is_corner = (i == 0 && j == 0) || i == n || j == n;
          if (is_corner) {
            lattice.push_back(corners[v[i == n ? 2 : j == n ? 1 : 0]]);
            continue;
          }
          const bool on_edge = i == 0 || j == 0 || i + j == n;
          lattice.push_back(closest(a + (b - a) * (1.0 * j / n) + (c - a) * (1.0 * i / n), to));
          found_.emplace_back(static_cast<float>(lattice.back().distance_mm),
                              static_cast<float>((on_edge ? 3 : 6) * weight));
        }
      for (int i = 0, row = 0; i < n; row += n + 1 - i, ++i)
        for (int j = 0; i + j < n; ++j) {
          const auto at = [&](int of_row, int of_column) -> const Sample& {
            return lattice[static_cast<std::size_t>(row + of_row * (n + 1 - i) + j + of_column)];
          };
          consider(at(0, 0), at(0, 1), at(1, 0), longest / n, kNoBound, to);
          if (i + j + 1 < n) consider(at(0, 1), at(1, 1), at(1, 0), longest / n, kNoBound, to);
        }
    }
    for (std::size_t i = 0; i < corners.size(); ++i)
      found_.emplace_back(static_cast<float>(corners[i].distance_mm), static_cast<float>(weights[i]));
  }

  static double reach(const Piece& piece, std::uint32_t triangle) {
    double largest = 0;
    for (const Sample& s : piece.corners)
      largest = std::max(largest, s.triangle == triangle
                                      ? s.distance_mm
                                      : (piece.to->closest_on(triangle, s.point) - s.point).norm());
    return largest;
  }

  /// Keeps a piece that may hold a distance clearly above the largest found. Its bound is the least of what
  /// its corners allow: a corner's distance and the way from there, or, for the closest triangle of a corner,
  /// the largest distance of a corner.
  void consider(const Sample& a, const Sample& b, const Sample& c, double longest, double bound,
                const ClosestPointTree& to) {
    const double enough = largest_ + params_.tolerance_mm;
    bound = std::min(bound, std::min({a.distance_mm, b.distance_mm, c.distance_mm}) + longest);
    if (bound > enough) {
      Piece piece{{a, b, c}, longest, bound, &to, next_id_++};
      for (const Sample& s : piece.corners)
        piece.bound_mm = std::min(piece.bound_mm, reach(piece, s.triangle));
      bound = piece.bound_mm;
      if (bound > enough) {
        open_.push_back(piece);
        std::push_heap(open_.begin(), open_.end());
        return;
      }
    }
    bound_ = std::max(bound_, bound);
  }

  /// Takes the piece of the largest bound: settles it by its centre's closest triangle, or divides it in
  /// four.
  void divide() {
    std::pop_heap(open_.begin(), open_.end());
    const Piece piece = open_.back();
    open_.pop_back();
    const auto& [a, b, c] = piece.corners;
    const double enough = largest_ + params_.tolerance_mm;
    hint_ = a.triangle;
    const Sample centre = closest((a.point + b.point + c.point) / 3, *piece.to);
    if (const double bound = std::min(piece.bound_mm, reach(piece, centre.triangle)); bound <= enough) {
      bound_ = std::max(bound_, bound);
      return;
    }
    const Sample ab = closest((a.point + b.point) / 2, *piece.to),
                 bc = closest((b.point + c.point) / 2, *piece.to),
                 ca = closest((c.point + a.point) / 2, *piece.to);
    for (const std::array<Sample, 3>& p :
         {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
      consider(p[0], p[1], p[2], piece.longest_mm / 2, piece.bound_mm, *piece.to);
  }

  DistanceSummary summary() {
    DistanceSummary out;
    double sum = 0, squares = 0, area = 0;
    for (const auto& [distance, weight] : found_) {
      sum += static_cast<double>(weight) * distance;
      squares += static_cast<double>(weight) * distance * distance;
      area += weight;
    }
    if (found_.empty()) return out;
    out.samples = found_.size();
    out.spacing_mm = spacing_;
    out.mean_mm = area > 0 ? sum / area : 0;
    out.rms_mm = area > 0 ? std::sqrt(squares / area) : 0;
    out.max_mm = largest_;
    out.uncertainty_mm =
        std::max({0.0, bound_ - largest_, open_.empty() ? 0.0 : open_.front().bound_mm - largest_});
    // From the largest down, until a twentieth of the area has gone by.
    std::make_heap(found_.begin(), found_.end());
    for (double above = 0; above <= 0.05 * area && !found_.empty(); found_.pop_back()) {
      std::pop_heap(found_.begin(), found_.end());
      out.p95_mm = found_.back().first;
      above += found_.back().second;
    }
    return out;
  }

  const Boundaries& from_;
  Boundaries& to_;
  const DistanceParams& params_;
  const RunContext& ctx_;
  std::atomic<bool>& cancelled_;
  std::vector<std::vector<Sample>> corners_;    ///< the points of each tree
  std::vector<std::pair<float, float>> found_;  ///< distance, weight
  std::vector<Piece> open_;                     ///< heap, largest bound first
  double spacing_ = 0;                          ///< longest edge of the lattices
  double largest_ = 0;                          ///< found so far
  double bound_ = 0;                            ///< of the pieces no longer open
  std::uint32_t hint_ = 0, queries_ = 0, next_id_ = 0;
};

}  // namespace

struct DistanceMeasurement::Impl {
  DistanceParams params;
  RunContext& ctx;
  std::array<std::optional<Boundaries>, 2> boundaries;  ///< none where a set has no triangles
  std::array<DistanceSummary, 2> found;
  std::vector<float> of_points;  ///< of the first set
  std::atomic<bool> cancelled = false;
};

DistanceMeasurement::DistanceMeasurement(const TriangleSet& a, const TriangleSet& b,
                                         const DistanceParams& params, RunContext& ctx)
    : impl_(new Impl{
          params, ctx, {}, {}, std::vector(a.points.size(), std::numeric_limits<float>::quiet_NaN())}) {
  if (a.triangles.empty() || b.triangles.empty()) return;
  auto& boundaries = impl_->boundaries;
  run_tasks(ctx.threads, {[&] { boundaries[0].emplace(a); }, [&] { boundaries[1].emplace(b); }});
}

DistanceMeasurement::~DistanceMeasurement() = default;

void DistanceMeasurement::measure(std::size_t direction) {
  auto& [params, ctx, boundaries, found, of_points, cancelled] = *impl_;
  if (!boundaries[direction]) return;
  DirectedDistance distance(*boundaries[direction], *boundaries[1 - direction], params, ctx, cancelled);
  found[direction] = distance.measure();
  if (direction == 0) distance.raise_to_points(of_points);
}

Result<SurfaceDistances> DistanceMeasurement::result() const {
  if (impl_->cancelled) return cancelled_error(kQualityStage);
  return SurfaceDistances{impl_->found[0], impl_->found[1]};
}

std::vector<float> DistanceMeasurement::of_points() const {
  return impl_->of_points;
}

Result<SurfaceDistances> measure_distances(const TriangleSet& a, const TriangleSet& b,
                                           const DistanceParams& params, RunContext& ctx) {
  DistanceMeasurement distances(a, b, params, ctx);
  run_tasks(ctx.threads, {[&] { distances.measure(0); }, [&] { distances.measure(1); }});
  return distances.result();
}

}  // namespace voxtet
