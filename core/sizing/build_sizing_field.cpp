#include "sizing/build_sizing_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>

#include "base/wave_speed_error.h"
#include "geometry/elements/region_distance.h"
#include "geometry/grid/distance_transform.h"
#include "geometry/grid/fast_sweeping.h"
#include "sizing/check_sizing_params.h"
#include "sizing/curvature_size.h"
#include "sizing/edge_lengths.h"
#include "sizing/side_volumes.h"
#include "sizing/thickness_size.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

constexpr int kPadding = 2;

std::optional<Error> find_volume_error(const LabelVolume& volume) {
  const auto refuse = [](const char* message) {
    return Error{ErrorCode::kBadInput, kSizingStage, message, {}};
  };
  if (volume.labels.empty() || volume.labels.size() != volume.voxel_count())
    return refuse("volume: expected size[0] * size[1] * size[2] labels and at least one");
  if (!volume.index_to_mm.allFinite() || !(volume.voxel_mm3() > 0))
    return refuse("volume: expected a finite index_to_mm with a determinant that is not 0");
  return std::nullopt;
}

/// The grid of the volume with `kPadding` points more on each side, all of them +infinity.
SizingField padded_grid(const LabelVolume& volume) {
  SizingField field;
  for (std::size_t d = 0; d < 3; ++d) field.size[d] = volume.size[d] + 2 * kPadding;
  field.index_to_mm = volume.index_to_mm;
  field.index_to_mm.topRightCorner<3, 1>() = volume.to_mm(Eigen::Vector3d::Constant(-kPadding));
  field.invert();
  field.h_mm.assign(field.voxel_count(), kFar);
  return field;
}

/// Calls visit(label of the voxel, offset in the field) for every voxel.
template <class Visit>
void for_each_voxel(const LabelVolume& volume, const SizingField& field, Visit visit) {
  volume.visit([&](int i, int j, int k, std::size_t at) {
    visit(volume.labels[at], field.offset(i + kPadding, j + kPadding, k + kPadding));
  });
}

/// Sizes that hold in place of edge_mm where they are finite.
using BaseSizes = std::vector<float>;

void add_label_sizes(const LabelVolume& volume, const SizingParams& params, const BaseSizes& base,
                     SizingField& field) {
  std::vector<float> size_of(65536, kFar);
  for (const LabelSize& rule : params.labels) size_of[rule.label] = static_cast<float>(rule.edge_mm);
  const auto edge = static_cast<float>(params.edge_mm);
  for_each_voxel(volume, field, [&](Label label, std::size_t at) {
    if (label == kBackground) return;
    const float size = std::min(size_of[label], base.empty() ? kFar : base[at]);
    field.h_mm[at] = size < kFar ? size : edge;
  });
}

void add_wave_size(const LabelVolume& volume, const WaveSize& rule, SizingField& field) {
  const auto edge = static_cast<float>(edge_of(rule));
  std::vector<bool> concerned(65536, rule.labels.empty());
  for (const Label label : rule.labels) concerned[label] = true;
  for_each_voxel(volume, field, [&](Label label, std::size_t at) {
    if (label != kBackground && concerned[label]) field.h_mm[at] = std::min(field.h_mm[at], edge);
  });
}

bool add_distance_size(const LabelVolume& volume, const DistanceSize& rule, SizingField& field,
                       const RunContext& ctx) {
  const Eigen::Matrix3d linear = volume.linear();
  std::vector<float> size;
  if (has_orthogonal_axes(linear)) {
    std::vector<std::uint8_t> mask(field.h_mm.size(), 0);
    for_each_voxel(volume, field, [&](Label label, std::size_t at) { mask[at] = label == rule.label; });
    size = distance_to_mask_mm(field.size, volume.spacing_mm(), mask);
    for (float& value : size) value = static_cast<float>(rule.edge_mm + rule.slope * value);
  } else {
    size.assign(field.h_mm.size(), kFar);
    for_each_voxel(volume, field, [&](Label label, std::size_t at) {
      if (label == rule.label) size[at] = static_cast<float>(rule.edge_mm);
    });
    if (!limit_gradation(field.size, linear, rule.slope, size, ctx)) return false;
  }
  for (std::size_t at = 0; at < size.size(); ++at) field.h_mm[at] = std::min(field.h_mm[at], size[at]);
  return true;
}

/// The range of grid indices along each axis in which a box of mm can have points.
struct IndexBox {
  std::array<int, 3> low{}, high{};  ///< high is one past the end
};

IndexBox index_box(const SizingField& field, const Eigen::Vector3d& low_mm, const Eigen::Vector3d& high_mm) {
  const Eigen::Matrix3d to_index = field.mm_to_index.topLeftCorner<3, 3>();
  const Eigen::Vector3d middle = field.to_index((low_mm + high_mm) / 2);
  const Eigen::Vector3d half = to_index.cwiseAbs() * ((high_mm - low_mm) / 2);
  IndexBox box;
  for (int d = 0; d < 3; ++d) {
    const double end = field.size[d];
    box.low[d] = static_cast<int>(std::clamp(std::floor(middle[d] - half[d]), 0.0, end));
    box.high[d] = static_cast<int>(std::clamp(std::ceil(middle[d] + half[d]) + 1, 0.0, end));
  }
  return box;
}

