#include "remesh/delaunay/delaunay_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

#include "geometry/cut/cut_faces.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/repair/undo_intersections.h"
#include "geometry/topology/compare_topology.h"
#include "geometry/topology/label_topology.h"
#include "remesh/cells/cut_folds.h"
#include "remesh/cells/extract_interface.h"
#include "remesh/cells/interface_edges.h"
#include "remesh/cells/make_two_manifold.h"
#include "remesh/cells/mend_contacts.h"
#include "remesh/cells/remove_islands.h"
#include "remesh/cells/remove_wedges.h"
#include "remesh/delaunay/delaunay_refiner.h"
#include "remesh/delaunay/find_missed.h"
#include "remesh/delaunay/fit_surface.h"
#include "remesh/delaunay/relax_surface.h"
#include "remesh/delaunay/seed_interfaces.h"
#include "remesh/delaunay/suspect_voxels.h"
#include "remesh/field/label_field.h"
#include "types/stage_names.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

/// Measured on hearts, aorta and spheres: the median edge of a relaxed surface is 1.32 times the largest
/// radius allowed for the surface Delaunay balls.
constexpr double kEdgePerRadius = 1.32;
constexpr double kSeedSeparation = 0.25;  ///< between first points, in units of the smallest spacing
constexpr double kLeastSeedSpacing = 1;   ///< of seeds that are not halved once more
/// Between points added in walls with layers, in target edge lengths, unless the topology is at stake.
constexpr double kLayerSeparation = 0.4;
constexpr double kPassedOverDepth = 0.06;  ///< of a cell's centroid in another label, in the same units

/// How a surface is refined where it does not follow the reference; lengths in units of the smallest spacing.
struct Repair {
  bool thorough;              ///< with a closer look around labels whose topology differs
  double separation;          ///< between points added where the surface missed something
  double least_facet_radius;  ///< of a facet that is refined to open a pinch or a channel
  double turned_cosine;       ///< of the largest angle between reference and surface
  double narrow_share = 1;    ///< of what counts as missed, in narrow places of those labels
  bool relabels = false;      ///< if cells that change labels do not mend the contacts
  bool dense = false;         ///< with many points on contacts of labels that are lost
};
/// One after the other, until there is nothing to repair. The last ones come more than once: what one adds
/// may show the next another place.
constexpr std::array<Repair, 9> kRepairs{{{false, 0.5, 0.3, 0},
                                          {true, 0.3, 0.2, 0.3},
                                          {true, 0.15, 0.1, 0.5, 0.4},
                                          {true, 0.09, 0.05, 0.7, 0.2},
                                          {true, 0.09, 0.05, 0.7, 0.2, true, true},
                                          {true, 0.09, 0.05, 0.7, 0.2, true, true},
                                          {true, 0.06, 0.03, 0.7, 0.1, true, true},
                                          {true, 0.06, 0.03, 0.7, 0.1, true, true},
                                          {true, 0.06, 0.03, 0.7, 0.1, true, true}}};
constexpr double kLeastFoldedRadius = 0.1;  ///< of a facet folded upon a cut, in the same units
constexpr double kContactReach =
    0.5;  ///< of cells that change labels around a lost contact, in the same units
constexpr double kDenseSpacing = 0.03;  ///< of points on lost contacts, in the same units

double facet_area2(const LabelledCells& cells, const InterfaceFacet& facet) {
  const auto point = [&](std::size_t c) {
    return cells.points[cells.vertices[facet.cell][kFacetCorners[facet.corner][c]]];
  };
  return (point(1) - point(0)).cross(point(2) - point(0)).squaredNorm();
}

/// The largest facet at each edge and point where the boundary of a label touches itself.
std::vector<InterfaceFacet> facets_at_pinches(const LabelledCells& cells, const Pinches& pinches) {
  const InterfaceEdges& edges = pinches.edges;
  constexpr std::uint32_t kNone = LabelledCells::kNone;
  std::vector<InterfaceFacet> out;
  for (const std::uint32_t edge : pinches.at_edges) {
    std::uint32_t largest = edges.facet_of[edges.start[edge]];
    for (std::uint32_t k = edges.start[edge]; k < edges.start[edge + 1]; ++k)
      if (facet_area2(cells, edges.facets[edges.facet_of[k]]) > facet_area2(cells, edges.facets[largest]))
        largest = edges.facet_of[k];
    out.push_back(edges.facets[largest]);
  }
  const std::vector<std::uint32_t>& points = pinches.at_points;
  if (points.empty()) return out;
  std::vector<std::uint32_t> slot(cells.points.size(), kNone), largest(points.size(), kNone);
  for (std::uint32_t i = 0; i < points.size(); ++i) slot[points[i]] = i;
  for (std::uint32_t f = 0; f < edges.facets.size(); ++f)
    for (const std::uint32_t k : kFacetCorners[edges.facets[f].corner]) {
      const std::uint32_t i = slot[cells.vertices[edges.facets[f].cell][static_cast<std::size_t>(k)]];
      if (i == kNone) continue;
      if (largest[i] == kNone ||
          facet_area2(cells, edges.facets[f]) > facet_area2(cells, edges.facets[largest[i]]))
        largest[i] = f;
    }
  for (const std::uint32_t f : largest) out.push_back(edges.facets[f]);
  return out;
}

