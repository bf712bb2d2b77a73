#include "tetra/mesh/tet_complex.h"

#include <algorithm>
#include <utility>

#include "base/buckets.h"
#include "base/parallel.h"
#include "geometry/elements/orientation.h"
#include "geometry/elements/tet_measures.h"

namespace voxtet::tetra {
namespace {

constexpr Tet kGone{kNone, kNone, kNone, kNone};

std::array<std::uint32_t, 3> side_of(const Tet& corners, std::uint32_t corner) {
  const auto& side = kFacetCorners[corner];
  return ascending(Triangle{corners[side[0]], corners[side[1]], corners[side[2]]});
}

}  // namespace

Triangle ascending(Triangle c) {
  if (c[0] > c[1]) std::swap(c[0], c[1]);
  if (c[1] > c[2]) std::swap(c[1], c[2]);
  if (c[0] > c[1]) std::swap(c[0], c[1]);
  return c;
}

TetComplex::TetComplex(TetMesh mesh)
    : points_(std::move(mesh.points)),
      on_interface_(points_.size(), 0),
      tet_at_(points_.size(), kNone),
      faces_(std::move(mesh.faces)),
      face_sides_(std::move(mesh.face_sides)) {
  cells_.reserve(mesh.tets.size());
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    cells_.push_back(
        {mesh.tets[t], {kNone, kNone, kNone, kNone}, quality_at(mesh.tets[t]), 0, mesh.labels[t]});
    for (const std::uint32_t v : mesh.tets[t]) tet_at_[v] = t;
    add_volume(label(t), tet_volume_mm3(t));
  }
  for (const Triangle& face : faces_)
    for (const std::uint32_t v : face) on_interface_[v] = 1;
  connect();
}

void TetComplex::connect() {
  Buckets<Waiting> sides(points_.size());
  const auto for_sides = [this](const auto& visit) {
    for_indices(0, places(), [&](std::size_t place) {
      const auto t = static_cast<std::uint32_t>(place);
      for (std::uint32_t c = 0; c < 4; ++c) visit(Waiting{side_of(corners(t), c), 4 * t + c});
    });
  };
  for_sides([&](const Waiting& side) { sides.count(side.corners[0]); });
  sides.allocate();
  for_sides([&](const Waiting& side) { sides.add(side.corners[0], side); });
  for_indices(0, sides.size(), [&](std::size_t lowest) {
    waiting_.clear();
    for (const Waiting& side : sides.at(lowest)) meet(side);
  });
}

bool TetComplex::is_positive(const Tet& t) const {
  return orientation(points_[t[0]], points_[t[1]], points_[t[2]], points_[t[3]]) > 0;
}

double TetComplex::tet_volume_mm3(std::uint32_t t) const {
  const auto& [a, b, c, d] = corners(t);
  return voxtet::tet_volume_mm3({points_[a], points_[b], points_[c], points_[d]});
}

void TetComplex::add_volume(Label label, double mm3) {
  if (label == kBackground) return;
  if (label >= volumes_mm3_.size()) volumes_mm3_.resize(label + 1, 0);
  volumes_mm3_[label] += mm3;
}

TetMesh TetComplex::release() && {
  TetMesh mesh;
  std::vector<std::uint32_t> renumbered(points_.size(), kNone);
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (tet_at_[v] == kNone) continue;
    renumbered[v] = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(points_[v]);
  }
  for (const Cell& cell : cells_) {
    if (cell.corners == kGone) continue;
    Tet tet;
    for (std::size_t c = 0; c < 4; ++c) tet[c] = renumbered[cell.corners[c]];
    mesh.tets.push_back(tet);
    mesh.labels.push_back(cell.label);
  }
  mesh.faces = std::move(faces_);
  mesh.face_sides = std::move(face_sides_);
  for (Triangle& face : mesh.faces)
    for (std::uint32_t& v : face) v = renumbered[v];
  return mesh;
}

