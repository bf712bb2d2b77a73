#include "geometry/cut/cut_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "geometry/elements/tet_measures.h"
#include "geometry/topology/adjacency.h"
#include "geometry/topology/unused_points.h"

namespace voxtet {
namespace {

/// Of the largest coordinate: points of a cut are nearer to its plane.
constexpr double kInPlane = 1e-5;
constexpr int kCutHalvings = 6;
/// Of the area or volume of an element that its points' way into their planes must leave.
constexpr double kLeastPart = 0.3;
/// Dihedral angles above this may shrink down to its part, 13 degrees: the chord on the unit circle, of 45
/// degrees.
constexpr double kOpenChord = 0.765;
constexpr std::uint32_t kGone = 0xffffffffU;

/// Whether a triangle bounds nothing but what is beyond; its label stands first, since it is the highest.
bool goes(const Sides& sides, const CutPlanes& cuts) {
  return is_beyond(cuts, sides[0]) && (sides[1] == kBackground || is_beyond(cuts, sides[1]));
}

using Points = std::vector<Eigen::Vector3d>;

/// Calls visit(element) for each whose measure shrinks too much on its points' way.
template <class Elements, class Measure, class Visit>
void visit_shrunk(const Elements& elements, const Measure& measure, const Points& before, const Points& now,
                  Visit&& visit) {
  for (const auto& element : elements)
    if (std::any_of(element.begin(), element.end(), [&](auto p) { return now[p] != before[p]; }) &&
        measure(now, element) < kLeastPart * measure(before, element))
      visit(element);
}

/// Moves points into their planes, and those of elements that shrink too much only by a part of the way.
/// `find_shrunk`: calls visit_shrunk() for all elements. Returns the largest distance that remains.
template <class FindShrunk>
double flatten(const std::vector<CutBits>& of_points, const CutPlanes& cuts, const FindShrunk& find_shrunk,
               Points& points) {
  const Points before = points;
  std::vector<double> share(points.size(), 1);
  for (int halving = 0;; ++halving) {
    for (std::size_t p = 0; p < points.size(); ++p)
      if (of_points[p] != 0)
        points[p] = before[p] + share[p] * (in_planes(before[p], of_points[p], cuts) - before[p]);
    std::vector<bool> back(points.size(), false);
    bool good = true;
    find_shrunk(before, points, [&](const auto& element) {
      good = false;
      for (const std::uint32_t p : element) back[p] = true;
    });
    if (good) break;
    for (std::size_t p = 0; p < points.size(); ++p)
      if (back[p]) share[p] = halving + 1 < kCutHalvings ? share[p] / 2 : 0;
  }
  double remains = 0;
  for (std::size_t p = 0; p < points.size(); ++p)
    if (of_points[p] != 0)
      remains = std::max(remains, (in_planes(points[p], of_points[p], cuts) - points[p]).norm());
  return remains;
}

/// Two triangles at an edge: its ends, and the corners across from it.
using Hinge = std::array<std::uint32_t, 4>;

/// All pairs of triangles at the edges of which a corner is in a plane, ascending.
std::vector<Hinge> hinges_at(const std::vector<CutBits>& of_points, const std::vector<Triangle>& triangles) {
  std::vector<std::array<std::uint32_t, 3>> uses;  // an edge, ascending, and the third corner
  for (const Triangle& t : triangles) {
    if ((of_points[t[0]] | of_points[t[1]] | of_points[t[2]]) == 0) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(t[c], t[(c + 1) % 3]);
      uses.push_back({low, high, t[(c + 2) % 3]});
    }
  }
  std::sort(uses.begin(), uses.end());
  std::vector<Hinge> hinges;
  for (std::size_t i = 0; i < uses.size(); ++i)
    for (std::size_t j = i + 1; j < uses.size() && uses[j][0] == uses[i][0] && uses[j][1] == uses[i][1]; ++j)
      hinges.push_back({uses[i][0], uses[i][1], uses[i][2], uses[j][2]});
  return hinges;
}

/// How far two triangles are from lying upon each other, as the chord of their angle, at most kOpenChord.
double opening(const Points& points, const Hinge& hinge) {
  const Eigen::Vector3d &a = points[hinge[0]], along = (points[hinge[1]] - a).normalized();
  const auto across = [&](std::uint32_t p) -> Eigen::Vector3d {
    const Eigen::Vector3d d = points[p] - a;
    return (d - d.dot(along) * along).normalized();
  };
  return std::min((across(hinge[2]) - across(hinge[3])).norm(), kOpenChord);
}

/// From the middle of a lattice triangle of body, beyond and background to where the wall passes through it.
Eigen::Vector3d to_the_wall(const Eigen::Vector3d& index, const LabelVolume& volume, const CutPlanes& cuts) {
  constexpr double kOnLattice = 1e-3;
  const Eigen::Vector3d thirds = 3 * index;
  if (!(thirds - thirds.array().round().matrix()).isZero(kOnLattice)) return Eigen::Vector3d::Zero();
  // Its corners, each at or above the one before along every axis, follow from how many are above the cell's
  // first corner along each.
  std::array<Eigen::Vector3i, 3> corners;
  for (int d = 0; d < 3; ++d) {
    const int sum = static_cast<int>(std::lround(thirds[d]));
    const int low = sum >= 0 ? sum / 3 : -((2 - sum) / 3);
    const int above = sum - 3 * low;
    for (int c = 0; c < 3; ++c) corners[static_cast<std::size_t>(c)][d] = low + (c >= 3 - above ? 1 : 0);
  }
  std::optional<std::size_t> body, beyond, outside;
  for (std::size_t c = 0; c < 3; ++c) {
    const Label label = volume.at_or_background(corners[c][0], corners[c][1], corners[c][2]);
    (label == kBackground ? outside : is_beyond(cuts, label) ? beyond : body) = c;
  }
  if (!body || !beyond || !outside) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d inside = 0.5 * (corners[*body] + corners[*beyond]).cast<double>();
  return (corners[*outside].cast<double>() - inside) / 6;
}

}  // namespace

