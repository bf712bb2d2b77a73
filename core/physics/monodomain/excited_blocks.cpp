#include "physics/monodomain/excited_blocks.h"

#include <algorithm>

namespace voxtet {

ExcitedBlocks::ExcitedBlocks(const fem::SparseMatrix& graph)
    : points_(static_cast<std::uint32_t>(graph.rows())), beside_((points_ + kPoints - 1) / kPoints) {
  for (std::uint32_t block = 0; block < beside_.size(); ++block) {
    std::vector<std::uint32_t>& beside = beside_[block];
    const auto [first, last] = rows_of(block);
    for (int at = graph.outerIndexPtr()[first]; at < graph.outerIndexPtr()[last]; ++at)
      beside.push_back(static_cast<std::uint32_t>(graph.innerIndexPtr()[at]) / kPoints);
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    rows_.push_back({first, last});
  }
  in_reach_.assign(beside_.size(), true);
}

fem::RowRange ExcitedBlocks::rows_of(std::uint32_t block) const {
  return {static_cast<int>(block * kPoints), static_cast<int>(std::min((block + 1) * kPoints, points_))};
}

void ExcitedBlocks::update(const Eigen::VectorXd& v, const Eigen::VectorXd& w,
                           const std::vector<double>& current) {
  const auto any_but = [](double value, const double* values, fem::RowRange rows) {
    return std::any_of(values + rows.first, values + rows.last, [=](double found) { return found != value; });
  };
  const std::vector<bool> before = in_reach_;
  in_reach_.assign(beside_.size(), false);
  for (std::uint32_t block = 0; block < beside_.size(); ++block) {
    const fem::RowRange rows = rows_of(block);
    if (!any_but(0, v.data(), rows) && (current.empty() || !any_but(0, current.data(), rows))) continue;
    for (const std::uint32_t beside : beside_[block]) in_reach_[beside] = true;
  }
  rows_.clear(), left_.clear(), recovering_.clear();
  for (std::uint32_t block = 0; block < beside_.size(); ++block) {
    const fem::RowRange rows = rows_of(block);
    if (in_reach_[block])
      rows_.push_back(rows);
    else if (any_but(1, w.data(), rows))
      recovering_.push_back(rows);
    if (before[block] && !in_reach_[block]) left_.push_back(rows);
  }
}

}  // namespace voxtet
