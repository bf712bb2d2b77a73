#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>

#include "surface/extract/cell_tables.h"
#include "surface/extract/extract_methods.h"
#include "surface/extract/march_slabs.h"

namespace voxtet {
namespace {

/// Lattice triangles bottom < middle < top have a slot at their top point, by the masks top^bottom and
/// top^middle; the latter is a proper part of the former.
constexpr std::size_t kFaceSlots = 12;
constexpr std::array<std::array<std::uint8_t, 8>, 8> make_face_slots() {
  std::array<std::array<std::uint8_t, 8>, 8> slots{};
  std::uint8_t next = 0;
  for (unsigned whole = 1; whole < 8; ++whole)
    for (unsigned part = 1; part < whole; ++part)
      if ((part & whole) == part) slots[whole][part] = next++;
  return slots;
}
constexpr std::array<std::array<std::uint8_t, 8>, 8> kFaceSlot = make_face_slots();
static_assert(kFaceSlot[7][6] == kFaceSlots - 1);

class TetMarcher {
 public:
  TetMarcher(const LabelVolume& volume, SurfaceMesh& out)
      : linear_(volume.linear()),
        first_mm_(volume.to_mm(Eigen::Vector3d::Constant(-1))),
        mirrored_(linear_.determinant() < 0),
        edge_ids_(volume, 8),
        face_ids_(volume, kFaceSlots),
        out_(out) {}

  void operator()(int x, int y, int z, const std::array<Label, 8>& corners) {
    cell_ = {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    for (unsigned c = 1; c < 8; ++c) edges_[c] = edge_ids_.at(x, y, z, c);
    for (unsigned d = 1; d < 8; ++d)
      if (corners[7] != corners[7 ^ d]) edges_[7][d] = add_point({7 ^ d, 7}, 0.5);
    const bool many = has_three_labels(corners);
    if (many) {
      for (const unsigned c : {3U, 5U, 6U, 7U}) faces_[c] = face_ids_.at(x, y, z, c);
      add_face_points(corners);
    }
    for (const KuhnTet& tet : kKuhnTets) add_tet(tet, corners);
  }

 private:
  static bool has_three_labels(const std::array<Label, 8>& corners) {
    Label other = corners[0];
    for (const Label label : corners) {
      if (label == corners[0] || label == other) continue;
      if (other != corners[0]) return true;
      other = label;
    }
    return false;
  }

  void add_face_points(const std::array<Label, 8>& corners) {
    for (unsigned whole = 1; whole < 8; ++whole)
      for (unsigned part = 1; part < whole; ++part) {
        if ((part & whole) != part) continue;
        const Label a = corners[7], b = corners[7 ^ part], c = corners[7 ^ whole];
        if (a != b && b != c && a != c)
          faces_[7][kFaceSlot[whole][part]] = add_point({7 ^ whole, 7 ^ part, 7}, 1.0 / 3.0);
      }
  }

  void add_tet(const KuhnTet& tet, const std::array<Label, 8>& corners) {
    const std::array<Label, 4> labels{corners[tet.corners[0]], corners[tet.corners[1]],
                                      corners[tet.corners[2]], corners[tet.corners[3]]};
    unsigned code = 0;
    for (unsigned e = 0; e < 6; ++e)
      code |= static_cast<unsigned>(labels[kTetEdges[e][0]] != labels[kTetEdges[e][1]]) << e;
    if (code == 0) return;
    std::uint32_t centre = 0;
    if (code == 63)
      centre = add_point({tet.corners[0], tet.corners[1], tet.corners[2], tet.corners[3]}, 0.25);
    for (const TetTriangle& triangle : table_.triangles(code)) {
      Triangle t{};
      for (std::size_t i = 0; i < 3; ++i) t[i] = vertex(tet, triangle.vertices[i], centre);
      Sides sides{labels[triangle.behind], labels[triangle.front]};
      const bool descending = sides[0] > sides[1];
      if (!descending) std::swap(sides[0], sides[1]);
      if ((tet.right_handed != mirrored_) != descending) std::swap(t[1], t[2]);
      out_.triangles.push_back(t);
      out_.sides.push_back(sides);
    }
  }

  std::uint32_t vertex(const KuhnTet& tet, unsigned id, std::uint32_t centre) const {
    if (id < 6) {
      const unsigned top = tet.corners[kTetEdges[id][1]];
      return edges_[top][top ^ tet.corners[kTetEdges[id][0]]];
    }
    if (id == 10) return centre;
    constexpr std::array<std::array<std::uint8_t, 3>, 4> kOpposite{
        {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
    const auto& face = kOpposite[id - 6];
    const unsigned top = tet.corners[face[2]];
    return faces_[top][kFaceSlot[top ^ tet.corners[face[0]]][top ^ tet.corners[face[1]]]];
  }

  std::uint32_t add_point(std::initializer_list<unsigned> corners, double weight) {
    std::array<int, 3> sum{};
    for (const unsigned c : corners)
      for (std::size_t d = 0; d < 3; ++d) sum[d] += static_cast<int>((c >> d) & 1);
    const Eigen::Vector3d index = cell_ + weight * Eigen::Vector3d(sum[0], sum[1], sum[2]);
    out_.points.emplace_back(linear_ * index + first_mm_);
    return static_cast<std::uint32_t>(out_.points.size() - 1);
  }

  const TetTable& table_ = tet_table();
  Eigen::Matrix3d linear_;
  Eigen::Vector3d first_mm_;
  bool mirrored_;
  PlaneIds edge_ids_, face_ids_;
  SurfaceMesh& out_;
  Eigen::Vector3d cell_;
  std::array<std::uint32_t*, 8> edges_{}, faces_{};
};

}  // namespace

Result<SurfaceMesh> extract_marching_tets(const LabelVolume& volume, RunContext& ctx) {
  return march_slabs(volume, false, ctx, [&](SurfaceMesh& out) { return TetMarcher(volume, out); });
}

}  // namespace voxtet
