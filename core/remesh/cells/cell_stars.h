// The cells around each point of a complex, and whether the boundaries of labels are 2-manifolds there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "remesh/cells/labelled_cells.h"

namespace voxtet::remesh {

/// Refers to a complex. Its labels may change, but not its cells.
class CellStars {
 public:
  using Cells = std::vector<std::uint32_t>;

  explicit CellStars(const LabelledCells& cells);

  /// The cells around a point, ascending.
  std::span<const std::uint32_t> around(std::uint32_t point) const {
    return std::span(around_).subspan(start_[point], start_[point + 1] - start_[point]);
  }

  /// The labels of the cells around a point, ascending.
  std::vector<Label> labels_at(std::uint32_t point) const;

  /// The cells around a point that have a label (or, with `outside`, do not have it), in groups connected
  /// over facets at that point; small groups first.
  std::vector<Cells> groups_at(std::uint32_t point, Label label, bool outside) const;

  /// Around a point of a 2-manifold boundary the cells of a label form one group, and so do all others.
  /// Returns the number of surplus groups at a point over all labels, background's too; 0 where all
  /// boundaries are 2-manifolds.
  std::size_t defects(std::uint32_t point) const;
  /// The same over several points.
  std::size_t defects(const Cells& points) const;

  /// The points of some cells, ascending.
  Cells points_of(const Cells& cells) const;

 private:
  const LabelledCells& cells_;
  Cells start_, around_;  ///< cells at each point, ascending
};

}  // namespace voxtet::remesh
