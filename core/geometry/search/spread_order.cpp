#include "geometry/search/spread_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

namespace voxtet {
namespace {

/// For each cell the number of the last group that has an item there; cells that share a bucket count as one.
class LastGroups {
 public:
  explicit LastGroups(std::span<const Eigen::AlignedBox3d> zones)
      : cells_per_mm_(1 / cell_mm_for(zones)), ends_(std::bit_ceil(8 * zones.size() + 64), 0) {}

  /// The first group after those of all cells that a zone covers, which then have it, too.
  std::uint32_t place(const Eigen::AlignedBox3d& zone) {
    buckets_.clear();
    std::uint32_t group = 0;
    const auto low = cell_of(zone.min()), high = cell_of(zone.max());
    for (auto k = low[2]; k <= high[2]; ++k)
      for (auto j = low[1]; j <= high[1]; ++j)
        for (auto i = low[0]; i <= high[0]; ++i) {
          buckets_.push_back(bucket(i, j, k));
          group = std::max(group, ends_[buckets_.back()]);
        }
    for (const std::size_t at : buckets_) ends_[at] = group + 1;
    return group;
  }

 private:
  /// At least the cubic mean of the zones' sizes: then they cover some eight cells each, on average.
  static double cell_mm_for(std::span<const Eigen::AlignedBox3d> zones) {
    double cubes = 0, fourths = 0;
    for (const Eigen::AlignedBox3d& zone : zones) {
      const double size_mm = zone.sizes().maxCoeff(), cube = size_mm * size_mm * size_mm;
      cubes += cube;
      fourths += cube * size_mm;
    }
    return cubes > 0 ? fourths / cubes : 1;
  }
  Eigen::Vector<std::int64_t, 3> cell_of(const Eigen::Vector3d& p) const {
    return (p * cells_per_mm_).array().floor().cast<std::int64_t>();
  }
  std::size_t bucket(std::int64_t i, std::int64_t j, std::int64_t k) const {
    const std::uint64_t hash = static_cast<std::uint64_t>(i) + static_cast<std::uint64_t>(j) * 73856093U +
                               static_cast<std::uint64_t>(k) * 19349663U;
    return static_cast<std::size_t>(hash & (ends_.size() - 1));
  }

  double cells_per_mm_;
  std::vector<std::uint32_t> ends_;  ///< one more than the last group
  std::vector<std::size_t> buckets_;
};

}  // namespace

Buckets<std::uint32_t> in_groups(std::span<const std::uint32_t> groups) {
  Buckets<std::uint32_t> items(groups.empty() ? 0 : *std::max_element(groups.begin(), groups.end()) + 1);
  for (const std::uint32_t group : groups) items.count(group);
  items.allocate();
  for (std::uint32_t i = 0; i < groups.size(); ++i) items.add(groups[i], i);
  return items;
}

Buckets<std::uint32_t> spread_order(std::span<const Eigen::AlignedBox3d> zones) {
  LastGroups last(zones);
  std::vector<std::uint32_t> groups;
  groups.reserve(zones.size());
  for (const Eigen::AlignedBox3d& zone : zones) groups.push_back(last.place(zone));
  return in_groups(groups);
}

}  // namespace voxtet
