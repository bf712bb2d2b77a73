// A set of numbers that is emptied again and again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxtet {

/// Takes as much memory as the largest set that it has held, however large the numbers are.
class IdSet {
 public:
  void clear() {
    size_ = 0;
    if (++round_ != 0) return;
    std::fill(slots_.begin(), slots_.end(), Slot{});
    round_ = 1;
  }

  /// Whether the number was not in the set before.
  bool insert(std::uint32_t id) {
    Slot& slot = slot_of(id);
    if (slot.round == round_) return false;
    slot = {id, round_};
    if (2 * ++size_ > slots_.size()) grow();
    return true;
  }

 private:
  struct Slot {
    std::uint32_t id = 0, round = 0;  ///< the round in which it was filled
  };

  /// The one that holds `id`, or the one where it would go.
  Slot& slot_of(std::uint32_t id) {
    constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15U;
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = static_cast<std::size_t>(id * kGoldenRatio >> 32U) & mask;
    while (slots_[at].round == round_ && slots_[at].id != id) at = (at + 1) & mask;
    return slots_[at];
  }

  void grow() {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
    for (const Slot& slot : old)
      if (slot.round == round_) slot_of(slot.id) = slot;
  }

  std::vector<Slot> slots_{128};  ///< a power of two, never more than half full
  std::size_t size_ = 0;
  std::uint32_t round_ = 1;
};

}  // namespace voxtet
