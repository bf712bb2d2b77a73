#include "volume/stack/align_slices.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "types/stage_names.h"
#include "volume/stack/estimate_shifts.h"
#include "volume/stack/interpolate_slices.h"
#include "volume/stack/move_slices.h"

namespace voxtet {
namespace {

using slices::SliceStack;
using Moves = std::vector<Eigen::Vector2d>;

/// A stack with more slices, or of more pixels, is no stack of breath-holds, and is not searched for shifts
/// that nobody asked about.
constexpr int kMostSlices = 64;
constexpr std::size_t kMostPixels = 1 << 23;

Error usage(const std::string& message) {
  return {ErrorCode::kUsage, kVolumeStage, message, {}};
}

std::string mm_text(double mm) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f mm", mm);
  return text;
}

/// The axis across the slices; none where more than one axis is thick.
std::optional<int> stack_axis(const LabelVolume& volume, double ratio) {
  const Eigen::Vector3d spacing = volume.spacing_mm();
  Eigen::Index axis = 0;
  spacing.maxCoeff(&axis);
  Eigen::Vector3d others = spacing;
  others[axis] = spacing.minCoeff();
  LabelVolume without;
  without.index_to_mm.diagonal().head<3>() = others;
  if (!has_thick_slices(volume, ratio) || has_thick_slices(without, ratio)) return std::nullopt;
  return static_cast<int>(axis);
}

Status check_shifts(const std::vector<SliceShift>& shifts, int count) {
  std::vector<bool> seen(static_cast<std::size_t>(count), false);
  for (std::size_t s = 0; s < shifts.size(); ++s) {
    const std::string field =
        "volume.slice_shifts[" + std::to_string(s) + "].slice: found " + std::to_string(shifts[s].slice);
    if (shifts[s].slice >= seen.size())
      return usage(field + ", expected at most " + std::to_string(count - 1) + ", the last slice");
    if (seen[shifts[s].slice]) return usage(field + " twice, expected each slice once");
    seen[shifts[s].slice] = true;
  }
  return std::monostate{};
}

/// The pixels by which the slices have to grow (by axis and end) so that no label leaves them.
std::array<std::array<int, 2>, 2> room_for(const SliceStack& stack, const Moves& moves) {
  std::array<std::array<int, 2>, 2> room{};
  for (int k = 0; k < stack.count; ++k) {
    const Eigen::Vector2d& move = moves[static_cast<std::size_t>(k)];
    const Label* pixel = stack.slice(k);
    for (int y = 0; y < stack.height; ++y)
      for (int x = 0; x < stack.width; ++x) {
        if (*pixel++ == kBackground) continue;
        const std::array<int, 2> place{x, y}, size{stack.width, stack.height};
        for (std::size_t d = 0; d < 2; ++d) {
          const double pixels = move[static_cast<Eigen::Index>(d)] / stack.pixel_mm[d];
          room[d][0] = std::max(room[d][0], static_cast<int>(std::ceil(-pixels)) - place[d]);
          room[d][1] = std::max(room[d][1], static_cast<int>(std::ceil(pixels)) + place[d] - size[d] + 1);
        }
      }
  }
  return room;
}

/// The volume with background around its slices.
LabelVolume grown(const LabelVolume& volume, const std::array<int, 2>& axes,
                  const std::array<std::array<int, 2>, 2>& room) {
  LabelVolume out;
  out.infos = volume.infos;
  out.size = volume.size;
  out.index_to_mm = volume.index_to_mm;
  std::array<int, 3> from{};
  for (std::size_t d = 0; d < 2; ++d) {
    const std::size_t axis = static_cast<std::size_t>(axes[d]);
    from[axis] = room[d][0];
    out.size[axis] += room[d][0] + room[d][1];
    out.index_to_mm.block<3, 1>(0, 3) -= room[d][0] * volume.linear().col(axes[d]);
  }
  out.labels.assign(out.voxel_count(), kBackground);
  volume.visit([&](int i, int j, int k, std::size_t voxel) {
    out.labels[out.offset(i + from[0], j + from[1], k + from[2])] = volume.labels[voxel];
  });
  return out;
}

/// The mean of a slice's overlaps with its neighbours.
std::vector<double> overlaps(const SliceStack& stack) {
  std::vector<double> between, out;
  for (int k = 0; k + 1 < stack.count; ++k) between.push_back(slices::overlap(stack, k));
  for (std::size_t k = 0; k <= between.size(); ++k) {
    const double before = k > 0 ? between[k - 1] : (between.empty() ? 1 : between[0]);
    const double behind = k < between.size() ? between[k] : before;
    out.push_back((before + behind) / 2);
  }
  return out;
}

void note_moves(const SliceAlignment& alignment, const RunContext& ctx) {
  double longest = 0, before = 0, after = 0;
  std::size_t moved = 0, at = 0;
  for (const AlignedSlice& slice : alignment.slices) {
    const double mm = Eigen::Vector2d(slice.move.first_mm, slice.move.second_mm).norm();
    moved += mm > 0;
    if (mm > longest) at = slice.move.slice;
    longest = std::max(longest, mm);
    before += slice.overlap_before / static_cast<double>(alignment.slices.size());
    after += slice.overlap_after / static_cast<double>(alignment.slices.size());
  }
  char dice[80];
  std::snprintf(dice, sizeof dice, "Dice of neighbouring slices %.3f before, %.3f after", before, after);
  ctx.note(kVolumeStage, "slices moved in their plane: " + std::to_string(moved) + " of " +
                             std::to_string(alignment.slices.size()) + ", slice " + std::to_string(at) +
                             " farthest by " + mm_text(longest) + "; " + dice);
}

void say_nothing_moved(const AlignParams& params, const SliceStack& stack, double spread_mm,
                       const RunContext& ctx) {
  const bool shifted = spread_mm >= slices::kLeastSpread * stack.smallest_pixel_mm();
  if (!params.align_slices && shifted)
    ctx.warn(kVolumeStage, "slices are shifted against each other in their plane by about " +
                               mm_text(spread_mm) + " along each axis, as by breath-holds: " +
                               "volume.align_slices (--align-slices) puts them back");
  if (params.align_slices && !shifted)
    ctx.note(kVolumeStage, "volume.align_slices: no shifts found, no slice was moved");
}

}  // namespace

