#include "tetra/operations/size_smoothing.h"

#include <algorithm>
#include <cmath>

namespace voxtet::tetra {
namespace {

/// How far an edge is from its target length, by their ratio: the same above and below, 0 where they are
/// equal. About 1.4 times its log2, without a logarithm, since those of standard libraries differ in their
/// last digit.
double deviation_of(double ratio) {
  return std::abs(ratio - 1 / ratio);
}

constexpr double kMuch = 0.55;  ///< of deviation: a factor of 1.31
constexpr int kShorterSteps = 2;

}  // namespace

/// Each edge pulls the vertex to where it would have its length, by the square of its deviation; the sum of
/// the fourth powers is to fall.
bool SizeSmoother::smooth(std::uint32_t vertex, double enough) {
  complex_.find_star(vertex, seen_, star_);
  complex_.find_neighbours(vertex, star_, seen_, neighbours_);
  const Point from = complex_.point(vertex);
  double before = 0, most = 0, weights = 0;
  Point pull = Point::Zero();
  for (const std::uint32_t v : neighbours_) {
    const Point& other = complex_.point(v);
    const double ratio = guard_.ratio(from, other), deviation = deviation_of(ratio),
                 weight = deviation * deviation;
    most = std::max(most, deviation);
    before += weight * weight;
    weights += weight;
    pull += weight * (1 / ratio - 1) * (from - other);
  }
  if (most < kMuch) return false;
  sides_.clear();
  for (const std::uint32_t t : star_) {
    enough = std::min(enough, complex_.quality_of(t));
    sides_.push_back(side_opposite(complex_, t, vertex));
  }
  const auto comes_nearer = [&](const Point& to) {
    double after = 0;
    for (const std::uint32_t v : neighbours_) {
      const double deviation = deviation_of(guard_.ratio(to, complex_.point(v)));
      after += deviation * deviation * deviation * deviation;
    }
    return after < before;
  };
  double share = 1 / weights;
  for (int h = 0; h <= kShorterSteps; ++h, share /= 2) {
    const Point to = from + share * pull;
    if (comes_nearer(to) && lowest_quality(to, sides_, enough) > enough)
      return complex_.move_point(vertex, to, star_);
  }
  return false;
}

}  // namespace voxtet::tetra
