#include "remesh/smooth_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxtet::remesh {
namespace {

constexpr std::int32_t kUnit = 1 << 30;
constexpr std::int32_t kNegligible = 30;  ///< of a kernel's 1024
/// How far a retained voxel's own label wins at its centre: the interface then lies a third to a half of a
/// voxel away, so that necks and specks stay wide enough to mesh.
constexpr std::int32_t kRetainMargin = static_cast<std::int32_t>(0.3 * kUnit);

/// 1 where all labels within `reach` voxels along every axis are equal.
std::vector<std::uint8_t> uniform_boxes(const LabelGrid& grid, const std::array<int, 3>& reach) {
  const std::size_t count = grid.voxel_count();
  std::vector<std::uint8_t> uniform(count, 1), next(count);
  std::vector<int> ends;
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = grid.size[axis];
    ends.resize(static_cast<std::size_t>(n));
    for (std::size_t line = 0; line < count / static_cast<std::size_t>(n); ++line) {
      const std::size_t start = (line / stride) * stride * static_cast<std::size_t>(n) + line % stride;
      const auto at = [&](int i) { return start + static_cast<std::size_t>(i) * stride; };
      for (int begin = 0; begin < n;) {
        int end = begin + 1;
        while (end < n && uniform[at(end)] && uniform[at(begin)] &&
               grid.labels[at(end)] == grid.labels[at(begin)])
          ++end;
        for (int i = begin; i < end; ++i) {
          const bool left = begin == 0 || i - begin >= reach[axis];
          const bool right = end == n || end - 1 - i >= reach[axis];
          next[at(i)] = uniform[at(i)] && left && right;
        }
        begin = end;
      }
    }
    uniform.swap(next);
    stride *= static_cast<std::size_t>(n);
  }
  return uniform;
}

/// The 3x3x3 neighbourhood of a voxel as a bit set of "has this label"; bit 13 is the voxel itself.
std::uint32_t neighbourhood(const std::vector<Label>& labels, const std::array<std::ptrdiff_t, 27>& steps,
                            std::size_t voxel, Label label) {
  std::uint32_t bits = 0;
  for (int n = 0; n < 27; ++n)
    if (n != 13 && labels[voxel + static_cast<std::size_t>(steps[n])] == label) bits |= 1U << n;
  return bits;
}

struct NeighbourTables {
  std::array<std::uint32_t, 27> six{}, all{};
  std::uint32_t faces = 0, eighteen = 0;
  NeighbourTables() {
    const auto coordinate = [](int n, int d) { return d == 0 ? n % 3 : d == 1 ? n / 3 % 3 : n / 9; };
    for (int a = 0; a < 27; ++a)
      for (int b = 0; b < 27; ++b) {
        int sum = 0, largest = 0;
        for (int d = 0; d < 3; ++d) {
          const int gap = std::abs(coordinate(a, d) - coordinate(b, d));
          sum += gap;
          largest = std::max(largest, gap);
        }
        if (largest != 1) continue;
        all[a] |= 1U << b;
        if (sum == 1) six[a] |= 1U << b;
        if (a == 13 && sum == 1) faces |= 1U << b;
        if (a == 13 && sum <= 2) eighteen |= 1U << b;
      }
  }
};

/// Number of connected components of `set` that contain a bit of `touching`.
int count_components(std::uint32_t set, std::uint32_t touching,
                     const std::array<std::uint32_t, 27>& adjacency) {
  int components = 0;
  for (std::uint32_t rest = set & touching; rest != 0;) {
    std::uint32_t grown = rest & (~rest + 1), frontier = grown;
    while (frontier != 0) {
      std::uint32_t reached = 0;
      for (int n = 0; n < 27; ++n)
        if ((frontier >> n) & 1U) reached |= adjacency[n];
      frontier = reached & set & ~grown;
      grown |= frontier;
    }
    rest &= ~grown;
    ++components;
  }
  return components;
}

/// Whether adding or removing the centre leaves the topology of the 6-connected set unchanged (simple point).
bool is_simple(std::uint32_t set) {
  static const NeighbourTables tables;
  const std::uint32_t complement = ~set & ((1U << 27) - 1) & ~(1U << 13);
  return count_components(set & tables.eighteen, tables.faces, tables.six) == 1 &&
         count_components(complement, complement, tables.all) == 1;
}

