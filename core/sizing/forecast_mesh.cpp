#include "sizing/forecast_mesh.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/elements/surface_curvature.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/grid/fast_sweeping.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

constexpr double kTrianglesPerArea = 2.15;     ///< in squared edges
constexpr double kTetsPerVolume = 9.96;        ///< in cubed edges
constexpr double kTetsLostPerTriangle = 0.3;   ///< there is none beyond it that would share its edges
constexpr double kLeastTetsPerTriangle = 0.5;  ///< where a body is as thin as an edge
constexpr double kRise = 0.7;  ///< of edge lengths from a surface that is finer than asked for, per mm
constexpr double kPointsPerTet = 0.17, kPointsPerTriangle = 0.25;

// By how much a refined surface is denser than asked for, measured on hearts, aorta, torso and mickey.nrrd:
constexpr double kRadiusPerEdge = 1 / 1.3;  ///< circumradius of its triangles
constexpr double kByBend = 0.4;             ///< where the middle of a triangle is as far off as allowed
constexpr double kByThinness = 0.1;         ///< where a layer is as thin as an edge
constexpr double kMostOffset = 2, kMostThin = 2.5;  ///< beyond, the surface is as dense whatever is asked for
constexpr double kCoarsened = 0.25;                 ///< part of the excess that local operations leave

constexpr std::size_t kMostSamples = 250000;

/// Walks through the voxels of a volume.
class GapFinder {
 public:
  explicit GapFinder(const LabelVolume& volume)
      : volume_(volume),
        to_index_(volume.index_to_mm.inverse()),
        step_mm_(0.25 * volume.smallest_spacing_mm()) {}

  /// How far one can go from a point along a unit direction inside a label, at most twelve voxels; that, too,
  /// where the label does not begin within a voxel, because the smoothed surface is off the voxels' faces.
  double gap_mm(const Vector3d& from, const Vector3d& direction, Label label) const {
    constexpr int kBegins = 4, kEnds = 48;
    const Vector3d start = to_index_.topLeftCorner<3, 3>() * from + to_index_.topRightCorner<3, 1>();
    const Vector3d step = to_index_.topLeftCorner<3, 3>() * direction * step_mm_;
    int k = 1;
    while (k <= kBegins && at(start + k * step) != label) ++k;
    if (k > kBegins) return kEnds * step_mm_;
    while (k < kEnds && at(start + k * step) == label) ++k;
    return k * step_mm_;
  }

 private:
  Label at(const Vector3d& index) const {
    return volume_.at_or_background(static_cast<int>(std::floor(index[0] + 0.5)),
                                    static_cast<int>(std::floor(index[1] + 0.5)),
                                    static_cast<int>(std::floor(index[2] + 0.5)));
  }
  const LabelVolume& volume_;
  Eigen::Matrix4d to_index_;
  double step_mm_;
};

/// The integral of e^-3 over the labelled voxels that are not beyond cuts. The grid has the volume's points
/// and some more around them.
double tets_per_volume(const LabelVolume& volume, const CutPlanes& cuts, const SizingField& grid,
                       const std::vector<float>& edge_mm) {
  std::array<int, 3> pad{};
  for (std::size_t d = 0; d < 3; ++d) pad[d] = (grid.size[d] - volume.size[d]) / 2;
  double sum = 0;
  volume.visit([&](int i, int j, int k, std::size_t voxel) {
    const Label label = volume.labels[voxel];
    if (label == kBackground || is_beyond(cuts, label)) return;
    const double edge = edge_mm[grid.offset(i + pad[0], j + pad[1], k + pad[2])];
    sum += 1 / (edge * edge * edge);
  });
  return sum * volume.voxel_mm3();
}

}  // namespace

