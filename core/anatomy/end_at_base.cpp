#include "anatomy/name_faces.h"
#include "geometry/topology/label_components.h"

namespace voxtet::anatomy {
namespace {

constexpr double kAlignedCosine = 0.9;  ///< of 25 degrees
constexpr int kRounds = 5;
constexpr double kBelow = 0.25;  ///< voxels

struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// The mean plane of the base faces of about its direction; without a normal if there is no base.
Plane base_plane(const WallSurface& surface, const FaceKinds& kinds) {
  Plane plane;
  for (int round = 0; round < kRounds; ++round) {
    const Plane before = plane;
    plane = {};
    double area = 0;
    for (std::size_t f = 0; f < kinds.size(); ++f) {
      const WallFace& face = surface.faces[f];
      if (kinds[f] != wall::kSide || (round > 0 && before.normal.dot(face.normal) < kAlignedCosine)) continue;
      area += face.area_mm2;
      plane.normal += face.area_mm2 * face.normal;
      plane.centre += face.area_mm2 * face.centre;
    }
    if (!(area > 0)) return {};
    plane.normal.normalize();
    plane.centre /= area;
  }
  return plane;
}

}  // namespace

bool end_at_base(const WallSurface& surface, const FaceKinds& kinds, wall::WallGrid& grid) {
  const Plane plane = base_plane(surface, kinds);
  if (!(plane.normal.squaredNorm() > 0)) return false;
  const double margin_mm = kBelow * (grid.linear().transpose() * plane.normal).norm();
  std::vector<std::uint8_t> kind = grid.kind;
  std::vector<bool> below(kind.size());
  std::vector<std::size_t> front;
  grid.visit([&](int i, int j, int k, std::size_t at) {
    below[at] = plane.normal.dot(grid.to_mm(i, j, k) - plane.centre) < -margin_mm;
    if (kind[at] < wall::kInner) return;
    if (below[at])
      front.push_back(at);
    else
      kind[at] = wall::kOuter;
  });
  for (std::size_t next = 0; next < front.size(); ++next) {
    const std::size_t at = front[next];
    int neighbours = 0;
    for_face_neighbours(grid.size, at, [&](std::size_t other, std::size_t) {
      ++neighbours;
      if (kind[other] != wall::kOuter || !below[other]) return;
      kind[other] = kind[at];
      front.push_back(other);
    });
    if (neighbours < 6) return false;  // at the border of the grid: it ran out
  }
  grid.kind = std::move(kind);
  return true;
}

}  // namespace voxtet::anatomy
