// The inertia of a body.
#pragma once

#include "physics/fem/fixed_order.h"
#include "physics/mechanics/elements/nodes.h"

namespace voxtet::mechanics {

/// Adds the consistent mass of all elements, exactly integrated, to a matrix that couples the nodes of a
/// tetrahedron, as Body::empty_tangent() does. With a density in kg/mm^3 times accelerations in mm/s^2 it is
/// a force in mN = kPa mm^2. Water has 1e-6 kg/mm^3.
void add_mass(const Nodes& nodes, double density_kg_per_mm3, fem::SparseMatrix& matrix);

}  // namespace voxtet::mechanics
