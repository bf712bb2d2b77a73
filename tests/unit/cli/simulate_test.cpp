// `simulate`, and the fibres that `mesh` writes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/cli.h"
#include "io/bytes/files.h"
#include "io/mesh/read_values.h"
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

#ifndef __EMSCRIPTEN__  // there are no pipes, and what is printed cannot be caught
TEST_F(CliTest, VerifiesWhatACasePromisesOfItsSimulations) {
  json small = ball();
  write("case.json", small.dump());
  ASSERT_EQ(run({"simulate", at("case.json"), "--report", at("r.json")}), kExitOk);
  ASSERT_EQ(run({"simulate", at("case.json"), "--what", "eikonal", "--report", at("e.json")}), kExitOk);
  const auto digest_in = [&](const char* report, const char* stage) {
    const json all = read_json(report);
    for (const json& one : all["stages"])
      if (one["name"] == stage) return one["digest"].get<std::string>();
    return std::string();
  };
  const json report = read_json("r.json");
  small["expected"] = {
      {"engine", report["engine"]}, {"digest", report["digest"]}, {"physics", report["physics"]}};
  small["expected"]["stages"] = {{"monodomain", digest_in("r.json", "monodomain")},
                                 {"eikonal", digest_in("e.json", "eikonal")}};
  const auto verify = [&] {
    write("case.json", small.dump());
    testing::internal::CaptureStdout();
    const int code = run({"verify", at("case.json"), "--json"});
    json out = json::parse(testing::internal::GetCapturedStdout());
    out["code"] = code;
    return out;
  };
  json out = verify();
  EXPECT_EQ(out["code"], kExitOk);
  EXPECT_EQ(out["verdict"], "reproduced");
  EXPECT_EQ(out["stages"]["eikonal"]["digest"], small["expected"]["stages"]["eikonal"]);

  small["physics"]["stimuli"][0]["radius_mm"] = 5;
  out = verify();
  EXPECT_EQ(out["code"], kExitDiffers) << "the mesh is the same";
  EXPECT_EQ(out["verdict"], "differs");
  EXPECT_EQ(out["digest"], out["expected"]);
  EXPECT_NE(out["stages"]["monodomain"]["digest"], out["stages"]["monodomain"]["expected"]);
  small["expected"]["physics"] = "0.1.0+0123456789ab";
  EXPECT_EQ(verify()["verdict"], "made with another engine");
}
#endif

