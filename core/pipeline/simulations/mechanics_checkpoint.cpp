#include "pipeline/simulations/mechanics_checkpoint.h"

#include <string>
#include <string_view>

#include "pipeline/simulations/checkpoint_archive.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

constexpr std::string_view kMechanicsKind = "voxtet mechanics state 1\n";

void visit_vector(CheckpointWriter& archive, const Eigen::VectorXd& values) {
  archive.list(std::vector<double>(values.begin(), values.end()));
}

void visit_vector(CheckpointReader& archive, Eigen::VectorXd& values) {
  std::vector<double> list;
  archive.list(list);
  values = Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

/// The same order for both. Lists of lists have their lengths already.
template <class Archive, class Checkpoint>
void visit_mechanics(Archive& archive, Checkpoint& checkpoint) {
  auto& motion = checkpoint.state.motion;
  archive.value(motion.time_s);
  for (auto* values : {&motion.u, &motion.velocity, &motion.acceleration, &motion.cavity_kpa,
                       &motion.cavity_ml, &motion.circulation})
    visit_vector(archive, *values);
  archive.value(checkpoint.state.tick);
  archive.value(checkpoint.state.length);
  archive.value(checkpoint.state.force_scale);
  archive.value(checkpoint.state.steps);
  archive.value(checkpoint.state.iterations);
  archive.list(checkpoint.measures.times_ms);
  for (auto& trace : checkpoint.measures.traces) archive.list(trace.values);
  for (auto& beat : checkpoint.measures.beats) archive.list(beat);
  archive.list(checkpoint.measures.ml_at_end);
  archive.list(checkpoint.measures.ml_before);
  archive.list(checkpoint.under_way);
  archive.list(checkpoint.times_ms);
  archive.value(checkpoint.next_frame_ms);
  archive.value(checkpoint.traced);
  archive.value(checkpoint.digest);
}

Error damaged_state(const char* what) {
  return {ErrorCode::kBadInput, kMechanicsStage, std::string("state: found ") + what, {}};
}

}  // namespace

Bytes write_checkpoint(const MechanicsCheckpoint& checkpoint) {
  CheckpointWriter writer(kMechanicsKind);
  writer.text(checkpoint.made_from.dump());
  writer.value(static_cast<std::uint64_t>(checkpoint.measures.traces.size()));
  writer.value(static_cast<std::uint64_t>(checkpoint.measures.beats.size()));
  visit_mechanics(writer, checkpoint);
  return writer.take();
}

Result<MechanicsCheckpoint> read_mechanics_checkpoint(const Bytes& bytes) {
  CheckpointReader reader(kMechanicsKind, bytes);
  if (!reader.is_ours())
    return damaged_state("bytes of another kind, expected the saved state of a beating heart");
  MechanicsCheckpoint checkpoint;
  std::string made_from;
  std::uint64_t traces = 0, beats = 0;
  reader.text(made_from);
  reader.value(traces);
  reader.value(beats);
  if (traces > bytes.size() || beats > bytes.size())
    return damaged_state("damaged bytes, expected a whole file");
  checkpoint.measures.traces.resize(static_cast<std::size_t>(traces));
  checkpoint.measures.beats.resize(static_cast<std::size_t>(beats));
  visit_mechanics(reader, checkpoint);
  checkpoint.made_from = nlohmann::json::parse(made_from, nullptr, false);
  if (!reader.complete() || !checkpoint.made_from.is_object())
    return damaged_state("cut or damaged bytes, expected a whole file");
  for (const Trace& trace : checkpoint.measures.traces)
    if (trace.values.size() != checkpoint.measures.times_ms.size())
      return damaged_state("traces of different lengths, expected a whole file");
  return checkpoint;
}

}  // namespace voxtet
