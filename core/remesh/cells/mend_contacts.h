// Small changes of cell labels after which the labels touch that are to, and no others.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "remesh/cells/labelled_cells.h"
#include "types/run_context.h"

namespace voxtet::remesh {

using Contact = std::array<Label, 2>;  ///< two labels, the lower one first

/// A contact that is to be there, and points (mm) of it.
struct LostContact {
  Contact labels;
  std::vector<Eigen::Vector3d> places;
};

/// Where a contact is so small that no facet of the triangulation shows it, two other labels touch across it:
/// the two configurations in which four labels meet around a short edge (Weaire and Rivier 1984: a T1
/// process). There cells change labels, a few at a time, so that one label reaches the other, or is parted
/// from it. Each change keeps the topology of every label: the Euler number of its boundary, and boundaries
/// that are 2-manifolds; and all other contacts. What does not succeed leaves the cells as they were.
///
/// `wanted`: all contacts that are to be, background's too, ascending. `lost`: those of them that are not
/// there, at the places where they are looked for; contacts that are there and not wanted are found.
/// `reach_mm`: of the cells that may change, around these places. Returns how many cells changed. Once
/// cancelled nothing more changes.
std::size_t mend_contacts(LabelledCells& cells, const std::vector<Contact>& wanted,
                          const std::vector<LostContact>& lost, double reach_mm, const RunContext& ctx = {});

}  // namespace voxtet::remesh
