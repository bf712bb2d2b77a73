#include "recipe/legend.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace voxtet {
namespace {

bool is_colour(const std::string& text) {
  return text.size() == 7 && text[0] == '#' &&
         text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
}

std::array<float, 3> colour_of(const std::string& text) {
  std::array<float, 3> colour{};
  for (std::size_t part = 0; part < 3; ++part)
    colour[part] = static_cast<float>(std::stoi(text.substr(1 + 2 * part, 2), nullptr, 16)) / 255.F;
  return colour;
}

}  // namespace

std::string fault_of(const std::vector<LegendEntry>& legend) {
  std::set<Label> seen;
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const std::string at = "legend[" + std::to_string(i) + "].";
    if (!seen.insert(legend[i].label).second)
      return at + "label: found " + std::to_string(legend[i].label) + " again, expected one entry a label";
    if (!legend[i].colour.empty() && !is_colour(legend[i].colour))
      return at + "colour: found \"" + legend[i].colour + "\", expected #rrggbb as #c83232, or nothing";
  }
  return "";
}

std::string colour_text(const std::array<float, 3>& colour) {
  const auto byte = [](float part) { return static_cast<unsigned>(part * 255 + 0.5F) & 255U; };
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(colour[0]), byte(colour[1]), byte(colour[2]));
  return text;
}

std::vector<LegendEntry> legend_of(const std::vector<LabelInfo>& infos) {
  std::vector<LegendEntry> legend;
  for (const LabelInfo& info : infos) {
    LegendEntry entry{info.label, info.name, info.colour[0] < 0 ? "" : colour_text(info.colour)};
    if (!entry.name.empty() || !entry.colour.empty()) legend.push_back(std::move(entry));
  }
  return legend;
}

std::vector<LabelInfo> with_legend(std::vector<LabelInfo> infos, const std::vector<LegendEntry>& legend) {
  for (const LegendEntry& entry : legend) {
    auto info =
        std::find_if(infos.begin(), infos.end(), [&](const auto& i) { return i.label == entry.label; });
    if (info == infos.end()) info = infos.insert(infos.end(), LabelInfo{entry.label, ""});
    if (!entry.name.empty()) info->name = entry.name;
    if (!entry.colour.empty()) info->colour = colour_of(entry.colour);
  }
  std::sort(infos.begin(), infos.end(), [](const auto& a, const auto& b) { return a.label < b.label; });
  return infos;
}

}  // namespace voxtet
