#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>

#include "surface/extract/cell_tables.h"
#include "surface/extract/extract_methods.h"
#include "surface/extract/march_slabs.h"

namespace voxtet {
namespace {

class CubeMarcher {
 public:
  CubeMarcher(const LabelVolume& volume, Label label, SurfaceMesh& out)
      : linear_(volume.linear()),
        first_mm_(volume.to_mm(Eigen::Vector3d::Constant(-1))),
        mirrored_(linear_.determinant() < 0),
        sides_{label, kBackground},
        ids_(volume, 4),
        out_(out) {}

  void operator()(int x, int y, int z, const std::array<Label, 8>& corners) {
    unsigned mask = 0;
    for (unsigned c = 0; c < 8; ++c) mask |= static_cast<unsigned>(corners[c]) << c;
    std::array<std::uint32_t*, 8> slots{};
    for (unsigned c = 1; c < 8; ++c) slots[c] = ids_.at(x, y, z, c);
    for (const unsigned direction : {1U, 2U, 4U})
      if (corners[7] != corners[7 ^ direction])
        slots[7][direction_slot(direction)] = add_point(x, y, z, direction);
    for (const auto& triangle : table_.triangles(mask)) {
      Triangle t{};
      for (std::size_t i = 0; i < 3; ++i) {
        const CellEdge& edge = CubeTable::kEdges[triangle[i]];
        t[i] = slots[edge.top][direction_slot(edge.direction)];
      }
      if (mirrored_) std::swap(t[1], t[2]);
      out_.triangles.push_back(t);
      out_.sides.push_back(sides_);
    }
  }

 private:
  static std::size_t direction_slot(unsigned direction) { return direction >> 1; }

  std::uint32_t add_point(int x, int y, int z, unsigned direction) {
    Eigen::Vector3d index(x + 1, y + 1, z + 1);
    index[static_cast<Eigen::Index>(direction_slot(direction))] -= 0.5;
    out_.points.emplace_back(linear_ * index + first_mm_);
    return static_cast<std::uint32_t>(out_.points.size() - 1);
  }

  const CubeTable& table_ = cube_table();
  Eigen::Matrix3d linear_;
  Eigen::Vector3d first_mm_;
  bool mirrored_;
  Sides sides_;
  PlaneIds ids_;
  SurfaceMesh& out_;
};

}  // namespace

Result<SurfaceMesh> extract_marching_cubes(const LabelVolume& volume, Label label, RunContext& ctx) {
  return march_slabs(volume, true, ctx, [&](SurfaceMesh& out) { return CubeMarcher(volume, label, out); });
}

}  // namespace voxtet
