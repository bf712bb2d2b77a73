#include "pipeline/simulations/monodomain_checkpoint.h"

#include <string>
#include <string_view>

#include "pipeline/simulations/checkpoint_archive.h"

namespace voxtet {
namespace {

constexpr std::string_view kKind = "voxtet monodomain state 1\n";

/// The same order for both.
template <class Archive, class Checkpoint>
void visit(Archive& archive, Checkpoint& checkpoint) {
  archive.value(checkpoint.state.steps);
  archive.value(checkpoint.state.step_ms);
  archive.list(checkpoint.state.v);
  archive.list(checkpoint.state.w);
  archive.list(checkpoint.state.change);
  archive.list(checkpoint.state.earlier);
  archive.list(checkpoint.state.activations);
  archive.list(checkpoint.state.repolarisations);
  archive.list(checkpoint.times_ms);
  archive.list(checkpoint.trace_times_ms);
  archive.value(checkpoint.digest);
  for (auto& values : checkpoint.traces) archive.list(values);
}

Error damaged(const char* what) {
  return {ErrorCode::kBadInput, "monodomain", std::string("state: found ") + what, {}};
}

}  // namespace

Bytes write_checkpoint(const MonodomainCheckpoint& checkpoint) {
  CheckpointWriter writer(kKind);
  writer.text(checkpoint.made_from.dump());
  writer.value(static_cast<std::uint64_t>(checkpoint.traces.size()));
  visit(writer, checkpoint);
  return writer.take();
}

Result<MonodomainCheckpoint> read_checkpoint(const Bytes& bytes) {
  CheckpointReader reader(kKind, bytes);
  if (!reader.is_ours()) return damaged("bytes of another kind, expected the saved state of a simulation");
  MonodomainCheckpoint checkpoint;
  std::string made_from;
  std::uint64_t traces = 0;
  reader.text(made_from);
  reader.value(traces);
  if (traces > bytes.size()) return damaged("damaged bytes, expected a whole file");
  checkpoint.traces.resize(static_cast<std::size_t>(traces));
  visit(reader, checkpoint);
  checkpoint.made_from = nlohmann::json::parse(made_from, nullptr, false);
  if (!reader.complete() || !checkpoint.made_from.is_object())
    return damaged("cut or damaged bytes, expected a whole file");
  const std::size_t points = checkpoint.state.v.size();
  for (const auto* crossings : {&checkpoint.state.activations, &checkpoint.state.repolarisations})
    for (const ActivationLog::Crossing& crossing : *crossings)
      if (crossing.point >= points) return damaged("a point out of range, expected a whole file");
  return checkpoint;
}

}  // namespace voxtet
