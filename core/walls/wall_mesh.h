// A wall within a tetrahedral mesh: its tetrahedra, its inner and outer surface, and paths through it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/topology/adjacency.h"
#include "types/tet_mesh.h"
#include "walls/wall_field.h"

namespace voxtet {

/// The wall consists of the tetrahedra of those labels of which most of the volume lies in the wall. Its
/// surface is inner or outer where the potential falls or rises across it (within 60 degrees); the rest are
/// sides, such as the rim of the base. Refers to the mesh and the field.
class WallMesh {
 public:
  enum class Part { kInner, kOuter, kSide };
  /// A face of the wall's surface.
  struct Face {
    Triangle corners;
    std::uint32_t tet;
    Part part;
    Eigen::Vector3d centre;
    double area;
  };
  WallMesh(const TetMesh& mesh, const WallField& field);

  bool holds(std::size_t tet) const { return in_wall_[tet]; }
  const std::vector<Face>& faces() const { return faces_; }
  /// For each point the fewest edges to the inner or the outer surface (edge_hops). Edges on the wall's
  /// surface are not used: where a ventricle's free wall meets the septum, the path along it is short.
  std::vector<std::uint32_t> edges_through_from(Part part) const {
    return edge_hops(edges_through_, points_of(part));
  }
  /// The same, from the inner surface.
  const std::vector<std::uint32_t>& from_inner() const { return from_inner_; }
  /// The same, from those points of the outer surface that are not near a side.
  std::vector<std::uint32_t> from_judged_outer() const;
  /// Edges of the wall's tetrahedra that are not on its surface.
  const std::vector<Edge>& edges_through() const { return edges_through_; }
  /// For each point whether it is within two edges of a side.
  const std::vector<bool>& near_side() const { return near_side_; }
  /// The layer, from 0, that a tetrahedron's centroid lies in when the potential is cut into `layers`.
  std::uint32_t layer_of(std::size_t tet, std::uint32_t layers) const;
  /// How many layers the field line from an outer face meets; 0 if it does not end on the inner surface.
  std::uint32_t layers_met(const Face& start, std::uint32_t layers) const;

 private:
  void find_tets();
  void find_faces();
  void find_edges();
  void add_face(const Triangle& corners, std::uint32_t tet);
  std::size_t opposite(std::size_t tet, const Triangle& corners) const;
  Eigen::Vector3d centre_of(std::size_t tet) const;
  Eigen::Vector3d slope_at(const Eigen::Vector3d& mm) const;
  std::vector<bool> points_of(Part part) const;
  std::size_t leave(std::uint32_t tet, std::size_t entry, Eigen::Vector3d& at) const;
  bool ends_inside(std::uint32_t tet, std::size_t corner) const;

  const TetMesh& mesh_;
  const WallField& field_;
  double step_;  ///< mm
  std::vector<bool> in_wall_;
  std::vector<std::array<std::uint32_t, 4>> neighbours_;  ///< across the face opposite to each corner
  std::vector<Face> faces_;
  std::vector<Edge> edges_;  ///< of the wall's tetrahedra
  std::vector<Edge> edges_through_;
  std::vector<std::array<std::uint32_t, 2>> surface_of_tet_;  ///< tet and face, ascending
  std::vector<std::uint32_t> from_inner_;
  std::vector<bool> near_side_;
};

}  // namespace voxtet
