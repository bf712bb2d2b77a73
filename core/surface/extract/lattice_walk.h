// One pass over the cells of a label volume padded by background, layer by layer, skipping uniform cells.
// Padded coordinates: voxel (i, j, k) is lattice point (i+1, j+1, k+1); cell (x, y, z) has corners x..x+1
// etc.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// Two neighbouring label planes, padded by background, plus slack so that rows can be read four at a time.
class LabelSlab {
 public:
  explicit LabelSlab(const LabelVolume& volume, bool binary)
      : volume_(volume), binary_(binary), stride_(static_cast<std::size_t>(volume.size[0]) + 2 + kSlack) {
    for (auto& plane : planes_)
      plane.assign(stride_ * (static_cast<std::size_t>(volume.size[1]) + 2), kBackground);
  }

  /// Loads padded plane z; it overwrites the plane loaded two calls before.
  void load(int z) {
    std::vector<Label>& plane = planes_[static_cast<std::size_t>(z) % 2];
    if (z == 0 || z == volume_.size[2] + 1) {
      std::fill(plane.begin(), plane.end(), kBackground);
      return;
    }
    const auto nx = static_cast<std::size_t>(volume_.size[0]);
    for (int j = 0; j < volume_.size[1]; ++j) {
      const Label* from = volume_.labels.data() + volume_.offset(0, j, z - 1);
      Label* to = plane.data() + stride_ * (static_cast<std::size_t>(j) + 1) + 1;
      if (binary_)
        for (std::size_t i = 0; i < nx; ++i) to[i] = from[i] != kBackground ? 1 : 0;
      else
        std::memcpy(to, from, nx * sizeof(Label));
    }
  }

  const Label* row(int z, int y) const {
    return planes_[static_cast<std::size_t>(z) % 2].data() + stride_ * static_cast<std::size_t>(y);
  }

 private:
  static constexpr std::size_t kSlack = 8;
  const LabelVolume& volume_;
  bool binary_;
  std::size_t stride_;
  std::array<std::vector<Label>, 2> planes_;
};

/// Calls visit(x, y, z, corner labels) for every cell of layer z with more than one label; planes z and z + 1
/// must be loaded. `visit` may rely only on cells with smaller (z, y, x) having been visited before.
template <class Visit>
void walk_mixed_cells(const LabelVolume& volume, const LabelSlab& slab, int z, Visit&& visit) {
  const int cells_x = volume.size[0] + 1, cells_y = volume.size[1] + 1;
  const auto four = [](const Label* at) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, sizeof word);
    return word;
  };
  for (int y = 0; y < cells_y; ++y) {
    const std::array<const Label*, 4> rows{slab.row(z, y), slab.row(z, y + 1), slab.row(z + 1, y),
                                           slab.row(z + 1, y + 1)};
    for (int x = 0; x < cells_x; x += 4) {
      const std::uint64_t a = four(rows[0] + x);
      std::uint64_t differs = a ^ four(rows[0] + x + 1);
      for (std::size_t r = 1; r < 4; ++r) differs |= (a ^ four(rows[r] + x)) | (a ^ four(rows[r] + x + 1));
      if (differs == 0) continue;
      for (int lane = 0; lane < 4 && x + lane < cells_x; ++lane) {
        if ((differs >> (16 * lane) & 0xFFFF) == 0) continue;
        std::array<Label, 8> corners{};
        for (std::size_t r = 0; r < 4; ++r) {
          corners[2 * r] = rows[r][x + lane];
          corners[2 * r + 1] = rows[r][x + lane + 1];
        }
        visit(x + lane, y, z, corners);
      }
    }
  }
}

/// Vertex ids that belong to lattice points, `slots` for each point, for the two planes of the current slab.
/// An id is stored at the highest corner of its lattice edge (or triangle): all cells around a crossed edge
/// are mixed, and the first one visited has that point as its corner 7, so ids need no clearing.
class PlaneIds {
 public:
  PlaneIds(const LabelVolume& volume, std::size_t slots)
      : slots_(slots),
        row_((static_cast<std::size_t>(volume.size[0]) + 2) * slots),
        planes_{std::vector<std::uint32_t>(row_ * (static_cast<std::size_t>(volume.size[1]) + 2)), {}} {
    planes_[1] = planes_[0];
  }
  /// Slots of corner `corner` (bit mask) of cell (x, y, z).
  std::uint32_t* at(int x, int y, int z, unsigned corner) {
    return planes_[(static_cast<std::size_t>(z) + (corner >> 2)) % 2].data() +
           row_ * (static_cast<std::size_t>(y) + ((corner >> 1) & 1)) +
           slots_ * (static_cast<std::size_t>(x) + (corner & 1));
  }

 private:
  std::size_t slots_, row_;
  std::array<std::vector<std::uint32_t>, 2> planes_;
};

}  // namespace voxtet
