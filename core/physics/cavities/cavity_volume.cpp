#include <Eigen/Geometry>

#include "physics/cavities/cavity.h"

namespace voxtet {
namespace {

using Points = std::span<const Eigen::Vector3d>;

/// All coordinates are relative to a point of the cavity: those of a heart may be far from the origin.
const Eigen::Vector3d& origin_of(const Cavity& cavity, Points points) {
  return points[cavity.triangles.front()[0]];
}

Eigen::Vector3d mean_of(const std::vector<std::uint32_t>& rim, Points points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t point : rim) sum += points[point];
  return sum / static_cast<double>(rim.size());
}

/// visit(a, b) for the points of each edge of a ring.
template <class Visit>
void visit_edges(const std::vector<std::uint32_t>& rim, Visit&& visit) {
  for (std::size_t i = 0; i < rim.size(); ++i) visit(rim[i], rim[(i + 1) % rim.size()]);
}

}  // namespace

double volume_mm3(const Cavity& cavity, Points points) {
  const Eigen::Vector3d origin = origin_of(cavity, points);
  const auto at = [&](std::uint32_t point) -> Eigen::Vector3d { return points[point] - origin; };
  double six = 0;
  for (const auto& [a, b, c] : cavity.triangles) six += at(a).dot(at(b).cross(at(c)));
  for (const auto& rim : cavity.rims) {
    const Eigen::Vector3d middle = mean_of(rim, points) - origin;
    visit_edges(rim, [&](std::uint32_t a, std::uint32_t b) { six += middle.dot(at(a).cross(at(b))); });
  }
  return six / 6;
}

void add_volume_gradient(const Cavity& cavity, Points points, double factor,
                         std::span<Eigen::Vector3d> gradient) {
  const Eigen::Vector3d origin = origin_of(cavity, points);
  const auto at = [&](std::uint32_t point) -> Eigen::Vector3d { return points[point] - origin; };
  const double sixth = factor / 6;
  for (const Triangle& triangle : cavity.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      gradient[triangle[k]] += sixth * at(triangle[(k + 1) % 3]).cross(at(triangle[(k + 2) % 3]));
  for (const auto& rim : cavity.rims) {
    const Eigen::Vector3d middle = mean_of(rim, points) - origin;
    Eigen::Vector3d of_middle = Eigen::Vector3d::Zero();
    visit_edges(rim, [&](std::uint32_t a, std::uint32_t b) {
      gradient[a] += sixth * at(b).cross(middle);
      gradient[b] += sixth * middle.cross(at(a));
      of_middle += at(a).cross(at(b));
    });
    for (const std::uint32_t point : rim)
      gradient[point] += sixth / static_cast<double>(rim.size()) * of_middle;
  }
}

void add_volume_gradient_change(const Cavity& cavity, Points points, Points moves, double factor,
                                std::span<Eigen::Vector3d> change) {
  const Eigen::Vector3d origin = origin_of(cavity, points);
  const auto at = [&](std::uint32_t point) -> Eigen::Vector3d { return points[point] - origin; };
  // How the cross product of two places changes as both move.
  const auto cross_change = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& dp,
                               const Eigen::Vector3d& dq) -> Eigen::Vector3d {
    return dp.cross(q) + p.cross(dq);
  };
  const double sixth = factor / 6;
  for (const Triangle& triangle : cavity.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3];
      change[triangle[k]] += sixth * cross_change(at(b), at(c), moves[b], moves[c]);
    }
  for (const auto& rim : cavity.rims) {
    const Eigen::Vector3d middle = mean_of(rim, points) - origin, moved = mean_of(rim, moves);
    Eigen::Vector3d of_middle = Eigen::Vector3d::Zero();
    visit_edges(rim, [&](std::uint32_t a, std::uint32_t b) {
      change[a] += sixth * cross_change(at(b), middle, moves[b], moved);
      change[b] += sixth * cross_change(middle, at(a), moved, moves[a]);
      of_middle += cross_change(at(a), at(b), moves[a], moves[b]);
    });
    for (const std::uint32_t point : rim)
      change[point] += sixth / static_cast<double>(rim.size()) * of_middle;
  }
}

}  // namespace voxtet
