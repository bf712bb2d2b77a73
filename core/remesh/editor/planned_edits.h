// Edits that threads plan and check ahead of their turn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "remesh/editor/complex_editor.h"

namespace voxtet::remesh {

struct PlannedEdit {
  bool any = false;  ///< false: there is nothing to attempt
  Edit edit;
  std::uint32_t hint = kNone;  ///< of the moved vertex
  EditFindings found;          ///< of the check; its zone holds whatever the plan depends on
};

/// Calls turn(i, plan) for each i below ends.back(), one after the other; false as soon as one of them
/// returns false. `plan` is what make_plan(i, check, plan) made of it on some thread, or null if it was not
/// made, or if edits have changed anything in its zone since: then the turn has to find out itself what to
/// do. So the result is that of turns without plans, for any number of threads. Planning may only read.
/// `ends`: of groups whose plans are made at once, ascending (SpreadOrder).
template <class MakePlan, class Turn>
bool take_turns(ComplexEditor& editor, int threads, std::span<const std::size_t> ends,
                const MakePlan& make_plan, const Turn& turn) {
  const std::size_t count = ends.empty() ? 0 : ends.back();
  if (threads < 2) {
    for (std::size_t i = 0; i < count; ++i)
      if (!turn(i, nullptr)) return false;
    return true;
  }
  constexpr std::size_t kMostPlans = 1024;  // at once
  std::vector<PlannedEdit> plans(std::min(kMostPlans, count));
  std::vector<EditCheck> checks(static_cast<std::size_t>(threads), EditCheck(editor));
  bool going = true;
  for (std::size_t first = 0; going && first < count;) {
    while (ends.front() <= first) ends = ends.subspan(1);
    const std::size_t some = std::min(kMostPlans, ends.front() - first);
    run_tasks_with(checks, some,
                   [&](std::size_t k, EditCheck& check) { make_plan(first + k, check, plans[k]); });
    editor.watch();
    for (std::size_t k = 0; going && k < some; ++k)
      going = turn(first + k, editor.changed_in(plans[k].found.zone) ? nullptr : &plans[k]);
    first += some;
  }
  editor.unwatch();
  return going;
}

}  // namespace voxtet::remesh
