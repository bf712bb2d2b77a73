// The measures of single tetrahedra, declared once: the report's distributions, what a viewer colours by and
// what is written into mesh files all come from this table.
#pragma once

#include <span>
#include <vector>

#include "geometry/elements/tet_measures.h"
#include "quality/summarise.h"
#include "types/field.h"
#include "types/sizing_field.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// One row. `of` is called with the target edge length (mm) at the centroid; NaN if there is no sizing field.
struct TetMeasure {
  const char* name;
  const char* title;
  const char* unit;
  Scale scale;
  MetricInfo::Worst worst;  ///< which end is bad
  double lo, hi;            ///< of its histogram; equal: the report has no distribution of it
  bool of_target;           ///< needs a sizing field
  double (*of)(const TetCorners& corners, const TetShape& shape, double target_mm);
};

std::span<const TetMeasure> tet_measures();

/// A field for each row, in its order, with one value per tetrahedron. Rows that need the target are left out
/// if `sizing` is null. `all_angles`, if given, receives the six dihedral angles of each tetrahedron, deg.
std::vector<Field> measure_tets(const TetMesh& mesh, const SizingField* sizing, int threads,
                                std::vector<float>* all_angles = nullptr);

}  // namespace voxtet
