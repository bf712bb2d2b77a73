#include "io/volume/nrrd_segments.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "io/bytes/byte_source.h"
#include "io/bytes/header_text.h"
#include "io/volume/nrrd_header.h"

namespace voxtet {
namespace {

constexpr std::string_view kPrefix = "Segment";

/// The numbers N of all keys "SegmentN_...".
std::set<std::int64_t> segment_numbers(const std::map<std::string, std::string>& key_values) {
  std::set<std::int64_t> numbers;
  for (const auto& [key, value] : key_values) {
    const std::size_t underscore = key.find('_');
    if (!key.starts_with(kPrefix) || underscore == std::string::npos) continue;
    const auto number =
        parse_integer(std::string_view(key).substr(kPrefix.size(), underscore - kPrefix.size()));
    if (number && *number >= 0) numbers.insert(*number);
  }
  return numbers;
}

Result<std::int64_t> bounded(const std::string& key, const std::string& text, std::int64_t lo,
                             std::int64_t hi) {
  const auto value = parse_integer(trimmed(text));
  if (!value || *value < lo || *value > hi)
    return bad_nrrd(key + " is " + in_quotes(text) + "; expected a whole number from " + std::to_string(lo) +
                    " to " + std::to_string(hi));
  return *value;
}

Result<NrrdSegment> parse_segment(const std::map<std::string, std::string>& key_values, std::int64_t number,
                                  std::int64_t layers, std::int64_t place) {
  NrrdSegment segment;
  segment.layer = layers > 1 ? place : 0;
  const std::string prefix = std::string(kPrefix) + std::to_string(number) + "_";
  const auto find = [&](const char* name) {
    const auto at = key_values.find(prefix + name);
    return at == key_values.end() ? nullptr : &at->second;
  };
  if (const std::string* name = find("Name")) segment.info.name = *name;
  if (const std::string* text = find("LabelValue")) {
    const Result<std::int64_t> value = bounded(prefix + "LabelValue", *text, 1, 65535);
    if (!value) return value.error();
    segment.value = static_cast<Label>(*value);
  }
  if (const std::string* text = find("Layer")) {
    const Result<std::int64_t> layer = bounded(prefix + "Layer", *text, 0, layers - 1);
    if (!layer) return layer.error();
    segment.layer = *layer;
  }
  if (segment.layer >= layers)
    return bad_nrrd(prefix + "Layer is missing, and the file has only " + std::to_string(layers) + " layers");
  if (const std::string* text = find("Color")) {
    const auto rgb = parse_doubles(*text);
    const auto in_range = [](double c) { return c >= 0 && c <= 1; };
    if (!rgb || rgb->size() != 3 || !std::all_of(rgb->begin(), rgb->end(), in_range))
      return bad_nrrd(prefix + "Color is " + in_quotes(*text) + "; expected three numbers from 0 to 1");
    for (std::size_t c = 0; c < 3; ++c) segment.info.colour[c] = static_cast<float>((*rgb)[c]);
  }
  return segment;
}

/// "inner (label 1)".
std::string called(const NrrdSegment& segment) {
  const std::string label = "label " + std::to_string(segment.info.label);
  return segment.info.name.empty() ? label : segment.info.name + " (" + label + ")";
}

std::string voxels(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " voxel" : " voxels");
}

/// How many voxels segments have, keep, and share with a later one. Segments by their place.
struct Overlaps {
  std::vector<std::size_t> claimed, kept;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> shared;  ///< by earlier and later segment

  explicit Overlaps(std::size_t segments) : claimed(segments, 0), kept(segments, 0) {}

  /// `places`: of all segments that claim one voxel.
  void add(const std::vector<std::size_t>& places) {
    for (std::size_t a = 0; a < places.size(); ++a) {
      ++claimed[places[a]];
      for (std::size_t b = 0; b < a; ++b) ++shared[std::minmax(places[a], places[b])];
    }
    if (!places.empty()) ++kept[*std::max_element(places.begin(), places.end())];
  }
};

/// The error of segments that have voxels and keep none.
std::optional<Error> lost_segments(const Overlaps& overlaps, const std::vector<NrrdSegment>& segments) {
  std::string lost;
  for (std::size_t n = 0; n < segments.size(); ++n) {
    if (overlaps.claimed[n] == 0 || overlaps.kept[n] > 0) continue;
    std::string winners;
    for (const auto& [pair, count] : overlaps.shared)
      if (pair.first == n) winners += (winners.empty() ? "" : ", ") + called(segments[pair.second]);
    lost += (lost.empty() ? "" : "; ") + ("segment " + called(segments[n]) + " loses all of its " +
                                          voxels(overlaps.claimed[n]) + " to " + winners);
  }
  if (lost.empty()) return {};
  return bad_nrrd(lost +
                  ": where segments overlap the later one wins; expected a voxel or more left of each (move "
                  "it behind the others in the list of segments, or remove the overlap)");
}

}  // namespace

