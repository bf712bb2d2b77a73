#include "volume/stack/interpolate_slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "geometry/topology/label_components.h"
#include "types/stage_names.h"
#include "volume/stack/balance_offsets.h"
#include "volume/stack/compare_slices.h"
#include "volume/stack/slice_gap.h"
#include "volume/stack/slice_stack.h"

namespace voxtet {
namespace {

using slices::Candidate;
using slices::Contacts;
using slices::SliceDistances;
using slices::SliceGap;
using slices::SliceStack;

/// Distances are measured up to so many slice steps: what is deeper in a region that ends between two slices
/// is a cut.
constexpr double kReach = 3;
/// Passes over what must be kept apart.
constexpr int kSeparations = 8;
/// Volumes are balanced again, for what absorbing and setting apart took, while a label is off by more.
constexpr double kVolumeError = 0.001;
constexpr int kRounds = 6;
/// A label on one or two slices that is off by more after that keeps them as slabs.
constexpr double kNotCarried = 0.03;
constexpr double kMaxVoxels = 1 << 30;

/// Spacings of an oblique header are rounded by so much: of equal ratios none is above the other.
constexpr double kRounding = 1e-3;

/// Whatever the ratio asked for, spacings that differ by rounding alone are no slices and pixels.
bool is_thick(double spacing, double smallest, double ratio) {
  constexpr double kLeastRatio = 1.01;
  return spacing > std::max(ratio, kLeastRatio) * (1 + kRounding) * smallest;
}

/// Odd, at least 3, nearest to the ratio of the spacings (the lower of equals).
int planes_per_slice(double ratio) {
  return std::max(3, 2 * static_cast<int>(std::floor(ratio / 2 * (1 - kRounding))) + 1);
}

Result<std::vector<SliceGap>> interpolate_gaps(const SliceStack& stack, const std::vector<Contacts>& contacts,
                                               int planes, const RunContext& ctx) {
  const double far_mm = kReach * stack.step_mm;
  std::array<std::optional<SliceDistances>, 4> window;  // slices lower - 1 ... lower + 2
  std::vector<SliceGap> gaps;
  for (int lower = -1; lower + 1 < stack.count; ++lower) {
    for (std::size_t i = 0; i < 3; ++i) window[i] = std::move(window[i + 1]);
    window[3].reset();
    if (lower < 0) {
      window[2] = slices::slice_distances(stack, 0, far_mm);
      if (stack.count > 1) window[3] = slices::slice_distances(stack, 1, far_mm);
      continue;
    }
    if (ctx.cancelled()) return cancelled_error(kVolumeStage);
    ctx.progress(kVolumeStage, static_cast<double>(lower) / stack.count);
    if (lower + 2 < stack.count) window[3] = slices::slice_distances(stack, lower + 2, far_mm);
    std::array<const SliceDistances*, 4> near{};
    for (std::size_t i = 0; i < 4; ++i) near[i] = window[i] ? &*window[i] : nullptr;
    gaps.push_back(
        slices::interpolate_gap(stack, contacts[static_cast<std::size_t>(lower)], lower, near, planes));
  }
  return gaps;
}

/// Every plane with the labels of the slice it is nearest to.
SliceStack repeat_slices(const SliceStack& stack, int planes) {
  SliceStack fine = stack;
  fine.count *= planes;
  fine.step_mm /= planes;
  fine.pixels.clear();
  fine.pixels.reserve(stack.pixels.size() * static_cast<std::size_t>(planes));
  for (int k = 0; k < stack.count; ++k)
    for (int plane = 0; plane < planes; ++plane)
      fine.pixels.insert(fine.pixels.end(), stack.slice(k), stack.slice(k) + stack.area());
  return fine;
}

/// Voxels that each label is to have among the candidates: an equal share of both slices' labels in every
/// column, which adds up to the slices' own volumes.
std::vector<double> wanted_voxels(const SliceStack& stack, const std::vector<SliceGap>& gaps, int planes) {
  std::vector<double> wanted(65536, 0);
  for (const SliceGap& gap : gaps)
    for (const std::uint32_t column : gap.columns) {
      wanted[stack.slice(gap.lower)[column]] += (planes - 1) / 2;
      wanted[stack.slice(gap.lower + 1)[column]] += (planes - 1) / 2;
    }
  return wanted;
}

/// First plane between slice `lower` and the next.
int first_plane(int lower, int planes) {
  return lower * planes + (planes + 1) / 2;
}

void fill_gap(SliceStack& fine, const SliceGap& gap, int planes, const std::vector<double>& offsets) {
  const Candidate* candidate = gap.candidates.data();
  for (const std::uint32_t column : gap.columns)
    for (int m = 0; m + 1 < planes; ++m)
      fine.slice(first_plane(gap.lower, planes) + m)[column] = settle(*candidate++, offsets);
}

/// Whether a voxel has a face neighbour of a label.
bool beside(const SliceStack& stack, std::size_t voxel, Label label) {
  bool found = false;
  for_face_neighbours({stack.width, stack.height, stack.count}, voxel,
                      [&](std::size_t other, std::size_t) { found = found || stack.pixels[other] == label; });
  return found;
}

/// The label that a voxel between two slices should have instead, where it touches, be it by a corner, one
/// that it touches in neither slice: one that touches both there, and this voxel by a face, so that no piece
/// of it floats. Its own label where nothing is to be done.
Label set_apart(const SliceStack& fine, const SliceGap& gap, const Contacts& contacts, std::uint32_t column,
                int z) {
  const int x = static_cast<int>(column) % fine.width, y = static_cast<int>(column) / fine.width;
  const std::size_t voxel = static_cast<std::size_t>(z) * fine.area() + column;
  const Label own = fine.pixels[voxel];
  Label apart = own;  // the lowest of several, whatever the direction they come from
  for (int d = 0; d < 27; ++d) {
    const int dx = d % 3 - 1, dy = d / 3 % 3 - 1, dz = d / 9 - 1;
    if (x + dx < 0 || y + dy < 0 || x + dx >= fine.width || y + dy >= fine.height) continue;
    const std::size_t pixel = static_cast<std::size_t>(x + dx) +
                              static_cast<std::size_t>(fine.width) * static_cast<std::size_t>(y + dy);
    const Label other = fine.slice(z + dz)[pixel];
    if (other == own || gap.flat[pixel] || contacts.touch(own, other)) continue;
    for (const Label between : contacts.separators(own, other)) {
      if (!beside(fine, voxel, between)) continue;
      if (apart == own || between < apart) apart = between;
      break;
    }
  }
  return apart;
}

/// set_apart for all voxels of a gap, as they are before the pass. Returns the number of voxels changed.
std::size_t separate(SliceStack& fine, const SliceGap& gap, const Contacts& contacts, int planes) {
  std::vector<std::pair<Label*, Label>> changes;
  for (const std::uint32_t column : gap.columns) {
    if (gap.flat[column]) continue;
    for (int m = 0; m + 1 < planes; ++m) {
      const int z = first_plane(gap.lower, planes) + m;
      const Label label = set_apart(fine, gap, contacts, column, z);
      if (label != fine.slice(z)[column]) changes.emplace_back(fine.slice(z) + column, label);
    }
  }
  for (const auto& [voxel, label] : changes) *voxel = label;
  return changes.size();
}

/// Components that no slice has a part of and that are smaller than a cube of a slice's thickness go to the
/// neighbour with the largest face area, the smallest first.
void absorb_small_components(SliceStack& fine, int planes) {
  const std::array<int, 3> size{fine.width, fine.height, fine.count};
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> ids = label_components(size, fine.pixels, sizes);
  std::vector<bool> anchored(sizes.size(), false);
  for (int k = planes / 2; k < fine.count; k += planes)
    for (std::size_t p = 0; p < fine.area(); ++p)
      anchored[ids[static_cast<std::size_t>(k) * fine.area() + p]] = true;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> components;  // by size, id
  for (std::size_t v = 0; v < ids.size(); ++v)
    if (!anchored[ids[v]] && sizes[ids[v]] < static_cast<std::uint32_t>(planes * planes * planes))
      components[{sizes[ids[v]], ids[v]}].push_back(v);
  const auto [a, b] = fine.pixel_mm;
  for (const auto& [key, voxels] : components) {
    const Label other =
        neighbour_by_area(size, fine.pixels, voxels, {b * fine.step_mm, a * fine.step_mm, a * b});
    for (const std::size_t voxel : voxels) fine.pixels[voxel] = other;
  }
}

/// All planes, their labels' outlines moved by `offsets`.
SliceStack settle_planes(const SliceStack& stack, const std::vector<SliceGap>& gaps,
                         const std::vector<Contacts>& contacts, int planes,
                         const std::vector<double>& offsets) {
  SliceStack fine = repeat_slices(stack, planes);
  for (const SliceGap& gap : gaps) fill_gap(fine, gap, planes, offsets);
  absorb_small_components(fine, planes);
  for (std::size_t g = 0; g < gaps.size(); ++g)
    for (int pass = 0; pass < kSeparations; ++pass)
      if (separate(fine, gaps[g], contacts[g], planes) == 0) break;
  return fine;
}

/// Voxels of each label, each counted `times`.
std::vector<double> voxels_by_label(const SliceStack& stack, int times) {
  std::vector<double> voxels(65536, 0);
  for (const Label label : stack.pixels) voxels[label] += times;
  return voxels;
}

/// The planes of a stack whose labels have their volumes as nearly as can be had.
struct Balanced {
  SliceStack planes;
  std::vector<double> error;  ///< of each label's volume, as a share of it
};

Result<Balanced> balance(const SliceStack& stack, const std::vector<SliceGap>& gaps,
                         const std::vector<Contacts>& contacts, int planes, const RunContext& ctx) {
  std::vector<double> wanted = wanted_voxels(stack, gaps, planes);
  const std::vector<double> target = voxels_by_label(stack, planes);
  Balanced best;
  double least = 0;
  for (int round = 0; round < kRounds; ++round) {
    if (ctx.cancelled()) return cancelled_error(kVolumeStage);
    SliceStack fine = settle_planes(stack, gaps, contacts, planes,
                                    balance_offsets(gaps, wanted, stack.smallest_pixel_mm()));
    const std::vector<double> found = voxels_by_label(fine, 1);
    std::vector<double> error(target.size(), 0);
    double largest = 0;
    for (std::size_t label = 0; label < target.size(); ++label) {
      wanted[label] += target[label] - found[label];
      if (target[label] > 0) error[label] = std::abs(found[label] - target[label]) / target[label];
      largest = std::max(largest, error[label]);
    }
    if (round == 0 || largest < least) {
      least = largest;
      best = {std::move(fine), std::move(error)};
    }
    if (least <= kVolumeError) break;
  }
  return best;
}

/// Labels (65536 entries) that are on no three slices in a row.
std::vector<bool> flat_labels(const SliceStack& stack) {
  std::vector<int> run(65536, 0), last(65536, -1), longest(65536, 0);
  for (int k = 0; k < stack.count; ++k)
    for (const Label* pixel = stack.slice(k); pixel < stack.slice(k) + stack.area(); ++pixel) {
      if (last[*pixel] == k) continue;
      run[*pixel] = last[*pixel] == k - 1 ? run[*pixel] + 1 : 1;
      last[*pixel] = k;
      longest[*pixel] = std::max(longest[*pixel], run[*pixel]);
    }
  std::vector<bool> flat(longest.size());
  for (std::size_t label = 0; label < flat.size(); ++label) flat[label] = longest[label] < 3;
  return flat;
}

/// Keeps as slabs what interpolation does not carry, and returns its names; empty if it carries all.
std::string keep_slabs(const SliceStack& stack, const std::vector<double>& error,
                       std::vector<SliceGap>& gaps) {
  const std::vector<bool> flat = flat_labels(stack);
  std::vector<bool> slabs(error.size(), false);
  std::string names;
  for (std::size_t label = 1; label < error.size(); ++label) {
    if (!flat[label] || error[label] <= kNotCarried) continue;
    slabs[label] = true;
    names += (names.empty() ? "label " : ", label ") + std::to_string(label);
  }
  if (names.empty()) return names;
  for (SliceGap& gap : gaps) slices::keep_as_slabs(gap, stack, slabs);
  return names;
}

Result<LabelVolume> interpolate_axis(const LabelVolume& volume, int axis, int planes, const RunContext& ctx) {
  const SliceStack stack = slices::take_slices(volume, axis);
  std::vector<Contacts> contacts;
  for (int lower = 0; lower + 1 < stack.count; ++lower) contacts.emplace_back(stack, lower);
  Result<std::vector<SliceGap>> gaps = interpolate_gaps(stack, contacts, planes, ctx);
  if (!gaps) return gaps.error();
  Result<Balanced> best = balance(stack, *gaps, contacts, planes, ctx);
  if (!best) return best.error();
  if (const std::string slabs = keep_slabs(stack, best->error, *gaps); !slabs.empty()) {
    Result<Balanced> kept = balance(stack, *gaps, contacts, planes, ctx);
    if (!kept) return kept.error();
    // Where labels have no room for the slabs, others would lose more.
    if (*std::max_element(kept->error.begin(), kept->error.end()) <
        *std::max_element(best->error.begin(), best->error.end())) {
      ctx.note(kVolumeStage,
               "kept as slabs of their slices, as they would lose volume by interpolation: " + slabs);
      best = std::move(kept);
    }
  }
  return slices::put_slices(best->planes, volume, axis, planes);
}

Error too_many_voxels(const Eigen::Vector3d& spacing, double voxels) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "volume.slice_ratio: voxels of %g x %g x %g mm would become %.2g by interpolation, at most %.2g "
      "are made; a slice_ratio of 0 leaves them as they are",
      spacing.x(), spacing.y(), spacing.z(), voxels, kMaxVoxels);
  return {ErrorCode::kOutOfMemory, kVolumeStage, text, {}};
}

}  // namespace

bool has_thick_slices(const LabelVolume& volume, double ratio) {
  return ratio > 0 && is_thick(volume.spacing_mm().maxCoeff(), volume.smallest_spacing_mm(), ratio);
}

Result<LabelVolume> interpolate_slices(const LabelVolume& volume, double ratio, const RunContext& ctx) {
  LabelVolume out = volume;
  const Eigen::Vector3d spacing = volume.spacing_mm();
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_thick(spacing[axis], spacing.minCoeff(), ratio)) continue;
    const double ratio_here = spacing[axis] / spacing.minCoeff();
    if (ratio_here * static_cast<double>(out.voxel_count()) > kMaxVoxels)
      return too_many_voxels(spacing, ratio_here * static_cast<double>(out.voxel_count()));
    Result<LabelVolume> finer = interpolate_axis(out, axis, planes_per_slice(ratio_here), ctx);
    if (!finer) return finer;
    out = std::move(finer).value();
  }
  slices::compare_slices(volume, out, ctx);
  return out;
}

}  // namespace voxtet
