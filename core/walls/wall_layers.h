// Walls cut into layers: every layer of a wall a label of its own, for as long as its mesh is made.
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

/// Sheets cut a wall where the share of one of its surfaces (WallField::inner_shares) is 1 - k/N, for k up to
/// N/2, seen from each surface: between two surfaces, where the shares add up to one, these are the sheets
/// u = k/N of the Laplace potential u. For odd N what is left is one layer in the middle of all surfaces; for
/// even N sheets part the surfaces where their shares are equal. Any number of surfaces meet like this
/// without a jump: between any two of them lie N layers, also where two ventricles' walls and their septum
/// meet.
///
/// A layer's label is one that the volume does not hold; labels of the volume are their own parents.
class WallLayers {
 public:
  WallLayers() = default;  ///< no layers

  /// Labels of the volume belong to a wall when most of their voxels lie in it; the first such wall has them.
  /// The fields must outlive this, and hold inner_shares. Layers for which no label is left are not made:
  /// see lacks_labels().
  WallLayers(const LabelVolume& volume, std::span<const LayeredWall> walls);

  bool empty() const { return layers_.empty(); }
  /// Whether the labels above the volume's highest, up to 65535, are too few for all layers.
  bool lacks_labels() const { return lacks_labels_; }
  /// Whether a label has layers of this wall, by its number.
  bool has_wall(std::size_t wall) const;
  Label parent(Label label) const { return is_layer(label) ? layers_[label - first_].parent : label; }
  bool is_layer(Label label) const { return label >= first_ && std::size_t{label} < first_ + layers_.size(); }

  /// The layer at a point (mm) of a label of the volume; that label where it has no layers.
  Label at(Label label, const Eigen::Vector3d& mm) const;

  /// How far a point is on a's side of the sheet between two layers of one wall, as a share: positive there.
  double lead(const Eigen::Vector3d& mm, Label a, Label b) const;
  /// Gradient of lead, 1/mm.
  Eigen::Vector3d lead_gradient(const Eigen::Vector3d& mm, Label a, Label b) const;
  /// How far inside a layer's own sheets a point lies, mm, to first order; negative outside of them.
  double depth_mm(const Eigen::Vector3d& mm, Label layer) const;

 private:
  /// `step` sheets away from surface number `surface` (0: the outer one), or in the middle of all.
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
/// Triangles of `surface` by their place in merge_layers(surface), in the same order; those of sheets are
/// left out.
std::vector<std::uint32_t> merged_triangles(const std::vector<std::uint32_t>& triangles,
                                            const SurfaceMesh& surface, const WallLayers& layers);
/// The same of tetrahedra.
TetMesh merge_layers(TetMesh mesh, const WallLayers& layers);

/// `surface`, that of the volume's labels, with the layers that touch its triangles in place of their
/// parents, and the sheets of `adapted`.
SurfaceMesh with_layers(const SurfaceMesh& surface, const SurfaceMesh& adapted, const WallLayers& layers);

}  // namespace voxtet
