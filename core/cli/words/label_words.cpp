#include "cli/words/label_words.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>

#include "volume/select_labels.h"

namespace voxtet {
namespace {

constexpr Label kLastLabel = std::numeric_limits<Label>::max();

bool is_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The label of a text of digits; nothing for one that is no label.
std::optional<Label> label_of_digits(std::string_view text) {
  Label label = kBackground;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), label);
  if (failed != std::errc{} || label == kBackground) return std::nullopt;
  return label;
}

std::string in_lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

Error no_label(const std::string& option, const std::string& word) {
  return usage_error(
      "cli", option + ": found '" + word + "', expected labels from 1 to " + std::to_string(kLastLabel));
}

}  // namespace

LabelWords::LabelWords(const LabelVolume* volume, const std::vector<LegendEntry>& legend)
    : known_(volume != nullptr) {
  if (!volume) return;
  infos_ = with_legend(volume->infos, legend);
  for (const auto& [label, count] : count_labels(*volume)) present_.push_back(label);
}

std::vector<Label> LabelWords::between(Label first, Label last) const {
  std::vector<Label> found;
  std::copy_if(present_.begin(), present_.end(), std::back_inserter(found),
               [&](Label label) { return label >= first && label <= last; });
  return found;
}

std::string LabelWords::name_of(Label label) const {
  for (const LabelInfo& info : infos_)
    if (info.label == label) return info.name;
  return "";
}

Error LabelWords::not_found(const std::string& option, const std::string& word) const {
  constexpr std::size_t kMost = 20;
  std::string there;
  for (std::size_t i = 0; i < present_.size() && i < kMost; ++i) {
    const std::string name = name_of(present_[i]);
    there += (i == 0 ? "" : ", ") + std::to_string(present_[i]) + (name.empty() ? "" : " (" + name + ")");
  }
  if (present_.size() > kMost) there += " and " + std::to_string(present_.size() - kMost) + " more";
  return usage_error("cli", option + ": found no label '" + word + "' in the volume, which has " +
                                (there.empty() ? "none" : there) + "; expected " + kLabelForms);
}

Result<std::vector<Label>> LabelWords::labels_of_word(const std::string& option,
                                                      const std::string& word) const {
  if (is_digits(word)) {
    const std::optional<Label> label = label_of_digits(word);
    if (!label) return no_label(option, word);
    return std::vector<Label>{*label};
  }
  if (!known_) return std::vector<Label>{};
  std::vector<Label> same, alike;
  for (const LabelInfo& info : infos_) {
    if (info.name == word) same.push_back(info.label);
    if (in_lower_case(info.name) == in_lower_case(word)) alike.push_back(info.label);
  }
  const std::vector<Label>& named = same.empty() ? alike : same;
  if (named.size() > 1)
    return usage_error("cli", option + ": '" + word + "' is the name of the labels " +
                                  std::to_string(named[0]) + " and " + std::to_string(named[1]) +
                                  ", expected one of these numbers");
  if (!named.empty()) return named;
  if (word == "all" && !present_.empty()) return present_;
  const std::size_t dash = word.find('-');
  if (dash == std::string::npos || !is_digits(word.substr(0, dash)) || !is_digits(word.substr(dash + 1)))
    return not_found(option, word);
  const std::optional<Label> first = label_of_digits(word.substr(0, dash));
  const std::optional<Label> last = label_of_digits(word.substr(dash + 1));
  if (!first || !last) return no_label(option, word);
  std::vector<Label> range = between(*first, *last);
  if (range.empty()) return not_found(option, word);
  return range;
}

Result<std::vector<Label>> LabelWords::labels_of(const std::string& option, const std::string& text) const {
  std::vector<Label> labels;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string word = text.substr(start, end - start);
    start = end + 1;
    if (word.empty())
      return usage_error("cli", option + ": found " + (text.empty() ? "nothing" : "'" + text + "'") +
                                    ", expected labels: " + kLabelForms);
    const Result<std::vector<Label>> found = labels_of_word(option, word);
    if (!found) return found.error();
    for (const Label label : *found)
      if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  }
  return labels;
}

}  // namespace voxtet
