#include "pipeline/result_store.h"

#include <algorithm>

namespace voxtet {

const StageResult* ResultStore::find(Stage stage, const std::string& key) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.stage == stage && entry.result->record.key == key;
  });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return found->result.get();
}

void ResultStore::keep(Stage stage, std::shared_ptr<const StageResult> result) {
  entries_.remove_if([&](const Entry& entry) {
    return entry.stage == stage && entry.result->record.key == result->record.key;
  });
  entries_.push_front({stage, std::move(result)});
}

void ResultStore::trim(const StageKeys& keys) {
  std::size_t spare = 0;
  entries_.remove_if([&](const Entry& entry) {
    if (entry.result->record.key == keys[static_cast<std::size_t>(entry.stage)]) return false;
    spare += entry.result->bytes;
    return spare > spare_bytes_;
  });
}

std::size_t ResultStore::bytes() const {
  std::size_t bytes = 0;
  for (const Entry& entry : entries_) bytes += entry.result->bytes;
  return bytes;
}

}  // namespace voxtet
