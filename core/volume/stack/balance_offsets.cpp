#include "volume/stack/balance_offsets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace voxtet::slices {
namespace {

constexpr int kSteps = 15;
constexpr int kSweeps = 200;          // of the damped Jacobi iteration
constexpr double kTolerance = 0.001;  // of a label's volume
constexpr double kStep = 0.3;         // of the limit, largest change of an offset in one step

/// All disputed voxels between two labels, by their margin in favour of the lower one.
struct Border {
  Label low, high;
  std::vector<float> margins;  // ascending
  double count_from(double margin) const {
    return static_cast<double>(margins.end() - std::lower_bound(margins.begin(), margins.end(), margin));
  }
};

struct Contest {
  std::vector<Border> borders;
  std::vector<double> undisputed;  // voxels, by label
};

Contest gather(const std::vector<SliceGap>& gaps, double limit_mm) {
  Contest out;
  out.undisputed.assign(65536, 0);
  std::map<std::pair<Label, Label>, std::vector<float>> margins;
  std::pair<Label, Label> last{0, 0};
  std::vector<float>* list = nullptr;
  for (const SliceGap& gap : gaps)
    for (const Candidate& c : gap.candidates) {
      if (c.margin_mm > 2 * limit_mm) {
        ++out.undisputed[c.first];
        continue;
      }
      const std::pair<Label, Label> pair = std::minmax(c.first, c.second);
      if (!list || pair != last) list = &margins[pair];
      last = pair;
      list->push_back(c.first < c.second ? c.margin_mm : -c.margin_mm);
    }
  for (auto& [pair, values] : margins) {
    std::sort(values.begin(), values.end());
    out.borders.push_back({pair.first, pair.second, std::move(values)});
  }
  return out;
}

/// The step of the offsets that moves the outlines by the voxels that are missing.
std::vector<double> newton_step(const std::vector<Border>& borders, const std::vector<double>& offsets,
                                const std::vector<double>& missing, double limit_mm) {
  std::vector<double> diagonal(65536, 0), step(65536, 0);
  std::vector<double> length;  // voxels per mm of each border
  for (const Border& border : borders) {
    const double at = offsets[border.high] - offsets[border.low], reach = limit_mm / 2;
    length.push_back((border.count_from(at - reach) - border.count_from(at + reach)) / (2 * reach));
    diagonal[border.low] += length.back();
    diagonal[border.high] += length.back();
  }
  std::vector<Label> labels;
  for (std::size_t label = 0; label < diagonal.size(); ++label) {
    if (diagonal[label] <= 0) continue;
    labels.push_back(static_cast<Label>(label));
    diagonal[label] = 1.02 * diagonal[label] + 1;
  }
  std::vector<double> right(65536, 0);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const Label label : labels) right[label] = missing[label];
    for (std::size_t b = 0; b < borders.size(); ++b) {
      right[borders[b].low] += length[b] * step[borders[b].high];
      right[borders[b].high] += length[b] * step[borders[b].low];
    }
    for (const Label label : labels) step[label] = (step[label] + right[label] / diagonal[label]) / 2;
  }
  for (const Label label : labels) step[label] = std::clamp(step[label], -kStep * limit_mm, kStep * limit_mm);
  return step;
}

}  // namespace

std::vector<double> balance_offsets(const std::vector<SliceGap>& gaps, const std::vector<double>& wanted,
                                    double limit_mm) {
  const Contest contest = gather(gaps, limit_mm);
  std::vector<double> offsets(65536, 0), best = offsets;
  double least = -1;
  for (int step = 0; step < kSteps; ++step) {
    std::vector<double> missing(65536);
    for (std::size_t label = 0; label < missing.size(); ++label)
      missing[label] = wanted[label] - contest.undisputed[label];
    for (const Border& border : contest.borders) {
      const double low = border.count_from(offsets[border.high] - offsets[border.low]);
      missing[border.low] -= low;
      missing[border.high] -= static_cast<double>(border.margins.size()) - low;
    }
    double total = 0;
    bool good = true;
    for (std::size_t label = 0; label < missing.size(); ++label) {
      total += std::abs(missing[label]);
      if (std::abs(missing[label]) > std::max(1.0, kTolerance * wanted[label])) good = false;
    }
    if (least < 0 || total < least) {
      least = total;
      best = offsets;
    }
    if (good) break;
    const std::vector<double> change = newton_step(contest.borders, offsets, missing, limit_mm);
    for (std::size_t label = 0; label < offsets.size(); ++label)
      offsets[label] = std::clamp(offsets[label] + change[label], -limit_mm, limit_mm);
  }
  return best;
}

}  // namespace voxtet::slices
