#include "remesh/cells/remove_islands.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace voxtet::remesh {
namespace {

constexpr std::size_t kMostCells = 300;

/// Six times the signed volume.
double volume6(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
               const Eigen::Vector3d& d) {
  return (b - a).dot((c - a).cross(d - a));
}

/// Adds the voxels of the cell's label whose centre lies in the cell.
void add_voxels(const LabelledCells& cells, std::uint32_t cell, const LabelField& field,
                std::vector<std::size_t>& voxels) {
  std::array<Eigen::Vector3d, 4> p;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e30), high = -low;
  for (std::size_t i = 0; i < 4; ++i) {
    p[i] = field.to_index(cells.points[cells.vertices[cell][i]]);
    low = low.cwiseMin(p[i]);
    high = high.cwiseMax(p[i]);
  }
  const double whole = volume6(p[0], p[1], p[2], p[3]);  // negative in a mirrored frame
  std::array<int, 3> first{}, last{};
  for (int d = 0; d < 3; ++d) {
    const auto k = static_cast<std::size_t>(d);
    first[k] = static_cast<int>(std::ceil(std::max(low[d], 0.0)));
    last[k] = static_cast<int>(std::floor(std::min(high[d], field.grid().size[k] - 1.0)));
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const std::size_t voxel = field.grid().offset({i, j, k});
        if (field.centre_labels()[voxel] != cells.labels[cell]) continue;
        const Eigen::Vector3d x(i, j, k);
        if (whole * volume6(x, p[1], p[2], p[3]) >= 0 && whole * volume6(p[0], x, p[2], p[3]) >= 0 &&
            whole * volume6(p[0], p[1], x, p[3]) >= 0 && whole * volume6(p[0], p[1], p[2], x) >= 0)
          voxels.push_back(voxel);
      }
}

/// The voxels of its label whose centres lie in a group of cells, each once.
std::vector<std::size_t> voxels_in(const LabelledCells& cells, const std::vector<std::uint32_t>& group,
                                   const LabelField& field) {
  std::vector<std::size_t> voxels;
  for (const std::uint32_t c : group) add_voxels(cells, c, field, voxels);
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  return voxels;
}

/// The voxel of its label in whose middle a group lies beside the centre: nearest to the centroid of one of
/// its cells, with the label all the way. Nothing where there is none.
std::optional<std::size_t> voxel_beside(const LabelledCells& cells, const std::vector<std::uint32_t>& group,
                                        const LabelField& field) {
  constexpr int kSteps = 8;
  const Label label = cells.labels[group.front()];
  for (const std::uint32_t c : group) {
    const Eigen::Vector3d from = field.to_index(cells.centroid(c));
    const std::size_t voxel = field.nearest_voxel(cells.centroid(c));
    if (field.centre_labels()[voxel] != label) continue;
    const Eigen::Vector3d to = from.array().round();
    bool all = true;
    for (int step = 0; step < kSteps && all; ++step)
      all = field.at(field.to_mm(from + step * (to - from) / kSteps)) == label;
    if (all) return voxel;
  }
  return std::nullopt;
}

/// Whether voxels are a whole piece, or enough of one to stay.
bool is_piece(const std::vector<std::size_t>& voxels, const VoxelPieces& pieces) {
  if (voxels.empty()) return false;
  return voxels.size() >= kIslandVoxels || 2 * voxels.size() >= pieces.sizes[pieces.ids[voxels.front()]];
}

/// Whether a label goes on beyond a cell of another, apart from a group, with at most `depth` more such cells
/// between.
bool leads_on(const LabelledCells& cells, std::uint32_t lid, Label label,
              const std::vector<std::uint32_t>& group, int depth) {
  for (const std::uint32_t n : cells.neighbours[lid]) {
    if (cells.label_or_background(n) == label) {
      if (std::find(group.begin(), group.end(), n) == group.end()) return true;
    } else if (depth > 0 && n != LabelledCells::kNone && leads_on(cells, n, label, group, depth - 1)) {
      return true;
    }
  }
  return false;
}

