// The longest that a stage works without asking whether it shall stop: so long may a cancel or a time limit
// wait.
#include <algorithm>
#include <ctime>
#include <map>

#include "phantom/make_phantom.h"
#include "support/data.h"
#include "sweep/command_line.h"
#include "sweep/findings.h"
#include "sweep/table_cases.h"

using namespace voxtet;
using namespace voxtet::sweep;

namespace {

constexpr double kLongest = 1;  ///< processor seconds of one thread

/// The atlas of many labels that is generated, at twice its spacing.
Status open_atlas(int regions, double spacing_mm, Session& session) {
  PhantomParams params;
  params.kind = PhantomKind::kAtlas;
  params.regions = regions;
  params.spacing_mm = {spacing_mm, spacing_mm, spacing_mm};
  const Result<LabelVolume> volume = make_phantom(params);
  if (!volume) return volume.error();
  if (Status loaded = load_labels(*volume, session); !loaded) return loaded;
  return set_fields({"sizing.edge_mm=" + std::to_string(2 * spacing_mm)}, session);
}

struct Silence {
  double seconds = 0, at = 0;  ///< at this part of the stage's progress
};

/// Meshes, and measures each stage.
Result<std::map<std::string, Silence>> listen(Session& session) {
  std::map<std::string, Silence> longest;
  std::string stage;
  double fraction = 0;
  std::clock_t last = std::clock();
  const auto heard = [&] {
    const std::clock_t now = std::clock();
    const double seconds = static_cast<double>(now - last) / CLOCKS_PER_SEC;
    if (seconds > longest[stage].seconds) longest[stage] = {seconds, fraction};
    last = now;
  };
  RunContext ctx;
  ctx.on_cancelled = [&] { return heard(), false; };
  ctx.on_progress = [&](const std::string& name, double now) {
    if (name != stage) heard();  // the stage before ended
    stage = name;
    fraction = now;
  };
  const Status done = session.run(Stage::kQuality, ctx);
  heard();
  if (!done) return done.error();
  return longest;
}

void judge(const std::string& name, const Status& opened, Session& session, Findings& findings) {
  if (!opened) return findings.add_error(name, opened.error());
  const Result<std::map<std::string, Silence>> longest = listen(session);
  if (!longest) return findings.add_error(name, longest.error());
  nlohmann::json row;
  std::vector<std::string> failures;
  std::printf("| %s |", name.c_str());
  for (const auto& [stage, silence] : *longest) {
    row[stage] = silence.seconds;
    if (stage.empty()) continue;
    std::printf(" %s %.2f |", stage.c_str(), silence.seconds);
    if (silence.seconds > kLongest)
      failures.push_back(stage + " is silent for " + std::to_string(silence.seconds) + " s after " +
                         std::to_string(silence.at) + " of its way");
  }
  std::printf("\n");
  findings.add(name, row, failures);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{
      "Processor seconds between two questions whether to stop, by stage. Exit code 1 above one second."};
  std::string only;
  int regions = 366;
  double spacing_mm = 1.5;
  line.app.add_option("--only", only, "cases whose name holds this");
  line.app.add_option("--regions", regions, "labels of the generated atlas");
  line.app.add_option("--spacing", spacing_mm, "of the generated atlas, mm");
  line.parse(argc, argv);
  Findings findings;
  const auto wanted = [&](const std::string& name) { return name.find(only) != std::string::npos; };
  std::vector<TableCase> cases{{"biv_ed_scar_1mm.nii.gz", {1, 2, 5, 6}},
                               {"ct_torso_62labels_3mm.nii.gz", {}},
                               {"prostate_phantom.nrrd", {}},
                               {"skull.nrrd", {}}};
  for (const TableCase& c : cases)
    for (const std::string& method : line.methods) {
      const std::string name = name_of(c, method), path = test::shared_data(c.file);
      if (!wanted(name)) continue;
      Session session;
      judge(name,
            path.empty() ? Status(Error{ErrorCode::kBadInput, {}, kNotThere, {}})
                         : open_case(c, path, method, session),
            session, findings);
    }
  if (wanted("atlas")) {
    Session session;
    judge("atlas", open_atlas(regions, spacing_mm, session), session, findings);
  }
  return findings.finish(line.json_file);
}
