#include "quality/checklist.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "geometry/adjacency.h"
#include "geometry/tet_measures.h"

namespace voxtet {
namespace {

ChecklistItem none_of(const std::string& name, std::size_t found, std::size_t total, bool hard = true) {
  return {name, found == 0, hard, std::to_string(found) + " of " + std::to_string(total), "0"};
}

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::size_t count_inverted(const TetMesh& mesh) {
  std::size_t inverted = 0;
  for (const auto& [a, b, c, d] : mesh.tets)
    // Negated so that NaN counts as inverted.
    if (!(tet_volume_mm3({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]}) > 0)) ++inverted;
  return inverted;
}

std::size_t count_duplicate_points(const TetMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    return std::array<double, 3>{mesh.points[i].x(), mesh.points[i].y(), mesh.points[i].z()};
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::size_t duplicates = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1])) ++duplicates;
  return duplicates;
}

std::size_t count_duplicate_tets(const TetMesh& mesh) {
  std::vector<Tet> sorted = mesh.tets;
  for (Tet& t : sorted) std::sort(t.begin(), t.end());
  std::sort(sorted.begin(), sorted.end());
  std::size_t duplicates = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] == sorted[i - 1]) ++duplicates;
  return duplicates;
}

std::size_t count_unused_points(const TetMesh& mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const Tet& t : mesh.tets)
    for (const std::uint32_t v : t) used[v] = true;
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
}

struct BoundaryFaults {
  std::size_t open = 0, branching = 0, edges = 0;
};

/// Each label's boundary on its own: edges with an odd number of its faces, and with more than two.
BoundaryFaults boundary_faults(const TetMesh& mesh, const std::vector<TetFace>& faces) {
  std::vector<std::vector<Triangle>> boundary(65536);
  for (const TetFace& face : faces) {
    const Label first = mesh.labels[face.first];
    const Label second = face.count > 1 ? mesh.labels[face.second] : kBackground;
    if (first == second) continue;
    boundary[first].push_back(face.corners);
    if (second != kBackground) boundary[second].push_back(face.corners);
  }
  BoundaryFaults faults;
  for (const std::vector<Triangle>& triangles : boundary) {
    if (triangles.empty()) continue;
    for (const EdgeUse& use : edge_uses(triangles, mesh.points.size())) {
      ++faults.edges;
      if (use.count % 2 == 1) ++faults.open;
      if (use.count > 2) ++faults.branching;
    }
  }
  return faults;
}

/// Union-find over indices, with path halving.
class Components {
 public:
  explicit Components(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }
  /// Number of components for each label (index), background left out.
  std::vector<std::uint32_t> count(const std::vector<Label>& labels) {
    std::vector<std::uint32_t> counts(65536, 0);
    for (std::uint32_t i = 0; i < parent_.size(); ++i)
      if (labels[i] != kBackground && find(i) == i) ++counts[labels[i]];
    return counts;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::vector<std::uint32_t> mesh_components(const TetMesh& mesh) {
  Components components(mesh.tets.size());
  for (const TetFace& face : tet_faces(mesh.tets, mesh.points.size()))
    if (face.count > 1 && mesh.labels[face.first] == mesh.labels[face.second]) components.join(face.first, face.second);
  return components.count(mesh.labels);
}

std::vector<std::uint32_t> voxel_components(const LabelVolume& volume) {
  Components components(volume.voxel_count());
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        const Label label = volume.at(i, j, k);
        if (label == kBackground) continue;
        const auto here = static_cast<std::uint32_t>(volume.offset(i, j, k));
        for (const auto& [x, y, z] : {std::array{i - 1, j, k}, std::array{i, j - 1, k}, std::array{i, j, k - 1}})
          if (volume.at_or_background(x, y, z) == label)
            components.join(here, static_cast<std::uint32_t>(volume.offset(x, y, z)));
      }
  return components.count(volume.labels);
}

}  // namespace

std::vector<ChecklistItem> check_mesh_alone(const TetMesh& mesh, double min_dihedral_deg) {
  const std::vector<TetFace> faces = tet_faces(mesh.tets, mesh.points.size());
  const auto infinite = std::count_if(mesh.points.begin(), mesh.points.end(),
                                      [](const Eigen::Vector3d& p) { return !p.allFinite(); });
  const auto crowded = std::count_if(faces.begin(), faces.end(), [](const TetFace& f) { return f.count > 2; });
  const BoundaryFaults faults = boundary_faults(mesh, faces);
  return {none_of("finite_coordinates", static_cast<std::size_t>(infinite), mesh.points.size()),
          none_of("no_inverted_tets", count_inverted(mesh), mesh.tets.size()),
          none_of("no_duplicate_points", count_duplicate_points(mesh), mesh.points.size()),
          none_of("no_duplicate_tets", count_duplicate_tets(mesh), mesh.tets.size()),
          none_of("no_unused_points", count_unused_points(mesh), mesh.points.size()),
          none_of("faces_on_at_most_two_tets", static_cast<std::size_t>(crowded), faces.size()),
          none_of("label_boundaries_closed", faults.open, faults.edges),
          none_of("label_boundaries_manifold", faults.branching, faults.edges, false),
          {"min_dihedral", min_dihedral_deg >= 10, false, shown(min_dihedral_deg) + " deg", ">= 10 deg"}};
}

std::vector<ChecklistItem> check_against_labels(const TetMesh& mesh, const LabelVolume& volume,
                                                const std::vector<LabelFidelity>& fidelity) {
  const std::vector<std::uint32_t> in_mesh = mesh_components(mesh), in_voxels = voxel_components(volume);
  std::string missing, split, off;
  const auto add = [](std::string& list, const std::string& text) { list += (list.empty() ? "" : ", ") + text; };
  for (const LabelFidelity& f : fidelity) {
    const std::string name = "label " + std::to_string(f.label);
    if (f.tets == 0) add(missing, name);
    if (in_mesh[f.label] != in_voxels[f.label])
      add(split, name + " has " + std::to_string(in_mesh[f.label]) + " instead of " + std::to_string(in_voxels[f.label]));
    if (std::abs(f.volume_error_percent) > (f.voxels < 1000 ? 2 : 0.5))
      add(off, name + " " + shown(f.volume_error_percent) + " %");
  }
  const auto found = [](const std::string& list, const char* fine) { return list.empty() ? std::string(fine) : list; };
  return {{"labels_present", missing.empty(), true, missing.empty() ? "all" : "missing: " + missing, "all"},
          {"components_per_label", split.empty(), false, found(split, "as in the voxels"), "as in the voxels"},
          {"label_volumes", off.empty(), false, found(off, "all within"), "0.5 %, below 1000 voxels 2 %"}};
}

}  // namespace voxtet