/// Facets of a group towards a lid, beyond which its label goes on.
std::vector<InterfaceFacet> lids_of(const LabelledCells& cells, const std::vector<std::uint32_t>& group) {
  constexpr int kThickness = 3;  // of a lid, in cells
  std::vector<InterfaceFacet> lids;
  const Label label = cells.labels[group.front()];
  for (const std::uint32_t c : group)
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t lid = cells.neighbours[c][i];
      if (lid != LabelledCells::kNone && cells.labels[lid] != label &&
          leads_on(cells, lid, label, group, kThickness - 1))
        lids.push_back({c, i});
    }
  return lids;
}

}  // namespace

VoxelPieces find_pieces(const LabelField& field) {
  VoxelPieces pieces;
  pieces.ids = label_components(field.grid().size, field.centre_labels(), pieces.sizes, field.connectivity());
  return pieces;
}

Label label_around(const LabelledCells& cells, const std::vector<std::uint32_t>& group) {
  std::vector<Label> around;
  for (const std::uint32_t c : group)
    for (const std::uint32_t n : cells.neighbours[c])
      if (cells.label_or_background(n) != cells.labels[c]) around.push_back(cells.label_or_background(n));
  std::sort(around.begin(), around.end());
  Label best = kBackground;
  std::ptrdiff_t most = 0;
  for (auto first = around.begin(); first != around.end();) {
    const auto last = std::upper_bound(first, around.end(), *first);
    if (last - first > most) {
      most = last - first;
      best = *first;
    }
    first = last;
  }
  return best;
}

std::size_t remove_islands(LabelledCells& cells, const LabelField& field, const VoxelPieces& pieces,
                           std::vector<InterfaceFacet>* torn) {
  std::vector<std::vector<std::uint32_t>> islands;
  std::vector<std::size_t> largest(65536, 0);
  std::vector<std::uint8_t> seen(cells.labels.size(), 0);
  std::vector<std::uint32_t> group;
  for (std::uint32_t first = 0; first < cells.labels.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = 1;
    group.assign(1, first);
    for (std::size_t g = 0; g < group.size(); ++g)
      for (const std::uint32_t n : cells.neighbours[group[g]]) {
        if (n == LabelledCells::kNone || seen[n] || cells.labels[n] != cells.labels[first]) continue;
        seen[n] = 1;
        group.push_back(n);
      }
    std::size_t& most = largest[cells.labels[first]];
    most = std::max(most, group.size());
    if (group.size() <= kMostCells) islands.push_back(group);
  }
  std::vector<std::vector<std::size_t>> voxels_of;
  std::set<std::size_t> held;
  for (const std::vector<std::uint32_t>& island : islands) {
    voxels_of.push_back(voxels_in(cells, island, field));
    held.insert(voxels_of.back().begin(), voxels_of.back().end());
  }
  std::size_t changed = 0;
  for (std::size_t f = 0; f < islands.size(); ++f) {
    const std::vector<std::uint32_t>& island = islands[f];
    if (island.size() == largest[cells.labels[island.front()]]) continue;
    std::vector<std::size_t>& voxels = voxels_of[f];
    if (voxels.empty())
      if (const auto beside = voxel_beside(cells, island, field); beside && held.insert(*beside).second)
        voxels.push_back(*beside);
    if (is_piece(voxels, pieces)) continue;
    if (torn && !voxels.empty()) {
      const std::vector<InterfaceFacet> lids = lids_of(cells, island);
      torn->insert(torn->end(), lids.begin(), lids.end());
    }
    const Label label = label_around(cells, island);
    for (const std::uint32_t c : island) cells.labels[c] = label;
    changed += island.size();
  }
  return changed;
}

}  // namespace voxtet::remesh
