#include "remesh/balance_volumes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxtet::remesh {
namespace {

constexpr double kUnit = 1 << 30;
constexpr double kMostBias = 0.25;
constexpr int kRounds = 6;
constexpr double kCloseEnough = 5e-4;  ///< of a label's volume

/// The indicators of one cell's eight corners; rows of labels that can come close to winning.
struct Cell {
  std::uint32_t first = 0, count = 0;  ///< rows
};

struct Rows {
  std::vector<Label> labels;
  std::vector<std::array<float, 8>> values;
};

/// Adds the rows of one cell, or none where one label leads everywhere by more than any bias can make up for:
/// then returns true and that label.
bool add_rows(const LabelGrid& grid, const VoxelWeights& weights, const std::array<std::size_t, 8>& corners,
              Rows& rows, Label& leader) {
  const std::size_t first = rows.labels.size();
  const auto row = [&](Label label) -> std::array<float, 8>& {
    for (std::size_t i = first; i < rows.labels.size(); ++i)
      if (rows.labels[i] == label) return rows.values[i];
    rows.labels.push_back(label);
    rows.values.push_back({});
    return rows.values.back();
  };
  for (std::size_t c = 0; c < 8; ++c) {
    const std::size_t v = corners[c];
    if (weights.offsets[v] == weights.offsets[v + 1]) row(grid.labels[v])[c] = 1;
    for (std::uint32_t e = weights.offsets[v]; e < weights.offsets[v + 1]; ++e)
      row(weights.labels[e])[c] = static_cast<float>(weights.weights[e] / kUnit);
  }
  for (std::size_t i = first; i < rows.labels.size(); ++i) {
    bool leads = true;
    for (std::size_t j = first; j < rows.labels.size() && leads; ++j)
      for (std::size_t c = 0; c < 8 && j != i; ++c)
        leads = leads && rows.values[i][c] - rows.values[j][c] > 2 * kMostBias;
    if (!leads) continue;
    leader = rows.labels[i];
    rows.labels.resize(first);
    rows.values.resize(first);
    return true;
  }
  return false;
}

/// How much of the cell a label wins, and how fast that grows with its bias.
struct Share {
  double volume = 0, growth = 0;
};

/// By the linear part of the lead at the eight corners of a box.
Share share_of_box(const std::array<double, 8>& lead) {
  double centre = 0, slope = 0;
  for (const double value : lead) centre += value / 8;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double rise = 0;
    for (std::size_t c = 0; c < 8; ++c) rise += ((c >> axis) & 1U ? lead[c] : -lead[c]) / 4;
    slope += std::abs(rise);
  }
  const double share = 0.5 + centre / std::max(slope, 1e-6);
  if (share <= 0) return {0, 0};
  if (share >= 1) return {1, 0};
  return {share, 1 / std::max(slope, 0.05)};
}

/// Box by box over the eighths of a cell: across a whole one the bend of the interface of small bodies would
/// show.
Share share_of_cell(const std::array<double, 8>& lead) {
  const auto [low, high] = std::minmax_element(lead.begin(), lead.end());
  if (*low > 0) return {1, 0};
  if (*high < 0) return {0, 0};
  std::array<double, 27> lattice{};
  for (std::size_t p = 0; p < 27; ++p) {
    const std::array<std::size_t, 3> at{p % 3, p / 3 % 3, p / 9};
    for (std::size_t c = 0; c < 8; ++c) {
      double weight = 1;
      for (std::size_t d = 0; d < 3; ++d) {
        const double t = 0.5 * static_cast<double>(at[d]);
        weight *= (c >> d) & 1U ? t : 1 - t;
      }
      lattice[p] += weight * lead[c];
    }
  }
  Share total;
  for (std::size_t box = 0; box < 8; ++box) {
    std::array<double, 8> corners{};
    for (std::size_t c = 0; c < 8; ++c)
      corners[c] = lattice[(box & 1U) + (c & 1U) + 3 * (((box >> 1) & 1U) + ((c >> 1) & 1U)) +
                           9 * ((box >> 2) + (c >> 2))];
    const Share share = share_of_box(corners);
    total.volume += share.volume / 8;
    total.growth += share.growth / 8;
  }
  return total;
}

