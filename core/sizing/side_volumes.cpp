#include "sizing/side_volumes.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "geometry/grid/distance_transform.h"
#include "types/grid_corners.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

Error refuse(ErrorCode code, const std::string& name, const std::string& message) {
  return {code, kSizingStage, name + ": " + message, {}};
}

/// Offset of the grid point nearest to a continuous index, if there is one within half a step.
bool nearest_offset(const Grid& grid, const Eigen::Vector3d& index, std::size_t& offset) {
  offset = 0;
  for (int d = 2; d >= 0; --d) {
    const int n = grid.size[static_cast<std::size_t>(d)];
    if (!(index[d] >= -0.5 && index[d] < n - 0.5)) return false;
    offset = offset * static_cast<std::size_t>(n) + static_cast<std::size_t>(index[d] + 0.5);
  }
  return true;
}

/// Calls visit(offset, index) for all points of a grid.
template <class Visit>
void for_points(const Grid& grid, Visit&& visit) {
  grid.visit([&](int i, int j, int k, std::size_t at) { visit(at, Eigen::Vector4d(i, j, k, 1)); });
}

Eigen::Vector3d mapped(const Eigen::Matrix4d& by, const Eigen::Vector4d& index) {
  return (by * index).head<3>();
}

/// The size of each label of a mask, +infinity for those without one.
Result<std::vector<float>> sizes_of(const LabelVolume& mask, const MaskSize& rule, const std::string& name) {
  if (rule.edges.empty())
    return refuse(ErrorCode::kUsage, name + ".edges", "found none, expected a size for a label of the mask");
  std::vector<std::uint8_t> held(65536, 0);
  for (const Label label : mask.labels) held[label] = 1;
  std::vector<float> size_of(65536, kFar);
  for (std::size_t e = 0; e < rule.edges.size(); ++e) {
    const auto& [label, edge_mm] = rule.edges[e];
    const std::string field = name + ".edges[" + std::to_string(e) + "]";
    if (!(std::isfinite(edge_mm) && edge_mm > 0))
      return refuse(ErrorCode::kUsage, field + ".edge_mm",
                    "found " + std::to_string(edge_mm) + ", expected a finite length > 0 mm");
    if (label == kBackground || !held[label])
      return refuse(ErrorCode::kUsage, field + ".label",
                    "found " + std::to_string(label) + ", which the mask '" + rule.name + "' does not hold");
    if (size_of[label] < kFar)
      return refuse(ErrorCode::kUsage, field + ".label",
                    "label " + std::to_string(label) + " has a size already");
    size_of[label] = static_cast<float>(edge_mm);
  }
  return size_of;
}

std::optional<Error> find_image_error(const ScalarVolume& image, const std::string& name) {
  const auto nx = static_cast<std::size_t>(image.size[0]), ny = static_cast<std::size_t>(image.size[1]);
  for (std::size_t at = 0; at < image.values.size(); ++at) {
    const float value = image.values[at];
    if (std::isnan(value) || (value >= 0 && value < kFar)) continue;
    return refuse(ErrorCode::kBadInput, name,
                  "voxel (" + std::to_string(at % nx) + ", " + std::to_string(at / nx % ny) + ", " +
                      std::to_string(at / nx / ny) + ") asks for an edge of " + std::to_string(value) +
                      " mm; expected a finite length > 0, or 0 for none");
  }
  return std::nullopt;
}

/// The image's size at a continuous index, trilinear among its voxels that have one; 0 for no rule.
double size_at(const ScalarVolume& image, const Eigen::Vector3d& index) {
  std::size_t inside = 0;
  if (!nearest_offset(image, index, inside)) return 0;
  double sum = 0, weights = 0;
  for_grid_corners(image.size, index, [&](std::size_t corner, double weight) {
    if (!(image.values[corner] > 0)) return;
    sum += weight * image.values[corner];
    weights += weight;
  });
  return weights > 0 ? sum / weights : 0;
}

}  // namespace

Status lower_by_mask(const LabelVolume& mask, const MaskSize& rule, const std::string& name,
                     SizingField& field) {
  const Result<std::vector<float>> size_of = sizes_of(mask, rule, name);
  if (!size_of) return size_of.error();
  bool reached = false;
  const auto lower = [&](std::size_t to, std::size_t from) {
    const float size = (*size_of)[mask.labels[from]];
    field.h_mm[to] = std::min(field.h_mm[to], size);
    reached = reached || size < kFar;
  };
  const Eigen::Matrix4d to_mask = mask.index_to_mm.inverse() * field.index_to_mm;
  for_points(field, [&](std::size_t at, const Eigen::Vector4d& index) {
    if (std::size_t from = 0; nearest_offset(mask, mapped(to_mask, index), from)) lower(at, from);
  });
  const Eigen::Matrix4d to_field = field.mm_to_index * mask.index_to_mm;
  for_points(mask, [&](std::size_t at, const Eigen::Vector4d& index) {
    if (std::size_t to = 0; nearest_offset(field, mapped(to_field, index), to)) lower(to, at);
  });
  if (reached) return std::monostate{};
  return refuse(ErrorCode::kUsage, name,
                "no voxel of the mask '" + rule.name +
                    "' that has a size lies in the volume; expected one painted in the same space");
}

Status lower_by_image(const LabelVolume& volume, const ScalarVolume& image, const std::string& name,
                      const SizingParams& params, const SizingField& grid, std::vector<float>& sizes,
                      RunContext& ctx) {
  if (const auto error = find_image_error(image, name)) return *error;
  const Eigen::Matrix4d to_image = image.index_to_mm.inverse() * grid.index_to_mm;
  const Eigen::Matrix4d to_volume = volume.index_to_mm.inverse() * grid.index_to_mm;
  std::size_t labelled = 0, sized = 0;
  double smallest = kFar, largest = 0;
  for_points(grid, [&](std::size_t at, const Eigen::Vector4d& index) {
    std::size_t voxel = 0;
    const bool counts =
        nearest_offset(volume, mapped(to_volume, index), voxel) && volume.labels[voxel] != kBackground;
    labelled += counts;
    const double size = size_at(image, mapped(to_image, index));
    if (!(size > 0)) return;
    if (counts) {
      ++sized;
      smallest = std::min(smallest, size);
      largest = std::max(largest, size);
    }
    sizes[at] = std::min(sizes[at], static_cast<float>(size));
  });
  if (sized == 0)
    return refuse(ErrorCode::kBadInput, name,
                  "the image has no size in any labelled voxel; expected one that covers what is meshed");
  const auto warn = [&](const char* format, auto... numbers) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), format, numbers...);
    ctx.warn(kSizingStage, name + text.data());
  };
  if (sized < labelled)
    warn(": the image has no size in %.2f %% of the labelled voxels; edge_mm stands there",
         100.0 * static_cast<double>(labelled - sized) / static_cast<double>(labelled));
  if (smallest < params.edge_min_mm)
    warn(": sizes go down to %g mm, below sizing.edge_min_mm, which holds: %g mm", smallest,
         params.edge_min_mm);
  if (largest > params.edge_max_mm)
    warn(": sizes go up to %g mm, above sizing.edge_max_mm, which holds: %g mm", largest, params.edge_max_mm);
  return std::monostate{};
}

}  // namespace voxtet
