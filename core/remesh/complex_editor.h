// Edits of a labelled complex as transactions: checked, then done or refused.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "remesh/change.h"
#include "remesh/complex_mesh.h"
#include "remesh/reference_complex.h"
#include "remesh/sample_hosts.h"
#include "remesh/triangle_hash.h"
#include "types/sizing_field.h"

namespace voxtet::remesh {

struct EditLimits {
  double reach_mm = 0.5;       ///< envelope, both directions
  double lattice_mm = 1;       ///< spacing of the points at which new facets are compared with the reference
  double angle_cosine = 0.95;  ///< planar angles
  double crease_cosine = 0.5;  ///< angles between two facets inside a surface
  double junction_cosine = 0.9;  ///< angles between two facets where curves run
  double gap_share = 0;          ///< least distance of sheets that face each other, in wished edge lengths
  bool verify = false;
};

enum class Demand : std::uint8_t {
  kAllowed,      ///< every limit holds, or what breaks it is no worse than before
  kBetterAngle,  ///< and the smallest planar angle grows; normals count for less
  kBetterFold,   ///< and the sharpest angle between facets grows; normals count for less
};

/// Holds the complex, what it is compared with, and where its triangles are. The complex stays free of
/// self-intersections and within the envelope after every accepted change, if it was so before.
class ComplexEditor {
 public:
  ComplexEditor(const SurfaceMesh& surface, const SizingField& sizing);

  EditLimits limits;

  const ComplexMesh& mesh() const { return mesh_; }
  const ReferenceComplex& reference() const { return reference_; }
  const SampleHosts& samples() const { return samples_; }
  const Eigen::Vector3d& normal(std::uint32_t t) const { return normals_[t]; }
  /// Wished edge length at a vertex, times the scale.
  double size(std::uint32_t v) const { return scale_ * std::max(floor_, sizes_[v]); }
  void set_scale(double scale) { scale_ = scale; }
  /// Every wish as large as the largest.
  void set_coarsest(bool on) { floor_ = on ? *std::max_element(sizes_.begin(), sizes_.end()) : 0; }
  /// Cosine of the sharpest fold allowed at an edge.
  double fold_limit(std::uint32_t u, std::uint32_t w) const {
    return on_curves(u, w) ? limits.junction_cosine : limits.crease_cosine;
  }
  /// Length of an edge in wished lengths.
  double metric_length(std::uint32_t a, std::uint32_t b) const {
    return (mesh_.point(a) - mesh_.point(b)).norm() * 0.5 * (1 / size(a) + 1 / size(b));
  }
  /// A vertex of the reference near v, on a sheet or curve of v's.
  std::uint32_t hint(std::uint32_t v) const { return hints_[v]; }
  /// New cells for the search of near triangles.
  void set_cell(double cell_mm) { hash_.emplace(mesh_, cell_mm); }

  std::uint32_t add_vertex(const Eigen::Vector3d& p, Stratum stratum, std::uint32_t hint);
  void drop_last_vertex();
  /// `hint` replaces that of the moved vertex.
  bool attempt(const Change& change, Demand demand, std::uint32_t hint = kNone);
  /// Books a refusal found before the change was described in full.
  bool refuse(Reason reason) {
    ++refusals_[static_cast<std::size_t>(reason)];
    return false;
  }
  const std::array<std::uint64_t, kReasonNames.size()>& refusals() const { return refusals_; }
  std::uint64_t violations() const { return violations_; }

 private:
  Reason check(const Change& change);
  Reason check_shapes(const Change& change);
  Reason check_envelope(const Change& change) const;
  bool near_reference(const Facet& facet, const Corners& p, std::uint32_t moved) const;
  Reason check_contacts(const Change& change);
  double local_size(const Change& change) const;
  Reason check_pair(const Facet& facet, std::size_t i, const Triangle& other, const Corners& corners,
                    const Eigen::Vector3d& normal, PairId pair, bool boxes_meet);
  bool on_curves(std::uint32_t u, std::uint32_t w) const {
    return mesh_.stratum(u) != Stratum::kSurface && mesh_.stratum(w) != Stratum::kSurface;
  }
  bool fold_allowed(std::uint32_t u, std::uint32_t w, double cosine);
  double old_fold(bool junction) const;
  bool gap_allowed(std::size_t i, const Corners& corners, const Eigen::Vector3d& normal, bool same_pair);
  bool is_removed(std::uint32_t t) const { return t < removed_in_.size() && removed_in_[t] == attempt_; }
  void commit(const Change& change);
  void verify_from_scratch();

  ComplexMesh mesh_;
  ReferenceComplex reference_;
  SampleHosts samples_;
  std::optional<TriangleHash> hash_;
  const SizingField& sizing_;
  double scale_ = 1, floor_ = 0;
  std::vector<double> sizes_;
  std::vector<std::uint32_t> hints_;
  std::vector<Eigen::Vector3d> normals_;
  std::array<std::uint64_t, kReasonNames.size()> refusals_{};
  std::uint64_t violations_ = 0;

  // Of the change under way.
  const Change* change_ = nullptr;
  Demand demand_ = Demand::kAllowed;
  std::uint32_t attempt_ = 0;
  std::vector<std::uint32_t> removed_in_;  ///< by triangle: the attempt that would remove it
  std::vector<Corners> old_corners_, new_corners_;
  std::vector<Eigen::Vector3d> old_normals_, new_normals_;
  std::vector<FloatBox> new_boxes_, wide_boxes_;
  double gap_mm_ = 0;
  std::vector<std::uint32_t> near_, slots_;
};

}  // namespace voxtet::remesh
