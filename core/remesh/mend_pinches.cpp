#include "remesh/mend_pinches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "remesh/drop_fragments.h"
#include "remesh/interface_edges.h"

namespace voxtet::remesh {
namespace {

constexpr double kDeepestVoxels = 0.5;
constexpr int kVisits = 6;  ///< of one point

using Cells = std::vector<std::uint32_t>;

class Mender {
 public:
  Mender(CellComplex& cells, const LabelField& field)
      : cells_(cells), field_(field), population_(65536, 0), visits_(cells.points.size(), 0) {
    for (const Label label : cells.labels) ++population_[label];
    star_start_.assign(cells.points.size() + 1, 0);
    for (const auto& v : cells.vertices)
      for (const std::uint32_t p : v) ++star_start_[p + 1];
    for (std::size_t p = 1; p < star_start_.size(); ++p) star_start_[p] += star_start_[p - 1];
    Cells fill(star_start_.begin(), star_start_.end() - 1);
    star_cells_.resize(star_start_.back());
    for (std::uint32_t c = 0; c < cells.vertices.size(); ++c)
      for (const std::uint32_t p : cells.vertices[c]) star_cells_[fill[p]++] = c;
  }

  std::size_t run(Cells queue) {
    std::size_t changed = 0;
    for (std::size_t at = 0; at < queue.size(); ++at) {
      if (visits_[queue[at]]++ >= kVisits) continue;
      const Cells flipped = mend(queue[at]);
      changed += flipped.size();
      for (const std::uint32_t p : points_of(flipped))
        if (defects(p) > 0) queue.push_back(p);
    }
    return changed;
  }

 private:
  struct Option {
    Cells group;
    Label label = kBackground;
  };

  /// The groups into which the cells around a point fall that are (or, `outside`, are not) of a label,
  /// connected over facets at that point.
  void groups_at(std::uint32_t point, Label label, bool outside, std::vector<Cells>& groups) {
    groups.clear();
    const auto first = star_cells_.begin() + star_start_[point],
               last = star_cells_.begin() + star_start_[point + 1];
    waiting_.assign(static_cast<std::size_t>(last - first), 0);
    for (auto c = first; c != last; ++c)
      waiting_[static_cast<std::size_t>(c - first)] = (cells_.labels[*c] == label) != outside;
    for (std::size_t seed = 0; seed < waiting_.size(); ++seed) {
      if (!waiting_[seed]) continue;
      waiting_[seed] = 0;
      Cells group{first[static_cast<std::ptrdiff_t>(seed)]};
      for (std::size_t g = 0; g < group.size(); ++g) {
        const std::uint32_t cell = group[g];
        for (std::size_t i = 0; i < 4; ++i) {
          if (cells_.vertices[cell][i] == point) continue;
          const auto found = std::lower_bound(first, last, cells_.neighbours[cell][i]);
          if (found == last || *found != cells_.neighbours[cell][i]) continue;
          std::uint8_t& waits = waiting_[static_cast<std::size_t>(found - first)];
          if (!waits) continue;
          waits = 0;
          group.push_back(*found);
        }
      }
      groups.push_back(std::move(group));
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Cells& a, const Cells& b) { return a.size() < b.size(); });
  }

  std::vector<Label> labels_at(std::uint32_t point) const {
    std::vector<Label> labels;
    for (std::uint32_t k = star_start_[point]; k < star_start_[point + 1]; ++k)
      labels.push_back(cells_.labels[star_cells_[k]]);
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    return labels;
  }

  /// Surplus groups over all labels at a point; 0 where every boundary there is a 2-manifold.
  std::size_t defects(std::uint32_t point) {
    const std::vector<Label> labels = labels_at(point);
    if (labels.size() < 2) return 0;
    std::size_t count = 0;
    for (const Label label : labels)
      for (const bool outside : {false, true}) {
        groups_at(point, label, outside, groups_);
        count += groups_.size() - 1;
      }
    return count;
  }

  Cells points_of(const Cells& group) const {
    Cells points;
    for (const std::uint32_t c : group)
      points.insert(points.end(), cells_.vertices[c].begin(), cells_.vertices[c].end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

  /// Whether no cell of the group that would change lies deep in its label.
  bool may_change(const Cells& group, Label label) const {
    const double deepest = kDeepestVoxels * field_.smallest_spacing_mm();
    for (const std::uint32_t c : group) {
      const Label own = cells_.labels[c];
      if (own == label) continue;
      if (population_[own] <= group.size()) return false;
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      for (const std::uint32_t p : cells_.vertices[c]) {
        if (p < 8) return false;  // the far corners of the enclosing box
        centre += 0.25 * cells_.points[p];
      }
      if (field_.depth(centre, own) > deepest) return false;
    }
    return true;
  }

  /// Applies the option and returns how many defects are gone (negative: more than before).
  std::ptrdiff_t apply(const Option& option, std::vector<Label>& before) {
    const Cells points = points_of(option.group);
    std::ptrdiff_t gain = 0;
    for (const std::uint32_t p : points) gain += static_cast<std::ptrdiff_t>(defects(p));
    before.clear();
    for (const std::uint32_t c : option.group) before.push_back(cells_.labels[c]);
    for (const std::uint32_t c : option.group) cells_.labels[c] = option.label;
    for (const std::uint32_t p : points) gain -= static_cast<std::ptrdiff_t>(defects(p));
    return gain;
  }

  void restore(const Cells& group, const std::vector<Label>& labels) {
    for (std::size_t i = 0; i < group.size(); ++i) cells_.labels[group[i]] = labels[i];
  }

  std::vector<Option> options_at(std::uint32_t point) {
    std::vector<Option> options;
    std::vector<Cells> groups;
    for (const Label label : labels_at(point))
      for (const bool outside : {false, true}) {
        groups_at(point, label, outside, groups);
        for (std::size_t g = 0; g + 1 < groups.size(); ++g)
          options.push_back({groups[g], outside ? label : label_around(cells_, groups[g])});
      }
    return options;
  }

  /// Takes the best option at a point; the cells that changed, or none.
  Cells mend(std::uint32_t point) {
    Option best;
    std::ptrdiff_t best_gain = 0;
    std::vector<Label> before;
    for (const Option& option : options_at(point)) {
      if (!may_change(option.group, option.label)) continue;
      const std::ptrdiff_t gain = apply(option, before);
      restore(option.group, before);
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

  CellComplex& cells_;
  const LabelField& field_;
  std::vector<std::uint64_t> population_;
  std::vector<std::uint8_t> visits_;
  Cells star_start_, star_cells_;  ///< cells at each point, ascending
  std::vector<std::uint8_t> waiting_;
  std::vector<Cells> groups_;
};

}  // namespace

std::size_t mend_pinches(CellComplex& cells, const LabelField& field) {
  const InterfaceEdges edges = find_interface_edges(cells);
  Cells queue = find_pinched_points(cells, edges);
  for (const std::uint32_t e : find_pinched_edges(cells, edges))
    queue.insert(queue.end(), edges.ends[e].begin(), edges.ends[e].end());
  std::sort(queue.begin(), queue.end());
  queue.erase(std::unique(queue.begin(), queue.end()), queue.end());
  return queue.empty() ? 0 : Mender(cells, field).run(std::move(queue));
}

}  // namespace voxtet::remesh
