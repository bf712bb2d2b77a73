// One heart with its voxels stored in all 48 orders and directions, and turned as a whole 20 times: the same
// bounds hold, and the meshes agree.
#include "geometry/grid/rasterise.h"
#include "io/volume/read_volume.h"
#include "support/data.h"
#include "support/random_labels.h"
#include "support/test_random.h"
#include "sweep/command_line.h"
#include "sweep/findings.h"
#include "sweep/load_labels.h"
#include "sweep/surface_figures.h"
#include "volume/mesh_order.h"

using namespace voxtet;
using namespace voxtet::sweep;

namespace {

constexpr double kLeastDice = 0.99;

LabelVolume turned(const LabelVolume& volume, const Eigen::Matrix3d& rotation) {
  LabelVolume out = volume;
  out.index_to_mm.topRows<3>() = rotation * volume.index_to_mm.topRows<3>();
  return out;
}

double smallest_dice(const std::vector<Label>& a, const std::vector<Label>& b,
                     const std::vector<Label>& labels) {
  double smallest = 1;
  for (const Label label : labels) {
    double in_a = 0, in_b = 0, both = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      in_a += a[i] == label;
      in_b += b[i] == label;
      both += a[i] == label && b[i] == label;
    }
    smallest = std::min(smallest, 2 * both / std::max(1.0, in_a + in_b));
  }
  return smallest;
}

/// The meshes of one method.
struct Sweep {
  std::string method;
  std::vector<Label> labels;
  Findings& findings;
  std::vector<Label> reference{};  ///< the first mesh sampled at the voxel centres
  double least_dice = 1;

  /// `grid`: voxel centres that stand in the body where the file's own do.
  void add(const std::string& position, const LabelVolume& volume, const LabelVolume& grid) {
    const std::string name = position + ", " + method;
    Session session;
    if (Status done = run(volume, session); !done) {
      findings.add_error(name, done.error());
      return;
    }
    const SurfaceFigures figures = measure_surface(session);
    const std::vector<Label> sampled = rasterise(*session.mesh(), session.mesh()->labels, grid);
    if (reference.empty()) reference = sampled;
    const double dice = smallest_dice(reference, sampled, labels);
    std::vector<std::string> failures = check_distances(figures, limits_of(method));
    if (figures.intersections) failures.push_back("the adapted surface intersects itself");
    if (dice < kLeastDice) failures.push_back("Dice with the first mesh " + std::to_string(dice));
    print_figures(name, figures, failures.size());
    nlohmann::json row = figures_json(figures);
    row["dice"] = dice;
    findings.add(name, row, failures);
    least_dice = std::min(least_dice, dice);
  }

 private:
  Status run(const LabelVolume& volume, Session& session) const {
    if (Status loaded = load_labels(volume, session); !loaded) return loaded;
    Result<Recipe> recipe = with_field(session.recipe(), "remesh.method", method);
    if (!recipe) return recipe.error();
    recipe->labels = labels;
    recipe->sizing.edge_mm = 2 * volume.smallest_spacing_mm();
    if (Status set = session.set_recipe(*recipe); !set) return set;
    RunContext ctx;
    if (Status done = session.run(Stage::kSmooth, ctx); !done) return done;
    return session.run(Stage::kTetra, ctx);
  }
};

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{"One heart in 48 storage orders and 20 oblique positions. Exit code 1 beyond any limit."};
  std::string file = "biv_mean_1mm.nii.gz";
  std::vector<Label> labels{1, 2};
  int orders = test::kAxisOrders, turns = 20;
  line.app.add_option("--volume", file, "a volume of the data folder");
  line.app.add_option("--labels", labels, "labels meshed")->delimiter(',');
  line.app.add_option("--orders", orders, "storage orders, of 48");
  line.app.add_option("--turns", turns, "random oblique positions");
  line.parse(argc, argv);

  const Result<LabelVolume> volume = read_volume_file(test::shared_data(file));
  if (!volume) {
    std::fprintf(stderr, "%s (set VOXTET_DATA)\n", volume.error().message.c_str());
    return 2;
  }
  Findings findings;
  double least_dice = 1;
  print_figures_heading();
  for (const std::string& method : line.methods) {
    Sweep sweep{method, labels, findings};
    for (int n = 0; n < orders; ++n)
      sweep.add("order " + std::to_string(n), reordered(*volume, test::axis_order(n)), *volume);
    test::TestRandom random(1);
    for (int n = 1; n <= turns; ++n) {
      const LabelVolume oblique = turned(*volume, test::random_rotation(random));
      sweep.add("oblique " + std::to_string(n), oblique, oblique);
    }
    least_dice = std::min(least_dice, sweep.least_dice);
  }
  std::printf("\nsmallest Dice with the first mesh: %.4f\n", least_dice);
  return findings.finish(line.json_file);
}
