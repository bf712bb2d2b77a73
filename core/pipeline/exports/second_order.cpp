#include "pipeline/exports/second_order.h"

#include <cstdio>

#include "base/with_commas.h"
#include "geometry/curved/midside_nodes.h"

namespace voxtet {

CurvedNodes second_order_nodes(const Session& session, int threads) {
  if (session.smooth()) return curve_midsides(*session.mesh(), *session.smooth(), threads);
  return {.nodes = straight_midside_nodes(*session.mesh())};
}

std::string note_of(const CurvedNodes& curved) {
  if (curved.moved == 0) return "second order, all edges straight";
  char text[256];
  std::snprintf(text, sizeof text,
                "second order, %s nodes moved to the label surface, %s pulled back for the Jacobian, %s for "
                "the distance; "
                "distance of faces mean %.3f, max %.3f mm (first order %.3f, %.3f); min scaled Jacobian %.3f",
                with_commas(curved.moved).c_str(), with_commas(curved.pulled_back).c_str(),
                with_commas(curved.held).c_str(), curved.curved.mean_mm, curved.curved.max_mm,
                curved.straight.mean_mm, curved.straight.max_mm, curved.min_scaled_jacobian);
  return text;
}

}  // namespace voxtet
