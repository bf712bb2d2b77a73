// The evidence: distributions of element measures, fidelity to the labels, and a pass/fail checklist.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "types/field.h"
#include "types/label_volume.h"
#include "types/topology_ledger.h"

namespace voxtet {

/// Equal bins over [lo, hi]; values outside are counted in the first or last bin.
struct Histogram {
  double lo = 0, hi = 1;
  std::vector<std::uint64_t> counts;
};

/// The distribution of one measure over elements. `worst` holds up to 100 element ids, worst first.
struct MetricSummary {
  std::string name;      ///< e.g. "min_dihedral_deg"
  std::string title;     ///< for people; may be empty
  std::string unit;      ///< "deg", "mm", "1", "log2"
  std::string elements;  ///< what was measured: "tets", "edges", "triangles"
  std::uint64_t count = 0;
  double min = 0, p01 = 0, p1 = 0, p5 = 0, median = 0, p95 = 0, p99 = 0, max = 0, mean = 0, sd = 0;
  Histogram histogram;
  std::vector<std::uint32_t> worst;
};

/// Distances from samples on one surface to another surface, mm. Between two points a distance changes by no
/// more than the points are apart. So mean, rms and p95 are those of the whole surface to within
/// `spacing_mm`, the longest edge of the sample lattices, and no point between samples is farther than
/// `max_mm + uncertainty_mm`.
struct DistanceSummary {
  std::uint64_t samples = 0;
  double spacing_mm = 0;
  double mean_mm = 0, rms_mm = 0, p95_mm = 0, max_mm = 0, uncertainty_mm = 0;
};

struct LabelFidelity {
  Label label = 0;
  std::uint64_t voxels = 0, tets = 0;
  double voxel_mm3 = 0, mesh_mm3 = 0, volume_error_percent = 0;
  double dice = 0;            ///< mesh sampled at voxel centres against the voxels
  double median_edge_mm = 0;  ///< over edges of tets of this label
  double target_edge_mm = 0;  ///< median of the sizing field over the same edges' midpoints
};

/// One number in which two ledgers differ.
struct TopologyDifference {
  std::string what;  ///< name of a field of LabelTopology; or "label" or "contact", whose number is 1 if it
                     ///< exists, else 0
  Label label = 0;
  Label other = 0;  ///< the second label of a contact
  std::int64_t before = 0, after = 0;
};

struct TopologyComparison {
  TopologyLedger before;  ///< of the label surface
  TopologyLedger after;   ///< of the mesh
  std::vector<TopologyDifference> differences;
};

/// Area of a wall's outer surface by the number of layers beneath it.
struct LayerShares {
  std::vector<double> area_mm2;    ///< index: number of layers
  double exact = 0, at_least = 0;  ///< shares of the area with exactly, and with at least, the number of
                                   ///< layers asked for
};

/// A connected part of a wall's outer surface with another number of layers than asked for.
struct LayerPlace {
  double area_mm2 = 0;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  std::uint32_t fewest = 0, most = 0;  ///< layers found there
};

/// The layers of one wall, counted in two ways (walls/count_layers.h).
struct LayerCount {
  /// Of the counted area, as little as layers that shall be exact may have.
  static constexpr double kNearlyAll = 0.97;

  std::vector<Label> wall;
  std::uint32_t target_layers = 0;
  bool shall_be_exact = false;  ///< by sheets across the wall, not by size alone
  LayerShares by_edges, by_lines;
  std::vector<LayerPlace> places;  ///< counted by edges; the ten largest, largest first

  /// False where no part of the outer surface lies far enough from the wall's sides.
  bool counted() const {
    return std::any_of(by_edges.area_mm2.begin(), by_edges.area_mm2.end(),
                       [](double area) { return area > 0; });
  }
  /// Whether layers that shall be exact are not, over more of the area than may be.
  bool given_up() const { return shall_be_exact && counted() && by_edges.exact < kNearlyAll; }
};

struct ChecklistItem {
  std::string name;  ///< e.g. "no_inverted_tets"
  bool passed = false;
  bool hard = true;  ///< a failed hard item makes the mesh unusable
  std::string found, expected;
};

struct QualityReport {
  std::vector<MetricSummary> metrics;
  std::vector<LabelFidelity> labels;
  DistanceSummary mesh_to_surface, surface_to_mesh;  ///< mesh boundary against the label surface
  TopologyComparison topology;
  std::vector<LayerCount> layers;  ///< one per wall for which a number of layers was asked for
  /// Measures of tetrahedra (quality/tet_measure_table.h). If numbers of layers were asked for, also `layer`
  /// and `layers_across` (quality/count_layers.h). If there is a label surface to compare with, also
  /// `distance_mm` and `distance_voxels` on points.
  std::vector<Field> fields;
  std::vector<ChecklistItem> checklist;

  bool passed() const {
    for (const ChecklistItem& item : checklist)
      if (item.hard && !item.passed) return false;
    return true;
  }
};

}  // namespace voxtet