Result<std::vector<NrrdSegment>> parse_segments(const std::map<std::string, std::string>& key_values,
                                                std::int64_t layers) {
  std::vector<NrrdSegment> segments;
  std::set<std::pair<std::int64_t, Label>> claimed;
  std::int64_t next_free = 1;
  for (const std::int64_t number : segment_numbers(key_values)) {
    const Result<NrrdSegment> segment =
        parse_segment(key_values, number, layers, static_cast<std::int64_t>(segments.size()));
    if (!segment) return segment.error();
    if (!claimed.emplace(segment->layer, segment->value).second)
      return bad_nrrd("Segment" + std::to_string(number) + "_LabelValue is " +
                      std::to_string(segment->value) + ", which an earlier segment already has in layer " +
                      std::to_string(segment->layer));
    next_free = std::max<std::int64_t>(next_free, segment->value + 1);
    segments.push_back(*segment);
  }
  std::set<Label> used;
  for (NrrdSegment& segment : segments) {
    std::int64_t label = segment.value;
    if (used.count(segment.value) > 0) label = next_free++;
    if (label > 65535) return bad_nrrd("the segments' LabelValues leave no free label up to 65535");
    segment.info.label = static_cast<Label>(label);
    used.insert(segment.info.label);
  }
  return segments;
}

Result<std::vector<Label>> flatten_layers(const std::vector<Label>& values, std::int64_t layers,
                                          const std::vector<NrrdSegment>& segments,
                                          const std::array<std::int64_t, 3>& size,
                                          std::vector<std::string>& warnings) {
  // Of each layer the segments by value; a number is the segment's place, from 1.
  std::vector<std::vector<std::uint32_t>> place_of(static_cast<std::size_t>(layers));
  for (std::size_t n = 0; n < segments.size(); ++n) {
    std::vector<std::uint32_t>& table = place_of[static_cast<std::size_t>(segments[n].layer)];
    if (table.size() <= segments[n].value) table.resize(segments[n].value + std::size_t{1}, 0);
    table[segments[n].value] = static_cast<std::uint32_t>(n + 1);
  }
  std::vector<Label> labels(values.size() / static_cast<std::size_t>(layers), kBackground);
  Overlaps overlaps(segments.size());
  std::vector<std::size_t> places;
  const Label* value = values.data();
  for (std::size_t voxel = 0; voxel < labels.size(); ++voxel) {
    places.clear();
    for (std::size_t layer = 0; layer < place_of.size(); ++layer, ++value) {
      if (*value == 0) continue;
      const std::uint32_t place = *value < place_of[layer].size() ? place_of[layer][*value] : 0;
      if (place == 0) {
        const std::size_t nx = static_cast<std::size_t>(size[0]), ny = static_cast<std::size_t>(size[1]);
        return bad_nrrd("voxel (" + std::to_string(voxel % nx) + ", " + std::to_string(voxel / nx % ny) +
                        ", " + std::to_string(voxel / nx / ny) + ") of layer " + std::to_string(layer) +
                        " has the value " + std::to_string(*value) +
                        ", which no Segment's LabelValue and Layer claim");
      }
      places.push_back(place - 1);
    }
    overlaps.add(places);
    if (!places.empty()) labels[voxel] = segments[*std::max_element(places.begin(), places.end())].info.label;
  }
  if (auto lost = lost_segments(overlaps, segments)) return *std::move(lost);
  for (const auto& [pair, count] : overlaps.shared)
    warnings.push_back("segments " + called(segments[pair.first]) + " and " + called(segments[pair.second]) +
                       " overlap in " + voxels(count) + ": of the two the later one wins, " +
                       called(segments[pair.second]));
  return labels;
}

void warn_of_empty_segments(const std::vector<Label>& labels, const std::vector<NrrdSegment>& segments,
                            std::vector<std::string>& warnings) {
  if (segments.empty()) return;
  std::vector<bool> found(std::numeric_limits<Label>::max() + std::size_t{1});
  for (const Label label : labels) found[label] = true;
  for (const NrrdSegment& segment : segments)
    if (!found[segment.info.label]) warnings.push_back("segment " + called(segment) + " has no voxels");
}

}  // namespace voxtet
