#include "io/mesh/read/text/read_nastran.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/header_text.h"
#include "io/bytes/text_numbers.h"
#include "io/mesh/read/shared/found_labels.h"
#include "io/mesh/read/shared/numbered_mesh.h"

namespace voxtet {
namespace {

constexpr std::size_t kName = 8;  // characters of the first field, in every form of fixed fields
constexpr std::int64_t kMostGrid = 0xffffffff;

/// An entry with the fields of all its lines.
struct NastranCard {
  std::string name;  ///< in capitals, without an asterisk; empty: none yet
  std::vector<std::string_view> fields;
  std::size_t line = 0;  ///< the first
};

/// The fields of a line behind its first, of `width` characters each, `count` at the most.
void add_fixed_fields(std::string_view line, std::size_t width, std::size_t count, NastranCard& card) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = kName + i * width;
    card.fields.push_back(begin < line.size() ? trimmed(line.substr(begin, width)) : std::string_view{});
  }
}

void add_free_fields(std::string_view line, std::size_t count, NastranCard& card) {
  std::size_t begin = line.find(',');
  for (std::size_t i = 0; i < count; ++i) {
    if (begin == std::string_view::npos) {
      card.fields.emplace_back();
      continue;
    }
    const std::size_t end = line.find(',', begin + 1);
    card.fields.push_back(
        trimmed(line.substr(begin + 1, end == std::string_view::npos ? end : end - begin - 1)));
    begin = end;
  }
}

/// "1.5", "1.5E3", "1.5D3" and "1.5+3".
bool parse_nastran_real(std::string_view field, double& value) {
  std::string text(field);
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == 'D' || text[i] == 'd') text[i] = 'e';
    const bool exponent = text[i - 1] == 'e' || text[i - 1] == 'E';
    if ((text[i] == '+' || text[i] == '-') && !exponent) text.insert(i++, "e");
  }
  if (!text.empty() && text.back() == '.') text.pop_back();
  if (text.starts_with('+')) text.erase(0, 1);
  const std::size_t point = text.find(".e");
  if (point != std::string::npos) text.erase(point, 1);
  return parse_real(text, value);
}

class NastranReader {
 public:
  NastranReader(const VolumeFile& file, MeshArrays* arrays)
      : in_(file.bytes, file.name, "read_nastran"), arrays_(arrays) {
    const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
    const std::size_t bulk = lower_case(text.substr(0, 1 << 16)).find("begin bulk");
    bulk_ = bulk == std::string_view::npos ? 0 : bulk;
    bytes_ = file.bytes;
  }

  Result<TetMesh> read() {
    std::size_t at = 0;
    bool line_ended = false;
    while (in_.ok() && !ended_) {
      const bool in_bulk = at >= bulk_;
      const std::optional<std::string_view> line = next_line(bytes_, at, line_ended);
      if (!line) break;
      ++line_;
      if (line->starts_with('$'))
        read_comment(trimmed(line->substr(1)));
      else if (in_bulk)
        read_line(*line);
    }
    finish_card();
    if (ours_ && !ended_) fail("the file ends without ENDDATA");
    if (!ended_ && !line_ended) fail("the file ends inside a line");
    TetMesh mesh = in_.ok() ? assemble(in_, found_) : TetMesh{};
    set_labels(in_, mesh, found_.labels, "property", arrays_);
    keep_corners(mesh, found_.curved, arrays_);
    return finish_mesh(in_, std::move(mesh), lps_);
  }

 private:
  void fail(const std::string& message) {
    if (in_.ok()) in_.fail_in_line(card_.name.empty() ? line_ : card_.line, message);
  }

  void read_comment(std::string_view text) {
    ours_ = ours_ || text == "voxtet mesh";
    lps_ = lps_ || (ours_ && text.starts_with("space LPS"));
    if (!arrays_ || !text.starts_with("label ")) return;
    text.remove_prefix(6);
    const std::size_t space = text.find(' ');
    if (space != std::string_view::npos)
      add_label_name(parse_integer(text.substr(0, space)).value_or(0), text.substr(space + 1),
                     arrays_->infos);
  }

  void read_line(std::string_view line) {
    line = line.substr(0, line.find('$'));
    if (trimmed(line).empty()) return;
    if (line.find('\t') != std::string_view::npos)
      return fail("found a tab, expected fields by columns or commas");
    const bool is_free = line.substr(0, kName + 1).find(',') != std::string_view::npos;
    std::string_view first = trimmed(is_free ? line.substr(0, line.find(',')) : line.substr(0, kName));
    const bool continues = first.empty() || first[0] == '+' || first[0] == '*';
    const bool is_large = !first.empty() && (first.back() == '*' || first[0] == '*');
    if (!continues) {
      finish_card();
      card_.name = lower_case(first.back() == '*' ? first.substr(0, first.size() - 1) : first);
      card_.line = line_;
      if (card_.name == "enddata") ended_ = true;
    }
    if (is_free)
      add_free_fields(line, is_large ? 4 : 8, card_);
    else
      add_fixed_fields(line, is_large ? 16 : 8, is_large ? 4 : 8, card_);
  }

  void finish_card() {
    if (card_.name == "grid") read_grid();
    if (card_.name == "ctetra") read_tetra();
    card_ = {};
  }

  std::string_view field(std::size_t i) const {
    return i < card_.fields.size() ? card_.fields[i] : std::string_view{};
  }
  std::uint64_t number(std::size_t i, const char* what) {
    const auto value = parse_integer(field(i));
    if (value && *value >= 0 && *value <= kMostGrid) return static_cast<std::uint64_t>(*value);
    fail(std::string(what) + " is " + in_quotes(field(i)) + ", expected a whole number");
    return 0;
  }

  void read_grid() {
    const std::uint64_t tag = number(0, "the number of a GRID");
    if (!field(1).empty() && field(1) != "0")
      fail("GRID " + std::to_string(tag) + " is in the coordinate system " + in_quotes(field(1)) +
           ", expected the basic one: 0 or nothing");
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (std::size_t d = 0; d < 3; ++d) {
      const std::string_view text = field(2 + d);
      if (!text.empty() && !parse_nastran_real(text, point[static_cast<Eigen::Index>(d)]))
        fail("a coordinate of GRID " + std::to_string(tag) + " is " + in_quotes(text) +
             ", expected a finite number");
    }
    found_.node_tags.push_back(tag);
    found_.nodes.push_back(point);
  }

  void read_tetra() {
    const std::uint64_t tag = number(0, "the number of a CTETRA");
    const std::uint64_t property =
        field(1).empty() ? tag : number(1, "the property of a CTETRA");  // as Nastran has it
    std::array<std::uint64_t, 4> corners{};
    for (std::size_t c = 0; c < 4; ++c) corners[c] = number(2 + c, "a grid of a CTETRA");
    if (!field(6).empty()) ++found_.curved;
    found_.add_tet(tag, corners, static_cast<std::int64_t>(property));
  }

  MeshCursor in_;
  MeshArrays* arrays_;
  std::span<const std::uint8_t> bytes_;
  std::size_t bulk_ = 0;  ///< where the bulk data begin
  std::size_t line_ = 0;
  NastranCard card_;
  NumberedMesh found_;
  bool ours_ = false, lps_ = false, ended_ = false;
};

}  // namespace

Result<TetMesh> read_nastran(const VolumeFile& file, MeshArrays* arrays) {
  return NastranReader(file, arrays).read();
}

}  // namespace voxtet
