#include "io/volume/coded/label_stream.h"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <utility>

#include "io/volume/coded/binary_coder.h"

namespace voxtet {
namespace {

/// Voxels of background around the box, so that every neighbour is there.
constexpr int kMargin = 4;
/// The labels around a voxel that are asked for by name, most likely first.
constexpr std::size_t kMostCandidates = 6;
constexpr std::uint8_t kNoCandidate = 7;
/// How far runs of one label are followed.
constexpr int kLongestRun = 6;

/// A neighbour that comes before its voxel.
struct Neighbour {
  std::ptrdiff_t offset;
  double weight;  ///< 1 over the squared distance
};

template <class Coder>
class LabelCoder {
 public:
  LabelCoder(Coder& coder, std::size_t label_count, IndexedLabels& labels)
      : coder_(coder),
        labels_(labels),
        row_(labels.size[0] + 2 * kMargin),
        slice_(static_cast<std::ptrdiff_t>(row_) * (labels.size[1] + 2 * kMargin)),
        known_(static_cast<std::size_t>(slice_) * static_cast<std::size_t>(labels.size[2] + kMargin)),
        neighbours_(neighbours()),
        sure_(IndexedLabels::kMostLabels + 1),
        others_(label_count, 1) {}

  bool run() {
    std::size_t voxel = 0;
    for (int k = 0; k < labels_.size[2]; ++k)
      for (int j = 0; j < labels_.size[1]; ++j) {
        for (int i = 0; i < labels_.size[0]; ++i, ++voxel) {
          place_ = {i, j, k};
          at_ = known_.data() + (i + kMargin) + static_cast<std::ptrdiff_t>(row_) * (j + kMargin) +
                slice_ * (k + kMargin);
          *at_ = labels_.indices[voxel] = code_voxel(labels_.indices[voxel]);
        }
        if constexpr (requires { coder_.past_end(); })
          if (coder_.past_end()) return false;
      }
    return true;
  }

 private:
  /// The nearest first.
  std::vector<Neighbour> neighbours() const {
    constexpr int kReach = 2, kFarthest2 = 6;
    std::vector<Neighbour> out;
    for (int distance2 = 1; distance2 <= kFarthest2; ++distance2)
      for (int k = -kReach; k <= 0; ++k)
        for (int j = -kReach; j <= kReach; ++j)
          for (int i = -kReach; i <= kReach; ++i) {
            const bool before = k < 0 || j < 0 || (j == 0 && i < 0);
            if (before && i * i + j * j + k * k == distance2)
              out.push_back({i + static_cast<std::ptrdiff_t>(row_) * j + slice_ * k, 1.0 / distance2});
          }
    return out;
  }

  std::uint8_t label(int i, int j, int k) const { return at_[i + std::ptrdiff_t{row_} * j + slice_ * k]; }
  std::uint8_t rank(int i, int j, int k) const { return rank_[label(i, j, k)]; }

  std::uint8_t code_voxel(std::uint8_t wanted) {
    const std::uint8_t first = at_[neighbours_.front().offset];
    const bool alike = std::all_of(neighbours_.begin(), neighbours_.end(),
                                   [&](const Neighbour& n) { return at_[n.offset] == first; });
    if (!alike) {
      rank_candidates();
      for (std::size_t c = 0; c < candidates_; ++c)
        if (code_candidate(c, wanted)) return candidate_[c];
      return code_other(wanted);
    }
    ContextCounter& sure = sure_[first];
    const bool same = coder_.code(wanted == first, sure.probability);
    sure.update(same, std::numeric_limits<std::uint16_t>::max());
    if (same) return first;
    candidates_ = 1;
    candidate_[0] = first;
    return code_other(wanted);
  }

