// A run of the mechanics stage that has come to some time, as bytes to go on from.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "base/digest.h"
#include "io/bytes/bytes.h"
#include "physics/beat/beat_record.h"
#include "physics/beat/heart_steps.h"
#include "types/result.h"

namespace voxtet {

struct MechanicsCheckpoint {
  nlohmann::json made_from;  ///< engine, mesh and the recipe's fields that the run has seen so far
  beat::HeartSteps::State state;
  beat::BeatMeasures measures;           ///< of the traces the values only
  std::vector<VentricleBeat> under_way;  ///< the beat
  std::vector<double> times_ms;          ///< of the frames so far
  double next_frame_ms = 0;
  std::uint64_t traced = 0;  ///< of the recorded times those that frames have had
  Sha256 digest;             ///< over the frames so far
};

Bytes write_checkpoint(const MechanicsCheckpoint& checkpoint);

/// Errors: kBadInput for bytes that are not of this version, and for those that are cut.
Result<MechanicsCheckpoint> read_mechanics_checkpoint(const Bytes& bytes);

}  // namespace voxtet
