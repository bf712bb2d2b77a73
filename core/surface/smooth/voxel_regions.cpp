#include "surface/smooth/voxel_regions.h"

#include <algorithm>

#include "base/union_find.h"

namespace voxtet {
namespace {

/// Voxels [begin, end) of one row.
struct Run {
  int begin = 0, end = 0;
  Label label = kBackground;
};

struct Runs {
  std::vector<Run> runs;
  std::vector<std::uint32_t> first;  ///< by row y + size[1] * z, and the end
};

Runs find_runs(const LabelVolume& volume, Label merged) {
  const int nx = volume.size[0];
  const std::size_t rows = volume.voxel_count() / static_cast<std::size_t>(nx);
  const auto meaning = [merged](Label label) {
    return merged != kBackground && label != kBackground ? merged : label;
  };
  Runs out;
  out.first.reserve(rows + 1);
  for (std::size_t row = 0; row < rows; ++row) {
    out.first.push_back(static_cast<std::uint32_t>(out.runs.size()));
    const Label* voxel = volume.labels.data() + row * static_cast<std::size_t>(nx);
    for (int i = 0; i < nx;) {
      const int begin = i;
      const Label label = meaning(voxel[i]);
      while (i < nx && meaning(voxel[i]) == label) ++i;
      out.runs.push_back({begin, i, label});
    }
  }
  out.first.push_back(static_cast<std::uint32_t>(out.runs.size()));
  return out;
}

/// Joins the runs of two rows that touch, at a corner at least. Run r is node r + 1.
void join_rows(const Runs& runs, std::size_t row, std::size_t other, UnionFind& nodes) {
  std::uint32_t a = runs.first[row], b = runs.first[other];
  while (a < runs.first[row + 1] && b < runs.first[other + 1]) {
    const Run &p = runs.runs[a], &q = runs.runs[b];
    if (p.label == q.label && p.begin <= q.end && q.begin <= p.end) nodes.join(a + 1, b + 1);
    // Where both end, each also touches the other's successor.
    if (p.end == q.end && a + 1 < runs.first[row + 1] && runs.runs[a + 1].label == q.label)
      nodes.join(a + 2, b + 1);
    p.end < q.end ? ++a : ++b;
  }
}

}  // namespace

VoxelRegions::VoxelRegions(const LabelVolume& volume, Label merged) : size_(volume.size) {
  const Runs runs = find_runs(volume, merged);
  UnionFind nodes(runs.runs.size() + 1);
  const int nx = size_[0], ny = size_[1], nz = size_[2];
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y) {
      const auto row =
          static_cast<std::size_t>(y) + static_cast<std::size_t>(ny) * static_cast<std::size_t>(z);
      const bool border = y == 0 || z == 0 || y == ny - 1 || z == nz - 1;
      for (std::uint32_t r = runs.first[row]; r < runs.first[row + 1]; ++r) {
        const Run& run = runs.runs[r];
        if (run.label == kBackground && (border || run.begin == 0 || run.end == nx)) nodes.join(0, r + 1);
      }
      if (y > 0) join_rows(runs, row, row - 1, nodes);
      if (z == 0) continue;
      const std::size_t below = row - static_cast<std::size_t>(ny);
      if (y > 0) join_rows(runs, row, below - 1, nodes);
      join_rows(runs, row, below, nodes);
      if (y < ny - 1) join_rows(runs, row, below + 1, nodes);
    }
  std::vector<std::uint32_t> region(nodes.size());
  labels_.push_back(kBackground);
  volumes_.push_back(0);
  of_voxel_.resize(volume.voxel_count());
  auto out = of_voxel_.begin();
  for (std::uint32_t node = 1; node < nodes.size(); ++node) {
    const Run& run = runs.runs[node - 1];
    const std::uint32_t root = nodes.find(node);
    if (root == node) {
      region[node] = static_cast<std::uint32_t>(labels_.size());
      labels_.push_back(run.label);
      volumes_.push_back(0);
    }
    if (region[root] != kOutside) volumes_[region[root]] += run.end - run.begin;
    out = std::fill_n(out, run.end - run.begin, region[root]);
  }
}

VoxelRegions::Surroundings VoxelRegions::around(int i, int j, int k) const {
  const std::uint32_t own = at(i, j, k);
  const std::array<int, 3> along{
      (at(i - 1, j, k) != own ? 1 : 0) + (at(i + 1, j, k) != own ? 1 : 0),
      (at(i, j - 1, k) != own ? 1 : 0) + (at(i, j + 1, k) != own ? 1 : 0),
      (at(i, j, k - 1) != own ? 1 : 0) + (at(i, j, k + 1) != own ? 1 : 0),
  };
  Surroundings found;
  for (const int others : along) {
    found.others += others;
    found.thin_axes += others == 2 ? 1 : 0;
  }
  return found;
}

}  // namespace voxtet
