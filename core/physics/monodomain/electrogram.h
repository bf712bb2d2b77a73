// The voltage that tissue gives to an electrode.
#pragma once

#include <Eigen/Core>
#include <string>

#include "physics/monodomain/conducting_mesh.h"

namespace voxtet {

/// Where a voltage is recorded: in the blood, on the tissue, or far away as a lead of an ECG.
struct Electrode {
  std::string name;
  Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();
};

/// The potential at an electrode, in mV, against one far away, in an infinite bath around the tissue:
///   phi = - 1 / (4 pi sigma_b) integral of (sigma grad V) . grad(1 / r)
/// (Plonsey and Barr, "Bioelectricity", 2007, chapter 8; Gima and Rudy, Circulation Research 90, 2002), with
/// sigma of the diffusivity by a surface-to-volume ratio of 140 /mm and a capacitance of 0.01 uF/mm^2, and
/// sigma_b = 1 S/m. Linear in v: the sum of a weight times v over the points, which this returns. The
/// electrode is no smaller than half a millimetre, so that one that touches the tissue has a finite
/// potential.
Eigen::VectorXd electrogram_weights(const ConductingMesh& tissue, const Eigen::Vector3d& at_mm);

}  // namespace voxtet
