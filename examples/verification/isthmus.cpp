// Current through a narrow channel in scar, on voxels and on meshes; the tables of
// examples/isthmus-conductance.
#include "support/isthmus.h"

#include <array>
#include <cstdio>

#include "verify.h"

namespace voxtet::verify {
namespace {

constexpr std::array kWidths{2.0, 4.0, 6.0};
constexpr std::array kTissueBy{"mesh", "centroid", "majority", "fraction"};

double percent(double found, double expected) {
  return 100 * (found / expected - 1);
}

/// Of one width of the channel.
struct References {
  test::Conductance truth, voxels;
};

void print_model(double width, const std::string& model, const std::string& tets,
                 const test::Conductance& found, const References& references) {
  const auto& [truth, voxels] = references;
  std::printf("| %.0f | %s | %s | %.3f | %+.1f | %.4f | %+.0f | %+.0f |\n", width, model.c_str(),
              tets.c_str(), found.whole, percent(found.whole, voxels.whole), found.channel,
              percent(found.channel, voxels.channel), percent(found.channel, truth.channel));
  std::fflush(stdout);
}

void print_adaptive(const std::vector<References>& references) {
  std::printf(
      "| channel, mm | model | tetrahedra | conductance | against voxels, %% | through the channel | against "
      "voxels, %% | against the true shape, %% |\n|---|---|---|---|---|---|---|---|\n");
  for (std::size_t w = 0; w < kWidths.size(); ++w) {
    const test::Isthmus isthmus{kWidths[w]};
    print_model(isthmus.width_mm, "true shape, bricks of 0.125 mm", "", references[w].truth, references[w]);
    print_model(isthmus.width_mm, "voxels, one brick each", "", references[w].voxels, references[w]);
    print_model(isthmus.width_mm, "voxels, each cut into 36 bricks", "",
                value_or_exit(test::voxel_conductance(isthmus, 6)), references[w]);
    for (const char* by : kTissueBy) {
      const auto found = value_or_exit(test::mesh_conductance(isthmus, {.by = by}));
      print_model(isthmus.width_mm, std::string("adaptive, by ") + by, std::to_string(found.tets), found,
                  references[w]);
    }
  }
}

void print_coarse(const std::vector<References>& references) {
  constexpr std::array kEdges{3.4, 3.6, 3.8, 4.0, 4.2};
  std::printf("\n| channel, mm | tissue by |");
  for (const double edge : kEdges) std::printf(" %.1f mm |", edge);
  std::printf("\n|---|---|---|---|---|---|---|\n");
  for (std::size_t w = 0; w < kWidths.size(); ++w)
    for (const char* by : kTissueBy) {
      std::printf("| %.0f | %s |", kWidths[w], by);
      for (const double edge : kEdges) {
        const auto found =
            value_or_exit(test::mesh_conductance({kWidths[w]}, {.scar_mm = edge, .rest_mm = edge, .by = by}));
        std::printf(" %+.0f |", percent(found.channel, references[w].truth.channel));
        std::fflush(stdout);
      }
      std::printf("\n");
    }
}

}  // namespace

void print_isthmus(bool) {
  std::vector<References> references;
  for (const double width : kWidths)
    references.push_back({value_or_exit(test::true_conductance({width}, 0.125)),
                          value_or_exit(test::voxel_conductance({width}, 1))});
  print_adaptive(references);
  print_coarse(references);
}

}  // namespace voxtet::verify
