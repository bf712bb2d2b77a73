#include "walls/find_cavities.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/grid/distance_transform.h"
#include "geometry/topology/label_components.h"

namespace voxtet::wall {
namespace {

constexpr double kLeastShare = 0.1;  ///< of the largest cavity
constexpr int kBlocks = 48;          ///< along the longest axis, for the search

/// Cells on planes across a direction: `frame` has the direction as its last row and maps mm from `low` to
/// cells.
struct Planes {
  Eigen::Matrix3d frame;
  Eigen::Vector3d low;
  std::array<int, 3> size{};

  std::size_t count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  std::size_t cell_of(const Eigen::Vector3d& mm) const {
    const Eigen::Vector3d place = frame * (mm - low);
    std::size_t at = 0;
    for (int d = 2; d >= 0; --d) {
      const int n = size[static_cast<std::size_t>(d)];
      at = at * static_cast<std::size_t>(n) +
           static_cast<std::size_t>(std::clamp(static_cast<int>(place[d] + 0.5), 0, n - 1));
    }
    return at;
  }
};

/// Planes `step_mm` apart, of cells as wide, around the points; one free cell around them in each plane.
Planes planes_across(const Eigen::Vector3d& direction, const std::vector<Eigen::Vector3d>& points,
                     double step_mm) {
  Planes planes;
  const Eigen::Vector3d w = direction.normalized(), u = w.unitOrthogonal();
  planes.frame.row(0) = u;
  planes.frame.row(1) = w.cross(u);
  planes.frame.row(2) = w;
  Eigen::Vector3d low = planes.frame * points.front(), high = low;
  for (const Eigen::Vector3d& p : points) {
    low = low.cwiseMin(planes.frame * p);
    high = high.cwiseMax(planes.frame * p);
  }
  for (int d = 0; d < 3; ++d) {
    low[d] -= 2 * step_mm;
    planes.size[static_cast<std::size_t>(d)] = static_cast<int>(std::ceil((high[d] - low[d]) / step_mm)) + 3;
  }
  planes.low = planes.frame.transpose() * low;
  planes.frame /= step_mm;
  return planes;
}

enum Cell : std::uint8_t { kHole = 0, kSolid = 1, kOpen = 2 };

/// Floods each plane from its border: what stays kHole is enclosed by kSolid cells of its plane.
void flood_planes(const Planes& planes, std::vector<std::uint8_t>& cells) {
  const std::size_t nx = static_cast<std::size_t>(planes.size[0]),
                    ny = static_cast<std::size_t>(planes.size[1]);
  std::vector<std::size_t> front;
  for (std::size_t plane = 0; plane < cells.size(); plane += nx * ny) {
    front = {plane};
    cells[plane] = kOpen;
    while (!front.empty()) {
      const std::size_t at = front.back();
      front.pop_back();
      const std::size_t i = (at - plane) % nx, j = (at - plane) / nx;
      const auto visit = [&](std::size_t other) {
        if (cells[other] != kHole) return;
        cells[other] = kOpen;
        front.push_back(other);
      };
      if (i > 0) visit(at - 1);
      if (i + 1 < nx) visit(at + 1);
      if (j > 0) visit(at - nx);
      if (j + 1 < ny) visit(at + nx);
    }
  }
}

/// The centres (mm) of blocks of voxels that hold some of the wall.
std::vector<Eigen::Vector3d> wall_blocks(const WallGrid& grid, int voxels) {
  std::array<std::size_t, 3> size{};
  for (std::size_t d = 0; d < 3; ++d)
    size[d] = static_cast<std::size_t>((grid.size[d] + voxels - 1) / voxels);
  std::vector<std::uint8_t> held(size[0] * size[1] * size[2], 0);
  grid.visit([&](int i, int j, int k, std::size_t at) {
    if (grid.kind[at] == kWall)
      held[static_cast<std::size_t>(i / voxels) +
           size[0] *
               (static_cast<std::size_t>(j / voxels) + size[1] * static_cast<std::size_t>(k / voxels))] = 1;
  });
  std::vector<Eigen::Vector3d> centres;
  for (std::size_t b = 0; b < held.size(); ++b) {
    if (!held[b]) continue;
    const Eigen::Vector3d block(static_cast<double>(b % size[0]), static_cast<double>(b / size[0] % size[1]),
                                static_cast<double>(b / (size[0] * size[1])));
    centres.push_back(grid.to_mm((block * voxels).array() + (voxels - 1) / 2.0));
  }
  return centres;
}

/// The direction across whose planes the blocks enclose most.
Eigen::Vector3d direction_of_cup(const std::vector<Eigen::Vector3d>& blocks, double block_mm) {
  const auto enclosed = [&](const Eigen::Vector3d& direction) {
    // Cells wider than a block's diagonal leave no gaps between blocks.
    const Planes planes = planes_across(direction, blocks, 1.75 * block_mm);
    std::vector<std::uint8_t> cells(planes.count(), kHole);
    for (const Eigen::Vector3d& p : blocks) cells[planes.cell_of(p)] = kSolid;
    flood_planes(planes, cells);
    return std::count(cells.begin(), cells.end(), static_cast<std::uint8_t>(kHole));
  };
  Eigen::Vector3d best = Eigen::Vector3d::UnitZ();
  std::ptrdiff_t most = enclosed(best);
  const auto attempt = [&](const Eigen::Vector3d& direction) {
    const std::ptrdiff_t found = enclosed(direction);
    if (found <= most) return false;
    most = found;
    best = direction.normalized();
    return true;
  };
  for (int c = 0; c <= 2; ++c)
    for (int b = -2; b <= 2; ++b)
      for (int a = -2; a <= 2; ++a)
        if (std::gcd(std::gcd(a, b), c) == 1) attempt({1.0 * a, 1.0 * b, 1.0 * c});
  for (double step = 0.2; step > 0.02; step /= 2) {
    const Eigen::Vector3d middle = best, u = middle.unitOrthogonal(), v = middle.cross(u);
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a)
        if (a != 0 || b != 0) attempt(middle + step * (a * u + b * v));
  }
  return best;
}

/// 1 for the outer voxels that lie in holes of the planes across a direction.
std::vector<Label> holes_across(const WallGrid& grid, const Eigen::Vector3d& direction) {
  std::vector<Eigen::Vector3d> corners;
  for (int corner = 0; corner < 8; ++corner)
    corners.push_back(grid.to_mm({corner & 1 ? grid.size[0] - 1.0 : 0, corner & 2 ? grid.size[1] - 1.0 : 0,
                                  corner & 4 ? grid.size[2] - 1.0 : 0}));
  const Planes planes = planes_across(direction, corners, grid.spacing_mm().minCoeff());
  std::vector<std::uint8_t> cells(planes.count(), kHole);
  const Eigen::Matrix3d to_index = grid.linear().inverse(), to_mm = planes.frame.inverse();
  const Eigen::Vector3d origin = grid.origin();
  std::size_t at = 0;
  for (int k = 0; k < planes.size[2]; ++k)
    for (int j = 0; j < planes.size[1]; ++j)
      for (int i = 0; i < planes.size[0]; ++i, ++at) {
        const Eigen::Vector3d index = to_index * (planes.low + to_mm * Eigen::Vector3d(i, j, k) - origin);
        std::array<int, 3> voxel{};
        bool inside = true;
        for (int d = 0; d < 3; ++d) {
          voxel[static_cast<std::size_t>(d)] = static_cast<int>(std::floor(index[d] + 0.5));
          inside = inside && index[d] > -0.5 && voxel[static_cast<std::size_t>(d)] < grid.size[d];
        }
        if (inside && grid.kind[grid.offset(voxel[0], voxel[1], voxel[2])] == kWall) cells[at] = kSolid;
      }
  flood_planes(planes, cells);

  // A voxel at the wall may fall into a solid cell, which tells nothing: it goes with a neighbour that is a
  // hole.
  std::vector<Label> hole(grid.kind.size(), 0);
  std::vector<std::size_t> undecided, joined;
  grid.visit([&](int i, int j, int k, std::size_t voxel) {
    if (grid.kind[voxel] != kOuter) return;
    const std::uint8_t cell = cells[planes.cell_of(grid.to_mm(i, j, k))];
    if (cell == kHole) hole[voxel] = 1;
    if (cell == kSolid) undecided.push_back(voxel);
  });
  for (const std::size_t voxel : undecided)
    for_face_neighbours(grid.size, voxel, [&](std::size_t other, std::size_t) {
      if (hole[other] && (joined.empty() || joined.back() != voxel)) joined.push_back(voxel);
    });
  for (const std::size_t voxel : joined) hole[voxel] = 1;
  return hole;
}

/// The connected parts of the voxels with a 1 that are large enough, `most` at the most, from 1 on in the
/// order of their size; 0 elsewhere.
std::vector<Label> large_parts(const std::array<int, 3>& size, const std::vector<Label>& hole,
                               std::size_t most, std::size_t& count) {
  std::vector<std::uint32_t> sizes;
  std::vector<std::uint32_t> part = label_components(size, hole, sizes);
  std::vector<std::uint8_t> is_hole(sizes.size(), 0);
  for (std::size_t at = 0; at < part.size(); ++at) is_hole[part[at]] = hole[at] != 0;
  std::vector<std::uint32_t> order;
  for (std::uint32_t p = 0; p < sizes.size(); ++p)
    if (is_hole[p]) order.push_back(p);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return sizes[a] > sizes[b]; });
  count = 0;
  while (count < std::min(order.size(), most) && sizes[order[count]] >= kLeastShare * sizes[order[0]])
    ++count;
  std::vector<Label> number(sizes.size(), 0), out(part.size());
  for (std::size_t n = 0; n < count; ++n) number[order[n]] = static_cast<Label>(n + 1);
  for (std::size_t at = 0; at < part.size(); ++at) out[at] = number[part[at]];
  return out;
}

