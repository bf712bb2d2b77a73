// Items grouped by a small integer key, without sorting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxtet {

/// Items in buckets by a key below `buckets`. Inside a bucket, items stay in the order in which they were
/// added. Two passes: count every item's key, allocate, then add every item under the same key.
template <class Item>
class Buckets {
 public:
  explicit Buckets(std::size_t buckets) : start_(buckets + 2, 0) {}
  void count(std::uint32_t key) { ++start_[key + 2]; }
  void allocate() {
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    items_.resize(start_.back());
  }
  void add(std::uint32_t key, const Item& item) { items_[start_[key + 1]++] = item; }
  std::size_t size() const { return start_.size() - 2; }
  std::span<Item> at(std::size_t key) { return between(key, key); }
  std::span<const Item> at(std::size_t key) const {
    return std::span<const Item>(items_).subspan(start_[key], start_[key + 1] - start_[key]);
  }
  /// The items of all keys from `first` to `last`, both included.
  std::span<Item> between(std::size_t first, std::size_t last) {
    return std::span<Item>(items_).subspan(start_[first], start_[last + 1] - start_[first]);
  }

 private:
  /// Once all items are added, bucket k starts at items_[start_[k]]. Until then, start_[k + 1] is where the
  /// next item of bucket k goes.
  std::vector<std::size_t> start_;
  std::vector<Item> items_;
};

}  // namespace voxtet
