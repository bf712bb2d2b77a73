// Which tetrahedra conduct, and as what kind of tissue.
#pragma once

#include <string>
#include <vector>

#include "types/label_transfer.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet {

/// Where a tetrahedron's label comes from.
enum class TissueBy {
  kMesh,      ///< the label that it was meshed as
  kCentroid,  ///< the image's label at its centroid (Lamecker et al., 2009)
  kMajority,  ///< the image's label that most of it has
  /// The label that it was meshed as, and for transferred labels the part of it that they fill: a part
  /// without tissue lowers the diffusivity by as much, and tissue that fills more than half of it decides the
  /// kind.
  kFraction,
};

/// Labels that are one kind of tissue. What has no entry does not conduct.
struct TissueLabels : TissueKind {
  std::vector<Label> labels;
};

struct TissueParams {
  TissueBy by = TissueBy::kMesh;
  std::vector<TissueLabels> kinds;
};

/// Tissue without fibres. `transfer` is of the same mesh. Errors, naming physics.tissue: kUsage where there
/// is no entry, where an entry has no label, a label stands in two, no tetrahedron conducts, and where labels
/// are wanted that were not transferred.
Result<Tissue> make_tissue(const TetMesh& mesh, const LabelTransfer& transfer, const TissueParams& params);

}  // namespace voxtet
