#include "geometry/topology/label_topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <span>

#include "base/buckets.h"
#include "base/union_find.h"
#include "geometry/elements/edge_turn.h"

namespace voxtet {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// The complex as the labels see it. A sheet is one side of a triangle: 2 t for the label behind triangle t,
/// 2 t + 1 for the one in front; its corners run so that its normal points out of the label. Half-edge
/// 3 sheet + i goes from the sheet's corner i to the next.
class Sheets {
 public:
  explicit Sheets(const SurfaceMesh& surface)
      : surface_(surface),
        mates_(6 * surface.triangles.size(), kNone),
        shells_(2 * surface.sides.size()),
        labels_(65536) {
    for_edges([&](std::uint32_t low, std::span<const Crossing> around) { pair_around(low, around); });
    trace_fans();
  }

  std::vector<LabelTopology> count() {
    count_shells();
    count_pinches();
    std::vector<LabelTopology> out;
    for (std::size_t label = kBackground + 1; label < labels_.size(); ++label) {
      LabelTopology& t = labels_[label];
      if (t.components + t.cavities == 0) continue;
      t.label = static_cast<Label>(label);
      t.euler = 2 * (static_cast<int>(t.components + t.cavities) - static_cast<int>(t.handles));
      out.push_back(t);
    }
    return out;
  }

 private:
  struct Crossing {
    std::uint32_t high, side;  ///< of an edge: its other end, and 3 t + i for the side i of triangle t
  };
  struct LabelHalf {
    Label label;
    std::uint32_t half;
  };
  struct Fan {
    std::uint32_t point, sheet;
  };

  Label label_of(std::uint32_t sheet) const { return surface_.sides[sheet / 2][sheet % 2]; }
  std::uint32_t origin_of(std::uint32_t half) const {
    const std::uint32_t sheet = half / 3, corner = half % 3;
    return surface_.triangles[sheet / 2][sheet % 2 == 0 ? corner : (3 - corner) % 3];
  }
  static std::uint32_t next(std::uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }

