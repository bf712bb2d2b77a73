#include "remesh/field/resolve_face_ambiguity.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace voxtet::remesh {
namespace {

/// On faces, so that tunnels are wide enough to be followed: what is apart is so by this factor of products.
constexpr double kFaceMargin = 2;
constexpr float kLowered = 0.8F;        ///< a distance, per step
constexpr float kLeastLowered = 1e-3F;  ///< of a distance, in units of the smallest spacing

/// Voxels at the corners of a cell; x is the lowest bit of a corner's number.
using CellVoxels = std::array<std::size_t, 8>;

/// The four edges of a cell along an axis: the axis's bit, and their feet in the order around it.
struct Columns {
  std::size_t axis;
  std::array<std::size_t, 4> feet;
};
constexpr std::array<Columns, 3> kColumns{{{1, {0, 2, 6, 4}}, {2, {0, 1, 5, 4}}, {4, {0, 1, 3, 2}}}};

/// By corner, the first one that it is joined with, for each set of corners that are inside of the label: the
/// label along edges, background along the diagonals of faces too.
const std::array<std::array<std::uint8_t, 8>, 256> kPieces = [] {
  std::array<std::array<std::uint8_t, 8>, 256> pieces{};
  for (std::size_t inside = 0; inside < 256; ++inside) {
    const auto are_joined = [&](std::size_t a, std::size_t b) {
      const bool label = (inside >> a & 1) != 0, edge = std::has_single_bit(a ^ b), body = (a ^ b) == 7;
      return label == ((inside >> b & 1) != 0) && (edge || (!label && !body));
    };
    for (std::uint8_t c = 0; c < 8; ++c) pieces[inside][c] = c;
    for (int round = 0; round < 8; ++round)
      for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t b = 0; b < 8; ++b)
          if (are_joined(a, b)) pieces[inside][a] = std::min(pieces[inside][a], pieces[inside][b]);
  }
  return pieces;
}();

/// Values at the foot and the head of four columns, in the order around them.
using ColumnValues = std::array<std::array<double, 2>, 4>;

/// Across columns, at these shares of their lengths.
struct Slices {
  double from, to;
  double margin;  ///< 1 or more
};

/// Whether in one of the slices the bilinear interpolant joins the first column with the third: both are
/// positive, the others negative, and the margin times the product of the first two is the larger one.
bool slices_join(const ColumnValues& column, const Slices& slices) {
  double from = slices.from, to = slices.to;
  for (std::size_t k = 0; k < 4; ++k) {
    const double sign = k % 2 == 0 ? 1 : -1, foot = sign * column[k][0], head = sign * column[k][1];
    if (foot <= 0 && head <= 0) return false;
    if (foot < 0) from = std::max(from, foot / (foot - head));
    if (head < 0) to = std::min(to, foot / (foot - head));
  }
  if (from > to) return false;
  const auto at = [&](std::size_t k, double t) { return column[k][0] + t * (column[k][1] - column[k][0]); };
  const auto lead = [&](double t) { return slices.margin * at(0, t) * at(2, t) - at(1, t) * at(3, t); };
  if (lead(from) >= 0 || lead(to) >= 0) return true;
  // A parabola through three of its points.
  const double first = lead(0), last = lead(1), bend = 2 * (first + last - 2 * lead(0.5));
  const double top = 0.5 - (last - first) / (2 * bend);
  return bend < 0 && top > from && top < to && lead(top) >= 0;
}

class Separator {
 public:
  Separator(const LabelVolume& grid, LabelDistances& distances) : grid_(grid), distances_(distances) {}

  /// False when there was nothing to separate.
  bool run() {
    const std::size_t sx = static_cast<std::size_t>(grid_.size[0]);
    const std::size_t sxy = sx * static_cast<std::size_t>(grid_.size[1]);
    bool any = false;
    for (std::size_t v = 0; v + sxy + sx + 1 < grid_.labels.size(); ++v)
      if (distances_.offsets[v] != distances_.offsets[v + 1])
        any =
            separate({v, v + 1, v + sx, v + sx + 1, v + sxy, v + sxy + 1, v + sxy + sx, v + sxy + sx + 1}) ||
            any;
    return any;
  }

