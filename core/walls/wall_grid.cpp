#include "walls/wall_grid.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>

#include "base/parallel.h"
#include "geometry/grid/distance_transform.h"
#include "geometry/search/closest_point.h"

namespace voxtet::wall {
namespace {

constexpr int kPadding = 2;
constexpr std::uint8_t kJoins = 255;     // a voxel that is about to join the wall
constexpr double kReach = 1.05;          // voxels around a triangle that learn of it
constexpr double kLeastVoxels = 0.01;    // no distance is smaller, so that nothing is divided by zero
constexpr double kTypicalVoxels = 0.37;  // of a voxel beside the surface, where the surface is not known

/// The kinds of labels; kOuter unless listed.
std::vector<std::uint8_t> kinds_of_labels(const std::vector<Label>& wall, const std::vector<Label>& inner) {
  std::vector<std::uint8_t> kinds(65536, kOuter);
  for (std::size_t i = 0; i < inner.size(); ++i) kinds[inner[i]] = static_cast<std::uint8_t>(kInner + i);
  for (const Label label : wall) kinds[label] = kWall;
  return kinds;
}

/// Per voxel whether the wall begins or ends within `steps` steps from face to face.
std::vector<std::uint8_t> near_surface(const WallGrid& grid, int steps) {
  std::vector<std::uint8_t> near(grid.kind.size(), 0);
  const std::array<std::size_t, 3> stride = grid.strides();
  for (std::size_t d = 0; d < 3; ++d)
    for_indices(0, grid.kind.size() - stride[d], [&](std::size_t at) {
      if ((grid.kind[at] == kWall) != (grid.kind[at + stride[d]] == kWall))
        near[at] = near[at + stride[d]] = 1;
    });
  for (int step = 1; step < steps; ++step) {
    const std::vector<std::uint8_t> before = near;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t at = 0; at + stride[d] < near.size(); ++at)
        if (before[at] != before[at + stride[d]]) near[at] = near[at + stride[d]] = 1;
  }
  return near;
}

/// The nearest triangle met so far, seen from a voxel centre.
struct Nearest {
  float distance = kFar;
  float cosine = 0;  ///< between the normal and the way to the centre: the larger one decides on a tie
};

/// Scatters triangles onto the voxels of the layers [first, last) around them. Lengths are taken along the
/// axes of the grid, which are orthogonal.
class Scatter {
 public:
  Scatter(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles,
          const WallGrid& grid, const std::vector<std::uint8_t>& wanted)
      : triangles_(triangles),
        grid_(grid),
        wanted_(wanted),
        spacing_(grid.spacing_mm()),
        per_mm_(spacing_.cwiseInverse()) {
    const Eigen::Matrix3d along = spacing_.asDiagonal() * grid.linear().inverse();
    const Eigen::Vector3d origin = grid.index_to_mm.topRightCorner<3, 1>();
    points_.reserve(points.size());
    for (const Eigen::Vector3d& p : points) points_.emplace_back(along * (p - origin));
    mirrored_ = along.determinant() < 0;
  }

  void run(int first, int last, std::vector<Nearest>& nearest) const {
    in_stretches(0, triangles_.size(), [&](std::size_t begin, std::size_t end) {
      run(std::span(triangles_).subspan(begin, end - begin), first, last, nearest);
    });
  }

 private:
  static constexpr float kRounded = 1 + 1e-3F;  ///< more than what single precision takes away

  void run(std::span<const Triangle> triangles, int first, int last, std::vector<Nearest>& nearest) const {
    const Eigen::Vector3f spacing = spacing_.cast<float>();
    for (const Triangle& t : triangles) {
      const Eigen::Vector3d &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
      const Eigen::Vector3d lowest = a.cwiseMin(b).cwiseMin(c).cwiseProduct(per_mm_),
                            highest = a.cwiseMax(b).cwiseMax(c).cwiseProduct(per_mm_);
      std::array<int, 3> low{}, high{};
      for (std::size_t d = 0; d < 3; ++d) {
        const int end = d == 2 ? last : grid_.size[d], begin = d == 2 ? first : 0;
        low[d] = std::max(begin, first_from(lowest[static_cast<int>(d)] - kReach));
        high[d] = std::min(end, first_from(highest[static_cast<int>(d)] + kReach));
      }
      if (low[2] >= high[2]) continue;
      Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
      if (mirrored_) normal = -normal;
      const Eigen::Vector3d middle = (a + b + c) / 3;
      const auto radius = static_cast<float>(std::sqrt(
          std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm()})));
      const Eigen::Vector3f at = middle.cast<float>();
      for (int k = low[2]; k < high[2]; ++k)
        for (int j = low[1]; j < high[1]; ++j) {
          const std::size_t row = grid_.offset(0, j, k);
          const float y = static_cast<float>(j) * spacing[1] - at[1];
          const float z = static_cast<float>(k) * spacing[2] - at[2], aside = y * y + z * z;
          for (int i = low[0]; i < high[0]; ++i) {
            if (!wanted_[row + static_cast<std::size_t>(i)]) continue;
            Nearest& here = nearest[row + static_cast<std::size_t>(i)];
            const float x = static_cast<float>(i) * spacing[0] - at[0];
            const float within = (radius + here.distance) * kRounded;
            if (x * x + aside > within * within) continue;
            const Eigen::Vector3d centre(i * spacing_[0], j * spacing_[1], k * spacing_[2]);
            const double height = normal.dot(centre - a);
            if (height * height > squared(here.distance) * (1 + 1e-6)) continue;
            take(centre - closest_on_triangle(centre, a, b, c), normal, here);
          }
        }
    }
  }

  static double squared(double distance) { return distance * distance; }

  /// The first whole number from there on; std::ceil is a call on plain x86-64.
  static int first_from(double place) {
    const int whole = static_cast<int>(place);
    return whole + (place > whole ? 1 : 0);
  }

  static void take(const Eigen::Vector3d& to_centre, const Eigen::Vector3d& normal, Nearest& nearest) {
    const double found = to_centre.squaredNorm(), known = squared(nearest.distance);
    if (found > known * (1 + 1e-6)) return;
    const double length = std::sqrt(found);
    const auto cosine = static_cast<float>(length > 0 ? to_centre.dot(normal) / length : 0);
    // The triangles at a common edge or corner are equally near; the one seen least edge-on knows the side.
    const bool tie = found > known * (1 - 1e-6);
    if (tie && std::abs(cosine) <= std::abs(nearest.cosine)) return;
    nearest = {static_cast<float>(length), cosine};
  }

  std::vector<Eigen::Vector3d> points_;  ///< along the axes of the grid, mm
  const std::vector<Triangle>& triangles_;
  const WallGrid& grid_;
  const std::vector<std::uint8_t>& wanted_;
  Eigen::Vector3d spacing_, per_mm_;
  bool mirrored_ = false;
};

