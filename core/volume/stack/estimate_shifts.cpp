#include "volume/stack/estimate_shifts.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "volume/stack/slice_fit.h"

namespace voxtet::slices {
namespace {

constexpr int kLeastSlices = 5;
constexpr int kRounds = 15;
constexpr int kSpreadSteps = 30;
constexpr double kFirstSpread = 0.4;  ///< slice distances
constexpr double kNoSpread = 0.001;   ///< slice distances
/// What bodies bend between slices, of the misfit's square over the slice distance, as hearts do. Of slices
/// that are shifted a straighter body is taken, as a bend that is kept costs more than one that is lost.
constexpr double kBend = 0.8;
constexpr double kBendOfShifted = 0.3;
constexpr double kNoise = 0.04;    ///< of a fit, pixels
constexpr double kSettled = 0.01;  ///< pixels
constexpr int kUnseen = 4;         ///< moves that no stack shows: two of the whole, two shears

/// The first slice with labels, and their number up to the last.
std::pair<int, int> labelled_slices(const SliceStack& stack) {
  int first = stack.count, last = -1;
  for (int k = 0; k < stack.count; ++k)
    if (std::any_of(stack.slice(k), stack.slice(k) + stack.area(),
                    [](Label l) { return l != kBackground; })) {
      first = std::min(first, k);
      last = k;
    }
  return {first, std::max(0, last - first + 1)};
}

/// Least squares of the moves: for each slice, weight^(1/2) (the move less the neighbours' mean - wanted).
struct MoveEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

MoveEquations equations_of(const SliceOutlines& outlines, const SliceStack& stack, double bend_share,
                           const std::vector<Eigen::Vector2d>& moves) {
  const int count = static_cast<int>(moves.size());
  MoveEquations out{Eigen::MatrixXd::Zero(2 * count, 2 * count), Eigen::VectorXd::Zero(2 * count)};
  for (int k = 1; k + 1 < count; ++k) {
    const SliceFit fit = fit_slice(outlines, k, moves);
    const double bend =
        bend_share * fit.misfit_mm * fit.misfit_mm / stack.step_mm + kNoise * stack.smallest_pixel_mm();
    const Eigen::Matrix2d weight = fit.weight / (bend * bend);
    const auto at = [&](int slice) { return moves[static_cast<std::size_t>(slice)]; };
    const Eigen::Vector2d wanted = fit.move_mm + at(k) - (at(k - 1) + at(k + 1)) / 2;
    constexpr std::array<double, 3> kMiddle{-0.5, 1, -0.5};
    for (int a = 0; a < 3; ++a) {
      const double of_a = kMiddle[static_cast<std::size_t>(a)];
      out.right.segment<2>(2 * (k - 1 + a)) += of_a * weight * wanted;
      for (int b = 0; b < 3; ++b)
        out.matrix.block<2, 2>(2 * (k - 1 + a), 2 * (k - 1 + b)) +=
            of_a * kMiddle[static_cast<std::size_t>(b)] * weight;
    }
  }
  return out;
}

/// Moves as a sum of independent modes.
struct MoveModes {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes;
  Eigen::VectorXd right;

  explicit MoveModes(const MoveEquations& equations)
      : modes(equations.matrix), right(modes.eigenvectors().transpose() * equations.right) {}
  double stiffness(Eigen::Index mode, double spread) const {
    return std::max(0.0, modes.eigenvalues()[mode]) + 1 / (spread * spread);
  }

  /// For shifts of this spread.
  std::vector<Eigen::Vector2d> most_probable(double spread) const {
    Eigen::VectorXd amplitudes = right;
    for (Eigen::Index m = 0; m < right.size(); ++m) amplitudes[m] /= stiffness(m, spread);
    const Eigen::VectorXd moves = modes.eigenvectors() * amplitudes;
    std::vector<Eigen::Vector2d> out;
    for (Eigen::Index k = 0; k < moves.size(); k += 2) out.emplace_back(moves.segment<2>(k));
    return out;
  }

  /// The spread that makes the equations most probable, from a first guess.
  double most_probable_spread(double spread, double least) const {
    const auto count = static_cast<double>(right.size());
    for (int step = 0; step < kSpreadSteps; ++step) {
      double squares = -kUnseen * spread * spread;
      for (Eigen::Index m = 0; m < right.size(); ++m) {
        const double amplitude = right[m] / stiffness(m, spread);
        squares += amplitude * amplitude + 1 / stiffness(m, spread);
      }
      spread = std::max(least, std::sqrt(std::max(0.0, squares) / (count - kUnseen)));
    }
    return spread;
  }
};

/// Without their mean and their slope along the stack.
void remove_unseen(std::vector<Eigen::Vector2d>& moves) {
  const double count = static_cast<double>(moves.size()), middle = (count - 1) / 2;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), slope = Eigen::Vector2d::Zero();
  double squares = 0;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const double place = static_cast<double>(k) - middle;
    sum += moves[k];
    slope += place * moves[k];
    squares += place * place;
  }
  for (std::size_t k = 0; k < moves.size(); ++k)
    moves[k] -= sum / count + (static_cast<double>(k) - middle) / squares * slope;
}

}  // namespace

ShiftEstimate estimate_shifts(const SliceStack& stack, double largest_mm, const RunContext& ctx) {
  ShiftEstimate out;
  out.moves_mm.assign(static_cast<std::size_t>(stack.count), Eigen::Vector2d::Zero());
  const auto [first, count] = labelled_slices(stack);
  if (count < kLeastSlices) return out;
  const SliceOutlines outlines = slice_outlines(stack, first, count, largest_mm);
  std::vector<Eigen::Vector2d> moves(static_cast<std::size_t>(count), Eigen::Vector2d::Zero());
  out.spread_mm = kFirstSpread * stack.step_mm;
  for (int round = 0; round < kRounds && !ctx.cancelled(); ++round) {
    const MoveModes modes(equations_of(outlines, stack, kBend, moves));
    out.spread_mm = modes.most_probable_spread(out.spread_mm, kNoSpread * stack.step_mm);
    std::vector<Eigen::Vector2d> next = modes.most_probable(out.spread_mm);
    remove_unseen(next);
    double change = 0;
    for (std::size_t k = 0; k < next.size(); ++k) change = std::max(change, (next[k] - moves[k]).norm());
    moves = std::move(next);
    if (change < kSettled * stack.smallest_pixel_mm()) break;
  }
  if (out.spread_mm < kLeastSpread * stack.smallest_pixel_mm()) return out;
  moves = MoveModes(equations_of(outlines, stack, kBendOfShifted, moves)).most_probable(out.spread_mm);
  remove_unseen(moves);
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const double length = moves[k].norm();
    out.moves_mm[static_cast<std::size_t>(first) + k] =
        length > largest_mm ? Eigen::Vector2d(moves[k] * (largest_mm / length)) : moves[k];
  }
  return out;
}

}  // namespace voxtet::slices
