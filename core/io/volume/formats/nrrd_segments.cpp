#include "io/volume/formats/nrrd_segments.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "io/bytes/byte_source.h"
#include "io/bytes/header_text.h"
#include "io/volume/formats/nrrd_header.h"
#include "io/volume/voxels/collect_labels.h"

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
  return segment;
}

/// Gives the segments the colours of the file, or none of them where one is not from 0 to 1: what the others
/// mean is not certain then either.
void read_colours(const std::map<std::string, std::string>& key_values, const std::set<std::int64_t>& numbers,
                  std::vector<NrrdSegment>& segments, Reading& reading) {
  auto segment = segments.begin();
  for (const std::int64_t number : numbers) {
    std::array<float, 3>& colour = (segment++)->info.colour;
    const std::string key = std::string(kPrefix) + std::to_string(number) + "_Color";
    const auto text = key_values.find(key);
    if (text == key_values.end()) continue;
    const auto rgb = parse_doubles(text->second);
    const auto in_range = [](double c) { return c >= 0 && c <= 1; };
    if (!rgb || rgb->size() != 3 || !std::all_of(rgb->begin(), rgb->end(), in_range)) {
      reading.note(key + " is " + in_quotes(text->second) +
                   ", expected three numbers from 0 to 1; no colour of the file is used");
      for (NrrdSegment& all : segments) all.info.colour = LabelInfo{}.colour;
      return;
    }
    for (std::size_t c = 0; c < 3; ++c) colour[c] = static_cast<float>((*rgb)[c]);
  }
}

/// "inner (label 1)".
std::string called(const NrrdSegment& segment) {
  const std::string label = "label " + std::to_string(segment.info.label);
  return segment.info.name.empty() ? label : segment.info.name + " (" + label + ")";
}

std::string voxels(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " voxel" : " voxels");
}

/// Which of two segments wins where they overlap.
class Precedence {
 public:
  /// Errors: kUsage for a name that no segment has.
  static Result<Precedence> of(const std::vector<NrrdSegment>& segments,
                               const std::vector<std::string>& names) {
    Precedence order;
    for (std::size_t n = 0; n < segments.size(); ++n) order.rank_.push_back(n);
    for (std::size_t at = 0; at < names.size(); ++at) {
      const std::optional<std::size_t> place = place_of(segments, names[at]);
      if (!place) {
        std::string known;
        for (const NrrdSegment& segment : segments) known += (known.empty() ? "" : ", ") + called(segment);
        return usage_error(kNrrdReader, "source.precedence[" + std::to_string(at) + "]: found " +
                                            in_quotes(names[at]) +
                                            ", expected a segment of the file: " + known);
      }
      // Above all that are not named; of one that is named twice the first place counts.
      std::size_t& rank = order.rank_[*place];
      if (rank < segments.size()) rank = segments.size() + names.size() - at;
    }
    return order;
  }

  bool wins(std::size_t segment, std::size_t over) const { return rank_[segment] > rank_[over]; }
  bool is_named(std::size_t segment) const { return rank_[segment] >= rank_.size(); }
  std::size_t winner(const std::vector<std::size_t>& places) const {
    return *std::max_element(places.begin(), places.end(),
                             [&](std::size_t a, std::size_t b) { return rank_[a] < rank_[b]; });
  }

 private:
  static std::optional<std::size_t> place_of(const std::vector<NrrdSegment>& segments,
                                             const std::string& name) {
    for (std::size_t n = 0; n < segments.size(); ++n)
      if (segments[n].info.name == name) return n;
    for (std::size_t n = 0; n < segments.size(); ++n)
      if (std::to_string(segments[n].info.label) == name) return n;
    return std::nullopt;
  }

  std::vector<std::size_t> rank_;  ///< of each segment; the higher one wins
};

/// How many voxels segments have, keep, and share with others. Segments by their place.
struct Overlaps {
  std::vector<std::size_t> claimed, kept;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> shared;  ///< by earlier and later segment

  explicit Overlaps(std::size_t segments) : claimed(segments, 0), kept(segments, 0) {}

  /// `places`: of all segments that claim one voxel.
  void add(const std::vector<std::size_t>& places, std::size_t winner) {
    for (std::size_t a = 0; a < places.size(); ++a) {
      ++claimed[places[a]];
      for (std::size_t b = 0; b < a; ++b) ++shared[std::minmax(places[a], places[b])];
    }
    ++kept[winner];
  }