TEST_F(CliTest, SimulatesTwoBeatsAndWritesTheTimesOfBoth) {
  json paced = ball();
  paced["physics"]["stimuli"][0].update({{"count", 2}, {"interval_ms", 400}});
  paced["physics"]["monodomain"].update({{"end_ms", 500}, {"electrodes", json::array()}});
  write("paced.json", paced.dump());
  ASSERT_EQ(run({"simulate", at("paced.json"), "-o", at("a.vtu"), "--report", at("r.json")}), kExitOk);
  for (const char* name : {"activation_2_ms", "repolarisation_2_ms"})
    EXPECT_NE(text_at(at("a.vtu")).find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  const json wave = read_json("r.json")["simulation"]["monodomain"];
  ASSERT_EQ(wave["beats"].size(), 2U);
  for (const json& beat : wave["beats"]) EXPECT_EQ(beat["activated"], 1);
  EXPECT_EQ(wave["beats"][0]["last_ms"], wave["total_activation_ms"]);
  EXPECT_GT(wave["beats"][1]["first_ms"], 400);
  EXPECT_EQ(wave["beats"][1]["last_ms"], wave["last_activation_ms"]);
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
}

/// The values of a .par, or of a column of text, by their names.
std::map<std::string, std::string> parameters_at(const std::string& path) {
  std::map<std::string, std::string> found;
  for (const std::string& line : lines_at(path))
    if (const std::size_t equals = line.find(" = "); equals != std::string::npos && line[0] != '#')
      found[line.substr(0, equals)] = line.substr(equals + 3);
  return found;
}

TEST_F(CliTest, WritesACaseForOpenCarp) {
  json body = ball();
  body["physics"]["stimuli"][0].update(
      {{"name", "low \"end\""}, {"count", 2}, {"interval_ms", 4}, {"s2_ms", 3}, {"s3_ms", 500}});
  write("ball.json", body.dump());
  ASSERT_EQ(run({"simulate", at("ball.json"), "-o", at("a.carp"), "--frames", at("vm.igb")}), kExitOk);
  const auto par = parameters_at(at("a.par"));
  const auto value = [&](const std::string& name) {
    const auto found = par.find(name);
    return found == par.end() ? "none" : found->second;
  };
  const auto real = [&](const std::string& name) { return std::stod(value(name)); };
  EXPECT_EQ(value("meshname"), "\"a\"");
  EXPECT_EQ(value("dt"), "100");
  EXPECT_EQ(value("tend"), "10");
  EXPECT_EQ(value("bidm_eqv_mono"), "0");
  // The diffusivity of 0.5 mm/ms is 0.2118 mm^2/ms; sigma = D chi Cm, with 140 /mm and 0.01 uF/mm^2.
  EXPECT_NEAR(real("gregion[0].g_il"), 0.2118 * 1.4, 1e-4);
  EXPECT_EQ(value("gregion[0].g_it"), value("gregion[0].g_il"));
  EXPECT_EQ(value("gregion[0].g_in"), value("gregion[0].g_il"));
  EXPECT_EQ(value("imp_region[0].cellSurfVolRatio"), "0.14");
  EXPECT_EQ(value("imp_region[0].im"), "\"MitchellSchaeffer\"");
  EXPECT_EQ(value("imp_region[0].im_param"),
            "\"V_gate=0.13,a_crit=0,tau_in=0.3,tau_out=6,tau_open=120,tau_close=150,V_min=-80,V_max=20\"");
  EXPECT_EQ(value("phys_region[0].num_IDs"), "1");
  EXPECT_EQ(value("phys_region[0].ID[0]"), "1");
  EXPECT_EQ(value("lats[0].threshold"), "-30");
  // S1 at 0 and 4 ms, S2 at 7; S3 comes after the end.
  EXPECT_EQ(value("num_stim"), "2");
  EXPECT_EQ(value("stim[0].name"), "\"low end\"");
  EXPECT_EQ(value("stim[0].pulse.strength"), "50");
  EXPECT_EQ(value("stim[0].ptcl.npls"), "2");
  EXPECT_EQ(value("stim[0].ptcl.bcl"), "4");
  EXPECT_EQ(value("stim[1].ptcl.start"), "7");
  EXPECT_EQ(value("stim[1].ptcl.npls"), "1");
  EXPECT_EQ(value("stim[1].elec.vtx_file"), "\"a.stim0.vtx\"");

  // A direction for each element, which means nothing here and is not missed.
  const std::size_t elements = lines_at(at("a.elem")).size() - 1, points = lines_at(at("a.pts")).size() - 1;
  EXPECT_EQ(lines_at(at("a.lon")), [&] {
    std::vector<std::string> lines(elements + 1, "1 0 0");
    lines[0] = "1";
    return lines;
  }());
  // Every point conducts.
  EXPECT_EQ(lines_at(at("a.expected_ms.dat")), lines_at(at("a.activation_ms.dat")));
  const std::vector<std::string> electrode = lines_at(at("a.stim0.vtx")), pts = lines_at(at("a.pts"));
  ASSERT_EQ(electrode.size(), std::stoul(electrode[0]) + 2);
  EXPECT_EQ(electrode[1], "intra");
  for (std::size_t i = 2; i < electrode.size(); ++i) {
    std::istringstream in(pts[std::stoul(electrode[i]) + 1]);
    double x, y, z;  // um
    in >> x >> y >> z;
    EXPECT_LE(std::hypot(x, y, z + 8000), 4000);
  }

  const Result<Bytes> igb = read_file(at("vm.igb"));
  ASSERT_TRUE(igb.ok());
  const Result<PointValues> frames = PointValues::open("vm.igb", *igb);
  ASSERT_TRUE(frames.ok()) << frames.error().message;
  EXPECT_TRUE(frames->check_count(points).ok());
  EXPECT_EQ(frames->times_ms(), (std::vector<double>{0, 5, 10}));
  const Result<Field> first = frames->frame(0);
  for (const float rest : first->values) EXPECT_EQ(rest, -80);
}

TEST_F(CliTest, NumbersRegionsForOpenCarpByTissue) {
  // The label 1 is meshed; where the label 2 fills a tetrahedron, it is another tissue, and 3 is none.
  write("boxes.json",
        R"({"source": {"phantom": {"kind": "nested_boxes", "radius_mm": 8, "spacing_mm": [1, 1, 1]}},
    "sizing": {"edge_mm": 2},
    "merge": [[1, 2, 3]], "transfer": {"labels": [2, 3]},
    "physics": {"tissue": {"by": "centroid", "kinds": [{"labels": [1]}, {"labels": [2], "along_mm_per_ms": 0.25}]},
      "stimuli": [{"centre_mm": [0, 0, 0], "radius_mm": 1000}]}})");
  ASSERT_EQ(run({"simulate", at("boxes.json"), "-o", at("a.carp")}), kExitOk);
  const auto par = parameters_at(at("a.par"));
  std::set<std::string> regions;
  const std::vector<std::string> elements = lines_at(at("a.elem"));
  for (std::size_t e = 1; e < elements.size(); ++e)
    regions.insert(elements[e].substr(elements[e].find_last_of(' ') + 1));
  EXPECT_EQ(regions, (std::set<std::string>{"1", "2", "3"}));
  EXPECT_EQ(par.at("phys_region[0].num_IDs"), "2");
  EXPECT_EQ(par.at("gregion[0].ID[0]"), "1");
  EXPECT_EQ(par.at("gregion[1].ID[0]"), "2");
  EXPECT_NEAR(std::stod(par.at("gregion[1].g_il")), std::stod(par.at("gregion[0].g_il")) / 4, 1e-9);
  const std::string text = text_at(at("a.par"));
  EXPECT_NE(text.find("# Region 2: label 1 as tissue 1\n"), std::string::npos);
  EXPECT_NE(text.find("# Region 3: label 1, which does not conduct\n"), std::string::npos);
  EXPECT_NE(text.find("# Ours is the activation by the eikonal equation.\n"), std::string::npos);
  EXPECT_LT(lines_at(at("a.expected_ms.dat")).size(), lines_at(at("a.eikonal_ms.dat")).size());
}

