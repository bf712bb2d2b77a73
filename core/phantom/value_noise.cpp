#include "phantom/value_noise.h"

#include <array>
#include <cmath>

namespace voxtet {
namespace {

std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

double lattice_value(const std::array<std::int32_t, 3>& at, std::uint32_t seed) {
  std::uint32_t h = mix(seed + 0x9e3779b9U);
  for (const std::int32_t c : at) h = mix(h ^ (static_cast<std::uint32_t>(c) + 0x9e3779b9U));
  return h / 4294967295.0;
}

}  // namespace

double value_noise(const Eigen::Vector3d& point, std::uint32_t seed) {
  std::array<std::int32_t, 3> base{};
  std::array<double, 3> blend{};
  for (int d = 0; d < 3; ++d) {
    const double floor = std::floor(point[d]);
    const double t = point[d] - floor;
    base[d] = static_cast<std::int32_t>(floor);
    blend[d] = t * t * t * (t * (t * 6 - 15) + 10);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<std::int32_t, 3> at = base;
    for (int d = 0; d < 3; ++d) {
      const bool up = (corner >> d) & 1;
      weight *= up ? blend[d] : 1 - blend[d];
      at[d] += up;
    }
    sum += weight * lattice_value(at, seed);
  }
  return sum;
}

}  // namespace voxtet
