// The user's rules -> one target edge length at every point of space.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "types/label_volume.h"
#include "types/region.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/scalar_volume.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "walls/wall_field.h"

namespace voxtet {

/// Target edge length inside one label.
struct LabelSize {
  Label label = 0;
  double edge_mm = 2;
};

/// A place with its own size: edge_mm inside; outside it rises linearly to the surrounding size over band_mm.
struct SizeRegion : Region {
  std::string name;
  double edge_mm = 1;
  double band_mm = 5;
};

/// Size that grows with the distance to a label: edge_mm + slope * distance.
struct DistanceSize {
  Label label = 0;
  double edge_mm = 1;
  double slope = 0.2;
};

/// How the layers of a wall are made.
enum class Layering {
  kSize,   ///< by the size of elements alone, without sheets
  kExact,  ///< by sheets across the wall (walls/wall_layers.h), with one element between two of them
};

/// Size by the thickness t of a wall. `layers` > 0: t / layers. Accuracy by size alone, in parts of a shell's
/// area: 99 % has exactly two layers where two are asked for, 93 or 94 % exactly three or four; most of it
/// has two where one is asked for (core/README.md). `layers` 0: linear, from edge_thin_mm where t <= thin_mm
/// to edge_thick_mm where t >= thick_mm. If thin_mm and thick_mm are both 0, they are the first and the last
/// percentile of t.
struct ThicknessSize {
  std::vector<Label> wall;   ///< labels of the image that form the wall
  std::vector<Label> inner;  ///< labels on its inner side; none: the cavities of the background
  std::uint32_t layers = 0;
  Layering layering = Layering::kSize;
  double edge_thin_mm = 1, edge_thick_mm = 3;
  double thin_mm = 0, thick_mm = 0;
};

/// Sizes painted over the volume: a label volume of its own, on any grid, with a size for each of its labels.
/// A point has the label of the mask's voxel that contains it. Every painted voxel sets at least the grid
/// point nearest to it.
struct MaskSize {
  std::string name;              ///< of the file that holds the mask
  std::string sha256;            ///< digest_of(LabelVolume); empty accepts any
  std::vector<LabelSize> edges;  ///< by label of the mask
};

/// An image of edge lengths in mm, on any grid. Voxels that are 0 or NaN ask for nothing.
struct ImageSize {
  std::string name;    ///< of the file that holds the image
  std::string sha256;  ///< digest_of(ScalarVolume); empty accepts any
};

/// Size by the curvature of the label surface: h = 2 pi / (edges_per_turn * k), so that `edges_per_turn`
/// edges make a full turn of its circle of curvature. k is the larger absolute principal curvature, averaged
/// over some two voxels.
struct CurvatureSize {
  std::vector<Label> labels;  ///< whose surfaces count, whatever is on the other side; none: all
  double edges_per_turn = 20;
  double edge_min_mm = 0.5;  ///< no edge below this is asked, however sharp the bend
};

/// Size for an excitation wave: the longest edge at which its speed is wrong by no more than `error_percent`
/// (base/wave_speed_error.h). The diffusivity is that of a plane wave in Mitchell and Schaeffer's cell of
/// usual times.
struct WaveSize {
  std::vector<Label> labels;     ///< in which; none: all
  double speed_mm_per_ms = 0.5;  ///< the slowest direction's, across the fibres
  double error_percent = 2;
  double consistent_mass = 0.5;  ///< of the simulation to come; explicit steps: 0
};

struct SizingParams {
  double edge_mm = 2;                    ///< wherever nothing smaller is asked
  std::vector<LabelSize> labels;         ///< replaces edge_mm inside these labels (smaller or larger)
  std::vector<SizeRegion> regions;       ///< minimum with everything else
  std::vector<DistanceSize> distances;   ///< minimum with everything else
  std::vector<ThicknessSize> thickness;  ///< replaces edge_mm in its wall, minimum with everything else
  std::vector<MaskSize> masks;           ///< minimum with everything else
  std::vector<ImageSize> images;         ///< replaces edge_mm where it has a length, minimum with all else
  std::vector<CurvatureSize> curvature;  ///< minimum with everything else
  std::vector<WaveSize> waves;           ///< minimum with everything else
  double edge_min_mm = 0.1;
  double edge_max_mm = 50;
  double gradation = 0.3;  ///< bound on |grad h|; 0 < g <= 1
};

/// What sizes may depend on besides the labels.
struct SizingSources {
  /// Measured walls (measure_wall.h), one for each of SizingParams::thickness.
  std::span<const WallField> walls = {};
  std::span<const LabelVolume* const> masks = {};    ///< one for each of SizingParams::masks
  std::span<const ScalarVolume* const> images = {};  ///< one for each of SizingParams::images
  /// The smoothed label surface, where SizingParams::curvature asks for it.
  const SurfaceMesh* surface = nullptr;
};

/// The edge length (mm) that a wave asks for.
double edge_of(const WaveSize& rule);

/// The minimum of all sources at the volume's voxels, clamped to [edge_min_mm, edge_max_mm], then
/// gradation-limited: h*(x) = min_y h(y) + g|x - y| by fast sweeping (fast_sweeping.h states its accuracy).
/// The grid is that of the volume with two points more on each side. Background has no rule of its own: it
/// gets its size from the labels around it through the gradation, from distances and from regions. Regions do
/// not depend on their order: the band of each rises to the size that there is without any region. Voxels of
/// other labels within two voxels of a wall also take the wall's size; the gradation would bring them near it
/// anyway.
///
/// Warnings: edge lengths beyond edge_min_mm and edge_max_mm, regions that do not reach into the volume, and
/// images that leave some labelled voxels without a size, which then have edge_mm. Errors: kUsage naming the
/// field ("sizing.labels[1].edge_mm") for sizes that are not finite and positive, labels that the volume or
/// mask does not hold or that are listed twice, empty regions, masks that do not reach into the volume;
/// kBadInput for a volume that makes no sense and for images with negative or infinite sizes or without a
/// size in any labelled voxel; kCancelled.
Result<SizingField> build_sizing_field(const LabelVolume& volume, const SizingParams& params, RunContext& ctx,
                                       const SizingSources& sources = {});

}  // namespace voxtet
