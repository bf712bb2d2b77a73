// Items grouped by a small integer key, without a sort over all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxtet {

/// Items in buckets by a key below `buckets`, each bucket in the order of adding. Two passes: count every
/// item's key, allocate, then add every item under the same key.
template <class Item>
class Buckets {
 public:
  explicit Buckets(std::size_t buckets) : start_(buckets + 1, 0) {}
  void count(std::uint32_t key) { ++start_[key + 1]; }
  void allocate() {
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    fill_.assign(start_.begin(), start_.end() - 1);
    items_.resize(start_.back());
  }
  void add(std::uint32_t key, const Item& item) { items_[fill_[key]++] = item; }
  std::size_t size() const { return start_.size() - 1; }
  std::span<Item> at(std::size_t key) {
    return std::span<Item>(items_).subspan(start_[key], start_[key + 1] - start_[key]);
  }

 private:
  std::vector<std::size_t> start_, fill_;
  std::vector<Item> items_;
};

}  // namespace voxtet