  void warn(const std::vector<NrrdSegment>& segments, const Precedence& order, Reading& reading) const {
    for (std::size_t n = 0; n < segments.size(); ++n) {
      if (claimed[n] == 0) reading.warn("segment " + called(segments[n]) + " has no voxels");
      if (claimed[n] > 0 && kept[n] == 0) warn_of_lost(segments, n, order, reading);
    }
    for (const auto& [pair, count] : shared) {
      const auto [first, second] = pair;
      const std::size_t winner = order.wins(first, second) ? first : second;
      reading.warn("segments " + called(segments[first]) + " and " + called(segments[second]) +
                   " overlap in " + voxels(count) + ": of the two the " +
                   (order.is_named(winner) ? "first of source.precedence" : "later one") + " wins, " +
                   called(segments[winner]));
    }
  }

 private:
  void warn_of_lost(const std::vector<NrrdSegment>& segments, std::size_t lost, const Precedence& order,
                    Reading& reading) const {
    std::string winners;
    for (const auto& [pair, count] : shared) {
      if (pair.first != lost && pair.second != lost) continue;
      const std::size_t other = pair.first == lost ? pair.second : pair.first;
      if (order.wins(other, lost)) winners += (winners.empty() ? "" : ", ") + called(segments[other]);
    }
    const LabelInfo& info = segments[lost].info;
    // The command line takes a comma for the end of a name.
    const bool plain = !info.name.empty() && info.name.find(',') == std::string::npos;
    const std::string name = plain ? in_quotes(info.name) : std::to_string(info.label);
    reading.warn("SEGMENT LOST: segment " + called(segments[lost]) + " loses all of its " +
                 voxels(claimed[lost]) + " to " + winners +
                 ", and will not be in the mesh; to keep it, let it win with --precedence " + name +
                 " (source.precedence)");
  }
};

}  // namespace

Result<std::vector<NrrdSegment>> parse_segments(const std::map<std::string, std::string>& key_values,
                                                std::int64_t layers, Reading& reading) {
  std::vector<NrrdSegment> segments;
  std::set<std::pair<std::int64_t, Label>> claimed;
  std::int64_t next_free = 1;
  const std::set<std::int64_t> numbers = segment_numbers(key_values);
  for (const std::int64_t number : numbers) {
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
  read_colours(key_values, numbers, segments, reading);
  return segments;
}

Result<std::vector<Label>> read_segments(const VoxelLayout& layout, const std::vector<NrrdSegment>& segments,
                                         const std::function<Status(ValueSink&)>& feed, Reading& reading) {
  const Result<Precedence> order = Precedence::of(segments, reading.options.precedence);
  if (!order) return order.error();
  LabelCollector collector(layout, reading);
  if (Status fed = feed(collector); !fed) return fed.error();
  const Result<std::vector<Label>> values = collector.finish();
  if (!values) return values.error();
  // Of each layer the segments by value; a number is the segment's place, from 1.
  std::vector<std::vector<std::uint32_t>> place_of(static_cast<std::size_t>(layout.layers));
  for (std::size_t n = 0; n < segments.size(); ++n) {
    std::vector<std::uint32_t>& table = place_of[static_cast<std::size_t>(segments[n].layer)];
    if (table.size() <= segments[n].value) table.resize(segments[n].value + std::size_t{1}, 0);
    table[segments[n].value] = static_cast<std::uint32_t>(n + 1);
  }
  std::vector<Label> labels(static_cast<std::size_t>(layout.voxel_count()), kBackground);
  Overlaps overlaps(segments.size());
  std::vector<std::size_t> places;
  std::size_t index = 0;
  for (Label& label : labels) {
    places.clear();
    for (std::size_t layer = 0; layer < place_of.size(); ++layer, ++index) {
      const Label value = (*values)[index];
      if (value == 0) continue;
      const std::uint32_t place = value < place_of[layer].size() ? place_of[layer][value] : 0;
      if (place == 0)
        return bad_nrrd(voxel_name(layout, index) + " has the value " + std::to_string(value) +
                        ", which no Segment's LabelValue and Layer claim");
      places.push_back(place - 1);
    }
    if (places.empty()) continue;
    const std::size_t winner = order->winner(places);
    overlaps.add(places, winner);
    label = segments[winner].info.label;
  }
  overlaps.warn(segments, *order, reading);
  reading.precedence_used = true;
  return labels;
}

void warn_of_empty_segments(const std::vector<Label>& labels, const std::vector<NrrdSegment>& segments,
                            Reading& reading) {
  if (segments.empty()) return;
  std::vector<bool> found(std::numeric_limits<Label>::max() + std::size_t{1});
  for (const Label label : labels) found[label] = true;
  for (const NrrdSegment& segment : segments)
    if (!found[segment.info.label]) reading.warn("segment " + called(segment) + " has no voxels");
}

}  // namespace voxtet