/// Gives the voxels of `hole` without a number that of the nearest numbered one, from face to face.
void grow_parts(const std::array<int, 3>& size, const std::vector<Label>& hole, std::vector<Label>& part) {
  std::vector<std::size_t> front, next;
  for (std::size_t at = 0; at < part.size(); ++at)
    if (part[at]) front.push_back(at);
  for (; !front.empty(); front.swap(next)) {
    next.clear();
    for (const std::size_t at : front)
      for_face_neighbours(size, at, [&](std::size_t other, std::size_t) {
        if (!hole[other] || part[other]) return;
        part[other] = part[at];
        next.push_back(other);
      });
  }
}

/// Makes inner spaces of the large parts of `hole`. Two that only a neck joins, such as ventricles below a
/// septum that ends early, are parted there: at the least distance from the wall at which they fall apart.
std::size_t take_spaces(const std::vector<Label>& hole, WallGrid& grid) {
  std::size_t count = 0;
  std::vector<Label> part = large_parts(grid.size, hole, kMaxInner, count);
  if (count == 1) {
    std::vector<std::uint8_t> other(hole.size());
    for (std::size_t at = 0; at < hole.size(); ++at) other[at] = !hole[at];
    const std::vector<float> depth = distance_to_mask_mm(grid.size, grid.spacing_mm(), other);
    const float deepest = *std::max_element(depth.begin(), depth.end());
    std::vector<Label> core(hole.size());
    for (int tenth = 2; tenth <= 6 && count == 1; ++tenth) {
      for (std::size_t at = 0; at < hole.size(); ++at)
        core[at] = depth[at] > deepest * static_cast<float>(tenth) / 10 ? 1 : 0;
      part = large_parts(grid.size, core, 2, count);
    }
    if (count == 1) part = large_parts(grid.size, hole, kMaxInner, count);
  }
  grow_parts(grid.size, hole, part);
  for (std::size_t at = 0; at < part.size(); ++at)
    if (part[at]) grid.kind[at] = static_cast<std::uint8_t>(kInner + part[at] - 1);
  return count;
}

