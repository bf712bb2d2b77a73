// Edits that threads plan and check ahead of their turn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/buckets.h"
#include "base/parallel.h"
#include "remesh/editor/complex_editor.h"

namespace voxtet::remesh {

struct PlannedEdit {
  bool any = false;  ///< false: there is nothing to attempt
  Edit edit;
  std::uint32_t hint = kNone;  ///< of the moved vertex
  EditFindings found;          ///< of the check; its zone holds whatever the plan depends on
};

/// Calls turn(item, plan) for the items of one group after the other; false as soon as one call returns
/// false. `plan` is what make_plan(item, check, plan) made of it on some thread, or null if it was not made,
/// or if edits have changed anything in its zone since: then the turn has to find out itself what to do. So
/// the result is that of turns without plans, for any number of threads. Planning may only read. Plans of a
/// group are made at once: few become stale where its items are apart (spread_order).
template <class MakePlan, class Turn>
bool take_turns(ComplexEditor& editor, int threads, const Buckets<std::uint32_t>& groups,
                const MakePlan& make_plan, const Turn& turn) {
  constexpr std::size_t kMostPlans = 1024;  // at once
  const bool ahead = threads > 1;
  std::vector<PlannedEdit> plans(ahead ? kMostPlans : 0);
  std::vector<EditCheck> checks(ahead ? static_cast<std::size_t>(threads) : 0, EditCheck(editor));
  const auto take = [&](std::span<const std::uint32_t> items) {
    if (ahead) {
      run_tasks_with(checks, items.size(),
                     [&](std::size_t k, EditCheck& check) { make_plan(items[k], check, plans[k]); });
      editor.watch();
    }
    for (std::size_t k = 0; k < items.size(); ++k)
      if (!turn(items[k], ahead && !editor.changed_in(plans[k].found.zone) ? &plans[k] : nullptr))
        return false;
    return true;
  };
  bool going = true;
  for (std::size_t g = 0; going && g < groups.size(); ++g)
    for (std::span<const std::uint32_t> left = groups.at(g); going && !left.empty();) {
      const std::size_t some = std::min(kMostPlans, left.size());
      going = take(left.first(some));
      left = left.subspan(some);
    }
  editor.unwatch();
  return going;
}

}  // namespace voxtet::remesh
