// The parameters of the stage remesh.
#pragma once

#include "remesh/adapt/adapt_schedule.h"

namespace voxtet {

enum class RemeshMethod {
  kDelaunay,  ///< restricted Delaunay refinement of the field of the labels' distances
  kAdapt,     ///< local operations on the label surface itself, each keeping topology and embedding
};

/// When the surface of method delaunay is replaced by one of method adapt, which keeps all topology.
enum class KeepTopology {
  kLabels,   ///< when a label is lost or its boundary touches itself
  kAll,      ///< when pieces, cavities, handles or contacts of any label differ from the label surface's
  kNothing,  ///< never
};

struct RemeshParams {
  RemeshMethod method = RemeshMethod::kDelaunay;
  KeepTopology keep_topology = KeepTopology::kAll;
  double facet_angle_deg = 30;  ///< delaunay: lower bound on the planar angles; 0 to 30
  double max_distance_voxels =
      0.5;  ///< delaunay: facet to label field, in units of the smallest spacing; at least 0.01
  AdaptSchedule schedule = AdaptSchedule::kAdaptive;  ///< adapt: order of operations
  double shape_weight = 0.7;  ///< adapt: weight of relocation, from sizes alone (0) to shapes alone (1)
  bool verify = false;        ///< adapt: check for intersections after every local operation (slow)
};

}  // namespace voxtet
