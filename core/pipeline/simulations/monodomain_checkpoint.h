// A run of the monodomain stage that has come to some time, as bytes to go on from.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "base/digest.h"
#include "io/bytes/bytes.h"
#include "physics/monodomain/monodomain.h"
#include "types/result.h"

namespace voxtet {

struct MonodomainCheckpoint {
  nlohmann::json made_from;  ///< engine, mesh, tissue and the recipe's fields that the run has seen so far
  MonodomainState state;
  std::vector<double> times_ms;  ///< of the frames so far
  std::vector<double> trace_times_ms;
  std::vector<std::vector<float>> traces;  ///< values of each electrode
  Sha256 digest;                           ///< over the frames so far
};

Bytes write_checkpoint(const MonodomainCheckpoint& checkpoint);

/// Errors: kBadInput for bytes that are not of this version, and for those that are cut.
Result<MonodomainCheckpoint> read_checkpoint(const Bytes& bytes);

}  // namespace voxtet
