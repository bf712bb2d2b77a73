#include "anatomy/wall_surface.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/buckets.h"
#include "geometry/elements/surface_measures.h"

namespace voxtet::anatomy {
namespace {

std::vector<WallFace> wall_faces(const TetMesh& mesh, const std::vector<bool>& is_wall) {
  std::vector<WallFace> faces;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [behind, front] = mesh.face_sides[f];
    if (is_wall[behind] == is_wall[front]) continue;
    Triangle corners = mesh.faces[f];
    if (is_wall[front]) std::swap(corners[1], corners[2]);
    const auto& [a, b, c] = corners;
    const Eigen::Vector3d &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    const Eigen::Vector3d cross = triangle_cross(p, q, r);
    faces.push_back({f, corners, (p + q + r) / 3, cross.normalized(), cross.norm() / 2});
  }
  return faces;
}

}  // namespace

WallSurface wall_surface(const TetMesh& mesh, const std::vector<bool>& is_wall) {
  struct Side {
    std::uint32_t high, face;
  };
  WallSurface surface{wall_faces(mesh, is_wall), {}};
  const auto for_sides = [&](auto&& visit) {
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const Triangle& corners = surface.faces[f].corners;
        const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
        visit(low, Side{high, f});
      }
  };
  Buckets<Side> sides(mesh.points.size());
  for_sides([&](std::uint32_t low, const Side&) { sides.count(low); });
  sides.allocate();
  for_sides([&](std::uint32_t low, const Side& side) { sides.add(low, side); });
  for (std::uint32_t low = 0; low < sides.size(); ++low) {
    const std::span<Side> here = sides.at(low);
    std::sort(here.begin(), here.end(), [](const Side& a, const Side& b) {
      return a.high != b.high ? a.high < b.high : a.face < b.face;
    });
    for (std::size_t i = 0; i < here.size(); ++i)
      for (std::size_t j = i + 1; j < here.size() && here[j].high == here[i].high; ++j)
        surface.contacts.push_back({here[i].face,
                                    here[j].face,
                                    {low, here[i].high},
                                    (mesh.points[low] - mesh.points[here[i].high]).norm()});
  }
  return surface;
}

}  // namespace voxtet::anatomy
