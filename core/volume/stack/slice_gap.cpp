#include "volume/stack/slice_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/topology/label_components.h"

namespace voxtet::slices {
namespace {

/// A label near a column.
struct Track {
  Label label = kBackground;
  std::array<double, 2> seen{};   // in the two slices, as measured
  std::array<double, 2> value{};  // bounded change
  std::array<double, 2> slope{};
};

/// One of the labels of either slice, with its distances in the four slices (null where it is absent).
struct Source {
  Label label;
  std::array<const LabelDistance*, 4> in;
};

std::vector<Source> merged_sources(const std::array<const SliceDistances*, 4>& near) {
  std::vector<Source> sources;
  for (const std::size_t slice : {1, 2})
    for (const LabelDistance& distance : *near[slice]) sources.push_back({distance.label, {}});
  const auto by_label = [](const Source& a, const Source& b) { return a.label < b.label; };
  std::sort(sources.begin(), sources.end(), by_label);
  sources.erase(std::unique(sources.begin(), sources.end(),
                            [](const Source& a, const Source& b) { return a.label == b.label; }),
                sources.end());
  for (std::size_t slice = 0; slice < 4; ++slice) {
    if (!near[slice]) continue;
    for (const LabelDistance& distance : *near[slice]) {
      const auto at = std::lower_bound(sources.begin(), sources.end(), Source{distance.label, {}}, by_label);
      if (at != sources.end() && at->label == distance.label) at->in[slice] = &distance;
    }
  }
  return sources;
}

/// Weights of the Hermite cubic at the inner planes; those of the upper end are the same from behind, so that
/// a mirrored stack gives the mirrored result.
struct Weights {
  std::vector<double> value, slope;
  explicit Weights(int planes) {
    for (int m = 1; m < planes; ++m) {
      const double t = static_cast<double>(m) / planes;
      value.push_back((2 * t - 3) * t * t + 1);
      slope.push_back(((t - 2) * t + 1) * t);
    }
  }
  std::size_t count() const { return value.size(); }
  double at(const Track& track, std::size_t m) const {
    const std::size_t back = count() - 1 - m;
    return (value[m] * track.value[0] + value[back] * track.value[1]) +
           (slope[m] * track.slope[0] - slope[back] * track.slope[1]);
  }
};

/// A column in which `below` becomes `above` half-way, whatever outlines are moved.
void change_half_way(Label below, Label above, std::size_t planes, Candidate* out) {
  constexpr float kUndisputed = std::numeric_limits<float>::max();
  for (std::size_t m = 0; m < planes; ++m)
    out[m] = 2 * m < planes ? Candidate{below, above, kUndisputed} : Candidate{above, below, kUndisputed};
}

class Gap {
 public:
  Gap(const SliceStack& stack, const Contacts& contacts, int lower,
      const std::array<const SliceDistances*, 4>& near, int planes)
      : stack_(stack), contacts_(contacts), near_(near), sources_(merged_sources(near)), weights_(planes) {
    out_.lower = lower;
    far_ = near[1]->front().far_mm;
    slices_ = {stack.slice(lower), stack.slice(lower + 1)};
    out_.flat.assign(stack.area(), false);
    for (std::uint32_t p = 0; p < stack.area(); ++p)
      if (slices_[0][p] != slices_[1][p]) out_.columns.push_back(p);
    reach_.assign(stack.area(), std::numeric_limits<float>::max());
    if (!out_.columns.empty())
      for (const std::size_t slice : {0, 1}) measure_regions(slice);
  }

  SliceGap run() {
    for (const std::uint32_t column : out_.columns) interpolate(column);
    return std::move(out_);
  }

 private:
  const Source& source_of(Label label) const {
    return *std::lower_bound(sources_.begin(), sources_.end(), label,
                             [](const Source& a, Label b) { return a.label < b; });
  }
  double distance(const Source& source, std::size_t slice, std::uint32_t pixel) const {
    const LabelDistance* in = source.in[slice];
    const std::uint32_t width = static_cast<std::uint32_t>(stack_.width);
    return in ? in->at(static_cast<int>(pixel % width), static_cast<int>(pixel / width)) : -far_;
  }

