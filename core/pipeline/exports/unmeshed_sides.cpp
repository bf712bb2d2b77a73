#include "pipeline/exports/unmeshed_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {
namespace {

/// How far beyond a face the image is looked at, in voxels.
constexpr std::array<double, 2> kBeyond{0.7, 1.4};
/// Rounds in which faces follow the two of their three neighbours that agree.
constexpr int kRounds = 4;

using Neighbours = std::array<std::int32_t, 3>;  ///< faces across the edges; -1: none

Label nearest_label(const LabelVolume& image, const Eigen::Matrix4d& to_index, const Eigen::Vector3d& at) {
  const Eigen::Vector3d index =
      (to_index.topLeftCorner<3, 3>() * at + to_index.topRightCorner<3, 1>()).array().round();
  if (!(index.cwiseAbs().maxCoeff() < 1e9)) return kBackground;
  const Eigen::Vector3i voxel = index.cast<int>();
  return image.at_or_background(voxel[0], voxel[1], voxel[2]);
}

/// Of each face the label beyond it that the mesh does not have.
std::vector<Label> labels_beyond(const TetMesh& mesh, const LabelVolume& image,
                                 const std::vector<bool>& meshed) {
  const Eigen::Matrix4d to_index = image.index_to_mm.inverse();
  const double voxel = image.smallest_spacing_mm();
  std::vector<Label> beyond(mesh.faces.size(), kBackground);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.face_sides[f][1] != kBackground) continue;
    const auto& [a, b, c] = mesh.faces[f];
    const Eigen::Vector3d out = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    const Eigen::Vector3d middle = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
    for (const double voxels : kBeyond) {
      const Label label = nearest_label(image, to_index, middle + voxels * voxel * out.normalized());
      if (label == kBackground || meshed[label]) continue;
      beyond[f] = label;
      break;
    }
  }
  return beyond;
}

/// Those of outer faces with the same label behind them.
std::vector<Neighbours> neighbours_of(const TetMesh& mesh) {
  struct Side {
    std::uint32_t low, high, face;
    std::size_t corner;
  };
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto [low, high] = std::minmax(mesh.faces[f][corner], mesh.faces[f][(corner + 1) % 3]);
      if (mesh.face_sides[f][1] == kBackground) sides.push_back({low, high, f, corner});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  std::vector<Neighbours> neighbours(mesh.faces.size(), {-1, -1, -1});
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &a = sides[i - 1], &b = sides[i];
    if (a.low != b.low || a.high != b.high || mesh.face_sides[a.face] != mesh.face_sides[b.face]) continue;
    neighbours[a.face][a.corner] = static_cast<std::int32_t>(b.face);
    neighbours[b.face][b.corner] = static_cast<std::int32_t>(a.face);
  }
  return neighbours;
}

/// The label that two neighbours have, else the face's own.
Label agreed(const Neighbours& neighbours, Label own, const std::vector<Label>& beyond) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 3; ++j)
      if (neighbours[i] >= 0 && neighbours[j] >= 0 &&
          beyond[static_cast<std::size_t>(neighbours[i])] == beyond[static_cast<std::size_t>(neighbours[j])])
        return beyond[static_cast<std::size_t>(neighbours[i])];
  return own;
}

}  // namespace

std::vector<NamedSet> unmeshed_sides(const TetMesh& mesh, const LabelVolume& image,
                                     const std::vector<LabelInfo>& infos) {
  std::vector<bool> meshed(65536, false);
  for (const Label label : mesh.labels) meshed[label] = true;
  const bool all_meshed = std::all_of(image.labels.begin(), image.labels.end(),
                                      [&](Label label) { return label == kBackground || meshed[label]; });
  if (all_meshed) return {};
  std::vector<Label> beyond = labels_beyond(mesh, image, meshed);
  const std::vector<Neighbours> neighbours = neighbours_of(mesh);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Label> before = beyond;
    for (std::size_t f = 0; f < beyond.size(); ++f) beyond[f] = agreed(neighbours[f], before[f], before);
  }
  std::map<std::pair<Label, Label>, std::vector<std::uint32_t>> members;
  for (std::uint32_t f = 0; f < beyond.size(); ++f)
    if (beyond[f] != kBackground) members[{mesh.face_sides[f][0], beyond[f]}].push_back(f);
  std::vector<NamedSet> sets;
  for (auto& [labels, faces] : members)
    sets.push_back({word_name(Sides{labels.first, labels.second}, infos), std::move(faces)});
  return sets;
}

}  // namespace voxtet
