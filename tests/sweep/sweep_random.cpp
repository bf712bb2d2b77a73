// Random label volumes through the pipeline: what breaks, in which of them, and how long it takes.
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "base/digest.h"
#include "sweep/command_line.h"
#include "sweep/random_case.h"

using namespace voxtet;
using namespace voxtet::sweep;

namespace {

using nlohmann::json;

struct Tally {
  std::uint64_t cases = 0, to_tets = 0, failed = 0;
  std::map<std::array<std::string, 2>, std::vector<std::uint64_t>> seeds;  ///< by {stage, kind of defect}
  std::map<std::string, std::array<std::uint64_t, 2>> kinds;               ///< {cases, failed} by kind
  std::array<double, kStageCount> seconds{};
  json failures = json::array(), gave_way = json::array();
  Sha256 digest;  ///< of all last results: native and wasm agree

  void add(const RandomCase& c) {
    digest.update(c.digest);
    ++cases;
    to_tets += c.last == Stage::kTetra ? 1 : 0;
    failed += c.defects.empty() ? 0 : 1;
    for (const std::string& group : {c.kind, c.affine}) {
      ++kinds[group][0];
      kinds[group][1] += c.defects.empty() ? 0 : 1;
    }
    if (!c.gave_way.empty()) gave_way.push_back({{"seed", c.seed}, {"why", c.gave_way}});
    for (std::size_t i = 0; i < kStageCount; ++i) seconds[i] += c.seconds[i];
    for (const Defect& d : c.defects) {
      seeds[{d.stage, d.kind}].push_back(c.seed);
      failures.push_back({{"seed", c.seed},
                          {"volume", c.kind},
                          {"affine", c.affine},
                          {"stage", d.stage},
                          {"defect", d.kind},
                          {"detail", d.detail}});
    }
  }
};

void print(const Tally& tally, const std::string& method, const std::string& digest) {
  std::printf(
      "%llu random volumes (method %s), %llu of them through to tetrahedra: %llu with defects, %zu for which "
      "delaunay gave way to adapt\n"
      "digest of all results: %s\n\n",
      static_cast<unsigned long long>(tally.cases), method.c_str(),
      static_cast<unsigned long long>(tally.to_tets), static_cast<unsigned long long>(tally.failed),
      tally.gave_way.size(), digest.c_str());
  std::printf("| stage | seconds |\n|---|---|\n");
  for (std::size_t i = 0; i < kStageCount; ++i)
    if (tally.seconds[i] > 0)
      std::printf("| %s | %.1f |\n", name_of(static_cast<Stage>(i)).c_str(), tally.seconds[i]);
  std::printf("\n| volume, affine | cases | with defects |\n|---|---|---|\n");
  for (const auto& [name, counts] : tally.kinds)
    std::printf("| %s | %llu | %llu |\n", name.c_str(), static_cast<unsigned long long>(counts[0]),
                static_cast<unsigned long long>(counts[1]));
  if (tally.seeds.empty()) return;
  std::printf("\n| stage | defect | cases | first seeds |\n|---|---|---|---|\n");
  for (const auto& [key, seeds] : tally.seeds) {
    std::printf("| %s | %s | %zu |", key[0].c_str(), key[1].c_str(), seeds.size());
    for (std::size_t i = 0; i < seeds.size() && i < 12; ++i)
      std::printf(" %llu", static_cast<unsigned long long>(seeds[i]));
    std::printf(" |\n");
  }
}

struct Seeds {
  std::uint64_t count = 1000, first = 1, tets_every = 5;
};

Result<Tally> sweep_seeds(const Seeds& seeds, const std::string& method) {
  Tally tally;
  for (std::uint64_t seed = seeds.first; seed < seeds.first + seeds.count; ++seed) {
    const Result<RandomCase> done =
        run_random_case(seed, method, seeds.tets_every && seed % seeds.tets_every == 0);
    if (!done) return done.error();
    tally.add(*done);
    if ((seed - seeds.first + 1) % 100 == 0)
      std::fprintf(stderr, "%llu of %llu, %llu with defects\n",
                   static_cast<unsigned long long>(seed - seeds.first + 1),
                   static_cast<unsigned long long>(seeds.count),
                   static_cast<unsigned long long>(tally.failed));
  }
  return tally;
}

json to_json(const Tally& tally, const std::string& method, const std::string& digest, std::uint64_t first) {
  json seconds;
  for (std::size_t i = 0; i < kStageCount; ++i) seconds[name_of(static_cast<Stage>(i))] = tally.seconds[i];
  return {{"method", method},         {"first_seed", first},       {"cases", tally.cases},
          {"to_tets", tally.to_tets}, {"failed", tally.failed},    {"digest", digest},
          {"seconds", seconds},       {"defects", tally.failures}, {"gave_way", tally.gave_way}};
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{"Random label volumes through the pipeline. Exit code 1 when anything is wrong with any."};
  Seeds seeds;
  line.app.add_option("--count", seeds.count, "how many volumes");
  line.app.add_option("--first-seed", seeds.first, "the first one's seed; the others follow");
  line.app.add_option("--tets-every", seeds.tets_every, "every n-th goes through to tetrahedra; 0: none");
  line.parse(argc, argv);

  json rows = json::array();
  bool failed = false;
  for (const std::string& method : line.methods) {
    Result<Tally> tally = sweep_seeds(seeds, method);
    if (!tally) {
      std::fprintf(stderr, "%s\n", tally.error().message.c_str());
      return 2;
    }
    const std::string digest = tally->digest.hex();
    print(*tally, method, digest);
    rows.push_back(to_json(*tally, method, digest, seeds.first));
    failed = failed || tally->failed;
  }
  if (!line.json_file.empty()) std::ofstream(line.json_file) << json{{"rows", rows}}.dump(1) << '\n';
  return failed ? 1 : 0;
}
