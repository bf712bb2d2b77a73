// Vertices in groups that threads can work on.
#pragma once

#include <cstdint>
#include <span>

#include "base/buckets.h"
#include "tetra/mesh/tet_complex.h"

namespace voxtet::tetra {

/// The places of the vertices in the span, in groups of which no two vertices have a tet in common; those
/// that have keep their order. Moving a vertex changes no tet of another one in its group.
Buckets<std::uint32_t> vertices_apart(const TetComplex& complex, std::span<const std::uint32_t> vertices,
                                      int threads);

}  // namespace voxtet::tetra
