// Walls cut into layers: while its mesh is made, every layer of a wall has a label of its own.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "types/label_volume.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"
#include "walls/wall_field.h"

namespace voxtet {

/// Sheets cut a wall into N layers. Seen from each of its surfaces, they lie where the share of that surface
/// (WallField::inner_shares) is 1 - k/N, for k up to N/2. Between two surfaces, where their shares add up to
/// one, these are the sheets u = k/N of the Laplace potential u. For odd N one layer remains in the middle
/// between all surfaces; for even N sheets separate the surfaces where their shares are equal. Any number of
/// surfaces meet like this without a jump: between any two of them lie N layers, also where the walls of two
/// ventricles and their septum meet.
///
/// A layer's label is one that the volume does not hold; labels of the volume are their own parents.
class WallLayers {
 public:
  WallLayers() = default;  ///< no layers

  /// A label of the volume belongs to the first wall that contains most of its voxels. The fields must
  /// outlive this, and hold inner_shares. Layers for which no label is left are not made: see lacks_labels().
  WallLayers(const LabelVolume& volume, std::span<const LayeredWall> walls);

  bool empty() const { return layers_.empty(); }
  /// Whether the labels above the volume's highest, up to 65535, are too few for all layers.
  bool lacks_labels() const { return lacks_labels_; }
  /// Whether any label has layers of the wall with this number.
  bool has_wall(std::size_t wall) const;
  Label parent(Label label) const { return is_layer(label) ? layers_[label - first_].parent : label; }
  bool is_layer(Label label) const { return label >= first_ && std::size_t{label} < first_ + layers_.size(); }

  /// The label of the layer at a point (mm) inside `label` of the volume; `label` itself if it has no layers
  /// there.
  Label at(Label label, const Eigen::Vector3d& mm) const;

  /// How far a point is on a's side of the sheet between two layers of one wall, as a share: positive on that
  /// side.
  double lead(const Eigen::Vector3d& mm, Label a, Label b) const;
  /// Gradient of lead, 1/mm.
  Eigen::Vector3d lead_gradient(const Eigen::Vector3d& mm, Label a, Label b) const;
  /// How far inside a layer's own sheets a point lies, mm, to first order; negative outside of them.
  double depth_mm(const Eigen::Vector3d& mm, Label layer) const;

 private:
  /// The layer `step` sheets away from surface number `surface` (0: the outer one), or the one in the middle
  /// of all.
  struct Layer {
    Label parent;
    std::uint32_t wall, surface, step;
    bool middle;
  };
  struct Wall {
    const WallField* field;
    std::uint32_t layers;
  };
  const Layer& layer(Label label) const { return layers_[label - first_]; }

  std::vector<Wall> walls_;
  std::vector<Layer> layers_;            ///< by label - first_
  std::vector<std::uint32_t> first_of_;  ///< by parent: place of its first layer, or kNone
  Label first_ = 0;
  bool lacks_labels_ = false;
};

/// A surface without the sheets between layers, all labels those of the volume.
SurfaceMesh merge_layers(const SurfaceMesh& surface, const WallLayers& layers);
/// Indices of triangles of `surface` turned into indices of merge_layers(surface), in the same order;
/// triangles of sheets are left out.
std::vector<std::uint32_t> merged_triangles(const std::vector<std::uint32_t>& triangles,
                                            const SurfaceMesh& surface, const WallLayers& layers);
/// The same for tetrahedra.
TetMesh merge_layers(TetMesh mesh, const WallLayers& layers);

/// `surface` has the volume's labels. Its triangles get the layers that touch them in place of these labels,
/// and the sheets of `adapted` are added.
SurfaceMesh with_layers(const SurfaceMesh& surface, const SurfaceMesh& adapted, const WallLayers& layers);

}  // namespace voxtet
