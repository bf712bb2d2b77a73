// Where an adapted surface fails to follow the label surface.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "remesh/delaunay/seed_junctions.h"
#include "remesh/field/label_field.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet::remesh {

struct MissedCriteria {
  double limit_mm;       ///< farther than this from the surface counts as missed
  double separation_mm;  ///< least distance between the places returned
  /// Around these labels (ascending) the search is thorough: at the suspect voxels, or everywhere if there
  /// are none. Every other triangle of the reference is a sample there, not only some 100,000 of all. A
  /// sample also counts as missed where the closest triangle is turned by more than an angle: a lid may be
  /// near the wall of a tunnel, but is not parallel to it.
  std::vector<Label> thorough = {};
  std::vector<bool> suspects = {};  ///< SuspectVoxels::of for the surface and these labels
  double turned_cosine = 0.3;       ///< cosine of that angle
  double narrow_share = 1;          ///< factor on the limit where these labels are narrow
};

/// Where a series of surfaces misses a reference. Refers to the reference and its field.
class MissedPlaces {
 public:
  MissedPlaces(const SurfaceMesh& reference, const LabelField& field);

  /// Samples are centroids of the reference's triangles, evenly through its list. Returns those that are
  /// farther than the limit from the triangles of `surface` between the same two labels. Each is moved along
  /// its normal onto the field's interface of the two labels, or left out if that is farther away than the
  /// limit. Grouped by labels, in the order of the reference. The triangle that was near a sample in the last
  /// call is tried first, if it still exists. Ends early, with only some of them, when cancelled.
  std::vector<Eigen::Vector3d> of(const SurfaceMesh& surface, const MissedCriteria& criteria,
                                  const RunContext& ctx = {});

 private:
  class NamedTriangles;
  /// Whether the surface follows a sample.
  struct Question {
    std::size_t sample = 0;  ///< place in samples_
    double limit_mm = 0;     ///< 0: not asked
    bool thorough = false, is_missed = false;
  };
  std::vector<Question> questions_between(std::size_t first, std::size_t last, const MissedCriteria& criteria,
                                          int threads) const;
  std::vector<Question> answered(const std::vector<Question>& questions, const SurfaceMesh& surface,
                                 std::span<const std::uint32_t> ids, const std::vector<std::uint64_t>& names,
                                 const NamedTriangles& named, const MissedCriteria& criteria, int threads);
  void add_missed(const std::vector<Question>& questions, double separation_mm,
                  std::vector<Eigen::Vector3d>& missed) const;

  const SurfaceMesh& reference_;
  const LabelField& field_;
  std::vector<std::uint32_t> samples_;      ///< triangles that may be samples, by their two labels
  std::vector<std::uint64_t> followed_by_;  ///< for each sample, the name of the triangle that was last
                                            ///< closest
};

/// Points on the field's interfaces of these pairs of labels (ascending, the higher label of each pair
/// first), near the reference's triangles between them and about `spacing_mm` apart: for contacts so small
/// that none of a few points on them becomes a facet. Those farther than `reach_mm` from their triangle are
/// left out.
std::vector<Eigen::Vector3d> points_between(const SurfaceMesh& reference, const LabelField& field,
                                            const std::vector<Sides>& pairs, double spacing_mm,
                                            double reach_mm);

/// A point of a reference that is far from a surface, and the surface's triangle that is closest.
struct FarPoint {
  Eigen::Vector3d point;
  std::uint32_t triangle;
};

/// Points of the reference that are farther than the limit from the triangles of `surface` between the same
/// two labels; layers count as their parents. A point has one entry for every two labels that meet there, in
/// their order.
std::vector<FarPoint> far_points(const SurfaceMesh& reference, const SurfaceMesh& surface,
                                 const WallLayers& layers, double limit_mm);

/// Points on the junction curves of `reference` (`edges`: its junction_edges). First the middles of its edges
/// that are farther than the limit from the junction curves of `surface`. Then, for middles of the surface's
/// junction edges that are farther than the limit from the reference's curves, the closest points on these.
/// In the order of the edges.
std::vector<Eigen::Vector3d> missed_junctions(const SurfaceMesh& reference, const std::vector<Edge>& edges,
                                              const SurfaceMesh& surface, double limit_mm);

}  // namespace voxtet::remesh
