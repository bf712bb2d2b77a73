// placeholder until geometry/label_components.h is merged
#pragma once
#include <array>
#include <cstdint>
#include <vector>
#include "types/label_volume.h"
namespace voxtet::remesh {
std::vector<std::uint32_t> label_components(const std::array<int, 3>& size, const std::vector<Label>& labels,
                                            std::vector<std::uint32_t>& sizes);
}
