// `simulate`, and the fibres that `mesh` writes.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/cli.h"
#include "io/bytes/files.h"
#include "support/printed.h"
#include "unit/cli/cli_fixture.h"

namespace voxtet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A ball of tissue that is excited at its lower end.
json ball() {
  return json::parse(R"({"source": {"phantom": {"kind": "sphere", "radius_mm": 8, "spacing_mm": [1, 1, 1]}},
    "sizing": {"edge_mm": 3},
    "physics": {"tissue": {"kinds": [{"labels": [1]}]},
      "stimuli": [{"centre_mm": [0, 0, -8], "radius_mm": 4}],
      "monodomain": {"end_ms": 10, "step_ms": 0.1, "electrodes": [{"at_mm": [0, 0, 30]}, {"at_mm": [30, 0, 0]}]}}})");
}

/// Two small ventricles without a wave.
json heart() {
  return json::parse(R"({"source": {"phantom": {"kind": "biventricle", "scale": 0.5, "roughness_mm": 0}},
    "labels": [1, 2], "sizing": {"edge_mm": 4},
    "physics": {"anatomy": {}, "fibres": {}, "tissue": {"kinds": [{"labels": [1, 2]}]},
      "stimuli": [{"centre_mm": [0, 0, -25], "radius_mm": 12}]}})");
}

std::string text_at(const std::string& path) {
  const Result<Bytes> bytes = read_file(path);
  return bytes.ok() ? std::string(bytes->begin(), bytes->end()) : "";
}

