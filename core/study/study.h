// A study: a table of cases that are run and compared.
#pragma once

#include <string>
#include <vector>

#include "pipeline/stages/stage.h"
#include "recipe/recipe.h"
#include "study/cohort.h"
#include "types/result.h"

namespace voxtet {

/// A change of the recipe that has a name.
struct NamedChange {
  std::string name;
  FieldValues set;
};

/// What every case of a study has.
struct StudyPlan {
  std::vector<Stage> stages;  ///< run in this order, with what they need
  std::vector<std::string>
      keep;                  ///< endings of mesh files that are kept, without the dot; "report": its report
  std::string folder;        ///< of the masks and images that the recipe names
  std::string study_folder;  ///< of the study, and so of its volumes
};

/// One case.
struct StudyCase {
  std::size_t number = 0;  ///< counted from 1
  std::string name;        ///< "heart 12, sizing.edge_mm 2"
  FieldValues varied;      ///< what differs between cases, the same fields in each
  Recipe recipe;
  std::string volume_path;  ///< empty: the recipe makes its own
};

struct Study {
  std::string title;
  StudyPlan plan;
  std::vector<StudyCase> cases;
};

/// Reads a study (docs/share/studies.md: its fields) and forms its cases: each volume or heart, with each
/// change of the list and each combination of the grid. Relative paths are beside the study's file; those of
/// a case file beside that. Errors: kBadInput for a file that cannot be read and a pattern without a match;
/// kUsage naming the field and, where a recipe is wrong, the case.
Result<Study> read_study(const std::string& path);

}  // namespace voxtet
