// The input of commands that open a case: a volume, a case file or a link, and the options that change it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/input/check_outputs.h"
#include "cli/words/read_options.h"
#include "io/bytes/bytes.h"
#include "pipeline/session.h"
#include "types/result.h"

namespace voxtet {

struct CaseOptions {
  std::string input;                     ///< volume file, case .json, link, or - for standard input
  std::string input_format;              ///< --input-format: the ending of a mesh on standard input
  std::vector<std::string> labels;       ///< --labels Wall,1-3 (label_words.h)
  std::vector<std::string> merge;        ///< --merge 1,5,6; an empty text: all labels to be meshed
  std::vector<std::string> transfer;     ///< --transfer
  std::optional<std::string> edge_mm;    ///< --edge-mm 2mm; if not given, as in the recipe
  std::vector<std::string> edge_labels;  ///< --edge-label 5=0.8
  std::vector<std::string> masks;        ///< --mask
  std::vector<std::string> mask_edges;   ///< --mask-edge 1=0.8, of every --mask
  std::vector<std::string> size_images;  ///< --size-image
  bool align_slices = false;             ///< --align-slices
  bool stack = false;                    ///< --stack: what thick slices need
  std::vector<std::string> cut;          ///< --cut Wall:0,0,40:0,0,1:base
  bool clean = false;                    ///< --clean
  std::vector<std::string> set;          ///< --set path=value
  ReadOptionTexts read;
};

/// The bytes of a file, or of standard input for the path "-".
Result<Bytes> read_input(const std::string& path);

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
