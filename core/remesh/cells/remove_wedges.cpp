#include "remesh/cells/remove_wedges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "remesh/cells/cell_stars.h"
#include "remesh/cells/interface_edges.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

constexpr int kRelabelRounds = 8;
constexpr double kExtraSectorCost = 0.02;
// Angles are compared by their cosines and chords 2 sin(angle/2), nearly linear in the angle: square roots
// are exact on every platform, arc functions are not.
constexpr double kSharpCosine = 0.8910065241883679;  // cos 27 deg
constexpr double kSharpChord = 0.4668907277118108;   // of 27 deg
constexpr double kPlanarChord = 0.4838437911993355;  // of 28 deg

double chord_deficit(double cosine, double limit) {
  const double chord = std::sqrt(std::max(0.0, 2 - 2 * cosine));
  const double deficit = std::max(0.0, (limit - chord) / limit);
  return deficit * deficit;
}

struct EdgeOfCell {
  std::uint32_t cell, a, b;  ///< a, b: points
};

/// A run of cells of one label around an edge.
struct Sector {
  Label label;
  std::size_t first, count;  ///< into the ring, cyclic
  double cosine;             ///< of its angle; -1 where it is not sharp
};

class Relabeller {
 public:
  explicit Relabeller(LabelledCells& cells) : cells_(cells), stars_(cells), population_(65536, 0) {
    for (const Label label : cells.labels) ++population_[label];
  }

  void run() {
    std::vector<EdgeOfCell> work = sharp_edges();
    for (int round = 0; round < kRelabelRounds && !work.empty(); ++round) {
      changed_.clear();
      for (const EdgeOfCell& edge : work) improve(edge);
      work.clear();
      for (const std::uint32_t cell : changed_)
        for (std::uint32_t i = 0; i < 4; ++i)
          for (std::uint32_t j = i + 1; j < 4; ++j)
            work.push_back({cell, cells_.vertices[cell][i], cells_.vertices[cell][j]});
    }
  }

 private:
  struct RingCell {
    std::uint32_t cell;
    double cosine, sine;  ///< of the cell's dihedral angle at the edge
  };

  std::size_t corner_of(std::uint32_t cell, std::uint32_t point) const {
    const auto& v = cells_.vertices[cell];
    return static_cast<std::size_t>(std::find(v.begin(), v.end(), point) - v.begin());
  }

  /// The cells around an edge in order; empty where the hull is reached.
  void walk_ring(const EdgeOfCell& edge, std::vector<RingCell>& ring) const {
    ring.clear();
    const Vector3d& a = cells_.points[edge.a];
    const Vector3d axis = (cells_.points[edge.b] - a).normalized();
    const auto away = [&](std::uint32_t point) {
      const Vector3d d = cells_.points[point] - a;
      return Vector3d((d - d.dot(axis) * axis).normalized());
    };
    std::uint32_t cell = edge.cell, from = LabelledCells::kNone;
    do {
      const auto& v = cells_.vertices[cell];
      std::uint32_t x = from, y = LabelledCells::kNone;
      for (const std::uint32_t p : v) {
        if (p == edge.a || p == edge.b || p == from) continue;
        if (x == LabelledCells::kNone) {
          x = p;
        } else {
          y = p;
        }
      }
      const Vector3d u = away(x), w = away(y);
      ring.push_back({cell, u.dot(w), u.cross(w).norm()});
      cell = cells_.neighbours[cell][corner_of(cell, x)];
      from = y;
      if (cell == LabelledCells::kNone) {
        ring.clear();
        return;
      }
    } while (cell != edge.cell);
  }

  void find_sectors(const std::vector<RingCell>& ring, std::vector<Sector>& sectors) const {
    sectors.clear();
    const std::size_t n = ring.size();
    const auto label = [&](std::size_t i) { return cells_.labels[ring[i % n].cell]; };
    std::size_t start = 0;
    while (start < n && label(start) == label(start + n - 1)) ++start;
    if (start == n) return;
    for (std::size_t i = start; i < start + n;) {
      Sector sector{label(i), i % n, 0, 1};
      double cosine = 1, sine = 0;
      bool sharp = true;
      for (; i < start + n && label(i) == sector.label; ++i, ++sector.count) {
        const RingCell& r = ring[i % n];
        const double c = cosine * r.cosine - sine * r.sine;
        sine = sine * r.cosine + cosine * r.sine;
        cosine = c;
        // Up to 27 degrees plus one cell of less than 180: the cosine still tells.
        sharp = sharp && cosine > kSharpCosine;
      }
      sector.cosine = sharp ? cosine : -1;
      sectors.push_back(sector);
    }
  }

