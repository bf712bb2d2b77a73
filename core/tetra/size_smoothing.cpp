#include "tetra/size_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace voxtet::tetra {
namespace {

/// How far an edge is from its wish, by their ratio: the same above and below, 0 where they are equal. About
/// 1.4 times its log2, without a logarithm, since those of standard libraries differ in their last digit.
double misfit_of(double ratio) {
  return std::abs(ratio - 1 / ratio);
}

constexpr double kMuch = 0.55;  ///< of misfit: a factor of 1.31
constexpr int kShorterSteps = 2;

}  // namespace

/// The lowest of the tets at the vertex, or of those up to the first below the bound.
double SizeSmoother::lowest_quality(std::uint32_t vertex, const Point& at, double bound) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : star_) {
    const std::uint32_t corner = complex_.corner_at(t, vertex);
    const auto& side = kSideCorners[corner];
    const Tet& c = complex_.corners(t);
    lowest = std::min(lowest, quality(at, complex_.point(c[side[0]]), complex_.point(c[side[1]]),
                                      complex_.point(c[side[2]])));
    if (lowest < bound) break;
  }
  return lowest;
}

/// Each edge pulls the vertex to where it would have its length, by the square of its misfit; the sum of the
/// fourth powers is to fall.
bool SizeSmoother::smooth(std::uint32_t vertex, double enough) {
  complex_.find_star(vertex, star_);
  complex_.find_neighbours(vertex, star_, neighbours_);
  const Point from = complex_.point(vertex);
  double before = 0, most = 0, weights = 0;
  Point pull = Point::Zero();
  for (const std::uint32_t v : neighbours_) {
    const Point& other = complex_.point(v);
    const double ratio = guard_.ratio(from, other), misfit = misfit_of(ratio), weight = misfit * misfit;
    most = std::max(most, misfit);
    before += weight * weight;
    weights += weight;
    pull += weight * (1 / ratio - 1) * (from - other);
  }
  if (most < kMuch) return false;
  for (const std::uint32_t t : star_) enough = std::min(enough, complex_.quality_of(t));
  const auto comes_nearer = [&](const Point& to) {
    double after = 0;
    for (const std::uint32_t v : neighbours_) {
      const double misfit = misfit_of(guard_.ratio(to, complex_.point(v)));
      after += misfit * misfit * misfit * misfit;
    }
    return after < before;
  };
  double share = 1 / weights;
  for (int h = 0; h <= kShorterSteps; ++h, share /= 2) {
    const Point to = from + share * pull;
    if (comes_nearer(to) && lowest_quality(vertex, to, enough) >= enough)
      return complex_.move_point(vertex, to, star_);
  }
  return false;
}

}  // namespace voxtet::tetra