/// Gives voxels that left the wall the kind of a neighbour outside of it, those beside such voxels first.
void settle_leavers(const std::vector<std::size_t>& leavers, std::vector<std::uint8_t>& kind,
                    const std::array<std::size_t, 3>& stride) {
  bool changed = true;
  while (changed) {
    changed = false;
    for (const std::size_t at : leavers) {
      if (kind[at] != kWall) continue;
      for (const std::size_t step : stride)
        for (const std::size_t neighbour : {at - step, at + step})
          if (kind[at] == kWall && kind[neighbour] != kWall && kind[neighbour] != kJoins)
            kind[at] = kind[neighbour], changed = true;
    }
  }
}

}  // namespace

WallGrid wall_grid(const LabelVolume& anatomy, const std::vector<Label>& wall,
                   const std::vector<Label>& inner) {
  const std::vector<std::uint8_t> kinds = kinds_of_labels(wall, inner);
  std::array<int, 3> low = anatomy.size, high{-1, -1, -1};
  anatomy.visit([&](int i, int j, int k, std::size_t at) {
    if (kinds[anatomy.labels[at]] != kWall) return;
    const std::array<int, 3> voxel{i, j, k};
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], voxel[d]);
      high[d] = std::max(high[d], voxel[d]);
    }
  });
  WallGrid grid;
  Eigen::Vector3d first;
  for (std::size_t d = 0; d < 3; ++d) {
    grid.size[d] = high[d] - low[d] + 1 + 2 * kPadding;
    first[static_cast<int>(d)] = low[d] - kPadding;
  }
  grid.index_to_mm = anatomy.index_to_mm;
  grid.index_to_mm.topRightCorner<3, 1>() = anatomy.to_mm(first);
  grid.kind.reserve(grid.voxel_count());
  for (int k = low[2] - kPadding; k <= high[2] + kPadding; ++k)
    for (int j = low[1] - kPadding; j <= high[1] + kPadding; ++j)
      for (int i = low[0] - kPadding; i <= high[0] + kPadding; ++i)
        grid.kind.push_back(anatomy.contains(i, j, k) ? kinds[anatomy.at(i, j, k)]
                                                      : static_cast<std::uint8_t>(kSide));
  return grid;
}

WallGrid refined(const WallGrid& grid, int factor) {
  WallGrid fine;
  for (std::size_t d = 0; d < 3; ++d) fine.size[d] = grid.size[d] * factor;
  fine.index_to_mm.topLeftCorner<3, 3>() = grid.linear() / factor;
  fine.index_to_mm.topRightCorner<3, 1>() = grid.to_mm(Eigen::Vector3d::Constant(0.5 / factor - 0.5));
  fine.kind.resize(fine.voxel_count());
  fine.visit([&](int i, int j, int k, std::size_t at) {
    fine.kind[at] = grid.kind[grid.offset(i / factor, j / factor, k / factor)];
  });
  return fine;
}

void measure_distances(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles,
                       int steps, int threads, WallGrid& grid) {
  const float voxel = static_cast<float>(grid.spacing_mm().minCoeff());
  const std::vector<std::uint8_t> wanted = near_surface(grid, steps);
  std::vector<Nearest> nearest(grid.kind.size());
  const Scatter scatter(points, triangles, grid, wanted);
  parallel_for(threads, static_cast<std::size_t>(grid.size[2]), [&](std::size_t first, std::size_t last) {
    scatter.run(static_cast<int>(first), static_cast<int>(last), nearest);
  });
  grid.distance_mm.assign(grid.kind.size(), static_cast<float>(kTypicalVoxels) * voxel);
  std::vector<std::size_t> leavers;
  for_indices(0, grid.kind.size(), [&](std::size_t at) {
    if (nearest[at].distance == kFar) return;
    grid.distance_mm[at] = std::max(nearest[at].distance, static_cast<float>(kLeastVoxels) * voxel);
    const bool in_wall = nearest[at].cosine < 0;
    if (in_wall && grid.kind[at] != kWall && grid.kind[at] != kSide) grid.kind[at] = kJoins;
    if (!in_wall && grid.kind[at] == kWall) leavers.push_back(at);
  });
  settle_leavers(leavers, grid.kind, grid.strides());
  std::replace(grid.kind.begin(), grid.kind.end(), static_cast<std::uint8_t>(kJoins),
               static_cast<std::uint8_t>(kWall));
}

}  // namespace voxtet::wall