std::array<std::ptrdiff_t, 27> neighbour_steps(const std::array<int, 3>& size) {
  std::array<std::ptrdiff_t, 27> steps{};
  for (int n = 0; n < 27; ++n)
    steps[n] = (n % 3 - 1) + static_cast<std::ptrdiff_t>(size[0]) *
                                 ((n / 3 % 3 - 1) + static_cast<std::ptrdiff_t>(size[1]) * (n / 9 - 1));
  return steps;
}

Label winner_at(const VoxelWeights& weights, std::size_t voxel, Label own) {
  Label best = own;
  std::int32_t best_weight = std::numeric_limits<std::int32_t>::min();
  for (std::uint32_t e = weights.offsets[voxel]; e < weights.offsets[voxel + 1]; ++e) {
    const bool tie_for_own = weights.weights[e] == best_weight && weights.labels[e] == own;
    if (weights.weights[e] > best_weight || tie_for_own) {
      best = weights.labels[e];
      best_weight = weights.weights[e];
    }
  }
  return best;
}

struct Flip {
  std::size_t voxel;
  Label winner;
  bool open;  ///< still waiting for a decision
};

/// Lets components vanish that are specks, lose at every voxel, and are not the largest of their label.
void drop_specks(const LabelGrid& grid, std::vector<Flip>& flips, std::vector<Label>& labels,
                 FieldLedger& ledger) {
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> component = label_components(grid.size, grid.labels, sizes);
  std::vector<std::uint32_t> lost(sizes.size(), 0), largest(65536, 0);
  for (const Flip& flip : flips) ++lost[component[flip.voxel]];
  std::vector<std::uint8_t> seen(sizes.size(), 0);
  for (std::size_t v = 0; v < component.size(); ++v) {
    const std::uint32_t c = component[v];
    if (seen[c]) continue;
    seen[c] = 1;
    largest[grid.labels[v]] = std::max(largest[grid.labels[v]], sizes[c]);
  }
  for (Flip& flip : flips) {
    const std::uint32_t c = component[flip.voxel];
    const bool speck = sizes[c] < kSpeckVoxels && sizes[c] < largest[grid.labels[flip.voxel]];
    if (!speck || lost[c] < sizes[c]) continue;
    labels[flip.voxel] = flip.winner;
    flip.open = false;
    ++ledger.flipped_voxels;
    if (seen[c]) ++ledger.dropped_specks;
    seen[c] = 0;
  }
}

}  // namespace

HalfKernel gaussian_kernel(double sigma) {
  HalfKernel kernel{1024};
  if (!(sigma > 0.05)) return kernel;
  std::vector<double> density{1.0};
  double sum = 1;
  constexpr int kLongest = 8;
  for (int i = 1; i <= kLongest; ++i) {
    density.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
    sum += 2 * density.back();
  }
  for (int i = 1; i <= kLongest; ++i) {
    const auto weight =
        static_cast<std::int32_t>(std::lround(1024 * density[static_cast<std::size_t>(i)] / sum));
    if (weight == 0) break;
    kernel.push_back(weight);
    kernel[0] -= 2 * weight;
  }
  return kernel;
}

VoxelWeights smooth_indicators(const LabelGrid& grid, const std::array<HalfKernel, 3>& kernels) {
  // Where other labels begin only in the kernel's outermost 3 %, the voxel's own label may as well have all
  // of it.
  std::array<int, 3> reach{};
  for (int d = 0; d < 3; ++d) {
    std::int32_t beyond = 1024 - kernels[d][0];
    int r = 0;
    while (r < 1 || beyond > kNegligible) {
      ++r;
      if (static_cast<std::size_t>(r) < kernels[d].size())
        beyond -= 2 * kernels[d][static_cast<std::size_t>(r)];
    }
    reach[d] = r;
  }
  const std::vector<std::uint8_t> uniform = uniform_boxes(grid, reach);

  VoxelWeights out;
  out.offsets.assign(grid.voxel_count() + 1, 0);
  std::vector<std::int32_t> sums(65536, 0);
  std::vector<Label> touched;
  std::array<int, 3> v{};
  std::size_t voxel = 0;
  for (v[2] = 0; v[2] < grid.size[2]; ++v[2])
    for (v[1] = 0; v[1] < grid.size[1]; ++v[1])
      for (v[0] = 0; v[0] < grid.size[0]; ++v[0], ++voxel) {
        if (!uniform[voxel]) {
          std::array<int, 3> lo{}, hi{};
          for (int d = 0; d < 3; ++d) {
            const int r = static_cast<int>(kernels[d].size()) - 1;
            lo[d] = -r;
            hi[d] = r;
          }
          touched.clear();
          for (int dz = lo[2]; dz <= hi[2]; ++dz) {
            const int z = std::clamp(v[2] + dz, 0, grid.size[2] - 1);
            for (int dy = lo[1]; dy <= hi[1]; ++dy) {
              const int y = std::clamp(v[1] + dy, 0, grid.size[1] - 1);
              const std::size_t row = static_cast<std::size_t>(grid.size[0]) *
                                      (static_cast<std::size_t>(y) +
                                       static_cast<std::size_t>(grid.size[1]) * static_cast<std::size_t>(z));
              const std::int32_t plane = kernels[2][static_cast<std::size_t>(std::abs(dz))] *
                                         kernels[1][static_cast<std::size_t>(std::abs(dy))];
              for (int dx = lo[0]; dx <= hi[0]; ++dx) {
                const int x = std::clamp(v[0] + dx, 0, grid.size[0] - 1);
                const Label label = grid.labels[row + static_cast<std::size_t>(x)];
                if (sums[label] == 0) touched.push_back(label);
                sums[label] += plane * kernels[0][static_cast<std::size_t>(std::abs(dx))];
              }
            }
          }
          std::sort(touched.begin(), touched.end());
          for (const Label label : touched) {
            out.labels.push_back(label);
            out.weights.push_back(sums[label]);
            sums[label] = 0;
          }
        }
        out.offsets[voxel + 1] = static_cast<std::uint32_t>(out.labels.size());
      }
  return out;
}

