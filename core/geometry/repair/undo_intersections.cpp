#include "geometry/repair/undo_intersections.h"

#include <algorithm>
#include <limits>

#include "geometry/intersect/self_intersections.h"
#include "geometry/repair/retreat.h"

namespace voxtet {

UndoOutcome undo_intersections(SurfaceMesh& surface, const std::vector<Eigen::Vector3d>& start,
                               const RunContext& ctx) {
  Retreat retreat(surface.triangles, start, surface.points, ctx.threads);
  Flags flagged = retreat.displaced();
  SelfIntersectionTree tree(surface, ctx.threads);
  for (;;) {
    const std::vector<TrianglePair> pairs = tree.find(flagged, std::numeric_limits<std::size_t>::max(), ctx);
    if (pairs.empty() || ctx.cancelled()) return {retreat.moved_back(), retreat.steps(), ctx.cancelled()};
    std::fill(flagged.begin(), flagged.end(), std::uint8_t{0});
    for (const TrianglePair& pair : pairs)
      for (const std::uint32_t t : pair) flagged[t] = 1;
    retreat.step(flagged);
  }
}

}  // namespace voxtet
