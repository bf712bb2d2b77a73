// What a cavity holds, and what a pressure in it does to the nodes around it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/cavities/cavity.h"
#include "physics/mechanics/elements/nodes.h"
#include "physics/mechanics/loads/surface.h"

namespace voxtet {

/// A cavity on the nodes of a body: of quadratic elements its triangles and the edges of its rims are curved.
/// `x`, in all functions, is where the nodes are, three numbers each (Nodes::places_after()), in mm.
class Enclosure {
 public:
  Enclosure(const mechanics::Nodes& nodes, const Cavity& cavity);

  /// mm^3; 1 ml is 1000 of them.
  double volume_mm3(const Eigen::VectorXd& x) const;

  /// Adds `factor` times the volume's derivatives with respect to x, mm^2. Times a pressure they are the
  /// forces that it has on the nodes, on those of rims from the fans too. `gradient` has at least the entries
  /// of x.
  void add_gradient(const Eigen::VectorXd& x, double factor, Eigen::VectorXd& gradient) const;

  /// Adds `factor` times how that gradient changes as nodes move: the second derivatives, which are
  /// symmetric, times `moves`, mm.
  void add_gradient_change(const Eigen::VectorXd& x, const Eigen::VectorXd& moves, double factor,
                           Eigen::VectorXd& change) const;

 private:
  /// A place that is a sum of others: the middle of a rim, and those of the fans' edges to it.
  struct Share {
    std::uint32_t of, node;  ///< both numbers among the places of surface_
    double part;
  };
  Eigen::VectorXd gather(const Eigen::VectorXd& x) const;
  Eigen::VectorXd gradient_at(const Eigen::VectorXd& places) const;
  void scatter(const Eigen::VectorXd& at_places, double factor, Eigen::VectorXd& out) const;

  std::vector<std::uint32_t> nodes_;  ///< of the body: the first places of surface_, in ascending order
  std::vector<Share> shares_;         ///< of the places behind them
  std::size_t places_ = 0;
  mechanics::Surface surface_;
};

/// Of a cavity of flat triangles between these points, mm^3.
double volume_mm3(const Cavity& cavity, std::span<const Eigen::Vector3d> points);

}  // namespace voxtet