bool TetComplex::find_ring(std::uint32_t t, std::uint32_t i, std::uint32_t j, EdgeRing& ring) const {
  ring.a = corners(t)[i];
  ring.b = corners(t)[j];
  ring.size = 0;
  const std::uint32_t first = t;
  std::uint32_t leaving = kOtherCorners[i][j][0], next = corners(t)[kOtherCorners[i][j][1]];
  do {
    if (ring.size == EdgeRing::kMost) return false;
    ring.ring[ring.size] = corners(t)[leaving];
    ring.tets[ring.size++] = t;
    const Facet facet = across(t, leaving);
    if (facet == kNone || label(tet_of(facet)) != label(t)) return false;
    t = tet_of(facet);
    leaving = corner_at(t, next);
    next = corners(t)[corner_of(facet)];
  } while (t != first);
  return true;
}

void TetComplex::find_star(std::uint32_t vertex, IdSet& seen, std::vector<std::uint32_t>& star) const {
  seen.clear();
  star.assign(1, tet_at_[vertex]);
  seen.insert(star[0]);
  for (std::size_t next = 0; next < star.size(); ++next) {
    const Cell& cell = cells_[star[next]];
    for (std::size_t c = 0; c < 4; ++c) {
      if (cell.corners[c] == vertex || cell.across[c] == kNone) continue;
      const std::uint32_t other = tet_of(cell.across[c]);
      if (seen.insert(other)) star.push_back(other);
    }
  }
}

void TetComplex::find_neighbours(std::uint32_t vertex, std::span<const std::uint32_t> star, IdSet& seen,
                                 std::vector<std::uint32_t>& neighbours) const {
  neighbours.clear();
  seen.clear();
  seen.insert(vertex);
  for (const std::uint32_t t : star)
    for (const std::uint32_t v : corners(t))
      if (seen.insert(v)) neighbours.push_back(v);
}

std::uint32_t TetComplex::take_place() {
  if (free_.empty()) {
    cells_.emplace_back();
    return places() - 1;
  }
  const std::uint32_t place = free_.back();
  free_.pop_back();
  return place;
}

void TetComplex::wait_outside(std::span<const std::uint32_t> gone) {
  ++mark_;
  for (const std::uint32_t t : gone) cells_[t].mark = mark_;
  waiting_.clear();
  for (const std::uint32_t t : gone)
    for (std::uint32_t c = 0; c < 4; ++c) {
      const Facet facet = across(t, c);
      if (facet == kNone || cells_[tet_of(facet)].mark != mark_)
        waiting_.push_back({side_of(corners(t), c), facet});
    }
}

void TetComplex::meet(const Waiting& side) {
  const auto other = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const Waiting& w) { return w.corners == side.corners; });
  if (other == waiting_.end()) {
    waiting_.push_back(side);
    return;
  }
  cells_[tet_of(side.facet)].across[corner_of(side.facet)] = other->facet;
  if (other->facet != kNone) cells_[tet_of(other->facet)].across[corner_of(other->facet)] = side.facet;
  *other = waiting_.back();
  waiting_.pop_back();
}

bool TetComplex::replace(std::span<const std::uint32_t> gone, std::span<const Tet> made) {
  for (const Tet& t : made)
    if (!is_positive(t)) return false;
  const Label label = cells_[gone[0]].label;
  Change change;
  if (keeps_changes_) {
    change.gone.assign(gone.begin(), gone.end());
    for (const std::uint32_t t : gone) change.gone_corners.push_back(corners(t));
  }
  wait_outside(gone);
  for (const std::uint32_t t : gone) {
    for (const std::uint32_t v : corners(t)) tet_at_[v] = kNone;
    cells_[t].corners = kGone;
  }
  // The last one first, so that places are taken in the order of `gone`.
  free_.insert(free_.end(), gone.rbegin(), gone.rend());
  made_.clear();
  for (const Tet& tet : made) {
    const std::uint32_t t = take_place();
    cells_[t] = {tet, {kNone, kNone, kNone, kNone}, quality_at(tet), 0, label};
    for (const std::uint32_t v : tet) tet_at_[v] = t;
    for (std::uint32_t c = 0; c < 4; ++c) meet({side_of(tet, c), 4 * t + c});
    made_.push_back(t);
  }
  if (keeps_changes_) {
    change.made = made_;
    changes_.push_back(std::move(change));
  }
  return true;
}

TetComplex::Mark TetComplex::mark() {
  keeps_changes_ = true;
  return {changes_.size(), points_.size()};
}

void TetComplex::forget_changes() {
  keeps_changes_ = false;
  changes_.clear();
}

