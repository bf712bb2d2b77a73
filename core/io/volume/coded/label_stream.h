// Labels voxel by voxel, each predicted from those before it: Weinberger, Rissanen and Arps, "Applications of
// universal context modeling to lossless compression of gray-scale images" (1996), with mixed contexts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/volume/coded/mixed_model.h"

namespace voxtet {

/// A box of labels, each as its place in a list of at most kMostLabels.
struct IndexedLabels {
  static constexpr std::size_t kMostLabels = 255;

  std::array<int, 3> size{};
  std::vector<std::uint8_t> indices;  ///< x fastest
};

/// Codes a box of labels, or decodes it into `labels`, by a BinaryEncoder or a BinaryDecoder. False where
/// the data of a decoder end too early.
template <class Coder>
bool code_labels(Coder& coder, std::size_t label_count, IndexedLabels& labels);

}  // namespace voxtet