  void rank_candidates() {
    for (std::size_t c = 0; c < found_; ++c) vote_[seen_[c]] = 0, rank_[seen_[c]] = kNoCandidate;
    found_ = 0;
    for (const Neighbour& n : neighbours_) {
      const std::uint8_t of = at_[n.offset];
      if (vote_[of] == 0) seen_[found_++] = of;
      vote_[of] += n.weight;
    }
    // Few, and nearly sorted: the label that more of the near voxels have comes first.
    for (std::size_t next = 1; next < found_; ++next)
      for (std::size_t at = next; at > 0 && vote_[seen_[at]] > vote_[seen_[at - 1]]; --at)
        std::swap(seen_[at], seen_[at - 1]);
    candidates_ = std::min(found_, kMostCandidates);
    for (std::size_t c = 0; c < candidates_; ++c) {
      candidate_[c] = seen_[c];
      rank_[seen_[c]] = static_cast<std::uint8_t>(c);
    }
    follow_runs();
  }

  /// How many voxels from one on, at most so many, have its label.
  int run_of(int i, int j, int k, int step_i, int step_j, int most) const {
    const std::uint8_t* start = at_ + i + std::ptrdiff_t{row_} * j + slice_ * k;
    const std::ptrdiff_t step = step_i + std::ptrdiff_t{row_} * step_j;
    int length = 0;
    while (length < most && start[step * (length + 1)] == *start) ++length;
    return length;
  }

  void follow_runs() {
    const int right = std::min(kLongestRun, labels_.size[0] - 1 - place_[0] + kMargin - 1);
    const int down = std::min(kLongestRun, labels_.size[1] - 1 - place_[1] + kMargin - 1);
    runs_ = {run_of(-1, 0, 0, -1, 0, std::min(8, place_[0])),
             run_of(0, -1, 0, 1, 0, right),
             run_of(0, -2, 0, 1, 0, right),
             run_of(0, 0, -1, 1, 0, right),
             run_of(0, 0, -2, 1, 0, right),
             run_of(0, 0, -1, 0, 1, down),
             run_of(0, 0, -2, 0, 1, down)};
  }

  bool code_candidate(std::size_t c, std::uint8_t wanted) {
    const std::uint8_t w = rank(-1, 0, 0), n = rank(0, -1, 0), p = rank(0, 0, -1);
    const std::size_t many = std::min<std::size_t>(candidates_, 4);
    const auto near = [](std::uint8_t of) { return std::min<std::size_t>(of, 4); };
    const double probability =
        model_.predict(contexts(c, w, n, p), {many * 8 + c, 25 * near(w) + 5 * near(n) + near(p)}, c,
                       (many * 8 + c) * 8 + p);
    const bool is = coder_.code(wanted == candidate_[c], probability);
    model_.update(is);
    return is;
  }