  /// Regions where a slice has one label and the other slice another: how far that label has to come from in
  /// the other slice, and whether the region is a cut.
  void measure_regions(std::size_t slice) {
    std::vector<Label> regions(stack_.area(), 0);
    for (const std::uint32_t p : out_.columns)
      regions[p] = static_cast<Label>(1 + (&source_of(slices_[slice][p]) - sources_.data()));
    std::vector<std::uint32_t> sizes;
    const std::vector<std::uint32_t> ids = label_components({stack_.width, stack_.height, 1}, regions, sizes);
    std::vector<float> depth(sizes.size(), 0);
    std::vector<bool> cut(sizes.size(), false);
    for (const std::uint32_t p : out_.columns) {
      const Source& source = sources_[static_cast<std::size_t>(regions[p] - 1)];
      const float away = static_cast<float>(-distance(source, 2 - slice, p));
      depth[ids[p]] = std::max(depth[ids[p]], away);
      if (away >= far_ && distance(source, 1 + slice, p) >= far_) cut[ids[p]] = true;
    }
    for (const std::uint32_t p : out_.columns) {
      reach_[p] = std::min(reach_[p], depth[ids[p]]);
      if (cut[ids[p]]) out_.flat[p] = true;
    }
  }

  void interpolate(std::uint32_t column) {
    tracks_.clear();
    const double half = 0.5 * stack_.smallest_pixel_mm();
    const double bound = std::max(stack_.step_mm, reach_[column] + half);
    for (const Source& source : sources_) {
      Track track{source.label, {distance(source, 1, column), distance(source, 2, column)}, {}, {}};
      if (is_far(track, 0) && is_far(track, 1)) continue;
      if (track.label == slices_[0][column]) lower_ = tracks_.size();
      if (track.label == slices_[1][column]) upper_ = tracks_.size();
      bound_change(track, bound, half);
      set_slopes(track, source, column, bound);
      tracks_.push_back(track);
    }
    // Neither slice knows the other's label: nothing says how the change comes about.
    if (is_far(tracks_[lower_], 1) && is_far(tracks_[upper_], 0)) out_.flat[column] = true;
    if (out_.flat[column]) {
      out_.candidates.resize(out_.candidates.size() + weights_.count());
      change_half_way(slices_[0][column], slices_[1][column], weights_.count(),
                      out_.candidates.data() + out_.candidates.size() - weights_.count());
      return;
    }
    find_passers();
    for (std::size_t m = 0; m < weights_.count(); ++m) out_.candidates.push_back(decide(m));
  }

  bool is_far(const Track& track, std::size_t slice) const { return track.seen[slice] <= -far_; }

  /// Brings the less telling value, the larger one, within `bound` of the other, on its side of the outline.
  static void bound_change(Track& track, double bound, double half) {
    track.value = track.seen;
    auto& [a, b] = track.value;
    const double change = b - a;
    if (std::abs(change) <= bound) return;
    const double step = change > 0 ? bound : -bound;
    const auto keep_side = [&](double seen, double value) {
      return seen > 0 ? std::max(value, half) : std::min(value, -half);
    };
    if (std::abs(a) == std::abs(b)) {
      a = -step / 2;
      b = step / 2;
    } else if (std::abs(a) > std::abs(b)) {
      a = keep_side(a, b - step);
    } else {
      b = keep_side(b, a + step);
    }
  }

  void set_slopes(Track& track, const Source& source, std::uint32_t column, double bound) const {
    const double change = track.value[1] - track.value[0];
    const bool known = !is_far(track, 0) && !is_far(track, 1);
    for (const std::size_t end : {0, 1}) {
      double slope = change;
      const std::size_t beyond = 3 * end;
      if (known && near_[beyond]) {
        const double outer = distance(source, beyond, column);
        if (outer > -far_) {
          const double held = std::clamp(outer, track.value[end] - bound, track.value[end] + bound);
          slope = end == 0 ? (track.value[1] - held) / 2 : (held - track.value[0]) / 2;
        }
      }
      if (slope * change <= 0)
        slope = 0;
      else if (std::abs(slope) > 3 * std::abs(change))
        slope = 3 * change;
      track.slope[end] = slope;
    }
  }

  /// Labels that may pass between the slices' labels, as indices of tracks.
  void find_passers() {
    passers_.clear();
    const Track &below = tracks_[lower_], &above = tracks_[upper_];
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      const Track& track = tracks_[t];
      if (t == lower_ || t == upper_) continue;
      const auto nearer = [&](const Track& owner, std::size_t slice) {
        return track.seen[slice] > owner.seen[slice] || (is_far(track, slice) && is_far(owner, slice));
      };
      if (nearer(above, 0) && nearer(below, 1) && contacts_.touch(track.label, below.label) &&
          contacts_.touch(track.label, above.label))
        passers_.push_back(t);
    }
    if (!passers_.empty()) return;
    std::size_t before_lower = 0, before_upper = 0;
    for (const Track& track : tracks_) {
      before_lower += track.seen[1] > below.seen[1];
      before_upper += track.seen[0] > above.seen[0];
    }
    if (before_lower <= before_upper) passers_.push_back(lower_);
    if (before_upper <= before_lower) passers_.push_back(upper_);
    std::sort(passers_.begin(), passers_.end());
  }

