#include "remesh/cells/cell_stars.h"

#include <algorithm>

namespace voxtet::remesh {

CellStars::CellStars(const LabelledCells& cells) : cells_(cells), start_(cells.points.size() + 1, 0) {
  for (const auto& v : cells.vertices)
    for (const std::uint32_t p : v) ++start_[p + 1];
  for (std::size_t p = 1; p < start_.size(); ++p) start_[p] += start_[p - 1];
  Cells fill(start_.begin(), start_.end() - 1);
  around_.resize(start_.back());
  for (std::uint32_t c = 0; c < cells.vertices.size(); ++c)
    for (const std::uint32_t p : cells.vertices[c]) around_[fill[p]++] = c;
}

std::vector<Label> CellStars::labels_at(std::uint32_t point) const {
  std::vector<Label> labels;
  for (std::uint32_t k = start_[point]; k < start_[point + 1]; ++k)
    labels.push_back(cells_.labels[around_[k]]);
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

std::vector<CellStars::Cells> CellStars::groups_at(std::uint32_t point, Label label, bool outside) const {
  const auto first = around_.begin() + start_[point], last = around_.begin() + start_[point + 1];
  std::vector<std::uint8_t> waiting;
  for (auto c = first; c != last; ++c) waiting.push_back((cells_.labels[*c] == label) != outside);
  std::vector<Cells> groups;
  for (std::size_t seed = 0; seed < waiting.size(); ++seed) {
    if (!waiting[seed]) continue;
    waiting[seed] = 0;
    Cells group{first[static_cast<std::ptrdiff_t>(seed)]};
    for (std::size_t g = 0; g < group.size(); ++g) {
      const std::uint32_t cell = group[g];
      for (std::size_t i = 0; i < 4; ++i) {
        if (cells_.vertices[cell][i] == point) continue;
        const auto found = std::lower_bound(first, last, cells_.neighbours[cell][i]);
        if (found == last || *found != cells_.neighbours[cell][i]) continue;
        std::uint8_t& waits = waiting[static_cast<std::size_t>(found - first)];
        if (!waits) continue;
        waits = 0;
        group.push_back(*found);
      }
    }
    groups.push_back(std::move(group));
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Cells& a, const Cells& b) { return a.size() < b.size(); });
  return groups;
}

std::size_t CellStars::defects(std::uint32_t point) const {
  const std::vector<Label> labels = labels_at(point);
  if (labels.size() < 2) return 0;
  std::size_t count = 0;
  for (const Label label : labels)
    for (const bool outside : {false, true}) count += groups_at(point, label, outside).size() - 1;
  return count;
}

std::size_t CellStars::defects(const Cells& points) const {
  std::size_t count = 0;
  for (const std::uint32_t p : points) count += defects(p);
  return count;
}

CellStars::Cells CellStars::points_of(const Cells& cells) const {
  Cells points;
  for (const std::uint32_t c : cells)
    points.insert(points.end(), cells_.vertices[c].begin(), cells_.vertices[c].end());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace voxtet::remesh
