#include "study/run_study.h"

#include <deque>
#include <filesystem>
#include <map>
#include <new>
#include <optional>
#include <utility>

#include "io/bytes/files.h"
#include "study/child_process.h"

namespace voxtet {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kNotWritten = 3;  // exit code of the process of a case

std::string record_path(const std::string& out, const std::string& key) {
  return (fs::path(out) / "cases" / (key + ".json")).string();
}

/// A file that keeps a little of the disk, to be given up for the records of failures when the disk is full.
class Reserve {
 public:
  Reserve(const std::string& out, const Chunk& chunk)
      : path_((fs::path(out) / (".reserve-" + std::to_string(chunk.index) + "of" + std::to_string(chunk.of)))
                  .string()) {
    constexpr std::size_t kBytes = 1U << 20U;
    place_files({{path_, Bytes(kBytes)}});  // without it, if need be
  }
  ~Reserve() { give_up(); }
  Reserve(const Reserve&) = delete;
  Reserve& operator=(const Reserve&) = delete;
  void give_up() const {
    std::error_code failed;
    fs::remove(path_, failed);
  }

 private:
  std::string path_;
};

Status write_record(const std::string& out, const Json& record) {
  return write_text_file(record_path(out, record["key"]),
                         record.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

/// Writes the files of a case, then its record: where that is, all of them are. Where there is no place for
/// them, the record says so.
Status write_outcome(const std::string& out, const Reserve& reserve, CaseOutcome& outcome) {
  std::vector<std::string> paths;
  for (const CaseFile& file : outcome.files) paths.push_back((fs::path(out) / file.path).string());
  std::vector<TargetFile> targets;
  for (std::size_t i = 0; i < paths.size(); ++i) targets.push_back({paths[i], outcome.files[i].bytes});
  Status written = place_files(targets);
  if (written) written = write_record(out, outcome.record);
  if (written) return written;
  reserve.give_up();
  for (const auto& [column, value] : outcome.record["figures"].items())
    outcome.record["figures"][column] = nullptr;
  outcome.record.update(
      {{"status", "failed"}, {"stage", "study"}, {"reason", written.error().message}, {"again", true}});
  return write_record(out, outcome.record);
}

struct Job {
  const StudyCase* one;
  std::string key;
};

/// Runs a case and writes what it gave; the exit code of its process.
int work(const Job& job, const Study& study, const StudyRun& run, const Reserve& reserve) {
  CaseOutcome outcome;
  try {
    outcome = run_case(*job.one, study.plan, job.key, run.limits);
  } catch (const std::exception& error) {
    relax_memory_limit();
    outcome.record = failed_record(*job.one, job.key, "study", error.what());
  }
  relax_memory_limit();
  return write_outcome(run.out, reserve, outcome) ? 0 : kNotWritten;
}

/// A process that died has not written why.
Status write_death(const Job& job, const ProcessEnd& end, const StudyRun& run, const Reserve& reserve) {
  CaseOutcome outcome;
  outcome.record =
      failed_record(*job.one, job.key, "study", "its process was ended by " + name_of_signal(end.signal));
  return write_outcome(run.out, reserve, outcome);
}

}  // namespace

std::vector<const StudyCase*> cases_of_chunk(const Study& study, const Chunk& chunk) {
  std::vector<const StudyCase*> cases;
  for (std::size_t i = chunk.index - 1; i < study.cases.size(); i += chunk.of)
    cases.push_back(&study.cases[i]);
  return cases;
}

Json record_at(const std::string& out, const std::string& key) {
  const Result<Bytes> bytes = read_file(record_path(out, key));
  if (!bytes) return nullptr;
  Json record = Json::parse(bytes->begin(), bytes->end(), nullptr, false);
  const auto has = [&](const char* field) { return record.contains(field); };
  const bool whole = record.is_object() && has("status") && has("stage") && has("reason") && has("again") &&
                     has("figures") && has("cost") && has("link");
  return whole && record["key"] == key ? record : Json(nullptr);
}

Status run_study(const Study& study, const StudyRun& run) {
  for (const char* folder : {"cases", "files", "pictures"}) {
    std::error_code failed;
    fs::create_directories(fs::path(run.out) / folder, failed);
    if (failed)
      return Error{
          ErrorCode::kBadInput, "study", (fs::path(run.out) / folder).string() + ": " + failed.message(), {}};
  }
  const Reserve reserve(run.out, run.chunk);
  std::size_t not_written = 0;
  const auto tell = [&](const Job& job, bool was_there) {
    const Json record = record_at(run.out, job.key);
    if (record.is_null()) ++not_written;
    if (run.on_case) run.on_case(*job.one, record, was_there);
  };
  std::map<int, Job> running;
  const auto finish_one = [&] {
    const ProcessEnd end = wait_for_process();
    const auto found = running.find(end.id);
    if (found == running.end()) return;
    if (end.signal != 0) write_death(found->second, end, run, reserve);
    tell(found->second, false);
    running.erase(found);
  };
  for (const StudyCase* one : cases_of_chunk(study, run.chunk)) {
    const Job job{one, key_of(*one, study.plan)};
    if (const Json record = record_at(run.out, job.key); !record.is_null() && !record.value("again", false)) {
      tell(job, true);
      continue;
    }
    while (static_cast<int>(running.size()) >= run.jobs) finish_one();
    const std::optional<int> id =
        start_process([&] { return work(job, study, run, reserve); }, run.limits.memory_mb);
    if (id) {
      running.emplace(*id, job);
    } else {
      work(job, study, run, reserve);
      tell(job, false);
    }
  }
  while (!running.empty()) finish_one();
  if (not_written == 0) return std::monostate{};
  return Error{ErrorCode::kBadInput,
               "study",
               run.out + ": the records of " + std::to_string(not_written) +
                   " cases could not be written; make room, and run the study again",
               {}};
}

}  // namespace voxtet