MeshForecaster::MeshForecaster(const LabelVolume& volume, const CutPlanes& cuts, const SurfaceMesh& surface,
                               const SurfaceExpectation& expectation)
    : volume_(volume), cuts_(cuts), expectation_(expectation) {
  const std::vector<float> curvature =
      surface_curvature(surface, kCurvatureWidthVoxels * volume.smallest_spacing_mm());
  const GapFinder gaps(volume);
  const std::size_t stride = surface.triangles.size() / kMostSamples + 1;
  double all = 0, sampled = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [ia, ib, ic] = surface.triangles[t];
    const Vector3d &a = surface.points[ia], &b = surface.points[ib], &c = surface.points[ic];
    const Vector3d cross = triangle_cross(a, b, c);
    const double twice = cross.norm();
    all += twice / 2;
    if (t % stride != 0 || !(twice > 0)) continue;
    const Vector3d at = (a + b + c) / 3, normal = cross / twice;
    const double gap =
        std::min(gaps.gap_mm(at, -normal, surface.sides[t][0]), gaps.gap_mm(at, normal, surface.sides[t][1]));
    samples_.push_back(
        {at, twice / 2, (static_cast<double>(curvature[ia]) + curvature[ib] + curvature[ic]) / 3, gap});
    sampled += twice / 2;
  }
  for (Sample& sample : samples_) sample.area_mm2 *= all / sampled;
}

double MeshForecaster::demand_per_mm2(const Sample& sample, double edge_mm) const {
  const double target = 1 / (edge_mm * edge_mm);
  const double allowed = expectation_.max_distance_voxels * volume_.smallest_spacing_mm();
  // How far the middle of a triangle is off the bend, over what is allowed, for a squared edge of 1 mm.
  const double offset_per_mm2 = kRadiusPerEdge * kRadiusPerEdge * sample.curvature / 2 / allowed;
  const double offset = std::min(offset_per_mm2 / target, kMostOffset);
  const double bend = offset < 1 ? offset * offset * target
                                 : (2 * offset - 1) * std::max(target, offset_per_mm2 / kMostOffset);
  const double thin = std::min(edge_mm / sample.gap_mm, kMostThin) / (sample.gap_mm * sample.gap_mm);
  const double excess = kByBend * bend + kByThinness * thin;
  return target + (expectation_.resolves_thin_places ? excess : kCoarsened * excess);
}

Result<MeshForecast> MeshForecaster::forecast(const SizingField& sizing, const RunContext& ctx) const {
  MeshForecast out;
  std::vector<float> demand(sizing.h_mm.size(), 0.F), weights(sizing.h_mm.size(), 0.F);
  for (const Sample& sample : samples_) {
    const double h = sizing.at(sample.at), area = sample.area_mm2, per_mm2 = demand_per_mm2(sample, h);
    out.triangles += kTrianglesPerArea * area * per_mm2;
    for_grid_corners(sizing.size, sizing.to_index(sample.at), [&](std::size_t at, double weight) {
      demand[at] += static_cast<float>(weight * area * per_mm2);
      weights[at] += static_cast<float>(weight * area);
    });
  }
  std::vector<float> edge_mm = sizing.h_mm;
  for (std::size_t at = 0; at < edge_mm.size(); ++at)
    if (weights[at] > 0) edge_mm[at] = std::min(edge_mm[at], std::sqrt(weights[at] / demand[at]));
  if (!limit_gradation(sizing.size, volume_.linear(), kRise, edge_mm, ctx))
    return cancelled_error(kSizingStage);
  const auto tets_without = [&](const CutPlanes& cuts) {
    return std::max(kTetsPerVolume * tets_per_volume(volume_, cuts, sizing, edge_mm) -
                        kTetsLostPerTriangle * out.triangles,
                    kLeastTetsPerTriangle * out.triangles);
  };
  out.tets = tets_without(cuts_);
  out.filled_tets = cuts_.empty() ? out.tets : tets_without({});
  out.points = kPointsPerTet * out.tets + kPointsPerTriangle * out.triangles;
  return out;
}

double least_tets(const LabelVolume& volume, const SizingField& sizing) {
  return kTetsPerVolume * tets_per_volume(volume, {}, sizing, sizing.h_mm);
}

}  // namespace voxtet
