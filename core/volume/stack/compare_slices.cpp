#include "volume/stack/compare_slices.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "geometry/topology/label_components.h"
#include "types/stage_names.h"

namespace voxtet::slices {
namespace {

constexpr double kVolumeChange = 0.01;

/// Voxels - pairs + squares + cubes of equal neighbours, for each label (65536 entries).
std::vector<std::int64_t> euler_numbers(const LabelVolume& volume) {
  std::vector<std::int64_t> euler(65536, 0);
  volume.visit([&](int i, int j, int k, std::size_t voxel) {
    const Label label = volume.labels[voxel];
    if (label == kBackground) return;
    const auto like = [&](int di, int dj, int dk) {
      return volume.at_or_background(i + di, j + dj, k + dk) == label;
    };
    const bool x = like(1, 0, 0), y = like(0, 1, 0), z = like(0, 0, 1);
    const bool xy = x && y && like(1, 1, 0), yz = y && z && like(0, 1, 1), zx = z && x && like(1, 0, 1);
    const bool cube = xy && yz && zx && like(1, 1, 1);
    euler[label] += 1 - (x + y + z) + (xy + yz + zx) - cube;
  });
  return euler;
}

std::string shown(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string grid_of(const LabelVolume& volume) {
  const Eigen::Vector3d spacing = volume.spacing_mm();
  std::string text;
  for (int d = 0; d < 3; ++d)
    text += (d ? " x " : "") + std::to_string(volume.size[static_cast<std::size_t>(d)]);
  for (int d = 0; d < 3; ++d) text += (d ? " x " : " voxels of ") + shown(spacing[d], "%.3g");
  return text + " mm";
}

void add(std::string& list, const std::string& text) {
  list += (list.empty() ? "" : ", ") + text;
}

}  // namespace

void compare_slices(const LabelVolume& before, const LabelVolume& after, const RunContext& ctx) {
  std::vector<double> mm3(65536, 0), change(65536, 0);
  for (const Label label : before.labels) mm3[label] += before.voxel_mm3();
  for (const Label label : after.labels) change[label] += after.voxel_mm3();
  const std::vector<std::uint32_t> parts = count_components(before.size, before.labels),
                                   parts_after = count_components(after.size, after.labels);
  const std::vector<std::int64_t> euler = euler_numbers(before), euler_after = euler_numbers(after);
  double largest = 0;
  std::string topology, grown, worse;
  for (std::size_t label = 1; label < mm3.size(); ++label) {
    if (mm3[label] <= 0) continue;
    const std::string name = "label " + std::to_string(label);
    const double share = change[label] / mm3[label] - 1;
    largest = std::max(largest, std::abs(share));
    if (std::abs(share) > kVolumeChange) add(grown, name + " by " + shown(100 * share, "%+.2f") + " %");
    const std::string counts = std::to_string(parts[label]) + " to " + std::to_string(parts_after[label]);
    const std::string numbers = name + " " + counts + " and " + std::to_string(euler[label]) + " to " +
                                std::to_string(euler_after[label]);
    if (parts_after[label] != parts[label] || euler_after[label] != euler[label]) add(topology, numbers);
    // Tunnels less cavities. Fewer of them are no loss: slices that are apart enclose gaps that nobody has.
    const std::int64_t tunnels = parts[label] - euler[label],
                       tunnels_after = parts_after[label] - euler_after[label];
    if (parts_after[label] > parts[label] || tunnels_after > tunnels) add(worse, numbers);
  }
  ctx.note(kVolumeStage, "thick slices interpolated: " + grid_of(before) + " to " + grid_of(after) +
                             "; label volumes kept within " + shown(100 * largest, "%.2f") + " %");
  if (!topology.empty())
    ctx.note(kVolumeStage, "components and Euler number after interpolation: " + topology);
  if (!grown.empty())
    ctx.warn(kVolumeStage, "interpolation changed the volume of " + grown +
                               "; volume.slice_ratio=0 keeps the slices as they are");
  if (!worse.empty())
    ctx.warn(kVolumeStage,
             "interpolation split labels or opened tunnels in them, components and Euler number: " + worse);
}

}  // namespace voxtet::slices
