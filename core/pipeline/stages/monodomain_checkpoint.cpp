#include "pipeline/stages/monodomain_checkpoint.h"

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace voxtet {
namespace {

constexpr std::string_view kMagic = "voxtet monodomain state 1\n";

/// Lengths and values, one after the other.
class Writer {
 public:
  Writer() { put(kMagic.data(), kMagic.size()); }

  void text(const std::string& text) {
    value(static_cast<std::uint64_t>(text.size()));
    put(text.data(), text.size());
  }
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(&value, sizeof(T));
  }
  template <class T>
  void list(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(values.size()));
    put(values.data(), values.size() * sizeof(T));
  }
  Bytes take() { return std::move(bytes_); }

 private:
  void put(const void* from, std::size_t size) {
    const auto* const bytes = static_cast<const std::uint8_t*>(from);
    bytes_.insert(bytes_.end(), bytes, bytes + size);
  }

  Bytes bytes_;
};

/// What does not fit into the bytes is left as it was, and complete() is false.
class Reader {
 public:
  explicit Reader(const Bytes& bytes) : bytes_(bytes) {}

  bool is_ours() const {
    return bytes_.size() >= kMagic.size() && std::memcmp(bytes_.data(), kMagic.data(), kMagic.size()) == 0;
  }
  bool complete() const { return complete_ && at_ == bytes_.size(); }

  void text(std::string& text) {
    text.resize(length(1));
    take(text.data(), text.size());
  }
  template <class T>
  void value(T& value) {
    if (fits(sizeof(T))) take(&value, sizeof(T));
  }
  template <class T>
  void list(std::vector<T>& values) {
    values.resize(length(sizeof(T)));
    take(values.data(), values.size() * sizeof(T));
  }

 private:
  bool fits(std::uint64_t size) {
    complete_ = complete_ && size <= bytes_.size() - at_;
    return complete_;
  }
  std::size_t length(std::size_t of_one) {
    std::uint64_t count = 0;
    value(count);
    if (count > bytes_.size()) complete_ = false;
    return complete_ && fits(count * of_one) ? static_cast<std::size_t>(count) : 0;
  }
  void take(void* to, std::size_t size) {
    if (size == 0) return;
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }

  const Bytes& bytes_;
  std::size_t at_ = kMagic.size();
  bool complete_ = true;
};

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
  Writer writer;
  writer.text(checkpoint.made_from.dump());
  writer.value(static_cast<std::uint64_t>(checkpoint.traces.size()));
  visit(writer, checkpoint);
  return writer.take();
}

Result<MonodomainCheckpoint> read_checkpoint(const Bytes& bytes) {
  Reader reader(bytes);
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
