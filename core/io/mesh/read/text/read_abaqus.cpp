#include "io/mesh/read/text/read_abaqus.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/bytes/header_text.h"
#include "io/bytes/text_numbers.h"
#include "io/mesh/read/shared/found_labels.h"
#include "io/mesh/read/shared/numbered_mesh.h"

namespace voxtet {
namespace {

constexpr std::int64_t kMostAbaqusNumber = 0xffffffff;
constexpr std::size_t kMostGenerated = std::size_t{1} << 28;  // members of a set of a few bytes

std::vector<std::string_view> split_at_commas(std::string_view line) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t comma = line.find(',');
    parts.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    line.remove_prefix(comma + 1);
  }
}

/// "*ELEMENT, TYPE=C3D4, ELSET=wall": names in small letters, values as they are.
struct AbaqusKeyword {
  std::string name;
  std::map<std::string, std::string> values;
};

AbaqusKeyword parse_keyword(std::string_view line) {
  AbaqusKeyword keyword;
  for (const std::string_view part : split_at_commas(line.substr(1))) {
    const std::size_t equals = part.find('=');
    const std::string key = lower_case(trimmed(part.substr(0, equals)));
    if (keyword.name.empty())
      keyword.name = key;
    else
      keyword.values[key] = equals == std::string_view::npos ? "" : trimmed(part.substr(equals + 1));
  }
  return keyword;
}

/// 4 or 10 for tetrahedra ("C3D4", "C3D10MH", "DC3D10"), 0 for all else.
std::size_t nodes_of_type(const std::string& type) {
  const std::size_t at = lower_case(type).find("c3d");
  if (at == std::string::npos) return 0;
  std::string digits = type.substr(at + 3);
  digits.erase(std::find_if(digits.begin(), digits.end(), [](char c) { return c < '0' || c > '9'; }),
               digits.end());
  return digits == "4" ? 4 : digits == "10" ? 10 : 0;
}

class AbaqusReader {
 public:
  AbaqusReader(const VolumeFile& file, MeshArrays* arrays)
      : in_(file.bytes, file.name, "read_abaqus"), bytes_(file.bytes), arrays_(arrays) {}

  Result<TetMesh> read() {
    std::size_t at = 0;
    bool line_ended = true;
    while (in_.ok()) {
      const std::optional<std::string_view> line = next_line(bytes_, at, line_ended);
      if (!line) break;
      ++line_;
      if (line->starts_with("**"))
        read_comment(trimmed(line->substr(2)));
      else if (line->starts_with('*'))
        read_keyword(*line);
      else if (!trimmed(*line).empty())
        read_data(*line);
    }
    if (!pending_.empty()) fail("the file ends inside an element");
    if (!line_ended) fail("the file ends inside a line");
    if (said_ && *said_ != counts_text()) fail("found " + counts_text() + ", expected " + *said_);
    std::vector<LabelInfo> infos;
    const std::vector<std::int64_t> labels = label_sets(infos);
    for (std::int64_t& set : found_.labels) set = labels[static_cast<std::size_t>(set)];
    TetMesh mesh = in_.ok() ? assemble(in_, found_) : TetMesh{};
    if (names_.size() == 1 && names_[0].empty())
      set_one_region(mesh, "no element sets", arrays_);
    else
      set_labels(in_, mesh, found_.labels, "element set", arrays_);
    if (arrays_) arrays_->infos = std::move(infos);
    keep_corners(mesh, found_.curved, arrays_);
    return finish_mesh(in_, std::move(mesh), lps_);
  }

 private:
  void fail(const std::string& message) {
    if (in_.ok()) in_.fail_in_line(line_, message);
  }

  std::string counts_text() const {
    return std::to_string(found_.nodes.size()) + " nodes, " + std::to_string(found_.tets.size()) +
           " elements";
  }

  void read_comment(std::string_view text) {
    if (!ours_) return;
    lps_ = lps_ || text.starts_with("space LPS");
    if (text.ends_with(" elements")) said_ = text;
  }

  void read_keyword(std::string_view line) {
    if (!pending_.empty()) fail("found a keyword inside an element");
    if (!continued_.empty()) continued_ += ' ';
    continued_ += trimmed(line);
    if (continued_.ends_with(',')) return;  // goes on in the next line
    begin_keyword(std::exchange(continued_, {}));
  }

  void begin_keyword(const std::string& line) {
    keyword_ = parse_keyword(line);
    if (keyword_.name == "element") {
      nodes_ = nodes_of_type(keyword_.values["type"]);
      if (nodes_ > 0) set_ = place_of(keyword_.values["elset"]);
    } else if (keyword_.name == "solid section") {
      sections_.push_back(lower_case(keyword_.values["elset"]));
      section_names_.push_back(keyword_.values["elset"]);
    }
  }

  void read_data(std::string_view line) {
    if (!continued_.empty()) {
      begin_keyword(std::exchange(continued_, {}) + std::string(line));
      return;
    }
    if (keyword_.name == "heading") {
      ours_ = ours_ || trimmed(line) == "voxtet mesh";
    } else if (keyword_.name == "node") {
      read_node(split_at_commas(line));
    } else if (keyword_.name == "element" && nodes_ > 0) {
      read_element(split_at_commas(line));
    } else if (keyword_.name == "elset") {
      read_set(split_at_commas(line));
    }
  }

