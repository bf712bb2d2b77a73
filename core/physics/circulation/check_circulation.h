// What a circulation refuses.
#pragma once

#include "physics/circulation/closed_loop.h"
#include "physics/circulation/windkessel.h"

namespace voxtet {

/// Returns kUsage, naming the field, for a number that is not finite or out of its range, as a resistance
/// that is not positive, a valve that is more open when closed, or an atrium that contracts for longer than a
/// beat.
Status check_ventricle_load(const VentricleLoad& load, double period_s);
Status check_closed_loop(const ClosedLoopParams& params);

/// The same for a chamber, with its name.
Status check_elastance(std::string_view name, const Elastance& chamber, double period_s);

}  // namespace voxtet
