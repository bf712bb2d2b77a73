// Results of stages, found by what they were made from, so that an undo in the app finds its mesh again.
#pragma once

#include <any>
#include <cstddef>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/stages/stage.h"

namespace voxtet {

/// What one stage did.
struct StageRecord {
  std::string key;     ///< digest of everything the stage depends on; empty: it has not run
  double seconds = 0;  ///< wall time of the run that made the result
  double peak_mb = 0;  ///< native: peak resident memory during the stage; wasm: linear memory after it
  std::vector<std::string> warnings, notes;
};

/// A stage's value, with the record of the run that made it. Never changes.
struct StageResult {
  std::any value;         ///< std::shared_ptr<const T>, T the stage's own type (stage_results.h)
  std::size_t bytes = 0;  ///< memory that it holds
  StageRecord record;
};

/// Keeps the results that the current recipe needs and, of earlier recipes, the most recently used ones that
/// fit into `spare_bytes`.
class ResultStore {
 public:
  explicit ResultStore(std::size_t spare_bytes) : spare_bytes_(spare_bytes) {}

  /// Null if there is none. A result that is found counts as used.
  const StageResult* find(Stage stage, const std::string& key) const;
  void keep(Stage stage, std::shared_ptr<const StageResult> result);
  /// Drops results that `keys` (one for each stage) do not name, least recently used first, until the rest of
  /// them fits.
  void trim(const StageKeys& keys);
  std::size_t bytes() const;  ///< of all results

 private:
  struct Entry {
    Stage stage;
    std::shared_ptr<const StageResult> result;
  };
  mutable std::list<Entry> entries_;  ///< the most recently used first
  std::size_t spare_bytes_;
};

}  // namespace voxtet
