#include "quality/checklist.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/with_commas.h"
#include "geometry/elements/tet_measures.h"
#include "geometry/topology/compare_topology.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

/// A volume below this part of its longest edge cubed is as good as none.
constexpr double kFlatVolume = 1e-12;
/// Labels of fewer voxels are held to the wider tolerance of volume.
constexpr std::uint64_t kSmallLabel = 1000;
/// Labels of fewer voxels may be there by mistake.
constexpr std::uint64_t kSpeck = 27;
/// Points closer than this part of the mesh's extent are the same point.
constexpr double kSamePoint = 1e-9;

/// "none of 35,120 tetrahedra", "3 of 35,120 tetrahedra"
ChecklistItem none_of(const std::string& name, std::uint64_t found, std::uint64_t total, const char* things) {
  const std::string of = " of " + with_commas(total) + " " + things;
  return {name, found == 0, true, (found == 0 ? "none" : with_commas(found)) + of, "none"};
}

ChecklistItem all_finite(std::uint64_t infinite, std::uint64_t points) {
  const std::string found = infinite == 0
                                ? "all " + with_commas(points) + " points finite"
                                : with_commas(infinite) + " of " + with_commas(points) + " points not finite";
  return {"finite_coordinates", infinite == 0, true, found, "all finite"};
}

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::size_t count_inverted(const TetMesh& mesh) {
  std::size_t inverted = 0;
  for (const auto& [a, b, c, d] : mesh.tets) {
    const TetCorners p{mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]};
    double longest2 = 0;
    for (const auto& [i, j] : kEdgesOfTet)
      longest2 =
          std::max(longest2, (p[static_cast<std::size_t>(i)] - p[static_cast<std::size_t>(j)]).squaredNorm());
    // Points without a place are counted on their own: what is not a number compares false.
    if (tet_volume_mm3(p) <= kFlatVolume * longest2 * std::sqrt(longest2)) ++inverted;
  }
  return inverted;
}

/// Points with an earlier one closer than kSamePoint, found by a sweep along a direction that no lattice
/// favours.
std::size_t count_duplicate_points(const TetMesh& mesh) {
  const Eigen::Vector3d direction(0.5369, 0.6124, 0.5802);
  Eigen::AlignedBox3d box;
  std::vector<std::pair<double, std::uint32_t>> order;
  order.reserve(mesh.points.size());
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
    if (!mesh.points[i].allFinite()) continue;
    box.extend(mesh.points[i]);
    order.emplace_back(mesh.points[i].dot(direction), i);
  }
  if (order.empty()) return 0;
  const double near = kSamePoint * box.sizes().maxCoeff();
  std::sort(order.begin(), order.end());
  std::size_t duplicates = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i; j > 0 && order[i].first - order[j - 1].first <= near; --j)
      if ((mesh.points[order[i].second] - mesh.points[order[j - 1].second]).norm() <= near) {
        ++duplicates;
        break;
      }
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

/// Whether a triangle's normal points away from a tetrahedron that it is a face of.
bool points_away(const TetMesh& mesh, const Triangle& t, std::uint32_t tet) {
  for (const std::uint32_t apex : mesh.tets[tet])
    if (apex != t[0] && apex != t[1] && apex != t[2])
      return tet_volume_mm3({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[apex]}) < 0;
  return false;
}

/// Faces that `mesh.faces` lacks, has twice or too many of, or that have other sides or point the other way.
std::size_t count_wrong_faces(const TetMesh& mesh, std::span<const TetFace> tet_faces) {
  std::vector<std::pair<Triangle, std::size_t>> given;
  given.reserve(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    given.emplace_back(mesh.faces[f], f);
    std::sort(given.back().first.begin(), given.back().first.end());
  }
  std::sort(given.begin(), given.end());
  std::size_t wrong = 0, at = 0;
  for (const TetFace& face : tet_faces) {
    const Label first = mesh.labels[face.first];
    const Label second = face.count > 1 ? mesh.labels[face.second] : kBackground;
    if (first == second) continue;
    for (; at < given.size() && given[at].first < face.corners; ++at) ++wrong;
    if (at == given.size() || given[at].first != face.corners) {
      ++wrong;
      continue;
    }
    const std::size_t f = given[at++].second;
    const std::uint32_t behind = first > second ? face.first : face.second;
    if (mesh.face_sides[f] != Sides{std::max(first, second), std::min(first, second)} ||
        !points_away(mesh, mesh.faces[f], behind))
      ++wrong;
  }
  return wrong + given.size() - at;
}

