// The nodes of linear and quadratic tetrahedra, and the functions that belong to them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "physics/fem/element.h"
#include "types/result.h"
#include "types/stage_names.h"
#include "types/tet_mesh.h"

namespace voxtet::mechanics {

/// The kInternal error of a list whose length is not that of what it belongs to.
template <class Found, class Expected>
Error wrong_length(const std::string& list, Found found, Expected expected) {
  return {ErrorCode::kInternal,
          kMechanicsStage,
          list + ": found " + std::to_string(found) + " entries, expected " + std::to_string(expected),
          {}};
}

/// How displacements are made of the values at nodes, and what a change of volume costs.
enum class Formulation {
  kLinear,  ///< P1: locks where the material hardly changes its volume
  /// P1 whose pressure is that of nodes: Bonet and Burton, Communications in Numerical Methods in Engineering
  /// 14 (1998)
  kAverageNodalPressure,
  kQuadratic,  ///< P2 with straight edges
  /// P1 with a linear pressure as an unknown, P1-P1, stabilised by its projection to constants: Dohrmann and
  /// Bochev, International Journal for Numerical Methods in Fluids 46 (2004); for large strains Karabelas,
  /// Haase, Plank and Augustin, Computational Mechanics 65 (2020)
  kStabilised,
};

/// A node's function at one place: its value there, and its gradient by undeformed places, 1/mm.
struct Shape {
  double value;
  Eigen::Vector3d gradient;
};

/// The nodes of a mesh: its points and then, for quadratic elements, the middles of its edges, in ascending
/// order of their ends.
class Nodes {
 public:
  Nodes() = default;
  /// Points without tetrahedra.
  explicit Nodes(std::vector<Eigen::Vector3d> points) : places_(std::move(points)) {}
  /// Every tetrahedron has a positive volume. `finely`: linear elements are integrated at four places too,
  /// for what changes within them, as the direction of fibres.
  Nodes(const TetMesh& mesh, Formulation formulation, bool finely = false);

  const std::vector<Eigen::Vector3d>& places() const { return places_; }  ///< undeformed, mm
  /// The same as three numbers a node, moved by the first ones of `u`; empty: not moved.
  Eigen::VectorXd places_after(const Eigen::VectorXd& u) const;
  std::size_t tets() const { return tets_.size(); }
  bool quadratic() const { return !edges_.empty(); }
  /// 4, or 10: the corners, then the edges in the order of kEdgesOfTet.
  std::size_t per_tet() const { return quadratic() ? 10 : 4; }
  const std::uint32_t* of_tet(std::size_t t) const { return tets_[t].data(); }
  /// The node in the middle of an edge of the mesh of quadratic elements.
  std::uint32_t middle(std::uint32_t end, std::uint32_t other) const;

  double volume_mm3(std::size_t t) const { return elements_[t].volume; }
  /// Where elements are integrated: one place, or four of the same weight.
  std::size_t samples_per_tet() const { return samples_; }
  /// The corners' shares of such a place.
  static std::array<double, 4> shares_of(std::size_t samples_per_tet, std::size_t sample);
  Eigen::Vector3d sample_place(std::size_t t, std::size_t sample) const;
  /// Of the nodes of a tetrahedron there, per_tet() of them.
  void shapes_at(std::size_t t, std::size_t sample, Shape* shapes) const;
  /// The deformation gradient where a tetrahedron has these functions.
  Eigen::Matrix3d deformation(const Eigen::VectorXd& u, std::size_t t, const Shape* shapes) const;

 private:
  std::size_t samples_ = 1;
  std::vector<Eigen::Vector3d> places_;
  std::vector<std::array<std::uint32_t, 10>> tets_;
  std::vector<fem::Element> elements_;
  std::vector<std::array<std::uint32_t, 2>> edges_;  ///< ascending; edge i has the node points + i
};

}  // namespace voxtet::mechanics
