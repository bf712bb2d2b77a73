// What the physics gives beside what is expected: verify_physics [--all] [PART ...]; all tables without a
// part.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "cli/program/huge_pages.h"
#include "verify.h"

namespace {

struct Part {
  const char* name;
  void (*print)(bool all);
};
constexpr Part kParts[] = {{"plane_wave", voxtet::verify::print_plane_wave},
                           {"slab", voxtet::verify::print_slab},
                           {"eikonal", voxtet::verify::print_eikonal},
                           {"isthmus", voxtet::verify::print_isthmus},
                           {"speed", voxtet::verify::print_speed},
                           {"land", voxtet::verify::print_land},
                           {"circulation", voxtet::verify::print_circulation},
                           {"inflation", voxtet::verify::print_inflation},
                           {"layers", voxtet::verify::print_layers},
                           {"elastodynamics", voxtet::verify::print_elastodynamics},
                           {"beat", voxtet::verify::print_beat},
                           {"checks", [](bool) { voxtet::verify::print_checks(); }}};

}  // namespace

int main(int argc, char** argv) {
  voxtet::use_huge_pages(argv);
  bool all = false;
  std::vector<std::string> wanted;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--all") {
      all = true;
    } else if (std::any_of(std::begin(kParts), std::end(kParts),
                           [&](const Part& part) { return argument == part.name; })) {
      wanted.push_back(argument);
    } else {
      std::fprintf(stderr,
                   "verify_physics: found '%s', expected --all, plane_wave, slab, eikonal, isthmus, speed, "
                   "land, circulation, inflation, layers, elastodynamics, beat or checks\n",
                   argument.c_str());
      return 2;
    }
  }
  if (wanted.empty()) wanted = {"plane_wave", "slab", "eikonal", "isthmus", "speed", "land"};
  for (const Part& part : kParts)
    if (std::find(wanted.begin(), wanted.end(), part.name) != wanted.end()) {
      part.print(all);
      std::printf("\n");
    }
  return 0;
}
