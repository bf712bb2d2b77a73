#include "volume/extend_cuts.h"

#include <algorithm>
#include <limits>
#include <string>

#include "geometry/topology/label_components.h"

namespace voxtet {
namespace {

constexpr int kPlanes = 3;
constexpr double kLeastShare = 0.5;

/// The two axes across one.
std::array<std::size_t, 2> across(std::size_t axis) {
  return axis == 0   ? std::array<std::size_t, 2>{1, 2}
         : axis == 1 ? std::array<std::size_t, 2>{0, 2}
                     : std::array<std::size_t, 2>{0, 1};
}

/// Visits the voxels of the plane `depth` steps inwards from an end of an axis, with their place in it.
template <class Visit>
void visit_plane(const Grid& grid, std::size_t axis, bool high, int depth, Visit&& visit) {
  const auto [u, v] = across(axis);
  std::array<int, 3> at{};
  at[axis] = high ? grid.size[axis] - 1 - depth : depth;
  std::size_t place = 0;
  for (at[v] = 0; at[v] < grid.size[v]; ++at[v])
    for (at[u] = 0; at[u] < grid.size[u]; ++at[u]) visit(grid.offset(at[0], at[1], at[2]), place++);
}

std::vector<std::uint8_t> cut_voxels(const LabelVolume& labels, std::size_t axis, bool high) {
  if (labels.size[axis] < kPlanes) return {};
  const auto [u, v] = across(axis);
  const std::size_t count =
      static_cast<std::size_t>(labels.size[u]) * static_cast<std::size_t>(labels.size[v]);
  std::vector<Label> body(kPlanes * count);
  bool touches = false;
  for (int depth = 0; depth < kPlanes; ++depth)
    visit_plane(labels, axis, high, depth, [&](std::size_t at, std::size_t place) {
      const bool is_body = labels.labels[at] != kBackground;
      body[static_cast<std::size_t>(depth) * count + place] = is_body ? 1 : 0;
      touches = touches || (is_body && depth == 0);
    });
  if (!touches) return {};
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> part =
      label_components({labels.size[u], labels.size[v], kPlanes}, body, sizes);
  std::vector<std::size_t> first(sizes.size(), 0), last(sizes.size(), 0);
  for (std::size_t place = 0; place < count; ++place) {
    ++first[part[place]];
    ++last[part[(kPlanes - 1) * count + place]];
  }
  std::vector<std::uint8_t> cut(count, 0);
  bool any = false;
  for (std::size_t place = 0; place < count; ++place)
    if (body[place] != 0 &&
        static_cast<double>(first[part[place]]) >= kLeastShare * static_cast<double>(last[part[place]])) {
      cut[place] = 1;
      any = true;
    }
  return any ? cut : std::vector<std::uint8_t>{};
}

/// The direction in the patient that a vector is nearest to.
std::string direction_of(const Eigen::Vector3d& normal) {
  static const std::array<std::array<const char*, 2>, 3> names{
      {{"left", "right"}, {"posterior", "anterior"}, {"inferior", "superior"}}};
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return names[static_cast<std::size_t>(axis)][normal[axis] > 0 ? 1 : 0];
}

const CutPlane* plane_at(const CutPlanes* cuts, std::size_t axis, bool high) {
  if (!cuts) return nullptr;
  for (const CutPlane& cut : *cuts)
    if (cut.axis == static_cast<int>(axis) && cut.high == high) return &cut;
  return nullptr;
}

}  // namespace

bool CutFaces::none() const {
  return std::all_of(cut.begin(), cut.end(),
                     [](const auto& ends) { return ends[0].empty() && ends[1].empty(); });
}

CutFaces find_cut_faces(const LabelVolume& labels) {
  CutFaces faces;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) faces.cut[axis][high ? 1 : 0] = cut_voxels(labels, axis, high);
  return faces;
}

LabelVolume extended(const LabelVolume& labels, const CutFaces& faces, const CutPlanes* cuts,
                     bool everywhere) {
  std::array<std::array<int, 2>, 3> added{};
  LabelVolume out;
  out.infos = labels.infos;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t end = 0; end < 2; ++end)
      added[axis][end] = faces.cut[axis][end].empty() ? 0 : kBeyondCut;
    out.size[axis] = labels.size[axis] + added[axis][0] + added[axis][1];
    shift[static_cast<Eigen::Index>(axis)] = added[axis][0];
  }
  out.index_to_mm = labels.index_to_mm;
  out.index_to_mm.topRightCorner<3, 1>() = labels.to_mm(-shift);
  out.labels.resize(out.voxel_count());
  // Where a voxel lies beyond, along each axis: -1, 0 or 1; and the voxel of the border that it is beyond.
  out.visit([&](int i, int j, int k, std::size_t at) {
    const std::array<int, 3> index{i, j, k};
    std::array<int, 3> from{}, side{};
    for (std::size_t d = 0; d < 3; ++d) {
      const int place = index[d] - added[d][0];
      from[d] = std::clamp(place, 0, labels.size[d] - 1);
      side[d] = place < 0 ? -1 : place >= labels.size[d] ? 1 : 0;
    }
    Label label = labels.labels[labels.offset(from[0], from[1], from[2])];
    for (std::size_t d = 0; d < 3 && label != kBackground; ++d) {
      if (side[d] == 0) continue;
      const bool high = side[d] > 0;
      const auto [u, v] = across(d);
      const std::size_t place = static_cast<std::size_t>(from[u]) +
                                static_cast<std::size_t>(labels.size[u]) * static_cast<std::size_t>(from[v]);
      if (!everywhere && faces.cut[d][high ? 1 : 0][place] == 0) label = kBackground;
    }
    for (std::size_t d = 0; d < 3 && label != kBackground; ++d)
      if (side[d] != 0)
        if (const CutPlane* plane = plane_at(cuts, d, side[d] > 0)) {
          label = plane->beyond;
          break;
        }
    out.labels[at] = label;
  });
  return out;
}

CutPlanes planes_of(const LabelVolume& labels, const CutFaces& faces, Label highest) {
  CutPlanes planes;
  Label next = std::numeric_limits<Label>::max();
  const Eigen::Matrix3d to_index = labels.linear().inverse();
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true}) {
      if (faces.cut[axis][high ? 1 : 0].empty()) continue;
      CutPlane plane;
      plane.beyond = next--;
      plane.axis = static_cast<int>(axis);
      plane.high = high;
      const int added = faces.cut[axis][0].empty() ? 0 : kBeyondCut;
      const double border = high ? labels.size[axis] - 0.5 : -0.5;
      plane.place = border + added;
      const Eigen::Vector3d along = to_index.row(plane.axis).transpose();
      plane.normal = (high ? 1 : -1) * along.normalized();
      Eigen::Vector3d on = Eigen::Vector3d::Zero();
      on[plane.axis] = border;
      plane.offset_mm = plane.normal.dot(labels.to_mm(on));
      plane.name = "cut_" + direction_of(plane.normal);
      planes.push_back(std::move(plane));
    }
  return std::size_t{highest} + planes.size() > std::numeric_limits<Label>::max() ? CutPlanes{} : planes;
}

}  // namespace voxtet
