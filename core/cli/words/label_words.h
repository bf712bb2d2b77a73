// The labels that the command line names: by number, range, name, or all of them.
#pragma once

#include <string>
#include <vector>

#include "recipe/legend.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// What a user may write for labels.
inline constexpr const char* kLabelForms = "numbers as 1,2,5, ranges as 1-3, names, or all";

/// Looks labels up in a volume, by the names of its file or of a legend. Before it has been read (null) only
/// numbers are known: names, ranges and `all` then give no labels, and no error.
class LabelWords {
 public:
  explicit LabelWords(const LabelVolume* volume, const std::vector<LegendEntry>& legend = {});

  /// The labels of "Wall,1-3", each once, in this order. Numbers need not be in the volume; a range gives
  /// the labels that are. `option` begins the messages. Errors: kUsage for an empty text or word, a number
  /// that is no label, and a range or name that the volume has no label for, or a name that several have.
  Result<std::vector<Label>> labels_of(const std::string& option, const std::string& text) const;

 private:
  Result<std::vector<Label>> labels_of_word(const std::string& option, const std::string& word) const;
  std::vector<Label> between(Label first, Label last) const;
  Error not_found(const std::string& option, const std::string& word) const;
  std::string name_of(Label label) const;

  bool known_;
  std::vector<LabelInfo> infos_;
  std::vector<Label> present_;  ///< ascending
};

}  // namespace voxtet