std::vector<Label> settle_winners(const LabelGrid& grid, VoxelWeights& weights, FieldLedger& ledger) {
  std::vector<Label> labels = grid.labels;
  std::vector<Flip> flips;
  for (std::size_t v = 0; v < labels.size(); ++v) {
    const Label winner = winner_at(weights, v, labels[v]);
    if (winner != labels[v]) flips.push_back({v, winner, true});
  }
  if (flips.empty()) return labels;
  drop_specks(grid, flips, labels, ledger);

  const std::array<std::ptrdiff_t, 27> steps = neighbour_steps(grid.size);
  for (bool changed = true; changed;) {
    changed = false;
    for (Flip& flip : flips) {
      if (!flip.open) continue;
      if (!is_simple(neighbourhood(labels, steps, flip.voxel, labels[flip.voxel])) ||
          !is_simple(neighbourhood(labels, steps, flip.voxel, flip.winner)))
        continue;
      labels[flip.voxel] = flip.winner;
      flip.open = false;
      changed = true;
      ++ledger.flipped_voxels;
    }
  }
  for (const Flip& flip : flips) {
    if (!flip.open) continue;
    ++ledger.retained_voxels;
    std::int32_t best = std::numeric_limits<std::int32_t>::min();
    std::uint32_t own = weights.offsets[flip.voxel];
    for (std::uint32_t e = weights.offsets[flip.voxel]; e < weights.offsets[flip.voxel + 1]; ++e) {
      best = std::max(best, weights.weights[e]);
      if (weights.labels[e] == labels[flip.voxel]) own = e;
    }
    weights.weights[own] = best + kRetainMargin;
  }
  return labels;
}

std::vector<std::uint32_t> label_components(const std::array<int, 3>& size, const std::vector<Label>& labels,
                                            std::vector<std::uint32_t>& sizes) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  const std::size_t count = labels.size();
  std::vector<std::uint32_t> parent(count);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const std::size_t sx = static_cast<std::size_t>(size[0]), sxy = sx * static_cast<std::size_t>(size[1]);
  for (std::size_t v = 0; v < count; ++v) {
    std::uint32_t own = static_cast<std::uint32_t>(v);
    parent[v] = own;
    const std::size_t x = v % sx, y = v / sx % static_cast<std::size_t>(size[1]), z = v / sxy;
    const auto join = [&](std::size_t other) {
      if (labels[other] != labels[v]) return;
      const std::uint32_t r = root(static_cast<std::uint32_t>(other));
      if (r == own) return;
      parent[std::max(r, own)] = std::min(r, own);
      own = std::min(r, own);
    };
    if (x > 0) join(v - 1);
    if (y > 0) join(v - sx);
    if (z > 0) join(v - sxy);
  }
  std::vector<std::uint32_t> ids(count, kNone);
  sizes.clear();
  for (std::size_t v = 0; v < count; ++v) {
    const std::uint32_t r = root(static_cast<std::uint32_t>(v));
    if (r == v) {
      ids[v] = static_cast<std::uint32_t>(sizes.size());
      sizes.push_back(0);
    } else {
      ids[v] = ids[r];
    }
    ++sizes[ids[v]];
  }
  return ids;
}

}  // namespace voxtet::remesh