Result<AlignedVolume> align_slices(const std::shared_ptr<const LabelVolume>& volume,
                                   const AlignParams& params, double slice_ratio, const RunContext& ctx) {
  constexpr double kUsualRatio = 2;
  AlignedVolume out{volume, {}};
  const std::optional<int> axis = stack_axis(*volume, slice_ratio > 0 ? slice_ratio : kUsualRatio);
  if (!axis) {
    if (!params.slice_shifts.empty())
      return usage("volume.slice_shifts: found " + std::to_string(params.slice_shifts.size()) +
                   " slices to move, expected none, as the volume is no stack of thick slices");
    if (params.align_slices)
      ctx.warn(kVolumeStage,
               "volume.align_slices: the volume is no stack of thick slices, nothing was moved");
    return out;
  }
  out.alignment.axis = *axis;
  SliceStack stack = slices::take_slices(*volume, *axis);
  if (Status checked = check_shifts(params.slice_shifts, stack.count); !checked) return checked.error();
  const bool asked = params.align_slices || !params.slice_shifts.empty();
  if (!asked && (stack.count > kMostSlices || stack.pixels.size() > kMostPixels)) return out;

  Moves moves(static_cast<std::size_t>(stack.count), Eigen::Vector2d::Zero());
  if (params.align_slices || !asked) {
    const slices::ShiftEstimate found = slices::estimate_shifts(stack, params.largest_shift_mm, ctx);
    if (ctx.cancelled()) return cancelled_error(kVolumeStage);
    out.alignment.spread_mm = found.spread_mm;
    say_nothing_moved(params, stack, found.spread_mm, ctx);
    if (params.align_slices) moves = found.moves_mm;
  }
  for (const SliceShift& shift : params.slice_shifts)
    moves[shift.slice] = Eigen::Vector2d(shift.first_mm, shift.second_mm);
  if (std::all_of(moves.begin(), moves.end(), [](const Eigen::Vector2d& m) { return m.isZero(0); }))
    return out;

  const std::vector<double> before = overlaps(stack);
  const std::array<int, 2> axes{*axis == 0 ? 1 : 0, *axis == 2 ? 1 : 2};
  const LabelVolume roomy = grown(*volume, axes, room_for(stack, moves));
  stack = slices::move_slices(slices::take_slices(roomy, *axis), moves);
  const std::vector<double> after = overlaps(stack);
  for (std::size_t k = 0; k < moves.size(); ++k)
    out.alignment.slices.push_back(
        {{static_cast<std::uint32_t>(k), moves[k].x(), moves[k].y()}, false, before[k], after[k]});
  for (const SliceShift& shift : params.slice_shifts) out.alignment.slices[shift.slice].given = true;
  note_moves(out.alignment, ctx);
  out.volume = std::make_shared<const LabelVolume>(slices::put_slices(stack, roomy, *axis, 1));
  return out;
}

}  // namespace voxtet
