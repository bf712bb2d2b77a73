// Moves a vertex to where its edges are nearer to their target lengths.
#pragma once

#include <cstdint>
#include <vector>

#include "tetra/mesh/tet_complex.h"
#include "tetra/operations/size_guard.h"
#include "tetra/operations/vertex_smoothing.h"

namespace voxtet::tetra {

/// Moves vertices of a complex. Keeps its work memory between calls.
class SizeSmoother {
 public:
  SizeSmoother(TetComplex& complex, const SizeGuard& guard) : complex_(complex), guard_(guard) {}

  /// Moves a vertex that is on no interface and has an edge much longer or shorter than its target, so that
  /// its edges together come nearer to their targets. No tet becomes worse than the worst one at the vertex
  /// was, or than `enough` if that is less. True if the vertex moved.
  bool smooth(std::uint32_t vertex, double enough);

 private:
  TetComplex& complex_;
  const SizeGuard& guard_;
  IdSet seen_;
  std::vector<std::uint32_t> star_, neighbours_;
  std::vector<StarSide> sides_;
};

}  // namespace voxtet::tetra
