#include "cli/cli.h"

int main(int argc, char** argv) {
  return voxtet::run_cli(argc, argv);
}