/// Labels of which fewer than a third of the voxels have six neighbours alike: about three voxels thick or
/// less.
std::vector<bool> thin_labels(const LabelVolume& volume) {
  std::vector<std::uint64_t> voxels(65536, 0), inner(65536, 0);
  volume.visit([&](int i, int j, int k, std::size_t voxel) {
    const Label label = volume.labels[voxel];
    if (label == kBackground) return;
    ++voxels[label];
    const auto like = [&](int x, int y, int z) { return volume.at_or_background(x, y, z) == label; };
    if (like(i - 1, j, k) && like(i + 1, j, k) && like(i, j - 1, k) && like(i, j + 1, k) &&
        like(i, j, k - 1) && like(i, j, k + 1))
      ++inner[label];
  });
  std::vector<bool> thin(65536);
  for (std::size_t label = 0; label < thin.size(); ++label) thin[label] = 3 * inner[label] < voxels[label];
  return thin;
}

/// Joined by commas, the first few in full.
std::string listed(const std::vector<std::string>& items, const char* none) {
  constexpr std::size_t kShown = 8;
  std::string text;
  for (std::size_t i = 0; i < items.size() && i < kShown; ++i) text += (i == 0 ? "" : ", ") + items[i];
  if (items.size() > kShown) text += " and " + std::to_string(items.size() - kShown) + " more";
  return items.empty() ? none : text;
}

/// With what brings the volume nearer: edges that the label has room for, or no such label.
void warn_of_volume(const LabelFidelity& f, double limit_percent, const RunContext& ctx) {
  // Of a label of a voxel the edges stay longer than asked for: its corners are as far apart as they are.
  double edge_mm = std::cbrt(f.voxel_mm3);
  for (const double length : {f.median_edge_mm, f.target_edge_mm})
    if (length > 0) edge_mm = std::min(edge_mm, length);
  edge_mm /= 2;
  char text[320];
  std::snprintf(text, sizeof text,
                "label %d of %llu voxels (%.3g mm3) has %.1f %% %s volume in the mesh, allowed are %g %%: a "
                "smaller edge length inside it brings it nearer (sizing.labels, --edge-label %d=%.2g)",
                static_cast<int>(f.label), static_cast<unsigned long long>(f.voxels), f.voxel_mm3,
                std::abs(f.volume_error_percent), f.volume_error_percent < 0 ? "less" : "more", limit_percent,
                static_cast<int>(f.label), edge_mm);
  std::string warning = text;
  if (f.voxels < kSpeck)
    warning += "; volume.speck_voxels=" + std::to_string(f.voxels + 1) + " leaves it out";
  ctx.warn(kQualityStage, warning);
}

}  // namespace

