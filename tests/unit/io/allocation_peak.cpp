#include "unit/io/allocation_peak.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {
std::size_t alive = 0, at_reset = 0, peak = 0;  // these tests have one thread
constexpr std::size_t kPrefix = 16;             // holds the size and keeps the alignment of malloc
}  // namespace

void* operator new(std::size_t size) {
  auto* block = static_cast<char*>(size < SIZE_MAX - kPrefix ? std::malloc(size + kPrefix) : nullptr);
  if (block == nullptr) throw std::bad_alloc();
  std::memcpy(block, &size, sizeof size);
  alive += size;
  peak = std::max(peak, alive);
  return block + kPrefix;
}

void operator delete(void* pointer) noexcept {
  if (pointer == nullptr) return;
  char* block = static_cast<char*>(pointer) - kPrefix;
  std::size_t size = 0;
  std::memcpy(&size, block, sizeof size);
  alive -= size;
  std::free(block);
}

void operator delete(void* pointer, std::size_t) noexcept {
  operator delete(pointer);
}

namespace voxtet::test {

void reset_allocation_peak() {
  at_reset = peak = alive;
}
std::size_t allocation_peak() {
  return peak - at_reset;
}

}  // namespace voxtet::test
