// Differences in the labels' topology between a surface and a mesh.
#pragma once

#include <string>
#include <vector>

#include "types/quality_report.h"

namespace voxtet {

/// Every number in which the ledgers differ: first labels lost and gained, then the numbers of labels that
/// both have, then contacts between these labels (with background too), each ascending by label. Empty only
/// for equal ledgers.
std::vector<TopologyDifference> compare_topology(const TopologyLedger& before, const TopologyLedger& after);

/// The difference as a phrase: "label 5: handles 1 -> 2", "labels 1 and 5 no longer touch".
std::string in_words(const TopologyDifference& difference);

}  // namespace voxtet
