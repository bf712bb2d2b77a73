// What is to be done, by levels of urgency.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace voxtet {

/// A queue for refinement, where the most urgent need only come about first: the highest level before the
/// others, and inside a level what was pushed last, which is still in the caches.
template <class Item, std::size_t limits>
class LevelStacks {
 public:
  /// `above`, ascending: an item is as many levels up as its urgency is above.
  explicit LevelStacks(const std::array<double, limits>& above) : above_(above) {}

  void push(double urgency, const Item& item) {
    const auto level = std::lower_bound(above_.begin(), above_.end(), urgency) - above_.begin();
    stacks_[static_cast<std::size_t>(level)].push_back(item);
  }

  /// Nothing where none is left.
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
