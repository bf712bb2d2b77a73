#include "io/volume/formats/nrrd_header.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

constexpr std::array<const char*, 29> kKnownFields{
    "content",        "number",         "type",       "dimension",
    "blocksize",      "encoding",       "endian",     "datafile",
    "lineskip",       "byteskip",       "min",        "max",
    "oldmin",         "oldmax",         "sizes",      "spacings",
    "thicknesses",    "axismins",       "axismaxs",   "centers",
    "centerings",     "labels",         "units",      "kinds",
    "space",          "spacedimension", "spaceunits", "spaceorigin",
    "spacedirections"};
constexpr std::array<const char*, 2> kIgnoredFields{"measurementframe", "sampleunits"};

std::string without_spaces(std::string_view text) {
  std::string name = lower_case(text);
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  return name;
}

std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const bool escape = text[n] == '\\' && n + 1 < text.size() && (text[n + 1] == 'n' || text[n + 1] == '\\');
    if (escape) ++n;
    plain += escape && text[n] == 'n' ? '\n' : text[n];
  }
  return plain;
}

Status parse_line(std::string_view line, NrrdHeader& header) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || colon + 1 >= line.size() ||
      (line[colon + 1] != '=' && line[colon + 1] != ' '))
    return bad_nrrd("the header line " + in_quotes(line) + " is neither \"field: value\" nor \"key:=value\"");
  if (line[colon + 1] == '=') {
    header.key_values[unescaped(line.substr(0, colon))] = unescaped(line.substr(colon + 2));
    return std::monostate{};
  }
  const std::string name = without_spaces(line.substr(0, colon));
  if (std::find(kKnownFields.begin(), kKnownFields.end(), name) == kKnownFields.end() &&
      std::find(kIgnoredFields.begin(), kIgnoredFields.end(), name) == kIgnoredFields.end())
    return bad_nrrd("unknown field " + in_quotes(line.substr(0, colon)));
  if (!header.fields.emplace(name, trimmed(line.substr(colon + 1))).second)
    return bad_nrrd("the field " + in_quotes(line.substr(0, colon)) + " is given twice");
  return std::monostate{};
}

}  // namespace

Result<NrrdHeader> parse_nrrd_header(std::span<const std::uint8_t> bytes) {
  NrrdHeader header;
  bool ended = false;
  const auto magic = next_line(bytes, header.data_at, ended);
  if (!magic || magic->size() != 8 || !magic->starts_with("NRRD000") || (*magic)[7] < '1' ||
      (*magic)[7] > '5')
    return bad_nrrd("the first line is " + in_quotes(magic.value_or("")) + "; expected NRRD0001 to NRRD0005");
  while (const auto line = next_line(bytes, header.data_at, ended)) {
    if (!ended) return bad_nrrd("the header is truncated inside the line " + in_quotes(*line));
    if (line->empty()) return header;
    if (line->front() == '#') continue;
    if (Status parsed = parse_line(*line, header); !parsed) return parsed.error();
    // What follows a list are its names.
    if (header.has_list()) return header;
  }
  // Only a header that names its data file may end with its own file.
  if (header.find("datafile") == nullptr) return bad_nrrd("the header is truncated: no empty line ends it");
  return header;
}

}  // namespace voxtet