std::vector<Eigen::Vector3d> places_of(const LabelledCells& cells, const Pinches& pinches) {
  std::vector<Eigen::Vector3d> places;
  for (const std::uint32_t p : pinches.points()) places.push_back(cells.points[p]);
  return places;
}

std::int64_t size_of(const std::vector<TopologyDifference>& differences) {
  std::int64_t size = 0;
  for (const TopologyDifference& difference : differences)
    size += std::abs(difference.after - difference.before);
  return size;
}

/// Labels whose topology or contacts differ, background left out; ascending.
std::vector<Label> labels_of(const std::vector<TopologyDifference>& differences) {
  std::vector<Label> labels;
  for (const TopologyDifference& difference : differences)
    for (const Label label : {difference.label, difference.other})
      if (label != kBackground) labels.push_back(label);
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

/// The pairs of labels that a surface parts, ascending.
std::vector<Sides> pairs_of(const SurfaceMesh& surface) {
  std::vector<Sides> pairs;
  std::unique_copy(surface.sides.begin(), surface.sides.end(), std::back_inserter(pairs));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// The area between two labels in squared target edge lengths.
double area_between(const SurfaceMesh& surface, const Sides& sides, const SizingField& sizing) {
  double area = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.sides[t] != sides) continue;
    const auto& [a, b, c] = surface.triangles[t];
    const Vector3d &p = surface.points[a], &q = surface.points[b], &r = surface.points[c];
    const double h = sizing.at((p + q + r) / 3);
    area += 0.5 * triangle_cross(p, q, r).norm() / (h * h);
  }
  return area;
}

/// Those of some pairs of labels that a surface does not part.
std::vector<Sides> lost_pairs(const std::vector<Sides>& pairs, const SurfaceMesh& surface) {
  const std::vector<Sides> taken = pairs_of(surface);
  std::vector<Sides> out;
  std::set_difference(pairs.begin(), pairs.end(), taken.begin(), taken.end(), std::back_inserter(out));
  return out;
}

/// Of these pairs of labels those that have room for more than seeds enough between them in the reference,
/// and no triangle in the surface: among so few points all circumcentres may lie outside of a wall that is
/// thin beside its edges.
std::vector<Sides> not_taken(const std::vector<Sides>& pairs, const SurfaceMesh& reference,
                             const SizingField& sizing, const SurfaceMesh& surface) {
  std::vector<Sides> out = lost_pairs(pairs, surface);
  std::erase_if(out, [&](const Sides& sides) {
    return area_between(reference, sides, sizing) <= kSeedsOfInterface * kSeedSpacing * kSeedSpacing;
  });
  return out;
}

/// Contacts that are lost, with the middles of the reference's triangles there.
std::vector<LostContact> lost_contacts(const std::vector<Sides>& lost, const SurfaceMesh& reference) {
  std::vector<LostContact> out;
  out.reserve(lost.size());
  for (const auto& [high, low] : lost) out.push_back({{low, high}, {}});
  for (std::size_t t = 0; t < reference.triangles.size(); ++t) {
    const auto found = std::lower_bound(lost.begin(), lost.end(), reference.sides[t]);
    if (found == lost.end() || *found != reference.sides[t]) continue;
    const auto& [a, b, c] = reference.triangles[t];
    out[static_cast<std::size_t>(found - lost.begin())].places.push_back(
        (reference.points[a] + reference.points[b] + reference.points[c]) / 3);
  }
  return out;
}