  std::array<std::uint32_t, MixedModel::kContexts> contexts(std::size_t c, std::uint32_t w, std::uint32_t n,
                                                            std::uint32_t p) const {
    std::array<std::uint32_t, MixedModel::kContexts> hashes{};
    std::size_t next = 0;
    const auto add = [&](std::initializer_list<std::uint32_t> values) {
      std::uint32_t hash =
          static_cast<std::uint32_t>(next) * 0x9E3779B1U + static_cast<std::uint32_t>(c) * 0x85EBCA6BU + 1;
      for (const std::uint32_t value : values) {
        hash = (hash + value + 1) * 0x2C1B3C6DU;
        hash ^= hash >> 15U;
        hash *= 0x297A2D39U;
        hash ^= hash >> 13U;
      }
      hashes[next++] = hash;
    };
    const auto at = [&](int i, int j, int k) -> std::uint32_t { return rank(i, j, k); };
    const std::uint32_t first = candidate_[0];
    const std::uint32_t second = candidates_ > 1 ? candidate_[1] : IndexedLabels::kMostLabels + 1;
    const std::uint32_t third = candidates_ > 2 ? candidate_[2] : IndexedLabels::kMostLabels + 1;
    const auto run = [&](std::size_t which) { return static_cast<std::uint32_t>(runs_[which]); };
    // What is near, with the labels that it is about.
    add({w, n, p, at(-1, -1, 0), at(1, -1, 0), at(1, 0, -1), at(0, 1, -1), at(-2, 0, 0), at(0, -2, 0),
         at(0, 0, -2), first, second});
    // Two slices before.
    add({p, at(-1, 0, -1), at(1, 0, -1), at(0, -1, -1), at(0, 1, -1), at(0, 0, -2), at(1, 0, -2),
         at(0, 1, -2), at(-1, 0, -2), at(0, -1, -2), w, n});
    // How boundaries go on from row to row,
    add({w, n, run(1), run(2), at(-1, -1, 0), at(0, -2, 0), run(0) / 2});
    // and from slice to slice.
    add({p, at(0, 0, -2), run(3), run(4), run(5), run(6), w});
    // The slice itself.
    add({w, n, at(1, -1, 0), at(-1, -1, 0), at(2, -1, 0), at(1, -2, 0), at(-1, -2, 0), at(0, -2, 0),
         at(-2, 0, 0), at(-2, -1, 0), p});
    add({first, second, third, p, w, n});
    // All.
    std::uint32_t all = 0;
    for (const Neighbour& near : neighbours_) all = all * 0x9E3779B1U + rank_[at_[near.offset]];
    add({all});
    double left = 0;
    for (std::size_t other = c; other < candidates_; ++other) left += vote_[candidate_[other]];
    add({static_cast<std::uint32_t>(32 * vote_[candidate_[c]] / left), candidate_[c], second});
    return hashes;
  }

  /// A label that is none of the candidates, by how often each was needed.
  std::uint8_t code_other(std::uint8_t wanted) {
    const auto is_candidate = [&](std::size_t label) {
      return std::find(candidate_.begin(), candidate_.begin() + static_cast<std::ptrdiff_t>(candidates_),
                       label) != candidate_.begin() + static_cast<std::ptrdiff_t>(candidates_);
    };
    double total = 0;
    std::size_t last = 0;
    for (std::size_t label = 0; label < others_.size(); ++label)
      if (!is_candidate(label)) {
        total += others_[label];
        last = label;
      }
    for (std::size_t label = 0; label < last; ++label) {
      if (is_candidate(label)) continue;
      if (coder_.code(wanted == label, others_[label] / total)) {
        last = label;
        break;
      }
      total -= others_[label];
    }
    others_[last] += 4;
    return static_cast<std::uint8_t>(last);
  }

  Coder& coder_;
  IndexedLabels& labels_;
  const int row_;
  const std::ptrdiff_t slice_;
  std::vector<std::uint8_t> known_;  ///< the labels so far, with a margin
  const std::vector<Neighbour> neighbours_;
  MixedModel model_;
  std::vector<ContextCounter> sure_;  ///< by label: all neighbours have it
  std::vector<double> others_;        ///< by label
  std::array<int, 3> place_{};
  std::uint8_t* at_ = nullptr;  ///< the voxel that is coded
  std::array<double, 256> vote_{};
  std::array<std::uint8_t, 256> rank_ = [] {
    std::array<std::uint8_t, 256> none{};
    none.fill(kNoCandidate);
    return none;
  }();
  std::array<std::uint8_t, 256> seen_{};
  std::array<std::uint8_t, kMostCandidates> candidate_{};
  std::array<int, 7> runs_{};
  std::size_t found_ = 0, candidates_ = 0;
};

}  // namespace

template <class Coder>
bool code_labels(Coder& coder, std::size_t label_count, IndexedLabels& labels) {
  return LabelCoder<Coder>(coder, label_count, labels).run();
}

template bool code_labels(BinaryEncoder&, std::size_t, IndexedLabels&);
template bool code_labels(BinaryDecoder&, std::size_t, IndexedLabels&);

}  // namespace voxtet
