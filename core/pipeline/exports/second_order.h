// The second-order elements of a session's mesh.
#pragma once

#include <string>

#include "geometry/curved/curve_midsides.h"
#include "pipeline/session.h"

namespace voxtet {

/// Nodes on the edges of Session::mesh(), those of its boundary on the smoothed label surface; of a mesh that
/// was opened, and has no such surface, in the middle of straight edges.
CurvedNodes second_order_nodes(const Session& session, int threads);

/// What that came to, for people.
std::string note_of(const CurvedNodes& curved);

}  // namespace voxtet
