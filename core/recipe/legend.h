// What the user calls the labels, and how they are coloured.
#pragma once

#include <string>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// One label's name and colour; what is empty is as the file has it.
struct LegendEntry {
  Label label = 1;
  std::string name;
  std::string colour;  ///< "#rrggbb", sRGB
};

/// What is wrong with a legend, naming the field; empty if nothing. Every label may have one entry; colours
/// are # and six hexadecimal digits.
std::string fault_of(const std::vector<LegendEntry>& legend);

/// Names and colours as a legend; labels without either have no entry.
std::vector<LegendEntry> legend_of(const std::vector<LabelInfo>& infos);

/// "#c83232" of a colour that is there.
std::string colour_text(const std::array<float, 3>& colour);

/// A file's names and colours with those of a valid legend over them, ascending by label.
std::vector<LabelInfo> with_legend(std::vector<LabelInfo> infos, const std::vector<LegendEntry>& legend);

}  // namespace voxtet
