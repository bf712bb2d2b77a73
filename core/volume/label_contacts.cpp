#include "volume/label_contacts.h"

#include <algorithm>
#include <map>
#include <utility>

#include "volume/clean/face_areas.h"
#include "volume/select_labels.h"

namespace voxtet {
namespace {

using Pair = std::pair<Label, Label>;  ///< lower first

/// Faces between voxels of different labels.
class FaceCounter {
 public:
  void add(Label a, Label b, double area) {
    // Neighbouring voxels often lie at the same boundary.
    const Pair pair = std::minmax(a, b);
    if (pair != last_) {
      last_ = pair;
      area_ = &areas_[pair];
    }
    *area_ += area;
  }
  const std::map<Pair, double>& areas() const { return areas_; }

 private:
  std::map<Pair, double> areas_;
  Pair last_{kBackground, kBackground};
  double* area_ = nullptr;
};

std::map<Pair, double> boundary_areas(const LabelVolume& volume) {
  const std::array<double, 3> areas = face_areas(volume);
  const std::array<std::size_t, 3> strides = volume.strides();
  FaceCounter faces;
  volume.visit([&](int i, int j, int k, std::size_t at) {
    const std::array<int, 3> place{i, j, k};
    for (std::size_t d = 0; d < 3; ++d) {
      if (place[d] + 1 == volume.size[d]) continue;
      const Label here = volume.labels[at], next = volume.labels[at + strides[d]];
      if (here != next) faces.add(here, next, areas[d]);
    }
  });
  return faces.areas();
}

/// Of the voxels on the image's border, by label.
std::vector<std::size_t> border_voxels(const LabelVolume& volume) {
  std::vector<std::size_t> counts(65536, 0);
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j) {
      const bool inside = k > 0 && j > 0 && k + 1 < volume.size[2] && j + 1 < volume.size[1];
      const int step = inside ? std::max(1, volume.size[0] - 1) : 1;
      for (int i = 0; i < volume.size[0]; i += step) ++counts[volume.at(i, j, k)];
    }
  return counts;
}

}  // namespace

std::vector<LabelSurroundings> label_surroundings(const LabelVolume& volume) {
  const std::map<Pair, double> areas = boundary_areas(volume);
  const std::vector<std::size_t> border = border_voxels(volume);
  std::size_t all_border = 0;
  for (const std::size_t count : border) all_border += count;
  std::map<Label, LabelSurroundings> found;
  for (const auto& [label, count] : count_labels(volume))
    found[label] = {label, {}, static_cast<double>(border[label]) / static_cast<double>(all_border)};
  for (const auto& [pair, area] : areas)
    for (const auto& [label, other] : {pair, Pair{pair.second, pair.first}})
      if (label != kBackground) found[label].contacts.push_back({other, area});
  std::vector<LabelSurroundings> out;
  for (auto& [label, of] : found) {
    double total = 0;
    for (const LabelContact& contact : of.contacts) total += contact.share;
    for (LabelContact& contact : of.contacts) contact.share /= total;
    std::stable_sort(of.contacts.begin(), of.contacts.end(),
                     [](const LabelContact& a, const LabelContact& b) { return a.share > b.share; });
    out.push_back(std::move(of));
  }
  return out;
}

}  // namespace voxtet