  double facet_deficit(std::uint32_t cell, std::size_t corner) const {
    std::array<Vector3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = cells_.points[cells_.vertices[cell][kFacetCorners[corner][k]]];
    double cosine = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d u = p[(k + 1) % 3] - p[k], w = p[(k + 2) % 3] - p[k];
      cosine = std::max(cosine, u.dot(w) / std::sqrt(u.squaredNorm() * w.squaredNorm()));
    }
    return chord_deficit(cosine, kPlanarChord);
  }

  /// Cost of the interface at the edges and facets of some cells.
  double local_cost(const std::vector<std::uint32_t>& touched) {
    double cost = 0;
    edges_.clear();
    for (const std::uint32_t cell : touched) {
      const auto& v = cells_.vertices[cell];
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t other = cells_.neighbours[cell][i];
        const bool twice = std::find(touched.begin(), touched.end(), other) != touched.end() && other < cell;
        if (!twice && cells_.labels[cell] != cells_.label_or_background(other))
          cost += facet_deficit(cell, i);
        for (std::size_t j = i + 1; j < 4; ++j)
          edges_.push_back({cell, std::min(v[i], v[j]), std::max(v[i], v[j])});
      }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto same = [&](const EdgeOfCell& x) { return x.a == edges_[e].a && x.b == edges_[e].b; };
      if (std::any_of(edges_.begin(), edges_.begin() + static_cast<std::ptrdiff_t>(e), same)) continue;
      walk_ring(edges_[e], cost_ring_);
      find_sectors(cost_ring_, cost_sectors_);
      for (const Sector& s : cost_sectors_)
        if (s.cosine > -1) cost += chord_deficit(s.cosine, kSharpChord);
      if (cost_sectors_.size() > 2) cost += kExtraSectorCost * static_cast<double>(cost_sectors_.size() - 2);
    }
    return cost;
  }

  void set_label(std::uint32_t cell, Label label) {
    --population_[cells_.labels[cell]];
    ++population_[label];
    cells_.labels[cell] = label;
  }

  /// Edges at which two interface facets stand at less than kSharpSectorDeg.
  std::vector<EdgeOfCell> sharp_edges() const {
    const InterfaceEdges edges = find_interface_edges(cells_);
    std::vector<EdgeOfCell> out;
    std::vector<Vector3d> away;
    for (std::size_t e = 0; e < edges.ends.size(); ++e) {
      const Vector3d& a = cells_.points[edges.ends[e][0]];
      const Vector3d axis = cells_.points[edges.ends[e][1]] - a;
      away.clear();
      bool sharp = false;
      for (std::uint32_t k = edges.start[e]; k < edges.start[e + 1]; ++k) {
        const InterfaceFacet& facet = edges.facets[edges.facet_of[k]];
        for (std::size_t c = 0; c < 3; ++c) {
          const std::uint32_t p = cells_.vertices[facet.cell][kFacetCorners[facet.corner][c]];
          if (p == edges.ends[e][0] || p == edges.ends[e][1]) continue;
          const Vector3d d = cells_.points[p] - a;
          away.push_back(d - d.dot(axis) / axis.squaredNorm() * axis);
        }
        for (std::size_t o = 0; o + 1 < away.size(); ++o) {
          const double dot = away[o].dot(away.back());
          sharp = sharp || (dot > 0 && dot * dot > kSharpCosine * kSharpCosine * away[o].squaredNorm() *
                                                       away.back().squaredNorm());
        }
      }
      if (sharp)
        out.push_back(
            {edges.facets[edges.facet_of[edges.start[e]]].cell, edges.ends[e][0], edges.ends[e][1]});
    }
    return out;
  }

  /// Gives `run` to `label` if that lowers the cost more than the best option so far.
  void try_option(const std::vector<std::uint32_t>& run, Label label, double& best_gain,
                  std::vector<std::uint32_t>& best_run, Label& best_label) {
    const Label old = cells_.labels[run.front()];
    if (old == label || population_[old] <= run.size()) return;
    const std::vector<std::uint32_t> points = stars_.points_of(run);
    const double before = local_cost(run);
    const std::size_t defects = stars_.defects(points);
    for (const std::uint32_t c : run) cells_.labels[c] = label;
    const double gain = before - local_cost(run);
    const bool manifold = gain > best_gain + 1e-9 && stars_.defects(points) <= defects;
    for (const std::uint32_t c : run) cells_.labels[c] = old;
    if (manifold) {
      best_gain = gain;
      best_run = run;
      best_label = label;
    }
  }

  void improve(const EdgeOfCell& edge) {
    walk_ring(edge, ring_);
    find_sectors(ring_, sectors_);
    const std::size_t n = ring_.size();
    for (const Sector& sector : sectors_) {
      if (sector.cosine <= -1) continue;
      std::vector<std::uint32_t> run, best_run;
      for (std::size_t i = 0; i < sector.count; ++i) run.push_back(ring_[(sector.first + i) % n].cell);
      const std::uint32_t before = ring_[(sector.first + n - 1) % n].cell;
      const std::uint32_t after = ring_[(sector.first + sector.count) % n].cell;
      double gain = 0;
      Label label = kBackground;
      try_option(run, cells_.labels[before], gain, best_run, label);
      try_option(run, cells_.labels[after], gain, best_run, label);
      try_option({before}, sector.label, gain, best_run, label);
      try_option({after}, sector.label, gain, best_run, label);
      if (best_run.empty()) continue;
      for (const std::uint32_t c : best_run) set_label(c, label);
      changed_.insert(changed_.end(), best_run.begin(), best_run.end());
      return;
    }
  }

  LabelledCells& cells_;
  const CellStars stars_;
  std::vector<std::uint64_t> population_;
  std::vector<std::uint32_t> changed_;
  std::vector<RingCell> ring_, cost_ring_;
  std::vector<Sector> sectors_, cost_sectors_;
  std::vector<EdgeOfCell> edges_;
};

}  // namespace

void remove_wedges(LabelledCells& cells) {
  Relabeller(cells).run();
}

}  // namespace voxtet::remesh
