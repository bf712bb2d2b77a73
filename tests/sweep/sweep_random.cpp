// Random label volumes through the pipeline: what breaks, in which of them, and how long it takes.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "geometry/digest.h"
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
  json failures = json::array();
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
      "%llu random volumes (method %s), %llu of them through to tetrahedra: %llu with defects\n"
      "digest of all results: %s\n\n",
      static_cast<unsigned long long>(tally.cases), method.c_str(),
      static_cast<unsigned long long>(tally.to_tets), static_cast<unsigned long long>(tally.failed),
      digest.c_str());
  std::printf("| stage | seconds |\n|---|---|\n");
  for (std::size_t i = 0; i < kStageCount; ++i)
    if (tally.seconds[i] > 0)
      std::printf("| %s | %.1f |\n", std::string(kStageNames[i]).c_str(), tally.seconds[i]);
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Random label volumes through the pipeline. Exit code 1 when anything is wrong with any."};
  std::uint64_t count = 1000, first = 1, tets_every = 5;
  std::string method = "delaunay", out;
  app.add_option("--count", count, "how many volumes");
  app.add_option("--first-seed", first, "the first one's seed; the others follow");
  app.add_option("--tets-every", tets_every, "every n-th goes through to tetrahedra; 0: none");
  app.add_option("--method", method, "remesh.method of the recipe");
  app.add_option("--json", out, "write the figures and every defect to this file");
  CLI11_PARSE(app, argc, argv);

  Tally tally;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Result<RandomCase> done = run_random_case(seed, method, tets_every && seed % tets_every == 0);
    if (!done) {
      std::fprintf(stderr, "seed %llu: %s\n", static_cast<unsigned long long>(seed),
                   done.error().message.c_str());
      return 2;
    }
    tally.add(*done);
    if ((seed - first + 1) % 100 == 0)
      std::fprintf(stderr, "%llu of %llu, %llu with defects\n",
                   static_cast<unsigned long long>(seed - first + 1), static_cast<unsigned long long>(count),
                   static_cast<unsigned long long>(tally.failed));
  }
  const std::string digest = tally.digest.hex();
  print(tally, method, digest);
  if (!out.empty()) {
    json seconds;
    for (std::size_t i = 0; i < kStageCount; ++i) seconds[std::string(kStageNames[i])] = tally.seconds[i];
    std::ofstream(out) << json{{"method", method},         {"first_seed", first},      {"cases", tally.cases},
                               {"to_tets", tally.to_tets}, {"failed", tally.failed},   {"digest", digest},
                               {"seconds", seconds},       {"defects", tally.failures}}
                              .dump(1)
                       << '\n';
  }
  return tally.failed ? 1 : 0;
}
