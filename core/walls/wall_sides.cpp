#include "walls/wall_sides.h"

#include <Eigen/LU>
#include <cmath>

#include "base/parallel.h"

namespace voxtet::wall {
namespace {

constexpr std::size_t kFewestFaces = 30;
constexpr double kBelow = 0.25, kAbove = 2;  ///< voxels

/// Which of its 26 neighbours a voxel has: all but those beyond the grid.
template <class Visit>
void for_neighbours(const WallGrid& grid, std::size_t at, Visit&& visit) {
  const auto nx = static_cast<std::size_t>(grid.size[0]), ny = static_cast<std::size_t>(grid.size[1]);
  const int i = static_cast<int>(at % nx), j = static_cast<int>(at / nx % ny),
            k = static_cast<int>(at / (nx * ny));
  for (int z = std::max(k - 1, 0); z < std::min(k + 2, grid.size[2]); ++z)
    for (int y = std::max(j - 1, 0); y < std::min(j + 2, grid.size[1]); ++y)
      for (int x = std::max(i - 1, 0); x < std::min(i + 2, grid.size[0]); ++x)
        if (x != i || y != j || z != k) visit(grid.offset(x, y, z));
}

/// Outer voxels joined to one another that an inner space touches.
struct Opening {
  std::vector<std::size_t> voxels;
  std::size_t faces = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();  ///< mm; outwards
  double voxel = 1;  ///< extent of a voxel along the normal, mm
};

class Openings {
 public:
  explicit Openings(WallGrid& grid) : grid_(grid), stride_(grid.strides()), seen_(grid.kind.size(), 0) {
    const Eigen::Matrix3d linear = grid.linear();
    area_ = std::abs(linear.determinant()) * linear.inverse().transpose();
  }

  std::vector<Opening> find() {
    std::vector<Opening> found;
    for_indices(0, grid_.kind.size(), [&](std::size_t at) {
      if (seen_[at] || !touches_inner(at)) return;
      Opening opening = collect(at);
      if (opening.faces >= kFewestFaces && finish(opening)) found.push_back(std::move(opening));
    });
    return found;
  }

  void mark_rim(const Opening& opening) {
    std::vector<std::size_t> front = opening.voxels;
    std::vector<std::uint8_t> visited(grid_.kind.size(), 0);
    for (const std::size_t at : front) visited[at] = 1;
    for (std::size_t next = 0; next < front.size(); ++next)
      for_neighbours(grid_, front[next], [&](std::size_t at) {
        if (visited[at] || (grid_.kind[at] != kOuter && grid_.kind[at] != kSide)) return;
        const double height = (mm_of(at) - opening.centre).dot(opening.normal) / opening.voxel;
        if (height < -kBelow || height > kAbove || !touches_wall(at)) return;
        visited[at] = 1;
        front.push_back(at);
      });
    for (const std::size_t at : front) grid_.kind[at] = kSide;
  }

 private:
  template <class Test>
  bool any_face_neighbour(std::size_t at, Test&& test) const {
    // A voxel's place along an axis takes a division: it is asked last, as the test nearly always fails.
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t step = stride_[d], end = static_cast<std::size_t>(grid_.size[d]);
      if (at >= step && test(grid_.kind[at - step]) && at / step % end > 0) return true;
      if (at + step < grid_.kind.size() && test(grid_.kind[at + step]) && at / step % end + 1 < end)
        return true;
    }
    return false;
  }
  bool touches_inner(std::size_t at) const {
    return grid_.kind[at] == kOuter &&
           any_face_neighbour(at, [](std::uint8_t kind) { return kind >= kInner; });
  }
  bool touches_wall(std::size_t at) const {
    bool found = false;
    for_neighbours(grid_, at, [&](std::size_t other) { found = found || grid_.kind[other] == kWall; });
    return found;
  }
  Eigen::Vector3d mm_of(std::size_t at) const {
    const std::size_t nx = stride_[1], ny = static_cast<std::size_t>(grid_.size[1]);
    return grid_.to_mm({static_cast<double>(at % nx), static_cast<double>(at / nx % ny),
                        static_cast<double>(at / stride_[2])});
  }

  Opening collect(std::size_t start) {
    Opening opening;
    opening.voxels = {start};
    seen_[start] = 1;
    for (std::size_t next = 0; next < opening.voxels.size(); ++next) {
      const std::size_t at = opening.voxels[next];
      add_faces(at, opening);
      for_neighbours(grid_, at, [&](std::size_t other) {
        if (seen_[other] || !touches_inner(other)) return;
        seen_[other] = 1;
        opening.voxels.push_back(other);
      });
    }
    return opening;
  }

  void add_faces(std::size_t at, Opening& opening) const {
    const Eigen::Vector3d here = mm_of(at);
    for (std::size_t d = 0; d < 3; ++d)
      for (const int direction : {-1, 1}) {
        const std::size_t place = at / stride_[d] % static_cast<std::size_t>(grid_.size[d]);
        if (direction < 0 ? place == 0 : place + 1 == static_cast<std::size_t>(grid_.size[d])) continue;
        const std::size_t other = direction < 0 ? at - stride_[d] : at + stride_[d];
        if (grid_.kind[other] < kInner) continue;
        const auto axis = static_cast<int>(d);
        opening.faces += 1;
        opening.normal -= direction * area_.col(axis);
        opening.centre += here + 0.5 * direction * grid_.linear().col(axis);
      }
  }

  /// False where the faces look into all directions, so that there is no plane.
  bool finish(Opening& opening) const {
    const double area = opening.normal.norm();
    if (!(area > 0)) return false;
    opening.centre /= static_cast<double>(opening.faces);
    opening.normal /= area;
    opening.voxel = (grid_.linear().transpose() * opening.normal).norm();
    return true;
  }

  WallGrid& grid_;
  std::array<std::size_t, 3> stride_;
  Eigen::Matrix3d area_;  ///< columns: normals of the voxel's faces, as long as their area
  std::vector<std::uint8_t> seen_;
};

}  // namespace

int mark_base(WallGrid& grid) {
  Openings openings(grid);
  const std::vector<Opening> found = openings.find();
  for (const Opening& opening : found) openings.mark_rim(opening);
  return static_cast<int>(found.size());
}

}  // namespace voxtet::wall
