// Sequences of operations that only help together: one that may do harm at first, and others that make up for
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tetra/interfaces/interface_sliding.h"
#include "tetra/mesh/tet_complex.h"
#include "tetra/operations/local_swaps.h"
#include "tetra/operations/size_guard.h"
#include "tetra/operations/vertex_insertion.h"
#include "tetra/operations/vertex_smoothing.h"

namespace voxtet::tetra {

/// How often each operation was done.
struct OperationCounts {
  std::size_t edges = 0, faces = 0, moved = 0, fitted = 0, inserted = 0, slid = 0, flipped = 0;
  bool operator==(const OperationCounts&) const = default;

  void add(Swap swap) {
    edges += swap == Swap::kEdge;
    faces += swap == Swap::kFaces;
  }
};

/// For the few tets that no single operation helps, most of them with all corners on interfaces. A trial is
/// an opening (a new vertex that may lower the quality, or nothing), and then swaps, smoothing and sliding in
/// turn where tets around are bad. It is taken back unless it touched its tet and everything that it touched
/// is better than that tet was.
class CompoundImprover {
 public:
  CompoundImprover(TetComplex& complex, const SizeGuard& guard, VertexSmoother& smoother,
                   VertexInserter& inserter, InterfaceSlider& slider, OperationCounts& counts)
      : complex_(complex),
        guard_(guard),
        smoother_(smoother),
        inserter_(inserter),
        slider_(slider),
        counts_(counts) {}

  /// Runs trials until one succeeds; new vertices only if `insert`. Tets below the goal are bad. Vertices on
  /// interfaces slide where the slider has approached them.
  bool improve(std::uint32_t t, double goal, bool insert);
  /// How often a bad tet was worked on: a measure of the cost.
  std::size_t steps() const { return steps_; }

 private:
  bool attempt(std::uint32_t t, double goal, const VertexInserter::Start* opening);
  bool open(std::uint32_t t, const VertexInserter::Start* opening);
  double settle(std::uint32_t t, double goal, const TetComplex::Mark& start);
  void improve_one(std::uint32_t t, double goal);
  double lowest_touched(std::uint32_t t, const TetComplex::Mark& since) const;
  void add_corners(std::uint32_t t);

  TetComplex& complex_;
  const SizeGuard& guard_;
  VertexSmoother& smoother_;
  VertexInserter& inserter_;
  InterfaceSlider& slider_;
  OperationCounts& counts_;
  std::vector<std::uint32_t> vertices_;  ///< around which a trial looks for bad tets
  IdSet seen_;
  std::vector<std::uint32_t> star_, tets_;
  std::size_t steps_ = 0;
};

}  // namespace voxtet::tetra
