#include "remesh/cells/make_two_manifold.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "remesh/cells/cell_stars.h"
#include "remesh/cells/remove_islands.h"

namespace voxtet::remesh {
namespace {

constexpr double kDeepestVoxels = 0.5;
constexpr int kVisits = 6;  ///< of one point

using Cells = CellStars::Cells;

class Mender {
 public:
  Mender(LabelledCells& cells, const LabelField& field)
      : cells_(cells), field_(field), stars_(cells), population_(65536, 0), visits_(cells.points.size(), 0) {
    for (const Label label : cells.labels) ++population_[label];
  }

  std::size_t run(Cells queue) {
    std::size_t changed = 0;
    for (std::size_t at = 0; at < queue.size(); ++at) {
      if (visits_[queue[at]]++ >= kVisits) continue;
      const Cells flipped = mend(queue[at]);
      changed += flipped.size();
      for (const std::uint32_t p : stars_.points_of(flipped))
        if (stars_.defects(p) > 0) queue.push_back(p);
    }
    return changed;
  }

 private:
  struct Option {
    Cells group;
    Label label = kBackground;
  };

  /// Whether no cell of the group that would change lies deep in its label.
  bool may_change(const Option& option) const {
    const double deepest = kDeepestVoxels * field_.grid().smallest_spacing_mm();
    for (const std::uint32_t c : option.group) {
      const Label own = cells_.labels[c];
      if (own == option.label) continue;
      if (population_[own] <= option.group.size()) return false;
      if (field_.depth(cells_.centroid(c), own) > deepest) return false;
    }
    return true;
  }

  /// How many defects an option removes (negative: adds).
  std::ptrdiff_t gain_of(const Option& option) {
    const Cells points = stars_.points_of(option.group);
    std::vector<Label> before;
    for (const std::uint32_t c : option.group) before.push_back(cells_.labels[c]);
    const auto defects = static_cast<std::ptrdiff_t>(stars_.defects(points));
    for (const std::uint32_t c : option.group) cells_.labels[c] = option.label;
    const auto left = static_cast<std::ptrdiff_t>(stars_.defects(points));
    for (std::size_t i = 0; i < before.size(); ++i) cells_.labels[option.group[i]] = before[i];
    return defects - left;
  }

  std::vector<Option> options_at(std::uint32_t point) const {
    std::vector<Option> options;
    for (const Label label : stars_.labels_at(point))
      for (const bool outside : {false, true}) {
        const std::vector<Cells> groups = stars_.groups_at(point, label, outside);
        for (std::size_t g = 0; g + 1 < groups.size(); ++g)
          options.push_back({groups[g], outside ? label : label_around(cells_, groups[g])});
      }
    return options;
  }

  /// Takes the best option at a point; the cells that changed, or none.
  Cells mend(std::uint32_t point) {
    Option best;
    std::ptrdiff_t best_gain = 0;
    for (const Option& option : options_at(point)) {
      if (!may_change(option)) continue;
      const std::ptrdiff_t gain = gain_of(option);
      if (gain > best_gain || (gain == best_gain && gain > 0 && option.group.size() < best.group.size())) {
        best = option;
        best_gain = gain;
      }
    }
    for (const std::uint32_t c : best.group) {
      --population_[cells_.labels[c]];
      ++population_[best.label];
      cells_.labels[c] = best.label;
    }
    return best.group;
  }

  LabelledCells& cells_;
  const LabelField& field_;
  const CellStars stars_;
  std::vector<std::uint64_t> population_;
  std::vector<std::uint8_t> visits_;
};

}  // namespace

std::size_t make_two_manifold(LabelledCells& cells, const LabelField& field, const Pinches& pinches) {
  Cells queue = pinches.points();
  return queue.empty() ? 0 : Mender(cells, field).run(std::move(queue));
}

void mend_parents(LabelledCells& cells, const LabelField& field) {
  constexpr int kRounds = 4;
  const WallLayers& layers = field.layers();
  if (layers.empty()) return;
  LabelledCells merged = cells;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t c = 0; c < cells.labels.size(); ++c) merged.labels[c] = layers.parent(cells.labels[c]);
    if (make_two_manifold(merged, field, find_pinches(merged)) == 0) return;
    for (std::uint32_t c = 0; c < cells.labels.size(); ++c)
      if (merged.labels[c] != layers.parent(cells.labels[c]))
        cells.labels[c] = layers.at(merged.labels[c], cells.centroid(c));
    make_two_manifold(cells, field, find_pinches(cells));
  }
}

}  // namespace voxtet::remesh
