#include "io/mesh/shared/mesh_groups.h"

#include <algorithm>
#include <array>

namespace voxtet {
namespace {

constexpr std::size_t kLongestName = 60;
constexpr std::size_t kLongestWord = 32;
constexpr std::uint32_t kNoGroup = 0xffffffff;
constexpr const char* kBackgroundName = "background";

std::string plain_name(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7f ? ' ' : c == '"' ? '\'' : c == '|' ? '/' : c;
  }
  if (result.size() > kLongestName) {
    std::size_t end = kLongestName;
    while (end > 0 && (static_cast<unsigned char>(result[end]) & 0xc0) == 0x80) --end;
    result.resize(end);
  }
  const std::size_t first = result.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return result.substr(first, result.find_last_not_of(' ') - first + 1);
}

/// Letters and digits, every run of other bytes as one underscore.
std::string plain_word(const std::string& name) {
  std::string word;
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    if (word.empty() && digit) word = "label_";
    if (letter || digit)
      word += c;
    else if (!word.empty() && word.back() != '_')
      word += '_';
  }
  word.resize(std::min(word.size(), kLongestWord));
  if (!word.empty() && word.back() == '_') word.pop_back();
  return word;
}

}  // namespace

FaceGroups group_faces(std::span<const Sides> sides) {
  FaceGroups groups;
  for (const Sides& pair : sides)
    if (groups.pairs.empty() || groups.pairs.back() != pair) groups.pairs.push_back(pair);
  std::sort(groups.pairs.begin(), groups.pairs.end());
  groups.pairs.erase(std::unique(groups.pairs.begin(), groups.pairs.end()), groups.pairs.end());
  groups.of_face.reserve(sides.size());
  std::uint32_t last = 0;
  for (const Sides& pair : sides) {
    if (groups.pairs[last] != pair)
      last = static_cast<std::uint32_t>(std::lower_bound(groups.pairs.begin(), groups.pairs.end(), pair) -
                                        groups.pairs.begin());
    groups.of_face.push_back(last);
  }
  return groups;
}

LabelGroups group_tets(std::span<const Label> labels) {
  LabelGroups groups;
  std::vector<std::uint32_t> place(1U << 16, kNoGroup);
  for (const Label label : labels) place[label] = 0;
  for (std::size_t label = 0; label < place.size(); ++label) {
    if (place[label] == kNoGroup) continue;
    place[label] = static_cast<std::uint32_t>(groups.labels.size());
    groups.labels.push_back(static_cast<Label>(label));
  }
  groups.of_tet.reserve(labels.size());
  for (const Label label : labels) groups.of_tet.push_back(place[label]);
  return groups;
}

std::vector<std::vector<std::uint32_t>> group_members(std::span<const std::uint32_t> group_of,
                                                      std::size_t groups) {
  std::vector<std::vector<std::uint32_t>> members(groups);
  for (std::size_t i = 0; i < group_of.size(); ++i)
    members[group_of[i]].push_back(static_cast<std::uint32_t>(i));
  return members;
}

std::vector<std::int32_t> set_numbers(const std::vector<NamedSet>& sets, std::size_t count) {
  std::vector<std::int32_t> numbers(count, 0);
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (const std::uint32_t member : sets[s].members) numbers[member] = static_cast<std::int32_t>(s + 1);
  return numbers;
}

std::string set_legend(const std::vector<NamedSet>& sets) {
  std::string legend;
  for (std::size_t s = 0; s < sets.size(); ++s)
    legend += (s == 0 ? "" : ", ") + std::to_string(s + 1) + " " + sets[s].name;
  return legend;
}

std::vector<std::string> group_names(const std::vector<Label>& labels, const std::vector<LabelInfo>& infos) {
  std::vector<std::string> names;
  for (const Label label : labels) {
    std::string name;
    for (const LabelInfo& info : infos)
      if (info.label == label) name = plain_name(info.name);
    names.push_back(name.empty() ? "label " + std::to_string(label) : name);
  }
  const std::vector<std::string> plain = names;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (plain[i] == kBackgroundName || std::count(plain.begin(), plain.end(), plain[i]) > 1)
      names[i] += " (" + std::to_string(labels[i]) + ")";
  return names;
}

std::string pair_name(const Sides& pair, const std::vector<Label>& labels,
                      const std::vector<std::string>& names) {
  const auto name_of = [&](Label label) -> std::string {
    if (label == kBackground) return kBackgroundName;
    const auto at = std::lower_bound(labels.begin(), labels.end(), label);
    if (at == labels.end() || *at != label) return "label " + std::to_string(label);
    return names[static_cast<std::size_t>(at - labels.begin())];
  };
  return name_of(pair[0]) + "|" + name_of(pair[1]);
}

std::string word_name(Label label, const std::vector<LabelInfo>& infos) {
  if (label == kBackground) return kBackgroundName;
  std::string word;
  for (const LabelInfo& info : infos)
    if (info.label == label) word = plain_word(info.name);
  return (word.empty() ? "label" : word) + "_" + std::to_string(label);
}

std::string word_name(const Sides& pair, const std::vector<LabelInfo>& infos) {
  return word_name(pair[0], infos) + "__" + word_name(pair[1], infos);
}

std::string coordinates_note(PatientSpace space) {
  return std::string("space ") + to_string(space) + ", unit mm: " +
         (space == PatientSpace::kRas ? "x to the right of the patient, y anterior, z superior"
                                      : "x to the left of the patient, y posterior, z superior");
}

}  // namespace voxtet