Eigen::Vector3d in_planes(Eigen::Vector3d point, CutBits of_point, const CutPlanes& cuts) {
  // Moves go along each other's planes where these are at right angles, and are repeated where they are not.
  constexpr int kRounds = 8, kMostRounds = 1000;
  constexpr double kInAll = 1e-9;  // mm
  const int rounds = (of_point & (of_point - 1)) == 0 ? 1 : kRounds;
  double farthest = 0;
  for (int round = 0; round < rounds || (rounds > 1 && farthest > kInAll && round < kMostRounds); ++round) {
    farthest = 0;
    for (std::size_t c = 0; c < cuts.size(); ++c) {
      if ((of_point >> c & 1) == 0) continue;
      const double distance = cuts[c].distance_mm(point);
      point -= distance * cuts[c].normal;
      farthest = std::max(farthest, std::abs(distance));
    }
  }
  return point;
}

CutBits cuts_of_sides(const Sides& sides, const CutPlanes& cuts) {
  for (std::size_t c = 0; c < cuts.size(); ++c)
    if (sides[0] == cuts[c].beyond && !goes(sides, cuts) && (!cuts[c].is_given() || cuts[c].cuts(sides[1])))
      return static_cast<CutBits>(1U << c);
  return 0;
}

std::vector<CutBits> cuts_of_points(std::size_t point_count, const std::vector<Triangle>& triangles,
                                    const std::vector<Sides>& sides, const CutPlanes& cuts) {
  std::vector<CutBits> of_points(point_count, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (const CutBits of_face = cuts_of_sides(sides[t], cuts); of_face != 0)
      for (const std::uint32_t p : triangles[t]) of_points[p] |= of_face;
  return of_points;
}

void settle_cuts(SurfaceMesh& extracted, const LabelVolume& volume, const CutPlanes& cuts) {
  // From the border's voxels points are up to three quarters of a voxel off, their cut is half a voxel off.
  constexpr double kBefore = 0.6, kBorder = 0.5;
  if (cuts.empty()) return;
  const Eigen::Matrix3d to_index = volume.linear().inverse();
  const std::vector<CutBits> of_points =
      cuts_of_points(extracted.points.size(), extracted.triangles, extracted.sides, cuts);
  for (std::size_t p = 0; p < of_points.size(); ++p) {
    if (of_points[p] == 0) continue;
    Eigen::Vector3d index = to_index * (extracted.points[p] - volume.origin());
    index += to_the_wall(index, volume, cuts);
    for (std::size_t c = 0; c < cuts.size(); ++c) {
      const auto& [axis, high, place] = std::tie(cuts[c].axis, cuts[c].high, cuts[c].place);
      const double voxel = high ? place - kBorder : place + kBorder;
      const double past = high ? index[axis] - voxel : voxel - index[axis];
      if ((of_points[p] >> c & 1) != 0)
        index[axis] = place;
      else if (past > 0)
        index[axis] = voxel + (high ? 1 : -1) * kBefore * past;
    }
    extracted.points[p] = volume.to_mm(index);
  }
}

double flatten_cuts(SurfaceMesh& surface, const CutPlanes& cuts) {
  if (cuts.empty()) return 0;
  const std::vector<CutBits> of_points =
      cuts_of_points(surface.points.size(), surface.triangles, surface.sides, cuts);
  const std::vector<Hinge> hinges = hinges_at(of_points, surface.triangles);
  const auto area = [](const Points& points, const Triangle& t) {
    return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
  };
  const auto find_shrunk = [&](const Points& before, const Points& now, const auto& visit) {
    visit_shrunk(surface.triangles, area, before, now, visit);
    visit_shrunk(hinges, opening, before, now, visit);
  };
  return flatten(of_points, cuts, find_shrunk, surface.points);
}

double flatten_cuts(TetMesh& mesh, const CutPlanes& cuts) {
  if (cuts.empty()) return 0;
  const auto volume = [](const Points& points, const Tet& t) {
    return tet_volume_mm3({points[t[0]], points[t[1]], points[t[2]], points[t[3]]});
  };
  const auto find_shrunk = [&](const Points& before, const Points& now, const auto& visit) {
    visit_shrunk(mesh.tets, volume, before, now, visit);
  };
  return flatten(cuts_of_points(mesh.points.size(), mesh.faces, mesh.face_sides, cuts), cuts, find_shrunk,
                 mesh.points);
}

std::vector<std::uint32_t> shown_triangles(const std::vector<std::uint32_t>& triangles,
                                           const SurfaceMesh& surface, const CutPlanes& cuts) {
  std::vector<std::uint32_t> place(surface.triangles.size(), 0), shown;
  std::uint32_t next = 0;
  for (std::size_t t = 0; t < place.size(); ++t) place[t] = goes(surface.sides[t], cuts) ? kGone : next++;
  for (const std::uint32_t t : triangles)
    if (place[t] != kGone) shown.push_back(place[t]);
  return shown;
}

TopologyLedger topology_before(const CutPlanes& cuts, TopologyLedger ledger) {
  std::erase_if(ledger.labels, [&](const LabelTopology& of) { return is_beyond(cuts, of.label); });
  std::erase_if(ledger.contacts, [&](const auto& pair) { return is_beyond(cuts, pair[1]); });
  return ledger;
}

SurfaceMesh without_beyond(const SurfaceMesh& surface, const CutPlanes& cuts) {
  if (cuts.empty()) return surface;
  SurfaceMesh out{surface.points, {}, {}};
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    auto [behind, front] = surface.sides[t];
    Triangle triangle = surface.triangles[t];
    if (goes(surface.sides[t], cuts)) continue;
    if (is_beyond(cuts, behind)) {
      // The normal goes from the higher label to the lower one.
      behind = front;
      front = kBackground;
      std::swap(triangle[1], triangle[2]);
    }
    out.triangles.push_back(triangle);
    out.sides.push_back({behind, front});
  }
  drop_unused_points(out);
  return out;
}

