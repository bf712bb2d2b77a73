// Which corners of a tetrahedron make its facets.
#pragma once

#include <array>
#include <cstdint>

namespace voxtet {

/// The corners of the facet opposite to a corner, counter-clockwise as seen from outside of a positive
/// tetrahedron: (corner, these) is an even permutation.
inline constexpr std::array<std::array<std::uint32_t, 3>, 4> kFacetCorners{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace voxtet
