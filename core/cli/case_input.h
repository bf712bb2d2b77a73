// The input of commands that open a case: a volume, a case file or a link, and the options that change it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/check_outputs.h"
#include "cli/read_options.h"
#include "pipeline/session.h"
#include "types/result.h"

namespace voxtet {

struct CaseOptions {
  std::string input;                     ///< volume file, case .json, or link
  std::vector<int> labels;               ///< --labels 1,2,5
  std::vector<std::string> merge;        ///< --merge 1,5,6; an empty text: all labels to be meshed
  std::vector<unsigned> transfer;        ///< --transfer
  std::optional<double> edge_mm;         ///< --edge-mm; if not given, as in the recipe
  std::vector<std::string> edge_labels;  ///< --edge-label 5=0.8
  std::vector<std::string> masks;        ///< --mask
  std::vector<std::string> mask_edges;   ///< --mask-edge 1=0.8, of every --mask
  std::vector<std::string> size_images;  ///< --size-image
  std::vector<std::string> set;          ///< --set path=value
  ReadOptionTexts read;
};

/// The files that the options name, and those that their case file names.
std::vector<NamedPath> inputs_of(const CaseOptions& options);

/// Recipe of a case file or link; default recipe (source still empty) for a volume.
Result<Recipe> read_case(const std::string& input);

/// What a case promises: its field `expected`, or else an expected.json beside the case file. Errors: kUsage
/// if there is neither, kBadInput naming a file that cannot be read.
Result<Expected> expected_of(const Recipe& recipe, const std::string& input);

/// Loads the volume, masks and images that the case names (looked up beside the case) and those that the
/// options add, and applies the options.
Status open_case(const CaseOptions& options, Session& session);

}  // namespace voxtet