std::vector<std::string> lines_at(const std::string& path) {
  std::istringstream in(text_at(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST_F(CliTest, SimulatesAWaveAndWritesWhatWasFound) {
  write("ball.json", ball().dump());
  ASSERT_EQ(run({"simulate", at("ball.json"), "-o", at("a.vtu"), "--report", at("r.json"), "--traces",
                 at("t.csv")}),
            kExitOk);
  const std::string vtu = text_at(at("a.vtu"));
  for (const char* name : {"activation_ms", "repolarisation_ms", "apd_ms", "activations"})
    EXPECT_NE(vtu.find("<DataArray type=\"Float32\" Name=\"" + std::string(name) + "\""), std::string::npos)
        << name;

  const json wave = read_json("r.json")["simulation"]["monodomain"];
  EXPECT_EQ(wave["end_ms"], 10);
  EXPECT_EQ(wave["frames"], 3);
  EXPECT_GT(wave["activated"], 0);
  EXPECT_EQ(wave["last_stimulus_ms"], 0);
  EXPECT_FALSE(read_json("r.json")["simulation"].contains("eikonal"));

  const std::vector<std::string> traces = lines_at(at("t.csv"));
  ASSERT_EQ(traces.size(), 11U);
  EXPECT_EQ(traces[0], "time_ms,electrode_0_mV,electrode_1_mV");
  EXPECT_EQ(traces[1].substr(0, 2), "1,");
  EXPECT_EQ(traces[10].substr(0, 3), "10,");
}

TEST_F(CliTest, SimulationsGoOnFromASavedState) {
  json first = ball();
  write("ball.json", first.dump());
  first["physics"]["monodomain"]["end_ms"] = 4;
  write("first.json", first.dump());
  ASSERT_EQ(run({"simulate", at("ball.json"), "-o", at("whole.vtu"), "--traces", at("whole.csv")}), kExitOk);
  ASSERT_EQ(run({"simulate", at("first.json"), "--save-state", at("four.state")}), kExitOk);
  ASSERT_EQ(run({"simulate", at("ball.json"), "--from-state", at("four.state"), "-o", at("second.vtu"),
                 "--traces", at("second.csv")}),
            kExitOk);
  EXPECT_EQ(text_at(at("second.vtu")), text_at(at("whole.vtu")));
  EXPECT_EQ(text_at(at("second.csv")), text_at(at("whole.csv")));
  for (const auto& [state, said] :
       {std::pair{"none.state", "none.state"},
        std::pair{"ball.json",
                  "state: found bytes of another kind, expected the saved state of a simulation"}}) {
    test::CaughtErrors errors;
    EXPECT_EQ(run({"simulate", at("ball.json"), "--from-state", at(state)}), kExitBadInput);
    EXPECT_TRUE(errors.say(said)) << said;
  }
}

TEST_F(CliTest, SimulatesTheActivationMapAlone) {
  write("ball.json", ball().dump());
  ASSERT_EQ(
      run({"simulate", at("ball.json"), "--what", "eikonal", "-o", at("a.carp"), "--report", at("r.json")}),
      kExitOk);
  const json simulation = read_json("r.json")["simulation"];
  EXPECT_EQ(simulation["eikonal"]["activated"], 1);
  EXPECT_FALSE(simulation.contains("monodomain"));
  EXPECT_EQ(lines_at(at("a.eikonal_ms.dat")).size() + 1, lines_at(at("a.pts")).size());
  EXPECT_TRUE(fs::exists(at("a.lon.txt")));
}

TEST_F(CliTest, RefusesASimulationThatCannotBe) {
  json without = ball();
  without.erase("physics");
  write("mesh.json", without.dump());
  json silent = ball();
  silent["physics"]["monodomain"].erase("electrodes");
  write("silent.json", silent.dump());
  write("ball.json", ball().dump());
  for (const auto& [words, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"simulate", at("mesh.json")},
            "physics: found none in the case, expected what is to be simulated"},
           {{"simulate", at("ball.json"), "--what", "remesh"}, "--what: remesh not in {monodomain,eikonal}"},
           {{"simulate", at("silent.json"), "--traces", at("t.csv")},
            "--traces: found no physics.monodomain.electrodes, expected at least one"},
           {{"simulate", at("ball.json"), "--what", "eikonal", "--traces", at("t.csv")},
            "--traces: found no physics.monodomain.electrodes, expected at least one"},
           {{"simulate", at("ball.json"), "--what", "eikonal", "--save-state", at("s")},
            "--save-state, --from-state: the activation map alone has no state"},
           {{"simulate", at("ball.json"), "-o", at("a.inp")},
            "this format has no place for values at points, expected .vtu, .xdmf or .carp"},
           {{"simulate", at("ball.json"), "-o", at("a.xyz")}, "ending \".xyz\", expected one of"}}) {
    test::CaughtErrors errors;
    EXPECT_EQ(run(words), kExitUsage) << said;
    EXPECT_TRUE(errors.say(said)) << said;
  }
  EXPECT_EQ(files(), 3U);
}

TEST_F(CliTest, WritesFibresWhereTheFormatHasAPlaceForThem) {
  write("heart.json", heart().dump());
  // Fibres of an earlier run are replaced.
  write("a.lon", "1\n1 0 0\n");
  ASSERT_EQ(run({"mesh", at("heart.json"), "--until", "fibres", "-o", at("a.carp")}), kExitOk);
  const std::vector<std::string> fibres = lines_at(at("a.lon"));
  ASSERT_EQ(fibres.size(), lines_at(at("a.elem")).size());
  EXPECT_EQ(fibres[0], "2");
  for (std::size_t t = 1; t < fibres.size(); ++t) {
    std::istringstream in(fibres[t]);
    double fibre[3], sheet[3];
    in >> fibre[0] >> fibre[1] >> fibre[2] >> sheet[0] >> sheet[1] >> sheet[2];
    EXPECT_TRUE(in && in.eof()) << fibres[t];
    EXPECT_NEAR(fibre[0] * fibre[0] + fibre[1] * fibre[1] + fibre[2] * fibre[2], 1, 1e-6);
    EXPECT_NEAR(fibre[0] * sheet[0] + fibre[1] * sheet[1] + fibre[2] * sheet[2], 0, 1e-6);
  }
  EXPECT_FALSE(fs::exists(at("a.lon.txt")));
  EXPECT_FALSE(fs::exists(at("a.fibre.dat")));

  ASSERT_EQ(run({"mesh", at("heart.json"), "--until", "fibres", "-o", at("a.vtu")}), kExitOk);
  EXPECT_NE(text_at(at("a.vtu")).find("Name=\"fibre\" NumberOfComponents=\"3\""), std::string::npos);
  test::CaughtErrors errors;
  ASSERT_EQ(run({"mesh", at("heart.json"), "--until", "fibres", "-o", at("a.inp")}), kExitOk);
  EXPECT_TRUE(errors.say("a.inp: left out fibre, for which this format has no place"));
}

TEST_F(CliTest, RefusesFibresOfAnotherMeshWhereNoneAreMade) {
  write("heart.json", heart().dump());
  write("ball.json", ball().dump());
  write("a.lon", "1\n1 0 0\n");
  // The stage optimise comes before fibres; the ball has none.
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"mesh", at("heart.json"), "-o", at("a.carp")},
        {"simulate", at("ball.json"), "-o", at("a.carp")}}) {
    test::CaughtErrors errors;
    EXPECT_EQ(run(words), kExitUsage);
    EXPECT_TRUE(errors.say("a.lon holds the fibres of another mesh"));
  }
  EXPECT_EQ(files(), 3U);
}

}  // namespace
}  // namespace voxtet
