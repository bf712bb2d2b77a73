#include "cli/verify.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/digest.h"
#include "cli/cli.h"
#include "cli/input/case_input.h"
#include "cli/print.h"
#include "pipeline/report.h"
#include "pipeline/results/describe_results.h"
#include "pipeline/version/engine_version.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using nlohmann::json;

/// What was found and what was promised: a digest, or a version.
struct Pair {
  std::string name, found, expected;
  bool same() const { return expected.empty() || expected == found; }
};

}  // namespace

int run_verify(const CaseOptions& options, const Output& output) {
  RunContext ctx = context_of(output);
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error(), output);
  const Result<Expected> expected = expected_of(session.recipe(), options.input);
  if (!expected) return fail(expected.error(), output);
  if (Status done = session.run(Stage::kOptimise, ctx); !done) return fail_run(done.error(), output);
  std::vector<Pair> digests{{"digest", digest_of(*session.mesh()), expected->digest}};
  const auto [eikonal, monodomain, mechanics] = expected->stages;
  if (!eikonal.empty()) {
    if (Status done = session.run(Stage::kEikonal, ctx); !done) return fail_run(done.error(), output);
    digests.push_back({kEikonalStage, digest_of(*session.eikonal()), eikonal});
  }
  if (!monodomain.empty()) {
    if (Status done = session.run(Stage::kMonodomain, ctx); !done) return fail_run(done.error(), output);
    digests.push_back({kMonodomainStage, digest_of(*session.monodomain()), monodomain});
  }
  if (!mechanics.empty()) {
    if (Status done = session.run(Stage::kMechanics, ctx); !done) return fail_run(done.error(), output);
    digests.push_back({kMechanicsStage, digest_of(*session.mechanics()), mechanics});
  }
  const Pair engine{"engine", engine_version(), expected->engine};
  const Pair physics{"physics", physics_version(), expected->physics};
  bool same = true;
  for (const Pair& one : digests) same = same && one.same();
  const bool same_engine = engine.same() && (digests.size() == 1 || physics.same());
  const std::string verdict = same ? "reproduced" : same_engine ? "differs" : "made with another engine";
  if (output.as_json) {
    json out{{"verdict", verdict},
             {"digest", digests.front().found},
             {"expected", digests.front().expected},
             {"tets", session.mesh()->tets.size()},
             {"expected_tets", expected->tets},
             {"engine", engine.found},
             {"expected_engine", engine.expected},
             {"stages", json::object()}};
    for (std::size_t i = 1; i < digests.size(); ++i)
      out["stages"][digests[i].name] = {{"digest", digests[i].found}, {"expected", digests[i].expected}};
    if (digests.size() > 1) {
      out["physics"] = physics.found;
      out["expected_physics"] = physics.expected;
    }
    print_json(out);
  } else {
    const auto print = [](const Pair& pair) {
      std::printf("  %s %s, expected %s\n", pair.name.c_str(), pair.found.c_str(),
                  pair.expected.empty() ? "any" : pair.expected.c_str());
    };
    std::printf("%s\n", verdict.c_str());
    print(engine);
    if (digests.size() > 1) print(physics);
    for (const Pair& pair : digests) print(pair);
    std::printf("  tets %zu, expected %u\n", session.mesh()->tets.size(), expected->tets);
  }
  return same ? kExitOk : kExitDiffers;
}

}  // namespace voxtet
