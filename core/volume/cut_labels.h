// Labels cut off at planes that the user gives.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "geometry/cut/cut_plane.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"

namespace voxtet {

/// What the normal points to is cut away.
struct CutParams {
  std::string name;           ///< of the surface there, a word; empty: cut, cut_2, ...
  std::vector<Label> labels;  ///< that it cuts; none: all
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// What one plane took away.
struct CutRecord {
  std::string name;
  std::map<Label, std::size_t> voxels;  ///< by label, of the file's own voxels
};

/// The planes of a recipe for the labels of a volume, as yet without the labels `beyond`. Errors: kUsage for
/// a label that is not meshed, a normal of no length, a name that is no word or not alone, too many planes.
Result<CutPlanes> planes_given(const std::vector<CutParams>& params, const LabelVolume& labels);

/// The voxels whose middles lie beyond planes become background: one plane after the other.
LabelVolume without_cut(const LabelVolume& labels, const CutPlanes& planes);
/// They get the labels `beyond`, and become background where they are more than kBeyondCut voxels off
/// (extend_cuts.h). Pieces that nowhere reach a voxel beyond a plane become what is around them.
LabelVolume with_beyond(const LabelVolume& labels, const CutPlanes& planes);

/// Counts what goes. Errors: kUsage where a plane cuts nothing of a label that it names, or a label goes as a
/// whole and none is left; warnings in `ctx` where a plane cuts nothing at all, or a label goes.
Result<std::vector<CutRecord>> count_cut(const LabelVolume& labels, const CutPlanes& planes,
                                         const RunContext& ctx);

/// By label, how much more of it stays than its voxels without_cut() say, mm^3: planes divide voxels.
std::map<Label, double> divided_mm3(const LabelVolume& labels, const CutPlanes& planes);

}  // namespace voxtet
