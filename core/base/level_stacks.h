// Items that wait for refinement, by levels of urgency.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace voxtet {

/// A queue that serves the most urgent items roughly first: it takes an item of the highest level that has
/// one, and inside a level the item pushed last, which is still in the caches.
template <class Item, std::size_t limits>
class LevelStacks {
 public:
  /// `above` holds ascending thresholds. The level of an item is the number of thresholds below its urgency.
  explicit LevelStacks(const std::array<double, limits>& above) : above_(above) {}

  void push(double urgency, const Item& item) {
    const auto level = std::lower_bound(above_.begin(), above_.end(), urgency) - above_.begin();
    stacks_[static_cast<std::size_t>(level)].push_back(item);
  }

  /// Takes out the next item; nothing if the queue is empty.
  std::optional<Item> pop() {
    const auto stack =
        std::find_if(stacks_.rbegin(), stacks_.rend(), [](const auto& s) { return !s.empty(); });
    if (stack == stacks_.rend()) return std::nullopt;
    const Item item = stack->back();
    stack->pop_back();
    return item;
  }

 private:
  std::array<double, limits> above_;
  std::array<std::vector<Item>, limits + 1> stacks_;
};

}  // namespace voxtet