  std::uint64_t number(std::string_view text, const char* what) {
    const auto value = parse_integer(text);
    if (value && *value >= 0 && *value <= kMostAbaqusNumber) return static_cast<std::uint64_t>(*value);
    fail(std::string(what) + " is " + in_quotes(text) + ", expected a whole number");
    return 0;
  }

  void read_node(const std::vector<std::string_view>& parts) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t d = 0; d < 3 && d + 1 < parts.size(); ++d)
      if (!parts[d + 1].empty() && !parse_real(parts[d + 1], point[static_cast<Eigen::Index>(d)]))
        fail("a coordinate is " + in_quotes(parts[d + 1]) + ", expected a finite number");
    if (parts.size() < 4) fail("a node of " + std::to_string(parts.size() - 1) + " coordinates, expected 3");
    found_.node_tags.push_back(number(parts[0], "a node number"));
    found_.nodes.push_back(point);
  }

  /// Numbers of an element may go on in the next line.
  void read_element(const std::vector<std::string_view>& parts) {
    for (const std::string_view part : parts)
      if (!part.empty()) pending_.push_back(number(part, "a number of an element"));
    if (pending_.size() < nodes_ + 1) return;
    if (pending_.size() > nodes_ + 1)
      return fail("element " + std::to_string(pending_[0]) + " has " + std::to_string(pending_.size() - 1) +
                  " nodes, expected " + std::to_string(nodes_));
    found_.add_tet(pending_[0], {pending_[1], pending_[2], pending_[3], pending_[4]}, set_);
    found_.curved += nodes_ > 4 ? 1 : 0;
    pending_.clear();
  }

  void read_set(const std::vector<std::string_view>& parts) {
    std::vector<std::uint64_t>& members = sets_[lower_case(keyword_.values["elset"])];
    if (keyword_.values.contains("generate") && parts.size() >= 2) {
      const std::uint64_t first = number(parts[0], "the first of a set"),
                          last = number(parts[1], "the last of a set"),
                          step = parts.size() > 2 && !parts[2].empty() ? number(parts[2], "a step") : 1;
      if (step == 0 || last < first ||
          (last - first) / step > kMostGenerated - std::min(kMostGenerated, members.size()))
        return fail("a set from " + std::to_string(first) + " to " + std::to_string(last) + " by " +
                    std::to_string(step));
      for (std::uint64_t i = first; i <= last; i += step) members.push_back(i);
      return;
    }
    for (const std::string_view part : parts) {
      if (part.empty()) continue;
      if (const auto value = parse_integer(part); value && *value >= 0)
        members.push_back(static_cast<std::uint64_t>(*value));
      else if (const auto other = sets_.find(lower_case(part));
               other != sets_.end() && &other->second != &members)
        members.insert(members.end(), other->second.begin(), other->second.end());
    }
  }

  /// The place of a set of elements in the order of the file.
  std::int64_t place_of(const std::string& name) {
    const auto at = std::find(names_.begin(), names_.end(), name);
    const std::int64_t place = at - names_.begin();
    if (at == names_.end()) names_.push_back(name);
    return place;
  }

  /// The label of each set that found_.labels refers to.
  std::vector<std::int64_t> label_sets(std::vector<LabelInfo>& infos) {
    const bool named = std::any_of(names_.begin(), names_.end(), [](const auto& n) { return !n.empty(); });
    if (!named && !sections_.empty()) use_sections();
    std::vector<std::string> shown = names_;
    for (std::string& name : shown)
      if (name.empty()) name = "without a set";
    if (shown.size() == 1 && names_[0].empty()) return {1};
    return labels_of_parts(shown, infos);
  }

  /// Elements of no section stay in the first, nameless set.
  void use_sections() {
    std::map<std::uint64_t, std::int64_t> of_element;
    for (std::size_t s = 0; s < sections_.size(); ++s)
      for (const std::uint64_t element : sets_[sections_[s]])
        of_element[element] = static_cast<std::int64_t>(s + 1);
    bool all = true;
    for (std::size_t t = 0; t < found_.labels.size(); ++t) {
      const auto at = of_element.find(found_.tet_tags[t]);
      found_.labels[t] = at == of_element.end() ? 0 : at->second;
      all = all && at != of_element.end();
    }
    if (of_element.empty()) return;
    names_.insert(names_.end(), section_names_.begin(), section_names_.end());
    if (!all) return;
    names_.erase(names_.begin());
    for (std::int64_t& set : found_.labels) --set;
  }

  MeshCursor in_;
  std::span<const std::uint8_t> bytes_;
  MeshArrays* arrays_;
  std::size_t line_ = 0, nodes_ = 0;
  AbaqusKeyword keyword_;
  std::string continued_;               ///< a keyword line that ended with a comma
  std::vector<std::uint64_t> pending_;  ///< numbers of an element that is not whole yet
  std::int64_t set_ = 0;                ///< of the elements that follow
  std::vector<std::string> names_;      ///< of the sets that labels of found_ refer to; "" for none
  std::vector<std::string> sections_, section_names_;
  std::map<std::string, std::vector<std::uint64_t>> sets_;
  NumberedMesh found_;
  bool ours_ = false, lps_ = false;
  std::optional<std::string> said_;  ///< of how many there are
};

}  // namespace

Result<TetMesh> read_abaqus(const VolumeFile& file, MeshArrays* arrays) {
  return AbaqusReader(file, arrays).read();
}

}  // namespace voxtet
