#include "io/volume/voxels/judge_volume.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

constexpr std::size_t kFewValues = 30, kManyValues = 64;
constexpr double kLargestBody = 3000, kSmallestBody = 1;  // mm

/// Of one label: its pairs of neighbouring voxels.
struct Pairs {
  std::uint32_t same = 0;   ///< both with this label
  std::uint32_t other = 0;  ///< the other with another label that is not the background
  bool found = false;
};

struct Neighbours {
  std::vector<Pairs> of_label;
  std::uint64_t near = 0, far = 0;  ///< pairs of different labels, by the difference

  void add(Label a, Label b, Label near_by) {
    if (a == kBackground || b == kBackground) return;
    if (a == b) {
      of_label[a].same += 2;
      return;
    }
    ++of_label[a].other;
    ++of_label[b].other;
    ++(std::max(a, b) - std::min(a, b) <= near_by ? near : far);
  }
};

/// "24,000", "0.024"
std::string with_commas(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 1000 ? "%.3g" : "%.0f", value);
  std::string out = text;
  if (value >= 1000)
    for (std::size_t at = out.size(); at > 3; at -= 3) out.insert(at - 3, at > 3 ? "," : "");
  return out;
}

void warn_of_unit(const LabelVolume& volume, Reading& reading) {
  if (reading.options.unit != LengthUnit::kOfFile) return;
  double span = 0;
  for (int d = 0; d < 3; ++d)
    span = std::max(span, volume.spacing_mm()[d] * volume.size[static_cast<std::size_t>(d)]);
  const bool fine = reading.said_mm > 0 && reading.said_mm < 1;
  if (span <= kLargestBody && (span >= kSmallestBody || fine)) return;
  const double per_number = reading.said_mm > 0 ? reading.said_mm : 1;
  struct Unit {
    const char* name;
    double mm;
  };
  constexpr std::array<Unit, 5> kCandidates{
      {{"um", 0.001}, {"mm", 1}, {"m", 1000}, {"cm", 10}, {"nm", 1e-6}}};
  std::string guess, remedy = "mm";
  for (const Unit& unit : kCandidates) {
    const double other = span / per_number * unit.mm;
    if (unit.mm == per_number || other < kSmallestBody || other > kLargestBody) continue;
    guess = " (" + with_commas(other) + " mm if its numbers are " + unit.name + ")";
    remedy = unit.name;
    break;
  }
  reading.warn("the volume spans " + with_commas(span) + " mm" + guess + ": wrong unit? --unit " + remedy +
               " (source.unit) says it");
}

void warn_of_slice(const LabelVolume& volume, Reading& reading) {
  const auto& [nx, ny, nz] = volume.size;
  if (std::min({nx, ny, nz}) > 1) return;
  reading.warn("the volume is one slice thick (" + std::to_string(nx) + " x " + std::to_string(ny) + " x " +
               std::to_string(nz) + " voxels), so that its mesh is a plate; expected a stack of slices");
}

}  // namespace

std::size_t count_values_of_image(const LabelVolume& volume) {
  if (volume.labels.empty()) return 0;
  const Label largest = *std::max_element(volume.labels.begin(), volume.labels.end());
  if (largest <= kFewValues) return 0;
  Neighbours neighbours{std::vector<Pairs>(largest + std::size_t{1})};
  std::size_t values = 0;
  for (const Label label : volume.labels) {
    bool& found = neighbours.of_label[label].found;
    if (!found && label != kBackground) ++values;
    found = true;
  }
  if (values <= kFewValues) return 0;
  const Label near_by = static_cast<Label>(std::max<int>(1, largest / 100));
  const std::array<std::size_t, 3> strides = volume.strides();
  volume.visit([&](int i, int j, int k, std::size_t at) {
    const std::array<int, 3> place{i, j, k};
    for (std::size_t d = 0; d < 3; ++d)
      if (place[d] + 1 < volume.size[d])
        neighbours.add(volume.labels[at], volume.labels[at + strides[d]], near_by);
  });
  std::size_t speckled = 0;
  std::uint64_t same = 0;
  for (const Pairs& pairs : neighbours.of_label) {
    speckled += pairs.same < pairs.other ? 1 : 0;
    same += pairs.same / 2;
  }
  const std::uint64_t different = neighbours.near + neighbours.far;
  const bool smooth = values > kManyValues && 10 * neighbours.near > 9 * different && 3 * different > same;
  return 2 * speckled > values || smooth ? values + (neighbours.of_label[kBackground].found ? 1 : 0) : 0;
}

void warn_of_unlikely(const LabelVolume& volume, Reading& reading) {
  if (const std::size_t values = count_values_of_image(volume); values > 0)
    reading.warn(
        std::to_string(values) + " values: an image, not labels? expected a mask, with a whole " +
        "number for each structure, or values to take as one: --threshold LOWER,UPPER (source.threshold)");
  warn_of_unit(volume, reading);
  warn_of_slice(volume, reading);
  if (!reading.options.precedence.empty() && !reading.precedence_used)
    reading.warn("source.precedence has no effect: the file has one label a voxel, so that nothing overlaps");
}

}  // namespace voxtet