/// 1 for the outer voxels from which no way leads to the grid's border.
std::vector<Label> enclosed_voxels(const WallGrid& grid) {
  std::vector<Label> solid(grid.kind.size());
  for (std::size_t at = 0; at < solid.size(); ++at) solid[at] = grid.kind[at] == kWall ? 0 : 1;
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> part = label_components(grid.size, solid, sizes);
  std::vector<std::uint8_t> open(sizes.size(), 0);
  grid.visit([&](int i, int j, int k, std::size_t at) {
    if (grid.on_border(i, j, k)) open[part[at]] = 1;
  });
  for (std::size_t at = 0; at < solid.size(); ++at) solid[at] = solid[at] && !open[part[at]] ? 1 : 0;
  return solid;
}

}  // namespace

std::size_t find_cavities(WallGrid& grid) {
  if (const std::size_t count = take_spaces(enclosed_voxels(grid), grid); count > 0) return count;
  const int voxels =
      std::max(1, (std::max({grid.size[0], grid.size[1], grid.size[2]}) + kBlocks - 1) / kBlocks);
  const Eigen::Vector3d direction =
      direction_of_cup(wall_blocks(grid, voxels), voxels * grid.spacing_mm().maxCoeff());
  return take_spaces(holes_across(grid, direction), grid);
}

}  // namespace voxtet::wall