void TetComplex::undo_to(const Mark& mark) {
  keeps_changes_ = false;
  while (changes_.size() > mark.changes) {
    const Change change = std::move(changes_.back());
    changes_.pop_back();
    if (change.moved == kNone)
      replace(change.made, change.gone_corners);  // in the places they had: see there
    else
      move_point(change.moved, change.from, change.made);
  }
  keeps_changes_ = true;
  while (points_.size() > mark.points) drop_point();
}

void TetComplex::relabel(std::uint32_t t, Label label) {
  const Tet corners = cells_[t].corners;
  std::array<bool, 4> held{};  // by a side that becomes an interface
  for (std::uint32_t c = 0; c < 4; ++c)
    if (behind(t, c) != kNone)
      for (std::uint32_t other = 0; other < 4; ++other) held[other] = held[other] || other != c;
  add_volume(cells_[t].label, -tet_volume_mm3(t));
  add_volume(label, tet_volume_mm3(t));
  if (label != kBackground) {
    for (std::uint32_t c = 0; c < 4; ++c) on_interface_[corners[c]] = held[c];
    cells_[t].label = label;
    return;
  }
  for (const std::uint32_t v : corners) tet_at_[v] = kNone;
  for (std::uint32_t c = 0; c < 4; ++c) {
    const Facet facet = across(t, c);
    if (facet == kNone) continue;
    cells_[tet_of(facet)].across[corner_of(facet)] = kNone;
    for (std::uint32_t other = 0; other < 4; ++other)
      if (other != c) tet_at_[corners[other]] = tet_of(facet);
  }
  cells_[t].corners = kGone;
  free_.push_back(t);
}

void TetComplex::exchange_interfaces(std::span<const InterfaceExchange> exchanges) {
  struct Change {
    Triangle key, gone;
    const Triangle* made;  ///< null: none
    bool operator<(const Change& other) const { return key < other.key; }
  };
  std::vector<Change> changes;
  for (const InterfaceExchange& exchange : exchanges)
    for (std::size_t i = 0; i < exchange.gone.size(); ++i)
      changes.push_back({ascending(exchange.gone[i]), exchange.gone[i],
                         i < exchange.made.size() ? &exchange.made[i] : nullptr});
  std::sort(changes.begin(), changes.end());
  std::size_t kept = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Change wanted{ascending(faces_[f]), {}, nullptr};
    const auto found = std::lower_bound(changes.begin(), changes.end(), wanted);
    Triangle face = faces_[f];
    if (found != changes.end() && found->key == wanted.key) {
      if (found->made == nullptr) continue;
      const auto at =
          static_cast<std::size_t>(std::find(face.begin(), face.end(), found->gone[0]) - face.begin());
      const bool alike = face[(at + 1) % 3] == found->gone[1];
      face = *found->made;
      if (!alike) std::swap(face[1], face[2]);
    }
    faces_[kept] = face;
    face_sides_[kept++] = face_sides_[f];
  }
  faces_.resize(kept);
  face_sides_.resize(kept);
}

std::uint32_t TetComplex::add_point(const Point& at) {
  points_.push_back(at);
  on_interface_.push_back(0);
  tet_at_.push_back(kNone);
  return point_count() - 1;
}

void TetComplex::drop_point() {
  points_.pop_back();
  on_interface_.pop_back();
  tet_at_.pop_back();
}

bool TetComplex::move_point(std::uint32_t vertex, const Point& to, std::span<const std::uint32_t> star) {
  // Interfaces alone part labels: what else moves takes as much as it gives.
  const bool changes_volumes = on_interface_[vertex];
  if (changes_volumes)
    for (const std::uint32_t t : star) add_volume(label(t), -tet_volume_mm3(t));
  const Point from = std::exchange(points_[vertex], to);
  const bool positive =
      std::all_of(star.begin(), star.end(), [this](std::uint32_t t) { return is_positive(corners(t)); });
  if (!positive) points_[vertex] = from;
  if (changes_volumes)
    for (const std::uint32_t t : star) add_volume(label(t), tet_volume_mm3(t));
  if (!positive) return false;
  for (const std::uint32_t t : star) cells_[t].quality = quality_at(corners(t));
  if (keeps_changes_) changes_.push_back({{star.begin(), star.end()}, {}, {}, vertex, from});
  return true;
}

}  // namespace voxtet::tetra