 private:
  bool separate(const CellVoxels& voxels) {
    std::size_t inside = 0;
    for (std::size_t c = 0; c < 8; ++c)
      if (grid_.labels[voxels[c]] != kBackground) inside |= std::size_t{1} << c;
    if (inside == 0 || inside == 0xff) return false;
    const std::array<std::uint8_t, 8>& piece = kPieces[inside];
    bool any = false;
    for (const auto& [axis, feet] : kColumns)
      for (std::size_t first = 0; first < 2; ++first) {
        const std::array<std::size_t, 4> around{feet[first], feet[first + 1], feet[first + 2],
                                                feet[(first + 3) % 4]};
        for (const std::size_t a : {around[0], around[0] | axis})
          for (const std::size_t b : {around[2], around[2] | axis}) {
            const bool label = (inside >> a & 1) != 0;
            if (label != ((inside >> b & 1) != 0)) continue;
            const double end = (a & axis) != 0 ? 1 : 0;
            if (label && (a & axis) == (b & axis))
              any = part(voxels, axis, around, a, b, {end, end, kFaceMargin}) || any;
            if (piece[a] != piece[b]) any = part(voxels, axis, around, a, b, {0, 1, 1}) || any;
          }
      }
    return any;
  }

  /// Changes the distances at corners until no slice joins the columns of `a` and `b`: lowers those two, and
  /// raises what is between them on a face as far as thin voxels are.
  bool part(const CellVoxels& voxels, std::size_t axis, const std::array<std::size_t, 4>& feet, std::size_t a,
            std::size_t b, const Slices& slices) {
    const bool label = grid_.labels[voxels[a]] != kBackground;
    const bool on_face = slices.from == slices.to;
    for (bool any = false;; any = true) {
      ColumnValues column{};
      for (std::size_t k = 0; k < 4; ++k)
        column[k] = {value(voxels[feet[k]], label), value(voxels[feet[k] | axis], label)};
      if (!slices_join(column, slices)) return any;
      bool changed = false;
      for (const std::size_t c : {a, b}) changed = scale(voxels[c], kLowered) || changed;
      if (on_face)
        for (const std::size_t c : {feet[1] | (a & axis), feet[3] | (a & axis)})
          if (std::abs(value(voxels[c], label)) < LabelDistances::kNearestThin)
            changed = scale(voxels[c], 1 / kLowered) || changed;
      if (!changed) return any;
    }
  }

  /// Signed distance at a voxel's centre to the boundary of the label, or of background.
  double value(std::size_t voxel, bool label) const {
    for (std::uint32_t e = distances_.offsets[voxel]; e < distances_.offsets[voxel + 1]; ++e)
      if ((distances_.labels[e] != kBackground) == label) return distances_.values[e];
    return -LabelDistances::kFarthest;
  }

  /// Multiplies a voxel's distances, unless they are next to nothing. Whether it did.
  bool scale(std::size_t voxel, float factor) {
    bool scaled = false;
    for (std::uint32_t e = distances_.offsets[voxel]; e < distances_.offsets[voxel + 1]; ++e) {
      if (std::abs(distances_.values[e]) < kLeastLowered) continue;
      distances_.values[e] *= factor;
      scaled = true;
    }
    return scaled;
  }

  const LabelVolume& grid_;
  LabelDistances& distances_;
};

}  // namespace

void resolve_face_ambiguity(const LabelVolume& grid, LabelDistances& distances) {
  // Lowering the label in one place may join background in another one, and so on; seldom.
  constexpr int kRounds = 4;
  Separator separator(grid, distances);
  for (int round = 0; round < kRounds; ++round)
    if (!separator.run()) return;
}

}  // namespace voxtet::remesh