  Candidate decide(std::size_t m) {
    values_.clear();
    for (const Track& track : tracks_) values_.push_back(weights_.at(track, m));
    std::size_t first = 0;
    for (std::size_t t = 1; t < values_.size(); ++t)
      if (values_[t] > values_[first]) first = t;
    const bool passed = values_[first] < 0;
    if (passed) {
      first = passers_.front();
      for (const std::size_t t : passers_)
        if (values_[t] > values_[first]) first = t;
    }
    std::size_t second = first == 0 ? 1 : 0;
    for (std::size_t t = 0; t < values_.size(); ++t)
      if (t != first && values_[t] > values_[second]) second = t;
    const double margin = passed ? -values_[second] : (values_[first] - values_[second]) / 2;
    return {tracks_[first].label, tracks_[second].label, static_cast<float>(margin)};
  }

  const SliceStack& stack_;
  const Contacts& contacts_;
  const std::array<const SliceDistances*, 4>& near_;
  std::vector<Source> sources_;
  Weights weights_;
  double far_ = 0;
  std::array<const Label*, 2> slices_{};
  std::vector<float> reach_;
  std::vector<Track> tracks_;
  std::size_t lower_ = 0, upper_ = 0;  // the slices' own labels among the tracks
  std::vector<std::size_t> passers_;
  std::vector<double> values_;
  SliceGap out_;
};

}  // namespace

Contacts::Contacts(const SliceStack& stack, int lower) {
  std::vector<std::uint32_t> keys;
  for (int slice = lower; slice < std::min(lower + 2, stack.count); ++slice) {
    const Label* pixels = stack.slice(slice);
    const std::size_t width = static_cast<std::size_t>(stack.width);
    for (std::size_t p = 0; p < stack.area(); ++p) {
      const auto meet = [&](std::size_t other) {
        const std::uint32_t a = pixels[p], b = pixels[other];
        if (a == b) return;
        keys.push_back(a << 16 | b);
        keys.push_back(b << 16 | a);
      };
      if ((p + 1) % width != 0) meet(p + 1);
      if (p + width < stack.area()) meet(p + width);
    }
  }
  std::sort(keys.begin(), keys.end());
  for (const std::uint32_t key : keys) {
    if (counts_.empty() || counts_.back().first != key) counts_.emplace_back(key, 0);
    ++counts_.back().second;
  }
}

std::uint32_t Contacts::count(Label a, Label b) const {
  const std::uint32_t key = static_cast<std::uint32_t>(a) << 16 | b;
  const auto at = std::lower_bound(counts_.begin(), counts_.end(), std::pair{key, 0U});
  return at != counts_.end() && at->first == key ? at->second : 0;
}

std::vector<Label> Contacts::separators(Label a, Label b) const {
  std::vector<std::pair<std::uint32_t, Label>> found;
  const std::uint32_t first = static_cast<std::uint32_t>(a) << 16;
  for (auto at = std::lower_bound(counts_.begin(), counts_.end(), std::pair{first, 0U});
       at != counts_.end() && at->first >> 16 == a; ++at) {
    const Label other = static_cast<Label>(at->first & 0xffffU);
    const std::uint32_t common = std::min(at->second, count(other, b));
    if (common > 0) found.emplace_back(common, other);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  std::vector<Label> labels;
  labels.reserve(found.size());
  for (const auto& [common, label] : found) labels.push_back(label);
  return labels;
}

SliceGap interpolate_gap(const SliceStack& stack, const Contacts& contacts, int lower,
                         const std::array<const SliceDistances*, 4>& near, int planes) {
  return Gap(stack, contacts, lower, near, planes).run();
}

void keep_as_slabs(SliceGap& gap, const SliceStack& stack, const std::vector<bool>& labels) {
  if (gap.columns.empty()) return;
  const std::size_t planes = gap.candidates.size() / gap.columns.size();
  for (std::size_t c = 0; c < gap.columns.size(); ++c) {
    const Label below = stack.slice(gap.lower)[gap.columns[c]],
                above = stack.slice(gap.lower + 1)[gap.columns[c]];
    if (!labels[below] && !labels[above]) continue;
    gap.flat[gap.columns[c]] = true;
    change_half_way(below, above, planes, gap.candidates.data() + c * planes);
  }
}

}  // namespace voxtet::slices
