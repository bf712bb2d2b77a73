// The continuous label field whose interfaces are meshed: argmax over the labels' signed distances to the
// smoothed label surface.
//
// Every label, background included, has a signed distance to its boundary, positive inside, known at voxel
// centres and interpolated between them; the label of a point is the one whose distance is largest. Because
// background competes like any other label, no cusps of background open along label interfaces. The
// interpolation follows the extraction, so that diagonal neighbours join where they do on the surface:
// trilinear for one label, and between voxel centres it joins no more than the extraction
// (resolve_face_ambiguity.h); linear on the Kuhn tetrahedra for several, and no label closes a way between
// two others that the extraction leaves open (keep_contacts_open.h).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/topology/label_components.h"
#include "remesh/field/label_distances.h"
#include "types/grid.h"
#include "types/label_volume.h"
#include "types/surface_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet::remesh {

/// The field on a grid padded by `kPad` background voxels on all sides. Immutable once built; outside of the
/// grid everything is background.
class LabelField {
 public:
  static constexpr int kPad = 2;

  /// `surface`: the smoothed boundary complex of the labels of `volume` (mm), each vertex within half a voxel
  /// or so of where it was extracted. The labels at voxel centres are those of the volume. Labels that have
  /// `layers` are replaced by these, so that the field also has the sheets inside of walls. `layers` must
  /// outlive this.
  LabelField(const LabelVolume& volume, const SurfaceMesh& surface, const WallLayers& layers = kNoLayers,
             int threads = 1);

  /// Label at a patient-space point (mm).
  Label at(const Eigen::Vector3d& mm) const { return layers_.at(at_index(to_index(mm)), mm); }
  /// Label of the volume, without layers, at a continuous index of the padded grid.
  Label at_index(const Eigen::Vector3d& index) const;

  /// A point where the label changes on the segment from `a` to `b` (mm): the one nearest to `a`, as far as
  /// bisection can tell. Needs at(a) == label_a, at(b) == label_b and label_a != label_b. The point lies
  /// within 1e-4 voxel of the interface, on the side of label_a; `other` is the label behind it.
  Eigen::Vector3d crossing(const Eigen::Vector3d& a, Label label_a, const Eigen::Vector3d& b, Label label_b,
                           Label& other) const;

  /// Direction in mm in which the distance of label `a` grows most against that of label `b` at a point; zero
  /// where one of the two cannot win in that cell. Not normalised.
  Eigen::Vector3d gradient(const Eigen::Vector3d& mm, Label a, Label b) const;

  /// Signed distance in mm, to first order, from a point to the interface of labels `a` and `b`: positive on
  /// the side of `a`. Nothing where one of the two cannot win in that cell.
  std::optional<double> distance(const Eigen::Vector3d& mm, Label a, Label b) const;

  /// How deep a point lies in label `a`, mm, to first order: the distance to the interface with its strongest
  /// rival, negative outside of `a`; a whole voxel where no other label can win.
  double depth(const Eigen::Vector3d& mm, Label a) const;

  /// The padded grid.
  const SearchableGrid& grid() const { return grid_; }
  const WallLayers& layers() const { return layers_; }
  /// Offset of the voxel of the padded grid whose centre is nearest to a point (mm).
  std::size_t nearest_voxel(const Eigen::Vector3d& mm) const;
  /// Label at each voxel centre of the padded grid, by offset.
  const std::vector<Label>& centre_labels() const { return centre_labels_; }
  /// Which voxels of a label are joined.
  Connectivity connectivity() const { return connectivity_; }

  Eigen::Vector3d to_index(const Eigen::Vector3d& mm) const { return grid_.to_index(mm); }
  Eigen::Vector3d to_mm(const Eigen::Vector3d& index) const { return grid_.to_mm(index); }
  /// A box around the centres of all voxels, mm.
  Eigen::AlignedBox3d box() const;

 private:
  static const WallLayers kNoLayers;

  /// A cell in which exactly two labels can win: difference at the corners, positive where `a` wins.
  struct Pair {
    std::array<float, 8> difference;
    Label a, b;
  };
  struct Sample {
    Label label;
    bool mixed;
  };

  /// crossing() for labels of the volume.
  Eigen::Vector3d parent_crossing(const Eigen::Vector3d& a, Label label_a, const Eigen::Vector3d& b,
                                  Label label_b, Label& other) const;
  /// Whether two labels are layers of one label, or one of them is the rest of that label outside of the
  /// wall.
  bool share_parent(Label a, Label b) const { return layers_.parent(a) == layers_.parent(b); }
  bool both_layers(Label a, Label b) const { return layers_.is_layer(a) && layers_.is_layer(b); }

  void build_cells(const LabelDistances& distances);
  /// The code of a cell in which more than one label can win.
  std::int32_t store_mixed_cell(const LabelDistances& distances, const std::array<std::size_t, 8>& corners);
  std::int32_t code_at(const Eigen::Vector3d& index, std::array<double, 3>& t) const;
  /// Corner values of a's distance minus b's in the cell of a point, and the point's place in the cell.
  bool corner_differences(const Eigen::Vector3d& mm, Label a, Label b, std::array<double, 8>& difference,
                          std::array<double, 3>& t) const;
  double margin(const Eigen::Vector3d& index, Label wanted, Sample& sample) const;
  template <class Number>
  double interpolate(const Number* corners, const std::array<double, 3>& t) const;

  SearchableGrid grid_;
  double smallest_spacing_mm_ = 1;
  std::vector<Label> centre_labels_;
  /// Per cell: a label (0..65535: only that label), 65536 + index into pairs_, or -1 - index into
  /// many_start_.
  std::vector<std::int32_t> cells_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> many_start_;  ///< ranges into many_labels_; eight values of many_values_ each
  std::vector<Label> many_labels_;
  std::vector<float> many_values_;
  Connectivity connectivity_ = Connectivity::kFaces;
  const WallLayers& layers_;
};

}  // namespace voxtet::remesh
