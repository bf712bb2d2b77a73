// Labels transferred instead of meshed: scar, border zone or any other label becomes a value of each tet of a
// mesh that does not follow its boundary. As for the conductivity in Lamecker et al.; see also ALGORITHMS,
// "Labels and conductivity to tets".
#pragma once

#include <vector>

#include "types/label_transfer.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/tet_mesh.h"

namespace voxtet {

struct TransferParams {
  std::vector<Label> labels;  ///< to be transferred; empty: nothing is
  int samples_min = 4;        ///< per tet, at least 1
  int samples_max = 64;       ///< per tet, at least samples_min
};

/// Takes the label of `volume` at the voxel nearest to each tet's centroid, and to each of its samples;
/// outside of the grid it is background. Samples are the barycentres of the n^3 parts of equal volume into
/// which Kuhn's subdivision cuts a tet; exact for functions that are linear in it. There are about 8 per
/// voxel: n is the least with n^3 >= clamp(8 V_tet / V_voxel, samples_min, samples_max), unless that exceeds
/// samples_max.
/// Only samples in labels that are asked for, or have most of their voxels in the mesh, count for fractions
/// and majority: at the mesh's border, samples in background or in a label left out say nothing about the
/// tet's tissue. If a tet has no other samples, all count. Of labels with equally many samples the one at the
/// centroid has the majority, else the lowest. Linear time, plus a few passes over the voxels.
/// Errors: kUsage for parameters out of range, labels that the volume does not hold (the message lists those
/// it does), background; kInternal if the mesh breaks an invariant; kCancelled.
Result<LabelTransfer> transfer_labels(const TetMesh& mesh, const LabelVolume& volume,
                                      const TransferParams& params, RunContext& ctx);

/// The checks of transfer_labels that need no mesh.
Status check_transfer(const LabelVolume& volume, const TransferParams& params);

}  // namespace voxtet
