#include "pipeline/sources/opened_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "base/digest.h"
#include "geometry/elements/tet_measures.h"
#include "geometry/grid/rasterise.h"
#include "geometry/topology/adjacency.h"
#include "geometry/topology/unused_points.h"
#include "io/mesh/write_mesh.h"

namespace voxtet {
namespace {

constexpr double kMostVoxels = 1 << 24;
constexpr int kMargin = 2;

double volume_of_tet(const TetMesh& mesh, const Tet& tet) {
  return tet_volume_mm3({mesh.points[tet[0]], mesh.points[tet[1]], mesh.points[tet[2]], mesh.points[tet[3]]});
}

std::size_t turn_inverted(TetMesh& mesh) {
  std::size_t turned = 0;
  for (Tet& tet : mesh.tets) {
    if (!(volume_of_tet(mesh, tet) < 0)) continue;
    std::swap(tet[2], tet[3]);
    ++turned;
  }
  return turned;
}

std::vector<Eigen::Vector3d> unit_vectors(const Field* field) {
  std::vector<Eigen::Vector3d> out;
  if (!field) return out;
  out.reserve(field->values.size() / 3);
  for (std::size_t i = 0; i + 2 < field->values.size(); i += 3) {
    const Eigen::Vector3d v(field->values[i], field->values[i + 1], field->values[i + 2]);
    const double length = v.norm();
    out.push_back(length > 0 ? Eigen::Vector3d(v / length) : Eigen::Vector3d::Zero());
  }
  return out;
}

/// Edge of cubes of which the label with the smallest tetrahedra holds eight for each.
double spacing_of(const TetMesh& mesh) {
  std::map<Label, std::pair<double, double>> labels;  // volume and number of tetrahedra
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    auto& [volume, count] = labels[mesh.labels[t]];
    volume += volume_of_tet(mesh, mesh.tets[t]);
    count += 1;
  }
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& [label, of_label] : labels)
    if (of_label.first > 0) smallest = std::min(smallest, of_label.first / of_label.second);
  return std::isfinite(smallest) ? std::cbrt(smallest / 8) : 1;
}

constexpr std::size_t kLabels = std::numeric_limits<Label>::max() + std::size_t{1};

/// By label; all where none is named.
std::vector<bool> kept_labels(const std::vector<Label>& wanted) {
  std::vector<bool> kept(kLabels, wanted.empty());
  for (const Label label : wanted) kept[label] = true;
  return kept;
}

}  // namespace

bool is_mesh_name(const std::string& name) {
  return mesh_format_of(name).ok();
}

Result<OpenedMesh> open_mesh(const VolumeFile& file, std::vector<std::string>& warnings) {
  MeshArrays arrays;
  Result<TetMesh> read = read_tet_mesh(file, &arrays);
  if (!read) return read.error();
  for (const std::string& note : arrays.notes) warnings.push_back(file.name + ": " + note);
  OpenedMesh opened;
  opened.mesh = std::move(read).value();
  opened.fibres = {unit_vectors(find_field(arrays.cell_data, kFibreField)),
                   unit_vectors(find_field(arrays.cell_data, kSheetField))};
  if (const std::size_t turned = turn_inverted(opened.mesh); turned > 0)
    warnings.push_back(file.name + ": " + std::to_string(turned) + " of " +
                       std::to_string(opened.mesh.tets.size()) + " tetrahedra were inverted, and are turned");
  if (const std::size_t unused = drop_unused_points(opened.mesh); unused > 0)
    warnings.push_back(file.name + ": " + std::to_string(unused) +
                       " points belong to no tetrahedron, and are left out; the others are numbered anew");
  add_label_faces(opened.mesh);
  return opened;
}

std::string digest_of(const OpenedMesh& opened) {
  std::string digest = digest_of(opened.mesh);
  if (opened.fibres.fibre.empty()) return digest;
  Sha256 all;
  all.update(digest);
  for (const auto* vectors : {&opened.fibres.fibre, &opened.fibres.sheet})
    for (const Eigen::Vector3d& v : *vectors) all.update_values(v.data(), 3);
  return all.hex();
}

LabelVolume voxels_of(const TetMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : mesh.points) box.extend(point);
  const double spacing = std::max(spacing_of(mesh), std::cbrt(box.volume() / kMostVoxels));
  LabelVolume volume;
  for (int d = 0; d < 3; ++d)
    volume.size[static_cast<std::size_t>(d)] =
        static_cast<int>(std::ceil(box.sizes()[d] / spacing)) + 2 * kMargin;
  volume.index_to_mm.setIdentity();
  volume.index_to_mm.topLeftCorner<3, 3>() *= spacing;
  volume.index_to_mm.topRightCorner<3, 1>() = box.min().array() + (0.5 - kMargin) * spacing;
  volume.labels = rasterise(mesh, mesh.labels, volume);
  return volume;
}

TetMesh mesh_of_labels(const TetMesh& mesh, const std::vector<Label>& wanted,
                       const std::vector<LabelGroup>& merge) {
  if (wanted.empty() && merge.empty()) return mesh;
  std::vector<Label> becomes(kLabels);
  std::iota(becomes.begin(), becomes.end(), Label{0});
  for (const LabelGroup& group : merge)
    for (const Label label : group) becomes[label] = *std::min_element(group.begin(), group.end());
  const std::vector<bool> kept = kept_labels(wanted);
  TetMesh out;
  out.points = mesh.points;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!kept[mesh.labels[t]]) continue;
    out.tets.push_back(mesh.tets[t]);
    out.labels.push_back(becomes[mesh.labels[t]]);
  }
  drop_unused_points(out);
  add_label_faces(out);
  return out;
}

Fibres fibres_of_labels(const OpenedMesh& opened, const std::vector<Label>& wanted) {
  const std::vector<bool> kept = kept_labels(wanted);
  const auto of_kept = [&](const std::vector<Eigen::Vector3d>& all) {
    std::vector<Eigen::Vector3d> out;
    for (std::size_t t = 0; t < all.size(); ++t)
      if (kept[opened.mesh.labels[t]]) out.push_back(all[t]);
    return out;
  };
  return {of_kept(opened.fibres.fibre), of_kept(opened.fibres.sheet)};
}

}  // namespace voxtet
