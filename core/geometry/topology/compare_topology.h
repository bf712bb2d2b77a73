// What of the labels' topology a mesh has not kept.
#pragma once

#include <string>
#include <vector>

#include "types/quality_report.h"

namespace voxtet {

/// Every number in which the ledgers differ: labels lost and gained, then the numbers of those that both
/// have, then contacts between those (with background too), each ascending by label. Empty only for equal
/// ledgers.
std::vector<TopologyDifference> compare_topology(const TopologyLedger& before, const TopologyLedger& after);

/// The difference as a phrase: "label 5: handles 1 -> 2", "labels 1 and 5 no longer touch".
std::string in_words(const TopologyDifference& difference);

}  // namespace voxtet
