// The command line of a sweep program: the options that all have, and its own beside them.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>
#include <vector>

#include "cli/program/huge_pages.h"

namespace voxtet::sweep {

struct CommandLine {
  CLI::App app;
  std::vector<std::string> methods{"delaunay"};  ///< remesh.method of the recipe, one after the other
  std::string json_file;                         ///< empty: none

  explicit CommandLine(const std::string& about) : app(about) {
    app.add_option("--methods,--method", methods, "as delaunay,adapt")->delimiter(',')->capture_default_str();
    app.add_option("--json", json_file, "write all figures to this file");
  }
  /// Ends the program after --help and after a wrong command line.
  void parse(int argc, char** argv) {
    use_huge_pages(argv);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
      std::exit(app.exit(end));
    }
  }
};

}  // namespace voxtet::sweep