  /// visit(low end, the sides that the triangles have on the edge), edge by edge.
  template <class Visit>
  void for_edges(const Visit& visit) const {
    Buckets<Crossing> buckets(surface_.points.size());
    const auto each = [&](const auto& use) {
      for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t)
        for (std::uint32_t i = 0; i < 3; ++i) {
          const std::uint32_t a = surface_.triangles[t][i], b = surface_.triangles[t][(i + 1) % 3];
          use(std::min(a, b), Crossing{std::max(a, b), 3 * t + i});
        }
    };
    each([&](std::uint32_t low, const Crossing&) { buckets.count(low); });
    buckets.allocate();
    each([&](std::uint32_t low, const Crossing& c) { buckets.add(low, c); });
    for (std::uint32_t low = 0; low < buckets.size(); ++low) {
      const std::span<Crossing> all = buckets.at(low);
      std::sort(all.begin(), all.end(), [](const Crossing& a, const Crossing& b) {
        return a.high != b.high ? a.high < b.high : a.side < b.side;
      });
      for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
        while (last < all.size() && all[last].high == all[first].high) ++last;
        visit(low, std::span<const Crossing>(all).subspan(first, last - first));
      }
    }
  }

  void mate(std::uint32_t a, std::uint32_t b) {
    mates_[a] = b;
    mates_[b] = a;
    shells_.join(a / 3, b / 3);
  }

  /// Mates the half-edges of each label on one edge.
  void pair_around(std::uint32_t low, std::span<const Crossing> around) {
    halves_.clear();
    for (const Crossing& c : around)
      for (std::uint32_t s = 0; s < 2; ++s) {
        const std::uint32_t sheet = 2 * (c.side / 3) + s, i = c.side % 3;
        if (const Label label = label_of(sheet); label != kBackground)
          halves_.push_back({label, 3 * sheet + (s == 0 ? i : 2 - i)});
      }
    std::sort(halves_.begin(), halves_.end(), [](const LabelHalf& a, const LabelHalf& b) {
      return a.label != b.label ? a.label < b.label : a.half < b.half;
    });
    for (std::size_t first = 0, last = 0; first < halves_.size(); first = last) {
      while (last < halves_.size() && halves_[last].label == halves_[first].label) ++last;
      const auto own = std::span<const LabelHalf>(halves_).subspan(first, last - first);
      labels_[own[0].label].open_edges += own.size() % 2;
      if (own.size() == 2) mate(own[0].half, own[1].half);
      if (own.size() > 2) pair_wedges(low, around[0].high, own);
    }
  }

  /// Mates the half-edges that bound the same wedge of the label: in the order of turning about the edge, one
  /// that opens a wedge with the one that closes it.
  void pair_wedges(std::uint32_t low, std::uint32_t high, std::span<const LabelHalf> own) {
    struct Blade {
      double turn;
      std::uint32_t half;
      bool opens;
    };
    const auto apex = [&](std::uint32_t half) -> const Eigen::Vector3d& {
      return surface_.points[origin_of(next(next(half)))];
    };
    const EdgeTurn turn(surface_.points[low], surface_.points[high], apex(own[0].half));
    std::vector<Blade> blades;
    for (const LabelHalf& h : own) {
      blades.push_back({turn(apex(h.half)), h.half, origin_of(h.half) == high});
      pinched_.push_back({h.label, h.half});
    }
    ends_.push_back(pinched_.size());
    std::sort(blades.begin(), blades.end(), [](const Blade& a, const Blade& b) {
      return a.turn != b.turn ? a.turn < b.turn : a.half < b.half;
    });
    std::vector<std::uint32_t> open;
    for (const bool first_turn : {true, false})
      for (const Blade& blade : blades) {
        if (blade.opens && first_turn) open.push_back(blade.half);
        if (blade.opens || open.empty() || mates_[blade.half] != kNone) continue;
        mate(open.back(), blade.half);
        open.pop_back();
      }
  }

  /// Numbers the rings of corners around points that mated half-edges connect.
  void trace_fans() {
    fan_of_.assign(mates_.size(), kNone);
    for (std::uint32_t half = 0; half < mates_.size(); ++half) {
      if (fan_of_[half] != kNone || label_of(half / 3) == kBackground) continue;
      for (std::uint32_t at = half; at != kNone && fan_of_[at] == kNone;
           at = mates_[at] == kNone ? kNone : next(mates_[at]))
        fan_of_[at] = static_cast<std::uint32_t>(fans_.size());
      fans_.push_back({origin_of(half), half / 3});
    }
  }

  void count_shells() {
    struct Shell {
      std::int64_t points = 0, triangles = 0;
      double sixfold_mm3 = 0;
    };
    std::vector<std::uint32_t> shell_of(shells_.size(), kNone), roots;
    std::vector<Shell> shells;
    for (std::uint32_t sheet = 0; sheet < shell_of.size(); ++sheet) {
      if (label_of(sheet) == kBackground) continue;
      const std::uint32_t root = shells_.find(sheet);
      if (root == sheet) {
        shell_of[sheet] = static_cast<std::uint32_t>(shells.size());
        shells.emplace_back();
        roots.push_back(root);
      }
      Shell& shell = shells[shell_of[sheet] = shell_of[root]];
      ++shell.triangles;
      // From a point of the shell itself: a far origin would cancel the digits of a small one.
      const Eigen::Vector3d& origin = surface_.points[surface_.triangles[root / 2][0]];
      const Eigen::Vector3d a = surface_.points[origin_of(3 * sheet)] - origin,
                            b = surface_.points[origin_of(3 * sheet + 1)] - origin,
                            c = surface_.points[origin_of(3 * sheet + 2)] - origin;
      shell.sixfold_mm3 += a.dot(b.cross(c));
    }
    for (const Fan& fan : fans_) ++shells[shell_of[fan.sheet]].points;
    for (std::size_t i = 0; i < shells.size(); ++i) {
      LabelTopology& label = labels_[label_of(roots[i])];
      ++(shells[i].sixfold_mm3 < 0 ? label.cavities : label.components);
      const std::int64_t euler = shells[i].points - shells[i].triangles / 2;
      label.handles += static_cast<std::uint32_t>(std::max<std::int64_t>(0, 1 - euler / 2));
    }
  }

  void count_pinches() {
    // Fans that hold the same pinched edge count as one.
    UnionFind touching(fans_.size());
    std::size_t first = 0;
    for (const std::size_t last : ends_) {
      const std::uint32_t start = origin_of(pinched_[first].half);
      const auto fan_at = [&](std::uint32_t half, bool at_start) {
        return fan_of_[(origin_of(half) == start) == at_start ? half : next(half)];
      };
      for (std::size_t i = first; i < last; ++i)
        for (const bool at_start : {true, false})
          touching.join(fan_at(pinched_[first].half, at_start), fan_at(pinched_[i].half, at_start));
      ++labels_[pinched_[first].label].pinched_edges;
      first = last;
    }
    Buckets<Label> at_point(surface_.points.size());
    const auto each = [&](const auto& use) {
      for (std::uint32_t fan = 0; fan < fans_.size(); ++fan)
        if (touching.find(fan) == fan) use(fans_[fan]);
    };
    each([&](const Fan& fan) { at_point.count(fan.point); });
    at_point.allocate();
    each([&](const Fan& fan) { at_point.add(fan.point, label_of(fan.sheet)); });
    for (std::size_t p = 0; p < at_point.size(); ++p) {
      const std::span<Label> labels = at_point.at(p);
      std::sort(labels.begin(), labels.end());
      for (std::size_t i = 1; i < labels.size(); ++i)
        if (labels[i] == labels[i - 1] && (i == 1 || labels[i] != labels[i - 2]))
          ++labels_[labels[i]].pinched_points;
    }
  }

  const SurfaceMesh& surface_;
  std::vector<std::uint32_t> mates_;   ///< of each half-edge, across its edge on the same shell
  UnionFind shells_;                   ///< of sheets
  std::vector<std::uint32_t> fan_of_;  ///< of the corner that each half-edge starts from
  std::vector<Fan> fans_;
  std::vector<LabelHalf> halves_;      ///< of the edge at hand
  std::vector<LabelHalf> pinched_;     ///< half-edges of pinched edges, edge by edge
  std::vector<std::size_t> ends_;      ///< of each pinched edge in pinched_
  std::vector<LabelTopology> labels_;  ///< by label
};

std::vector<std::array<Label, 2>> contacts_of(const SurfaceMesh& surface) {
  std::set<std::array<Label, 2>> contacts;
  Sides last{};
  for (const Sides& sides : surface.sides) {
    if (sides != last) contacts.insert({std::min(sides[0], sides[1]), std::max(sides[0], sides[1])});
    last = sides;
  }
  return {contacts.begin(), contacts.end()};
}

}  // namespace

TopologyLedger label_topology(const SurfaceMesh& surface) {
  return {Sheets(surface).count(), contacts_of(surface)};
}

}  // namespace voxtet
