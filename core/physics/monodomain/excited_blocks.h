// Which part of the tissue a wave can reach within one step: at the rest nothing changes, and nothing is
// computed.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "physics/fem/fixed_order.h"

namespace voxtet {

/// Points in blocks of consecutive numbers; those of a block should be near each other. A block is excited
/// where a voltage is not 0 or a current flows. One beside it, which shares an element with it, is within
/// reach.
class ExcitedBlocks {
 public:
  static constexpr std::uint32_t kPoints = 16;  ///< of a block

  ExcitedBlocks() = default;
  /// `graph` has an entry where two points share an element. At first all is within reach.
  explicit ExcitedBlocks(const fem::SparseMatrix& graph);

  /// v and w of all points, and the current into them (empty: none).
  void update(const Eigen::VectorXd& v, const Eigen::VectorXd& w, const std::vector<double>& current);

  /// The points of blocks that are within reach, or excited.
  const fem::RowRanges& rows() const { return rows_; }
  /// Those that the last update has taken out of reach.
  const fem::RowRanges& left() const { return left_; }
  /// Those out of reach whose gates are still opening.
  const fem::RowRanges& recovering() const { return recovering_; }

 private:
  fem::RowRange rows_of(std::uint32_t block) const;

  std::uint32_t points_ = 0;
  std::vector<std::vector<std::uint32_t>> beside_;  ///< of each block, itself included
  std::vector<bool> in_reach_;                      ///< of each block
  fem::RowRanges rows_, left_, recovering_;
};

}  // namespace voxtet
