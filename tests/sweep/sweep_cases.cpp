// The four cases of the paper's first table, conforming and merged, and the torso: their adapted surfaces
// against every limit.
#include "support/data.h"
#include "sweep/command_line.h"
#include "sweep/findings.h"
#include "sweep/surface_figures.h"
#include "sweep/table_cases.h"

using namespace voxtet;
using namespace voxtet::sweep;

namespace {

struct Case : TableCase {
  bool table = true;  ///< all limits hold; else intersections, topology and dihedral only
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const TableCase& c : table_cases()) cases.push_back({c});
  cases.push_back({{"ct_torso_62labels_3mm.nii.gz", {}}, false});
  return cases;
}

Status run_case(const Case& c, const std::string& path, const std::string& method, Session& session) {
  if (Status opened = open_case(c, path, method, session); !opened) return opened;
  RunContext ctx;
  if (Status done = session.run(Stage::kSmooth, ctx); !done) return done;
  return session.run(Stage::kRemesh, ctx);
}

std::vector<std::string> judge(const Case& c, const SurfaceFigures& figures, const std::string& method) {
  const SurfaceLimits limits = limits_of(method);
  std::vector<std::vector<std::string>> parts{check_intersections_and_topology(figures),
                                              check_dihedral(figures, c.merge ? 60 : 25)};
  if (c.table) {
    parts.push_back(check_distances(figures, limits));
    parts.push_back(check_shape_and_size(figures, limits));
  }
  std::vector<std::string> failures;
  for (const std::vector<std::string>& part : parts)
    failures.insert(failures.end(), part.begin(), part.end());
  return failures;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{"Adapted surfaces of the Table-1 cases and the torso. Exit code 1 beyond any limit."};
  std::string only;
  line.app.add_option("--only", only, "cases whose name holds this");
  line.parse(argc, argv);

  Findings findings;
  print_figures_heading();
  for (const std::string& method : line.methods)
    for (const Case& c : all_cases()) {
      const std::string name = name_of(c, method), path = test::shared_data(c.file);
      if (name.find(only) == std::string::npos) continue;
      if (path.empty()) {
        findings.add(name, {}, {kNotThere});
        continue;
      }
      Session session;
      if (Status done = run_case(c, path, method, session); !done) {
        findings.add_error(name, done.error());
        continue;
      }
      const SurfaceFigures figures = measure_surface(session);
      const std::vector<std::string> failures = judge(c, figures, method);
      print_figures(name, figures, failures.size());
      nlohmann::json row = figures_json(figures);
      for (const Stage stage : {Stage::kSurface, Stage::kSmooth, Stage::kSizing, Stage::kRemesh})
        row["seconds"][name_of(stage)] = session.record(stage).seconds;
      findings.add(name, row, failures);
    }
  return findings.finish(line.json_file);
}
