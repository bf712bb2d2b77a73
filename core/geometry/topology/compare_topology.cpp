#include "geometry/topology/compare_topology.h"

#include <algorithm>
#include <iterator>

namespace voxtet {
namespace {

const LabelTopology* find(const TopologyLedger& ledger, Label label) {
  const auto at = std::lower_bound(ledger.labels.begin(), ledger.labels.end(), label,
                                   [](const LabelTopology& t, Label l) { return t.label < l; });
  return at != ledger.labels.end() && at->label == label ? &*at : nullptr;
}

void compare_numbers(const LabelTopology& before, const LabelTopology& after,
                     std::vector<TopologyDifference>& out) {
  const auto compare = [&](const char* what, std::int64_t b, std::int64_t a) {
    if (b != a) out.push_back({what, before.label, kBackground, b, a});
  };
  compare("components", before.components, after.components);
  compare("cavities", before.cavities, after.cavities);
  compare("handles", before.handles, after.handles);
  compare("pinched_edges", before.pinched_edges, after.pinched_edges);
  compare("pinched_points", before.pinched_points, after.pinched_points);
  compare("open_edges", before.open_edges, after.open_edges);
}

}  // namespace

std::vector<TopologyDifference> compare_topology(const TopologyLedger& before, const TopologyLedger& after) {
  std::vector<TopologyDifference> out, numbers;
  for (const LabelTopology& t : before.labels)
    if (const LabelTopology* kept = find(after, t.label))
      compare_numbers(t, *kept, numbers);
    else
      out.push_back({"label", t.label, kBackground, 1, 0});
  for (const LabelTopology& t : after.labels)
    if (!find(before, t.label)) out.push_back({"label", t.label, kBackground, 0, 1});
  std::sort(out.begin(), out.end(),
            [](const TopologyDifference& a, const TopologyDifference& b) { return a.label < b.label; });
  out.insert(out.end(), numbers.begin(), numbers.end());

  std::vector<std::array<Label, 2>> changed;
  std::set_symmetric_difference(before.contacts.begin(), before.contacts.end(), after.contacts.begin(),
                                after.contacts.end(), std::back_inserter(changed));
  const auto in_both = [&](Label label) {
    return label == kBackground || (find(before, label) && find(after, label));
  };
  for (const auto& [a, b] : changed) {
    if (!in_both(a) || !in_both(b)) continue;
    const bool lost = std::binary_search(before.contacts.begin(), before.contacts.end(), std::array{a, b});
    out.push_back({"contact", a, b, lost, !lost});
  }
  return out;
}

std::string in_words(const TopologyDifference& d) {
  const std::string label = "label " + std::to_string(d.label);
  if (d.what == "label") return label + (d.after > 0 ? " is not in the label surface" : " is missing");
  if (d.what == "contact") {
    const std::string pair = d.label == kBackground
                                 ? "label " + std::to_string(d.other) + " and background"
                                 : "labels " + std::to_string(d.label) + " and " + std::to_string(d.other);
    return pair + (d.after > 0 ? " touch, and did not before" : " no longer touch");
  }
  std::string what = d.what;
  std::replace(what.begin(), what.end(), '_', ' ');
  return label + ": " + what + " " + std::to_string(d.before) + " -> " + std::to_string(d.after);
}

}  // namespace voxtet