/// Cells in which the labels of the volume touch as they are to, as far as that succeeds.
LabelledCells with_contacts(const LabelledCells& cells, const LabelField& field, const TopologyLedger& wanted,
                            const std::vector<LostContact>& lost, const RunContext& ctx) {
  const WallLayers& layers = field.layers();
  LabelledCells merged = cells, out = cells;
  for (Label& label : merged.labels) label = layers.parent(label);
  mend_contacts(merged, wanted.contacts, lost, kContactReach * field.grid().smallest_spacing_mm(), ctx);
  for (std::uint32_t c = 0; c < cells.labels.size(); ++c)
    if (merged.labels[c] != layers.parent(cells.labels[c]))
      out.labels[c] = layers.at(merged.labels[c], cells.centroid(c));
  if (!layers.empty()) make_two_manifold(out, field, find_pinches(out));
  return out;
}

/// The surface that came nearest to a topology.
struct Nearest {
  SurfaceMesh surface;
  std::int64_t differences;
};

/// The volumes that labels and their layers are to have: a layer, and what of its parent lies outside of the
/// wall, keeps its part of the parent's.
std::vector<double> with_layers_mm3(std::vector<double> volumes, const SurfaceMesh& surface,
                                    const WallLayers& layers) {
  const std::vector<double> now = enclosed_volumes_mm3(surface);
  std::vector<double> parents(volumes.size(), 0);
  for (std::size_t l = 1; l < now.size(); ++l) parents[layers.parent(static_cast<Label>(l))] += now[l];
  const std::vector<double> whole = volumes;
  volumes.resize(std::max(volumes.size(), now.size()), 0);
  for (std::size_t l = 1; l < now.size(); ++l) {
    const Label parent = layers.parent(static_cast<Label>(l));
    const bool is_part = parent != l || now[l] != parents[l];
    if (is_part && parents[parent] > 0) volumes[l] = now[l] * whole[parent] / parents[parent];
  }
  return volumes;
}

}  // namespace

