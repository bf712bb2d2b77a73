#include "cli/cli.h"
#include "cli/program/huge_pages.h"

int main(int argc, char** argv) {
  voxtet::use_huge_pages(argv);
  return voxtet::run_cli(argc, argv);
}