TetMesh without_beyond(TetMesh mesh, const CutPlanes& cuts) {
  if (cuts.empty()) return mesh;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (is_beyond(cuts, mesh.labels[t])) continue;
    mesh.tets[kept] = mesh.tets[t];
    mesh.labels[kept++] = mesh.labels[t];
  }
  mesh.tets.resize(kept);
  mesh.labels.resize(kept);
  drop_unused_points(mesh);
  add_label_faces(mesh);
  return mesh;
}

std::vector<NamedSet> cut_sets(const TetMesh& mesh, const CutPlanes& cuts) {
  std::vector<NamedSet> sets;
  double size = 0;
  for (const Eigen::Vector3d& p : mesh.points) size = std::max(size, p.cwiseAbs().maxCoeff());
  for (const CutPlane& cut : cuts) {
    NamedSet set{cut.name, {}};
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      const Triangle& face = mesh.faces[f];
      if (mesh.face_sides[f][1] != kBackground || (cut.is_given() && !cut.cuts(mesh.face_sides[f][0])))
        continue;
      if (std::all_of(face.begin(), face.end(), [&](std::uint32_t p) {
            return std::abs(cut.distance_mm(mesh.points[p])) <= kInPlane * size;
          }))
        set.members.push_back(f);
    }
    if (!set.members.empty()) sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace voxtet
