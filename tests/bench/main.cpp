// What all benchmarks start with: memory as the command line has it.
#include <benchmark/benchmark.h>

#include "cli/program/huge_pages.h"

int main(int argc, char** argv) {
  voxtet::use_huge_pages(argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
