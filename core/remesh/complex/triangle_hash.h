// Finds the triangles that may be near a box, by hashed grids on several levels.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "remesh/complex/complex_mesh.h"

namespace voxtet::remesh {

/// Rounded outwards to floats.
struct FloatBox {
  std::array<float, 3> low, high;
  bool meets(const FloatBox& o) const {
    return low[0] <= o.high[0] && o.low[0] <= high[0] && low[1] <= o.high[1] && o.low[1] <= high[1] &&
           low[2] <= o.high[2] && o.low[2] <= high[2];
  }
  void extend(const FloatBox& o);
  FloatBox grown(double margin) const;
};
FloatBox box_of(const Corners& t);

/// Spatial hashing (Teschner et al., "Optimized spatial hashing for collision detection of deformable
/// objects", 2003) with one entry per triangle. The entry is in the cell of its box's centre, on the level
/// whose cells are just larger than the box; so a search must look half a cell beyond its own box.
class TriangleHash {
 public:
  /// `cell_mm`: cell size of the finest level, which also holds all smaller triangles.
  TriangleHash(const ComplexMesh& mesh, double cell_mm);

  void insert(std::uint32_t t, const Corners& corners);
  void erase(std::uint32_t t);
  void move(std::uint32_t t, const Corners& corners);
  const FloatBox& box(std::uint32_t t) const { return entries_[t].box; }
  /// What a search has met; several threads that search at once have one each.
  struct Search {
    std::uint32_t number = 0;
    std::vector<std::uint32_t> met_by;  ///< by triangle: the last search that met it
  };
  /// Every triangle whose box meets `box`, each once, in an order that depends on the edits alone.
  void find(const FloatBox& box, Search& search, std::vector<std::uint32_t>& out) const;

 private:
  struct Entry {
    FloatBox box;
    std::uint32_t next = kNone;
  };
  static constexpr int kLevels = 16;
  std::uint32_t bucket(int level, int i, int j, int k) const;
  int level_of(const FloatBox& box) const;
  std::uint32_t bucket_of(const FloatBox& box, int level) const;
  void link(std::uint32_t t, int level);
  void unlink(std::uint32_t t, int level);

  std::array<double, kLevels> cell_mm_{}, cells_per_mm_{};
  std::array<std::uint32_t, kLevels> population_{};
  std::uint32_t mask_ = 0;
  std::vector<std::uint32_t> heads_;
  std::vector<Entry> entries_;  ///< by triangle
};

}  // namespace voxtet::remesh
