#include "study/run_study.h"

#include <chrono>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "io/bytes/files.h"
#include "study/case_key.h"
#include "study/child_process.h"
#include "study/figures.h"

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

bool is_done(const Json& record) {
  return record.is_object() && record["status"] == "done";
}

/// Writes the files of a case, then its record: where that is, all of them are. Where there is no place for
/// them, the record says so. What another run has done meanwhile stays.
Status write_outcome(const std::string& out, const Reserve& reserve, CaseOutcome& outcome) {
  const std::string key = outcome.record["key"];
  if (!is_done(outcome.record) && is_done(record_at(out, key))) return std::monostate{};
  std::vector<std::string> paths;
  std::vector<TargetFile> targets;
  for (const CaseFile& file : outcome.files) paths.push_back((fs::path(out) / file.path).string());
  for (std::size_t i = 0; i < paths.size(); ++i) targets.push_back({paths[i], outcome.files[i].bytes});
  Status written = place_files(targets);
  if (written) written = write_record(out, outcome.record);
  if (written) return written;
  reserve.give_up();
  const std::string beginning = out + "/";
  std::string reason = written.error().message;
  if (reason.starts_with(beginning)) reason.erase(0, beginning.size());
  outcome.record["figures"] = no_figures();
  outcome.record.update({{"status", "failed"}, {"stage", "study"}, {"reason", reason}, {"again", true}});
  return write_record(out, outcome.record);
}

struct Job {
  const StudyCase* one;
  std::string key;
};

/// Runs a case and writes what it gave.
Status work(const Job& job, const Study& study, const StudyRun& run, const Reserve& reserve) {
  CaseOutcome outcome;
  try {
    outcome = run_case(*job.one, study.plan, job.key, run.limits);
  } catch (const std::exception& error) {
    relax_memory_limit();
    outcome.record = failed_record(*job.one, job.key, "study", error.what());
  }
  relax_memory_limit();
  return write_outcome(run.out, reserve, outcome);
}

/// The record of a case whose process has not written any.
Status write_failure(const Job& job, const std::string& reason, const StudyRun& run, const Reserve& reserve) {
  CaseOutcome outcome;
  outcome.record = failed_record(*job.one, job.key, "study", reason);
  return write_outcome(run.out, reserve, outcome);
}

/// Files that a run began to write before it was killed. Other runs may be writing now, but not for an hour.
void remove_litter(const std::string& folder) {
  constexpr std::chrono::hours kOld{1};
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
    const bool is_part = entry.path().filename().string().find(".part") != std::string::npos;
    if (is_part && fs::file_time_type::clock::now() - entry.last_write_time(failed) > kOld)
      fs::remove(entry.path(), failed);
  }
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
  if (!record.is_object()) return nullptr;
  const auto is = [&](const char* field, bool (Json::*kind)() const noexcept) {
    return record.contains(field) && (record[field].*kind)();
  };
  const bool whole = is("key", &Json::is_string) && is("status", &Json::is_string) &&
                     is("again", &Json::is_boolean) && is("figures", &Json::is_object) &&
                     is("cost", &Json::is_object) && is("link", &Json::is_string) &&
                     record.contains("stage") && record.contains("reason");
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
  for (const char* folder : {"cases", "files", "pictures"})
    remove_litter((fs::path(run.out) / folder).string());
  const Reserve reserve(run.out, run.chunk);
  std::size_t not_written = 0;
  std::string why;
  const auto tell = [&](const Job& job, bool was_there, bool written) {
    if (!written) {
      ++not_written;
      if (const Status place = check_place(record_path(run.out, job.key)); !place)
        why = place.error().message;
    }
    if (run.on_case) run.on_case(*job.one, written ? record_at(run.out, job.key) : Json(nullptr), was_there);
  };
  std::map<int, Job> running;
  const auto finish_one = [&] {
    const std::optional<ProcessEnd> end = wait_for_process();
    if (!end) {  // somebody else has waited for them
      for (const auto& [id, job] : running) tell(job, false, !record_at(run.out, job.key).is_null());
      running.clear();
      return;
    }
    const auto found = running.find(end->id);
    if (found == running.end()) return;
    bool written = end->exit_code == 0;
    if (end->signal != 0)
      written = write_failure(found->second, "its process was ended by " + name_of_signal(end->signal), run,
                              reserve)
                    .ok();
    tell(found->second, false, written);
    running.erase(found);
  };
  CaseKeys keys(study.plan);
  for (const StudyCase* one : cases_of_chunk(study, run.chunk)) {
    const Job job{one, keys.of(*one)};
    if (const Json record = record_at(run.out, job.key); !record.is_null() && !record["again"].get<bool>()) {
      tell(job, true, true);
      continue;
    }
    if (!kHasProcesses) {
      tell(job, false, work(job, study, run, reserve).ok());
      continue;
    }
    while (static_cast<int>(running.size()) >= run.jobs) finish_one();
    const Result<int> id =
        start_process([&] { return work(job, study, run, reserve) ? 0 : kNotWritten; }, run.limits.memory_mb);
    if (id)
      running.emplace(*id, job);
    else
      tell(job, false, write_failure(job, id.error().message, run, reserve).ok());
  }
  while (!running.empty()) finish_one();
  if (not_written == 0) return std::monostate{};
  return Error{ErrorCode::kBadInput,
               "study",
               "the records of " + std::to_string(not_written) + " cases could not be written" +
                   (why.empty() ? "" : " (" + why + ")") + "; mend that, and run the study again",
               {}};
}

}  // namespace voxtet