struct Cells {
  std::vector<Cell> mixed;
  Rows rows;
  std::vector<double> settled;  ///< per label: cells in which it leads whatever the biases
};

Cells collect_cells(const LabelGrid& grid, const VoxelWeights& weights) {
  Cells out;
  out.settled.assign(65536, 0);
  const std::size_t sx = static_cast<std::size_t>(grid.size[0]),
                    sxy = sx * static_cast<std::size_t>(grid.size[1]);
  for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(grid.size[2]); ++k)
    for (std::size_t j = 0; j + 1 < static_cast<std::size_t>(grid.size[1]); ++j)
      for (std::size_t i = 0; i + 1 < sx; ++i) {
        const std::size_t v = i + sx * j + sxy * k;
        const std::array<std::size_t, 8> corners{v,       v + 1,       v + sx,       v + sx + 1,
                                                 v + sxy, v + sxy + 1, v + sxy + sx, v + sxy + sx + 1};
        bool plain = true;
        for (const std::size_t c : corners)
          plain = plain && weights.offsets[c] == weights.offsets[c + 1] && grid.labels[c] == grid.labels[v];
        const auto first = static_cast<std::uint32_t>(out.rows.labels.size());
        Label leader = grid.labels[v];
        if (plain || add_rows(grid, weights, corners, out.rows, leader))
          ++out.settled[leader];
        else
          out.mixed.push_back({first, static_cast<std::uint32_t>(out.rows.labels.size()) - first});
      }
  return out;
}

std::vector<Share> measure(const Cells& cells, const std::vector<double>& bias) {
  std::vector<Share> total(65536);
  for (std::size_t label = 0; label < total.size(); ++label) total[label].volume = cells.settled[label];
  for (const Cell& cell : cells.mixed)
    for (std::uint32_t own = cell.first; own < cell.first + cell.count; ++own) {
      const Label label = cells.rows.labels[own];
      if (label == kBackground) continue;
      std::array<double, 8> lead;
      lead.fill(10);
      for (std::uint32_t other = cell.first; other < cell.first + cell.count; ++other) {
        if (other == own) continue;
        const double offset = bias[label] - bias[cells.rows.labels[other]];
        for (std::size_t c = 0; c < 8; ++c)
          lead[c] = std::min(lead[c], cells.rows.values[own][c] - cells.rows.values[other][c] + offset);
      }
      const Share share = share_of_cell(lead);
      total[label].volume += share.volume;
      total[label].growth += share.growth;
    }
  return total;
}

}  // namespace

void balance_volumes(const LabelGrid& grid, VoxelWeights& weights) {
  std::vector<double> target(65536, 0), bias(65536, 0);
  for (const Label label : grid.labels) ++target[label];
  const Cells cells = collect_cells(grid, weights);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Share> found = measure(cells, bias);
    bool changed = false;
    for (std::size_t label = 1; label < target.size(); ++label) {
      const double missing = target[label] - found[label].volume;
      if (target[label] == 0 || found[label].growth == 0 || std::abs(missing) < kCloseEnough * target[label])
        continue;
      bias[label] = std::clamp(bias[label] + missing / found[label].growth, -kMostBias, kMostBias);
      changed = true;
    }
    if (!changed) break;
  }
  // Rounded, so that sums of doubles in another order could not show.
  std::vector<std::int32_t> rounded(65536, 0);
  for (std::size_t label = 1; label < bias.size(); ++label)
    rounded[label] = static_cast<std::int32_t>(std::lround(bias[label] * 4096)) * (1 << 18);
  for (std::size_t e = 0; e < weights.labels.size(); ++e) weights.weights[e] += rounded[weights.labels[e]];
}

}  // namespace voxtet::remesh