Result<SurfaceMesh> delaunay_surface(const LabelField& field, const SurfaceMesh& reference,
                                     const TopologyLedger& wanted, const SizingField& sizing,
                                     const DelaunayParams& params, RunContext& ctx, const CutPlanes& cuts) {
  const double voxel = field.grid().smallest_spacing_mm();
  const VoxelPieces pieces = find_pieces(field);
  const std::vector<double> volumes = enclosed_volumes_mm3(reference);
  const Seeds seeds = seed_interfaces(field, reference, sizing, ctx);
  if (ctx.cancelled()) return cancelled_error(kRemeshStage);
  DelaunayRefiner refiner(field, sizing,
                          {params.facet_angle_deg, params.max_distance_voxels * voxel, 1 / kEdgePerRadius});
  refiner.insert(seeds.points, kSeedSeparation * voxel);
  if (ctx.cancelled()) return cancelled_error(kRemeshStage);
  MissedPlaces places(reference, field);
  const SuspectVoxels suspect_voxels(reference, field);
  const std::vector<Edge> junctions = junction_edges(reference);
  const std::vector<Sides> pairs = pairs_of(reference);
  double seed_spacing = kSeedSpacing;
  std::optional<Nearest> nearest;
  auto repair = kRepairs.begin();
  bool was_sound = false;
  for (;;) {
    if (!refiner.refine(ctx, std::max(seeds.predicted_vertices, static_cast<double>(refiner.vertex_count()))))
      return cancelled_error(kRemeshStage);
    LabelledCells cells = refiner.cells();
    std::vector<InterfaceFacet> flawed;
    remove_islands(cells, field, pieces, &flawed);
    if (ctx.cancelled()) return cancelled_error(kRemeshStage);
    const Pinches pinches = find_pinches(cells);
    const std::vector<InterfaceFacet> pinched = facets_at_pinches(cells, pinches);
    flawed.insert(flawed.end(), pinched.begin(), pinched.end());
    const std::vector<InterfaceFacet> folded = find_cut_folds(cuts, cells, pinches.edges.facets);
    make_two_manifold(cells, field, pinches);
    if (ctx.cancelled()) return cancelled_error(kRemeshStage);
    remove_wedges(cells);
    remove_cut_folds(cuts, cells);
    remove_islands(cells, field, pieces);
    mend_parents(cells, field);
    SurfaceMesh surface = extract_interface(cells);
    if (ctx.cancelled()) return cancelled_error(kRemeshStage);
    SurfaceMesh merged = merge_layers(surface, field.layers());
    if (seed_spacing > kLeastSeedSpacing)
      if (const std::vector<Sides> lacking = not_taken(pairs, reference, sizing, merged); !lacking.empty()) {
        seed_spacing /= 2;
        refiner.insert(seed_between(field, sizing, seed_spacing, lacking, ctx), kSeedSeparation * voxel);
        continue;
      }
    std::optional<std::vector<Label>> broken;
    std::vector<bool> suspects;  // empty: none, or all
    const auto compare = [&] {
      if (broken) return;
      std::vector<TopologyDifference> differences =
          compare_topology(wanted, topology_before(cuts, label_topology(merged)));
      if (!differences.empty() && !ctx.cancelled() && (repair == kRepairs.end() || repair->relabels)) {
        LabelledCells mended =
            with_contacts(cells, field, wanted, lost_contacts(lost_pairs(pairs, merged), reference), ctx);
        SurfaceMesh other = extract_interface(mended), other_merged = merge_layers(other, field.layers());
        std::vector<TopologyDifference> left =
            compare_topology(wanted, topology_before(cuts, label_topology(other_merged)));
        if (size_of(left) < size_of(differences)) {
          cells = std::move(mended);
          surface = std::move(other);
          merged = std::move(other_merged);
          differences = std::move(left);
        }
      }
      broken = labels_of(differences);
      const std::int64_t size = size_of(differences);
      if (!nearest || size <= nearest->differences) nearest = {surface, size};
      if (!broken->empty() && !ctx.cancelled())
        suspects = suspect_voxels.of(merged, *broken, places_of(cells, find_pinches(cells)), ctx.threads);
    };
    std::size_t added = 0;
    for (; repair != kRepairs.end() && added == 0; ++repair) {
      if (repair->thorough) compare();
      if (ctx.cancelled()) return cancelled_error(kRemeshStage);
      // Where the topology is as wanted, mending has done away with what was flawed; what is still far from
      // the reference then is left to the improvement of the surface.
      const bool sound = repair->thorough && broken->empty();
      if (sound && was_sound && folded.empty()) break;
      was_sound = sound;
      std::vector<Eigen::Vector3d> missed =
          missed_junctions(reference, junctions, merged, params.missed_voxels * voxel);
      if (ctx.cancelled()) return cancelled_error(kRemeshStage);
      const std::vector<Eigen::Vector3d> elsewhere = places.of(
          merged,
          {params.missed_voxels * voxel, repair->separation * voxel, broken ? *broken : std::vector<Label>{},
           suspects, repair->turned_cosine, repair->narrow_share},
          ctx);
      if (ctx.cancelled()) return cancelled_error(kRemeshStage);
      missed.insert(missed.end(), elsewhere.begin(), elsewhere.end());
      if (repair->thorough && !sound)
        for (const Eigen::Vector3d& p : refiner.passed_over(kPassedOverDepth * voxel))
          if (suspects.empty() || suspects[field.nearest_voxel(p)]) missed.push_back(p);
      // These first, because new points do away with cells.
      for (const InterfaceFacet& facet : folded)
        added += refiner.request(facet.cell, facet.corner, kLeastFoldedRadius * voxel);
      if (!sound)
        for (const InterfaceFacet& facet : flawed)
          added += refiner.request(facet.cell, facet.corner, repair->least_facet_radius * voxel);
      if (ctx.cancelled()) return cancelled_error(kRemeshStage);
      // Layers need room: points close to others only where the topology is not as wanted.
      const auto at_stake = [&](const Vector3d& p) {
        return field.layers().empty() ||
               (!sound && repair->thorough && (suspects.empty() || suspects[field.nearest_voxel(p)]));
      };
      const auto rest = std::stable_partition(missed.begin(), missed.end(), at_stake);
      added += refiner.insert({missed.begin(), rest}, repair->separation * voxel);
      added += refiner.insert({rest, missed.end()}, repair->separation * voxel, kLayerSeparation);
      if (repair->dense && !sound)
        added += refiner.insert(points_between(reference, field, lost_pairs(pairs, merged),
                                               kDenseSpacing * voxel, params.missed_voxels * voxel),
                                kDenseSpacing * voxel);
      if (sound && added == 0) break;
    }
    if (added > 0) continue;
    compare();
    if (ctx.cancelled()) return cancelled_error(kRemeshStage);
    surface = std::move(nearest->surface);
    const std::vector<Eigen::Vector3d> unmoved = surface.points;
    relax_surface(surface, sizing);
    if (ctx.cancelled() ||
        !fit_surface(surface, field, reference, with_layers_mm3(volumes, surface, field.layers()), ctx))
      return cancelled_error(kRemeshStage);
    if (undo_intersections(surface, unmoved, ctx).cancelled) return cancelled_error(kRemeshStage);
    return surface;
  }
}

}  // namespace voxtet::remesh
