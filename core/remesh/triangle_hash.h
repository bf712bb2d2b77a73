// Which triangles may be near a box: cells of a grid, hashed into buckets.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "remesh/complex_mesh.h"

namespace voxtet::remesh {

/// Rounded outwards to floats.
struct FloatBox {
  std::array<float, 3> low, high;
  bool meets(const FloatBox& o) const {
    return low[0] <= o.high[0] && o.low[0] <= high[0] && low[1] <= o.high[1] && o.low[1] <= high[1] &&
           low[2] <= o.high[2] && o.low[2] <= high[2];
  }
  void extend(const FloatBox& o);
};
FloatBox box_of(const Corners& t, double margin = 0);

/// Teschner et al., "Optimized spatial hashing for collision detection of deformable objects", 2003.
/// Triangles stand in every cell their box meets.
class TriangleHash {
 public:
  TriangleHash(const ComplexMesh& mesh, double cell_mm);

  void insert(std::uint32_t t, const Corners& corners);
  void erase(std::uint32_t t);
  void move(std::uint32_t t, const Corners& corners);
  const FloatBox& box(std::uint32_t t) const { return boxes_[t]; }
  /// Every triangle whose box meets `box`, each once, in an order that depends on the edits alone.
  void find(const FloatBox& box, std::vector<std::uint32_t>& out);

 private:
  struct Cells {
    std::array<int, 3> low, high;
    bool operator==(const Cells&) const = default;
  };
  struct Node {
    std::uint32_t triangle, next;
  };
  Cells cells_of(const FloatBox& box) const;
  std::uint32_t bucket(int i, int j, int k) const;
  template <class Visit>
  void for_buckets(const Cells& cells, Visit&& visit);

  double cells_per_mm_;
  std::uint32_t mask_ = 0, free_ = kNone;
  std::vector<std::uint32_t> heads_;
  std::vector<Node> nodes_;
  std::vector<FloatBox> boxes_;         ///< by triangle
  std::vector<std::uint32_t> visited_;  ///< by triangle: the search that met it last
  std::uint32_t search_ = 0;
};

}  // namespace voxtet::remesh
