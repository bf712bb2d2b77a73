#include "tetra/operations/vertex_smoothing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace voxtet::tetra {
namespace {

/// Functions within this part of the lowest are climbed together.
constexpr double kActive = 0.05;
/// Part of the rise that the gradients promise below which a step is too long.
constexpr double kArmijo = 0.1;
/// A rise below this part of the quality is not worth a step.
constexpr double kLeastGain = 1e-3;
constexpr int kHalvings = 4;

/// One of the functions whose minimum is climbed, near a point.
struct Slope {
  double value;
  Point gradient;
};

/// The lowest function of each tet, and all others that are active.
void find_slopes(const Point& apex, std::span<const StarSide> sides, double lowest,
                 std::vector<Slope>& slopes) {
  slopes.clear();
  const double active = lowest * (1 + kActive);
  for (const auto& [b, c, d] : sides) {
    const ApexSines sines(apex, b, c, d);
    const auto& values = sines.values();
    const auto worst =
        static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
    for (std::size_t e = 0; e < values.size(); ++e)
      if (e == worst || values[e] <= active) slopes.push_back({values[e], sines.gradient(e)});
  }
}

/// The direction in which all of the lowest functions rise, at most four of them; zero at a maximum.
Point find_direction(const std::vector<Slope>& slopes, double lowest) {
  std::array<Point, 4> active;
  std::array<double, 4> values;
  std::size_t count = 0;
  for (const Slope& slope : slopes) {
    if (slope.value > lowest * (1 + kActive)) continue;
    std::size_t place = count < 4 ? count++ : 4;
    if (place == 4) {
      place = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
      if (values[place] <= slope.value) continue;
    }
    active[place] = slope.gradient;
    values[place] = slope.value;
  }
  return nearest_in_hull({active.data(), count});
}

/// How far along `direction` until a function that rises less becomes the lowest; at most `longest`.
double find_step(const std::vector<Slope>& slopes, double lowest, const Point& direction, double longest) {
  const double rise = direction.squaredNorm();
  double step = longest;
  for (const Slope& slope : slopes) {
    const double slower = rise - slope.gradient.dot(direction);
    if (slope.value <= lowest * (1 + kActive) || slower <= 0) continue;
    step = std::min(step, (slope.value - lowest) / slower);
  }
  return step;
}

/// Of four points: the origin is on the inner side of all planes through three.
bool holds_origin(std::span<const Point> corner) {
  for (std::size_t f = 0; f < 4; ++f) {
    const Point &p = corner[(f + 1) % 4], &q = corner[(f + 2) % 4], &r = corner[(f + 3) % 4];
    const Point normal = (q - p).cross(r - p);
    if (!(normal.dot(p) * normal.dot(p - corner[f]) > 0)) return false;
  }
  return true;
}

double shortest_side(const Point& apex, std::span<const StarSide> sides) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const StarSide& side : sides)
    for (const Point& p : side) shortest = std::min(shortest, (p - apex).squaredNorm());
  return std::sqrt(shortest);
}

}  // namespace

StarSide side_opposite(const TetComplex& complex, std::uint32_t tet, std::uint32_t vertex) {
  const Tet& c = complex.corners(tet);
  const auto& side = kFacetCorners[complex.corner_at(tet, vertex)];
  return {complex.point(c[side[0]]), complex.point(c[side[1]]), complex.point(c[side[2]])};
}

double lowest_quality(const Point& apex, std::span<StarSide> sides, double bound) {
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    lowest = std::min(lowest, quality(apex, sides[s][0], sides[s][1], sides[s][2]));
    if (lowest > bound) continue;
    std::swap(sides[0], sides[s]);
    return lowest;
  }
  return lowest;
}

Point nearest_in_hull(std::span<const Point> points) {
  if (points.size() == 4 && holds_origin(points)) return Point::Zero();
  Point best = points[0];
  const auto consider = [&best](const Point& p) {
    if (p.squaredNorm() < best.squaredNorm()) best = p;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& a = points[i];
    consider(a);
    for (std::size_t j = 0; j < i; ++j) {
      const Point ab = points[j] - a;
      const double along = -a.dot(ab), whole = ab.squaredNorm();
      if (along > 0 && along < whole) consider(a + ab * (along / whole));
      for (std::size_t k = 0; k < j; ++k) {
        // The foot of the origin on the plane, by its barycentric coordinates.
        const Point ac = points[k] - a, normal = ab.cross(ac);
        const double area = normal.squaredNorm();
        const double at_b = normal.dot(ac.cross(a)), at_c = normal.dot(a.cross(ab));
        if (at_b > 0 && at_c > 0 && at_b + at_c < area) consider(normal * (normal.dot(a) / area));
      }
    }
  }
  return best;
}

Apex ascend(const Point& start, std::span<StarSide> sides, int steps, const Track* track) {
  Apex apex{start, lowest_quality(start, sides, 0)};
  if (!(apex.quality > 0)) return apex;
  std::vector<Slope> slopes;
  for (int s = 0; s < steps; ++s) {
    find_slopes(apex.at, sides, apex.quality, slopes);
    const Point direction = find_direction(slopes, apex.quality);
    const double rise = direction.squaredNorm();
    const double longest = 0.5 * shortest_side(apex.at, sides) / std::sqrt(rise);
    if (!(rise * longest > kLeastGain * apex.quality)) break;
    double step = find_step(slopes, apex.quality, direction, longest);
    const double before = apex.quality;
    for (int h = 0; h <= kHalvings; ++h, step /= 2) {
      const double wanted = before + std::max(kArmijo * step * rise, kLeastGain * before);
      const Point ahead = apex.at + step * direction, to = track == nullptr ? ahead : track->pull(ahead);
      const double reached = lowest_quality(to, sides, wanted);
      if (!(reached > wanted)) continue;
      apex = {to, reached};
      break;
    }
    if (apex.quality == before) break;
  }
  return apex;
}

bool VertexSmoother::sizes_allow(std::uint32_t vertex, const Point& to, double most_misfit) {
  const Point& from = complex_.point(vertex);
  complex_.find_neighbours(vertex, star_, seen_, others_);
  const auto farthest = [&](const Point& at) {
    double misfit = 0;
    for (const std::uint32_t v : others_) misfit = std::max(misfit, guard_.misfit(at, complex_.point(v)));
    return misfit;
  };
  const double after = farthest(to);
  return after <= most_misfit || after <= farthest(from);
}

bool VertexSmoother::smooth(std::uint32_t vertex, double enough, int steps, const Track* track,
                            double most_misfit) {
  complex_.find_star(vertex, seen_, star_);
  sides_.clear();
  double before = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : star_) {
    sides_.push_back(side_opposite(complex_, t, vertex));
    if (complex_.quality_of(t) >= before) continue;
    before = complex_.quality_of(t);
    std::swap(sides_.front(), sides_.back());
  }
  if (before >= enough) return false;
  const Apex apex = ascend(complex_.point(vertex), sides_, steps, track);
  return apex.quality > before && sizes_allow(vertex, apex.at, most_misfit) &&
         complex_.move_point(vertex, apex.at, star_);
}

}  // namespace voxtet::tetra
