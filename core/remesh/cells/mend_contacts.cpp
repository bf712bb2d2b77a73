#include "remesh/cells/mend_contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "remesh/cells/cell_stars.h"

namespace voxtet::remesh {
namespace {

using Cells = CellStars::Cells;

/// For one contact. What succeeded in real and generated volumes took up to 673 tries; among rough voxels a
/// contact of many facets may have a hundred thousand, all in vain.
constexpr int kMostChanges = 60, kMostTries = 1000;

Contact contact_of(Label a, Label b) {
  return {std::min(a, b), std::max(a, b)};
}

bool contains(const Cells& sorted, std::uint32_t value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

class ContactMender {
 public:
  ContactMender(LabelledCells& cells, const std::vector<Contact>& wanted, double reach_mm,
                const RunContext& ctx)
      : cells_(cells), wanted_(wanted), reach_mm_(reach_mm), ctx_(ctx), stars_(cells), population_(65536, 0) {
    for (std::uint32_t c = 0; c < cells.labels.size(); ++c) {
      ++population_[cells.labels[c]];
      for (const std::uint32_t n : cells.neighbours[c])
        if (n != LabelledCells::kNone && n > c && cells.labels[n] != cells.labels[c])
          ++facets_[contact_of(cells.labels[c], cells.labels[n])];
    }
  }

  std::vector<Contact> unwanted() const {
    std::vector<Contact> out;
    for (const auto& [contact, facets] : facets_)
      if (facets > 0 && !is_wanted(contact)) out.push_back(contact);
    return out;
  }

  std::size_t join(const LostContact& lost) {
    const Cells near = cells_around(lost.places);
    tries_ = 0;
    for (const bool forward : {true, false}) {
      const Label from = lost.labels[forward ? 0 : 1], to = lost.labels[forward ? 1 : 0];
      done_.clear();
      for (int change = 0; change < kMostChanges && !touch(lost.labels); ++change)
        if (!grow(from, to, near)) break;
      if (touch(lost.labels)) return done_.size();
      undo();
    }
    return 0;
  }

  std::size_t part(const Contact& contact) {
    done_.clear();
    tries_ = 0;
    const Cells near = cells_at(contact);
    for (int change = 0; change < kMostChanges && touch(contact); ++change)
      if (!shrink(contact, near)) break;
    if (!touch(contact)) return done_.size();
    undo();
    return 0;
  }

 private:
  struct Change {
    std::uint32_t cell;
    Label before;
  };

  /// Whether there may be another try for the contact at hand.
  bool may_try() {
    constexpr int kTriesPerQuestion = 64;
    cancelled_ = cancelled_ || (tries_ % kTriesPerQuestion == 0 && ctx_.cancelled());
    return !cancelled_ && tries_++ < kMostTries;
  }
  bool is_wanted(const Contact& contact) const {
    return std::binary_search(wanted_.begin(), wanted_.end(), contact);
  }
  bool touch(const Contact& contact) const {
    const auto found = facets_.find(contact);
    return found != facets_.end() && found->second > 0;
  }

  /// Cells within reach of some points, and those that share a point with them; ascending.
  Cells cells_around(const std::vector<Eigen::Vector3d>& places) const {
    Eigen::AlignedBox3d all;
    for (const Eigen::Vector3d& place : places) all.extend(place);
    Cells near;
    for (std::uint32_t c = 0; c < cells_.vertices.size(); ++c) {
      Eigen::AlignedBox3d box;
      for (const std::uint32_t p : cells_.vertices[c]) box.extend(cells_.points[p]);
      const auto is_near = [&](const auto& place) {
        return box.squaredExteriorDistance(place) < reach_mm_ * reach_mm_;
      };
      if (is_near(all) && std::any_of(places.begin(), places.end(), is_near)) near.push_back(c);
    }
    return with_neighbours(near);
  }

  /// Cells at the facets of a contact, and those that share a point with them; ascending.
  Cells cells_at(const Contact& contact) const {
    Cells near;
    for (std::uint32_t c = 0; c < cells_.vertices.size(); ++c)
      for (const std::uint32_t n : cells_.neighbours[c])
        if (n != LabelledCells::kNone && contact_of(cells_.labels[c], cells_.labels[n]) == contact)
          near.push_back(c);
    return with_neighbours(near);
  }

  Cells with_neighbours(const Cells& cells) const {
    Cells out;
    for (const std::uint32_t p : stars_.points_of(cells)) {
      const auto around = stars_.around(p);
      out.insert(out.end(), around.begin(), around.end());
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  /// Groups of cells of one label that are worth a try: a cell; with one neighbour; with those around one of
  /// its edges.
  std::vector<Cells> groups_with(std::uint32_t cell) const {
    const Label label = cells_.labels[cell];
    std::vector<Cells> groups{{cell}};
    for (const std::uint32_t n : cells_.neighbours[cell])
      if (n != LabelledCells::kNone && cells_.labels[n] == label)
        groups.push_back({std::min(cell, n), std::max(cell, n)});
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        Cells ring;
        for (const std::uint32_t c : cells_at_edge(cells_.vertices[cell][i], cells_.vertices[cell][j]))
          if (cells_.labels[c] == label) ring.push_back(c);
        if (ring.size() > 2) groups.push_back(std::move(ring));
      }
    return groups;
  }

  Cells cells_at_edge(std::uint32_t p, std::uint32_t q) const {
    const auto a = stars_.around(p), b = stars_.around(q);
    Cells both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
  }

  /// Lets one label grow by what brings it nearest to the other.
  bool grow(Label from, Label to, const Cells& near) {
    const std::vector<int> steps = steps_to(to, from, near);
    std::vector<std::pair<int, std::uint32_t>> candidates;
    for (std::size_t i = 0; i < near.size(); ++i) {
      const Label label = cells_.labels[near[i]];
      if (label == from || label == to || steps[i] < 0) continue;
      const auto& around = cells_.neighbours[near[i]];
      if (std::any_of(around.begin(), around.end(),
                      [&](std::uint32_t n) { return n != LabelledCells::kNone && cells_.labels[n] == from; }))
        candidates.push_back({steps[i], near[i]});
    }
    std::sort(candidates.begin(), candidates.end());
    for (const auto& [step, cell] : candidates)
      for (const Cells& group : groups_with(cell)) {
        if (!may_try()) return false;
        if (change(group, from)) return true;
      }
    return false;
  }

  /// By cell of `near`, how many cells there are to one of a label, without crossing the other; -1: no way.
  std::vector<int> steps_to(Label label, Label other, const Cells& near) const {
    std::vector<int> steps(near.size(), -1);
    std::vector<std::size_t> queue;
    for (std::size_t i = 0; i < near.size(); ++i)
      if (cells_.labels[near[i]] == label) {
        steps[i] = 0;
        queue.push_back(i);
      }
    for (std::size_t at = 0; at < queue.size(); ++at)
      for (const std::uint32_t n : cells_.neighbours[near[queue[at]]]) {
        const auto found = std::lower_bound(near.begin(), near.end(), n);
        if (found == near.end() || *found != n || cells_.labels[n] == other) continue;
        const auto i = static_cast<std::size_t>(found - near.begin());
        if (steps[i] >= 0) continue;
        steps[i] = steps[queue[at]] + 1;
        queue.push_back(i);
      }
    return steps;
  }

  /// Takes facets of a contact away.
  bool shrink(const Contact& contact, const Cells& near) {
    const int before = facets_[contact];
    for (const std::uint32_t cell : near) {
      const Label label = cells_.labels[cell];
      if (label != contact[0] && label != contact[1]) continue;
      const Label other = contact[label == contact[0] ? 1 : 0];
      const auto& around = cells_.neighbours[cell];
      if (std::none_of(around.begin(), around.end(), [&](std::uint32_t n) {
            return n != LabelledCells::kNone && cells_.labels[n] == other;
          }))
        continue;
      std::vector<Label> labels;
      for (const std::uint32_t p : cells_.vertices[cell])
        for (const Label l : stars_.labels_at(p))
          if (l != contact[0] && l != contact[1]) labels.push_back(l);
      std::sort(labels.begin(), labels.end());
      labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
      for (const Cells& group : groups_with(cell))
        for (const Label to : labels) {
          if (!may_try()) return false;
          const std::size_t known = done_.size();
          if (!change(group, to)) continue;
          if (facets_[contact] < before) return true;
          undo(known);
        }
    }
    return false;
  }

  /// Gives a group, ascending and of one label, another label, if that keeps all topology.
  bool change(const Cells& group, Label to) {
    const Label from = cells_.labels[group.front()];
    if (population_[from] <= group.size()) return false;
    const Cells points = stars_.points_of(group);
    const std::array<int, 2> euler{euler_around(group, points, from), euler_around(group, points, to)};
    const std::size_t defects = stars_.defects(points);
    const std::size_t known = done_.size();
    std::map<Contact, int> counts;
    count_facets(group, -1, counts);
    set_labels(group, to);
    count_facets(group, 1, counts);
    bool kept = euler[0] == euler_around(group, points, from) && euler[1] == euler_around(group, points, to);
    for (const auto& [contact, more] : counts) {
      const auto found = facets_.find(contact);
      const int before = found == facets_.end() ? 0 : found->second;
      if ((before > 0) != (before + more > 0) && (before > 0) == is_wanted(contact)) kept = false;
    }
    kept = kept && stars_.defects(points) <= defects;
    for (const auto& [contact, more] : counts) facets_[contact] += more;
    if (!kept) undo(known);
    return kept;
  }

  void set_labels(const Cells& group, Label to) {
    for (const std::uint32_t c : group) {
      done_.push_back({c, cells_.labels[c]});
      --population_[cells_.labels[c]];
      ++population_[to];
      cells_.labels[c] = to;
    }
  }

  /// Back to the first so many changes.
  void undo(std::size_t known = 0) {
    while (done_.size() > known) {
      const auto [cell, before] = done_.back();
      done_.pop_back();
      std::map<Contact, int> counts;
      count_facets({cell}, -1, counts);
      --population_[cells_.labels[cell]];
      ++population_[before];
      cells_.labels[cell] = before;
      count_facets({cell}, 1, counts);
      for (const auto& [contact, more] : counts) facets_[contact] += more;
    }
  }

  /// Adds the facets of a group, each once.
  void count_facets(const Cells& group, int weight, std::map<Contact, int>& counts) const {
    for (const std::uint32_t c : group)
      for (const std::uint32_t n : cells_.neighbours[c])
        if (n != LabelledCells::kNone && !(n < c && contains(group, n)) &&
            cells_.labels[n] != cells_.labels[c])
          counts[contact_of(cells_.labels[c], cells_.labels[n])] += weight;
  }

  /// Of the points, edges and facets of a group that are on the boundary of a label: V - E + F.
  int euler_around(const Cells& group, const Cells& points, Label label) const {
    const auto is_boundary = [&](const auto& around) {
      bool inside = false, outside = false;
      for (const std::uint32_t c : around) (cells_.labels[c] == label ? inside : outside) = true;
      return inside && outside;
    };
    int euler = 0;
    for (const std::uint32_t p : points) euler += is_boundary(stars_.around(p));
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const std::uint32_t c : group) {
      const auto& v = cells_.vertices[c];
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) edges.push_back({std::min(v[i], v[j]), std::max(v[i], v[j])});
        const std::uint32_t n = cells_.neighbours[c][i];
        if (n < c && contains(group, n)) continue;
        euler += (cells_.labels[c] == label) != (cells_.label_or_background(n) == label);
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [p, q] : edges) euler -= is_boundary(cells_at_edge(p, q));
    return euler;
  }

  LabelledCells& cells_;
  const std::vector<Contact>& wanted_;
  const double reach_mm_;
  const RunContext& ctx_;
  const CellStars stars_;
  std::vector<std::uint64_t> population_;
  std::map<Contact, int> facets_;  ///< how many a contact has
  std::vector<Change> done_;       ///< for the contact at hand
  int tries_ = 0;                  ///< the same
  bool cancelled_ = false;
};

}  // namespace

std::size_t mend_contacts(LabelledCells& cells, const std::vector<Contact>& wanted,
                          const std::vector<LostContact>& lost, double reach_mm, const RunContext& ctx) {
  ContactMender mender(cells, wanted, reach_mm, ctx);
  std::size_t changed = 0;
  for (const Contact& contact : mender.unwanted()) changed += mender.part(contact);
  for (const LostContact& contact : lost) changed += mender.join(contact);
  return changed;
}

}  // namespace voxtet::remesh