std::vector<ChecklistItem> check_mesh_alone(const TetMesh& mesh, std::span<const TetFace> faces,
                                            const TopologyLedger& ledger, double min_dihedral_deg) {
  const auto infinite = std::count_if(mesh.points.begin(), mesh.points.end(),
                                      [](const Eigen::Vector3d& p) { return !p.allFinite(); });
  const auto crowded =
      std::count_if(faces.begin(), faces.end(), [](const TetFace& f) { return f.count > 2; });
  std::uint64_t open = 0, edges = 0, points = 0;
  for (const LabelTopology& t : ledger.labels) {
    open += t.open_edges;
    edges += t.pinched_edges;
    points += t.pinched_points;
  }
  const std::string pinched =
      edges + points == 0 ? "pinched nowhere"
                          : "pinched at " + with_commas(edges) + " edges, " + with_commas(points) + " points";
  return {all_finite(static_cast<std::uint64_t>(infinite), mesh.points.size()),
          none_of("no_inverted_tets", count_inverted(mesh), mesh.tets.size(), "tetrahedra"),
          none_of("no_duplicate_points", count_duplicate_points(mesh), mesh.points.size(), "points"),
          none_of("no_duplicate_tets", count_duplicate_tets(mesh), mesh.tets.size(), "tetrahedra"),
          none_of("no_unused_points", count_unused_points(mesh), mesh.points.size(), "points"),
          none_of("faces_on_at_most_two_tets", static_cast<std::uint64_t>(crowded), faces.size(), "faces"),
          {"label_boundaries_closed", open == 0, true, (open == 0 ? "no" : with_commas(open)) + " open edges",
           "no open edges"},
          {"label_boundaries_manifold", edges + points == 0, false, pinched, "pinched nowhere"},
          {"min_dihedral", min_dihedral_deg >= 10, false, shown(min_dihedral_deg) + " deg", ">= 10 deg"}};
}

std::vector<ChecklistItem> check_against_labels(const TetMesh& mesh, std::span<const TetFace> faces,
                                                const LabelVolume& volume,
                                                const std::vector<LabelFidelity>& fidelity,
                                                const std::vector<TopologyDifference>& differences,
                                                const RunContext& ctx) {
  std::vector<std::uint8_t> wanted(65536, 0);
  for (const Label label : volume.labels) wanted[label] = 1;
  const std::vector<bool> thin = thin_labels(volume);
  std::vector<std::string> wrong, changed, off;
  for (const LabelFidelity& f : fidelity) {
    const std::string name = "label " + std::to_string(f.label);
    if (f.tets == 0 && wanted[f.label]) wrong.push_back(name + " is missing");
    if (f.tets > 0 && !wanted[f.label]) wrong.push_back(name + " is not in the voxels");
    if (f.tets == 0 || f.voxels == 0 || !wanted[f.label]) continue;
    const double limit = thin[f.label] || f.voxels < kSmallLabel ? 2 : 0.5;
    if (std::abs(f.volume_error_percent) <= limit) continue;
    off.push_back(name + " " + shown(f.volume_error_percent) + " %");
    warn_of_volume(f, limit, ctx);
  }
  if (const auto count = std::count(mesh.labels.begin(), mesh.labels.end(), kBackground); count > 0)
    wrong.push_back(std::to_string(count) + " tetrahedra of background");
  for (const TopologyDifference& d : differences) changed.push_back(in_words(d));
  return {
      none_of("faces_match_tets", count_wrong_faces(mesh, faces), mesh.faces.size(), "boundary facets"),
      {"labels_present", wrong.empty(), true, listed(wrong, "those of the voxels"), "those of the voxels"},
      {"topology_kept", changed.empty(), false, listed(changed, "as the label surface"),
       "components, cavities, handles and contacts as the label surface has them"},
      {"label_volumes", off.empty(), false, listed(off, "all"), "within 0.5 %, or 2 % where small or thin"}};
}

std::vector<ChecklistItem> check_exact_layers(std::span<const LayerCount> layers) {
  std::vector<ChecklistItem> items;
  for (const LayerCount& count : layers) {
    if (!count.shall_be_exact) continue;
    char found[64], expected[64];
    std::snprintf(found, sizeof found, "%u on %.1f %% of the area", count.target_layers,
                  100 * count.by_edges.exact);
    std::snprintf(expected, sizeof expected, "%u on %.0f %% or more", count.target_layers,
                  100 * LayerCount::kNearlyAll);
    items.push_back({"exact_layers", count.counted() && !count.given_up(), false,
                     count.counted() ? found : "not counted: all is near the wall's sides", expected});
  }
  return items;
}

}  // namespace voxtet
