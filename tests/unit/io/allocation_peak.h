// How much memory `new` handed out at once, for tests that bound it. Linking allocation_peak.cpp replaces it.
#pragma once

#include <cstddef>

namespace voxtet::test {

void reset_allocation_peak();
/// Most bytes alive at once since the reset, beyond those alive at the reset.
std::size_t allocation_peak();

}  // namespace voxtet::test
