#include "volume/clean/padded_labels.h"

#include <algorithm>

namespace voxtet {
namespace {

/// Calls visit(first voxel in the margin's grid, first in the volume's) for each row along x.
template <class Visit>
void for_rows(const PaddedLabels& padded, const LabelVolume& volume, const Visit& visit) {
  constexpr int kMargin = PaddedLabels::kMargin;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      visit(padded.step({kMargin, j + kMargin, k + kMargin}),
            static_cast<std::ptrdiff_t>(volume.offset(0, j, k)));
}

}  // namespace

PaddedLabels::PaddedLabels(const LabelVolume& volume) : size(volume.size) {
  std::size_t count = 1;
  for (int& length : size) count *= static_cast<std::size_t>(length += 2 * kMargin);
  labels.assign(count, kBackground);
  for_rows(*this, volume, [&](std::ptrdiff_t here, std::ptrdiff_t there) {
    std::copy_n(volume.labels.begin() + there, volume.size[0], labels.begin() + here);
  });
}

void PaddedLabels::write_to(LabelVolume& volume) const {
  for_rows(*this, volume, [&](std::ptrdiff_t here, std::ptrdiff_t there) {
    std::copy_n(labels.begin() + here, volume.size[0], volume.labels.begin() + there);
  });
}

}  // namespace voxtet