TEST_F(CliTest, LetsAHeartBeatOnFromASavedState) {
  json beating = heart();
  beating["source"]["phantom"] = {{"kind", "biventricle"}};
  beating["merge"] = {{1, 2}};
  beating["sizing"] = {
      {"edge_mm", 10},
      {"thickness", {{{"wall", {1, 2}}, {"inner", {3, 4}}, {"layers", 1}, {"layering", "exact"}}}}};
  const json kick{{"kick_s", 0.05}};
  beating["physics"]["mechanics"] = {{"contraction", {{"start_ms", 20}, {"duration_ms", 40}}},
                                     {"windkessel", {{"systemic", kick}, {"pulmonary", kick}}},
                                     {"period_ms", 100},
                                     {"fill_ms", 20},
                                     {"beats", 2},
                                     {"cycle_percent", 0}};
  write("two.json", beating.dump());
  ASSERT_EQ(run({"simulate", at("two.json"), "-o", at("whole.vtu"), "--traces", at("whole.csv"), "--report",
                 at("r.json")}),
            kExitOk);
  for (const char* name :
       {"displacement_mm", "fibre_strain_percent", "thickening_percent", "active_stress_kpa"})
    EXPECT_NE(text_at(at("whole.vtu")).find(name), std::string::npos) << name;
  const json found = json::parse(text_at(at("r.json")))["simulation"]["mechanics"];
  ASSERT_EQ(found["beats"].size(), 2U);
  for (const char* ventricle : {"lv", "rv"}) {
    const json& beat = found["beats"][1][ventricle];
    EXPECT_LT(beat["end_systolic_ml"].get<double>(), beat["end_diastolic_ml"].get<double>());
    EXPECT_NEAR(beat["ejection_fraction"].get<double>(),
                beat["stroke_ml"].get<double>() / beat["end_diastolic_ml"].get<double>(), 1e-12);
  }
  EXPECT_EQ(lines_at(at("whole.csv"))[0],
            "time_ms,lv_volume_ml,rv_volume_ml,lv_pressure_kPa,rv_pressure_kPa,systemic_arteries_kPa,"
            "pulmonary_arteries_kPa");
  beating["physics"]["mechanics"]["beats"] = 1;
  write("one.json", beating.dump());
  ASSERT_EQ(run({"simulate", at("one.json"), "--save-state", at("one.state")}), kExitOk);
  ASSERT_EQ(run({"simulate", at("two.json"), "--from-state", at("one.state"), "--traces", at("later.csv")}),
            kExitOk);
  EXPECT_EQ(text_at(at("later.csv")), text_at(at("whole.csv")));
  // Of another heart.
  beating["physics"]["mechanics"]["bulk_kpa"] = 500;
  write("other.json", beating.dump());
  test::CaughtErrors errors;
  EXPECT_EQ(run({"simulate", at("other.json"), "--from-state", at("one.state")}), kExitUsage);
  EXPECT_TRUE(errors.say("state: was made from another physics.mechanics"));
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
           {{"simulate", at("ball.json"), "--what", "remesh"},
            "--what: remesh not in {mechanics,monodomain,eikonal}"},
           {{"simulate", at("silent.json"), "--traces", at("t.csv")},
            "--traces: found no physics.monodomain.electrodes, expected at least one"},
           {{"simulate", at("ball.json"), "--what", "eikonal", "--traces", at("t.csv")},
            "--traces: found no physics.monodomain.electrodes, expected at least one"},
           {{"simulate", at("ball.json"), "--what", "eikonal", "--save-state", at("s")},
            "--save-state, --from-state: the activation map alone has no state"},
           {{"simulate", at("ball.json"), "-o", at("a.inp")},
            "this format has no place for values at points, expected .vtu, .vtk, .xdmf or .carp"},
           {{"simulate", at("ball.json"), "--frames", at("a.vtu")},
            "--frames " + at("a.vtu") + ": frames are written as .igb"},
           {{"simulate", at("ball.json"), "--what", "eikonal", "--frames", at("a.igb")},
            "--frames: found no physics.monodomain to run, expected one"},
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

TEST_F(CliTest, WritesCasesOfMechanics) {
  write("heart.json", heart().dump());
  ASSERT_EQ(run({"mesh", at("heart.json"), "--mechanics", at("a.feb"), "--order", "2"}), kExitOk);
  EXPECT_NE(text_at(at("a.feb")).find("<Elements type=\"tet10\""), std::string::npos);
  EXPECT_NE(text_at(at("a.README.txt")).find("for FEBio 4"), std::string::npos);
  ASSERT_EQ(run({"mesh", at("heart.json"), "--mechanics", at("b.xml"), "--space", "lps"}), kExitOk);
  for (const char* name : {"b.xml", "b.mesh.vtu", "b.fibersLong.vtu", "b.fibersSheet.vtu", "b.pressure.dat",
                           "b.README.txt", "b.base.vtp", "b.epicardium.vtp", "b.lv_endocardium.vtp"})
    EXPECT_TRUE(fs::exists(at(name))) << name;
  EXPECT_NE(text_at(at("b.mesh.vtu")).find("space LPS"), std::string::npos);

  write("ball.json", ball().dump());
  const std::size_t before = files();
  for (const auto& [words, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"mesh", at("heart.json"), "--mechanics", at("a.vtu")},
            "found the ending \".vtu\", expected .feb for FEBio or .xml for svMultiPhysics"},
           {{"mesh", at("heart.json"), "--mechanics", at("c.xml"), "--order", "2"},
            "a case for svMultiPhysics has none"},
           {{"mesh", at("ball.json"), "--mechanics", at("c.feb")},
            "found no physics.anatomy with physics.fibres, expected both"}}) {
    test::CaughtErrors errors;
    EXPECT_EQ(run(words), kExitUsage) << said;
    EXPECT_TRUE(errors.say(said)) << said;
  }
  EXPECT_EQ(files(), before);
}

TEST_F(CliTest, RefusesFibresOfAnotherMeshWhereNoneAreMade) {
  write("heart.json", heart().dump());
  write("ball.json", ball().dump());
  write("a.lon", "1\n1 0 0\n");
  // The stage optimise comes before fibres; the ball has none.
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"mesh", at("heart.json"), "-o", at("a.carp")},
        {"mesh", at("ball.json"), "-o", at("a.carp")}}) {
    test::CaughtErrors errors;
    EXPECT_EQ(run(words), kExitUsage);
    EXPECT_TRUE(errors.say("a.lon holds the fibres of another mesh"));
  }
  EXPECT_EQ(files(), 3U);
}

}  // namespace
}  // namespace voxtet