/// `around` holds the sizes without any region, so that the order of regions does not matter. False if no
/// grid point lies in the region or its band.
bool add_region_size(const SizeRegion& region, double edge_max_mm, const std::vector<float>& around,
                     SizingField& field) {
  const RegionDistance distance(region);
  const IndexBox box = index_box(field, distance.low(region.band_mm), distance.high(region.band_mm));
  bool reached = false;
  for (int k = box.low[2]; k < box.high[2]; ++k)
    for (int j = box.low[1]; j < box.high[1]; ++j)
      for (int i = box.low[0]; i < box.high[0]; ++i) {
        const Eigen::Vector3d point = field.index_to_mm.topLeftCorner<3, 3>() * Eigen::Vector3d(i, j, k) +
                                      field.index_to_mm.topRightCorner<3, 1>();
        const double d = distance.at(point);
        if (d > 0 && d >= region.band_mm) continue;
        const std::size_t at = field.offset(i, j, k);
        const double outer = std::min<double>(around[at], edge_max_mm);
        const double size =
            d > 0 ? region.edge_mm + (outer - region.edge_mm) * (d / region.band_mm) : region.edge_mm;
        field.h_mm[at] = std::min(field.h_mm[at], static_cast<float>(size));
        reached = true;
      }
  return reached;
}

void warn_of_clamped(const SizingParams& params, const RunContext& ctx) {
  for_each_edge_length(params, [&](const std::string& field, double edge_mm) {
    const bool low = edge_mm < params.edge_min_mm;
    if (!low && !(edge_mm > params.edge_max_mm)) return;
    char text[160];
    std::snprintf(text, sizeof text, ": %g mm is %s, which holds: %g mm", edge_mm,
                  low ? "below sizing.edge_min_mm" : "above sizing.edge_max_mm",
                  low ? params.edge_min_mm : params.edge_max_mm);
    ctx.warn(kSizingStage, "sizing." + field + text);
  });
}

}  // namespace

double edge_of(const WaveSize& rule) {
  constexpr double kSpeedPerRoot = 1.0866;  // of a plane wave, for a diffusivity of 1 mm^2/ms
  const double root = rule.speed_mm_per_ms / kSpeedPerRoot;
  return edge_for_wave_speed_error(rule.error_percent, root * root, rule.consistent_mass);
}

Result<SizingField> build_sizing_field(const LabelVolume& volume, const SizingParams& params, RunContext& ctx,
                                       const SizingSources& sources) {
  if (const auto error = find_volume_error(volume)) return *error;
  if (const auto error = find_sizing_error(volume, params)) return *error;
  warn_of_clamped(params, ctx);
  ctx.progress(kSizingStage, 0);
  SizingField field = padded_grid(volume);
  BaseSizes base;
  if (!sources.walls.empty() || !sources.images.empty()) base.assign(field.h_mm.size(), kFar);
  for (std::size_t w = 0; w < sources.walls.size(); ++w)
    lower_by_thickness(sources.walls[w], params.thickness[w], field, base);
  for (std::size_t i = 0; i < sources.images.size(); ++i)
    if (Status done = lower_by_image(volume, *sources.images[i], "sizing.images[" + std::to_string(i) + "]",
                                     params, field, base, ctx);
        !done)
      return done.error();
  add_label_sizes(volume, params, base, field);
  for (const WaveSize& rule : params.waves) add_wave_size(volume, rule, field);
  for (const DistanceSize& rule : params.distances) {
    if (ctx.cancelled() || !add_distance_size(volume, rule, field, ctx)) return cancelled_error(kSizingStage);
  }
  for (std::size_t m = 0; m < sources.masks.size(); ++m)
    if (Status done = lower_by_mask(*sources.masks[m], params.masks[m],
                                    "sizing.masks[" + std::to_string(m) + "]", field);
        !done)
      return done.error();
  if (sources.surface)
    lower_by_curvature(*sources.surface, params.curvature, volume.smallest_spacing_mm(), field);
  ctx.progress(kSizingStage, 0.3);
  if (!params.regions.empty()) {
    const std::vector<float> around = field.h_mm;
    for (std::size_t r = 0; r < params.regions.size(); ++r) {
      if (ctx.cancelled()) return cancelled_error(kSizingStage);
      if (!add_region_size(params.regions[r], params.edge_max_mm, around, field))
        ctx.warn(kSizingStage, "sizing.regions[" + std::to_string(r) + "] '" + params.regions[r].name +
                                   "' and its band hold no voxel of the volume: it changes nothing");
    }
  }
  const float least = static_cast<float>(params.edge_min_mm);
  const float most = static_cast<float>(params.edge_max_mm);
  for (float& h : field.h_mm) h = std::clamp(h, least, most);
  ctx.progress(kSizingStage, 0.5);
  if (!limit_gradation(field.size, volume.linear(), params.gradation, field.h_mm, ctx))
    return cancelled_error(kSizingStage);
  ctx.progress(kSizingStage, 1);
  return field;
}

}  // namespace voxtet
