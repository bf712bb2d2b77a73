// What each stage returns: the types that pass between stages, besides those of types/.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "physics/circulation/ventricle_beat.h"
#include "physics/ventricles/ventricular_potentials.h"
#include "types/field.h"
#include "types/heart_surfaces.h"
#include "types/label_transfer.h"
#include "types/quality_report.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"
#include "volume/label_contacts.h"
#include "volume/prepare_volume.h"
#include "walls/wall_field.h"
#include "walls/wall_layers.h"

namespace voxtet {

struct VolumeResult {
  std::shared_ptr<const LabelVolume> source;    ///< all labels, as read or generated
  std::string digest;                           ///< digest_of(*source)
  std::vector<LabelSurroundings> surroundings;  ///< of the labels of *source
  PreparedVolume prepared;
};

/// The walls of the recipe's sizing.thickness, in its order.
using Walls = std::vector<WallField>;

struct WallsResult {
  Walls walls;
  /// `thickness_mm` at the voxels of the volume that is meshed, where they lie in a wall; none without walls.
  std::vector<Field> fields;
};

/// The sheets of the walls whose layers shall be exact. They refer to `walls`.
struct LayersResult {
  std::shared_ptr<const WallsResult> walls;
  std::vector<std::size_t> exact;  ///< indices of the walls whose layers shall be exact
  WallLayers layers;
};

/// A mesh of the volume's labels and, where it was made with others that go in the end, the mesh with these:
/// of the layers of walls that are exact, and of what is beyond cuts.
template <class Mesh>
struct Built {
  Mesh mesh;
  std::optional<Mesh> whole;

  const Mesh& as_built() const { return whole ? *whole : mesh; }
};

/// Empty where the recipe does not ask for it.
struct AnatomyResult {
  std::optional<HeartSurfaces> surfaces;
  VentricularPotentials potentials;
  std::vector<Field> fields;  ///< coordinates of the points
};

/// Empty where the recipe does not ask for them.
struct FibresResult {
  Fibres fibres;              ///< of the tetrahedra
  std::vector<Field> fields;  ///< `fibre` and `sheet` of the tetrahedra
};

struct TissueResult {
  Tissue tissue;
  std::vector<Field> fields;  ///< `speed_error_percent` of the tetrahedra, to be expected of a simulation
};

/// When the first wave comes: `eikonal_ms` at the points.
struct EikonalResult {
  std::vector<Field> fields;
};

/// A result that changes with time: its last frame, and a digest over all frames, fields and traces.
struct Trajectory {
  std::vector<double> times_ms;
  Snapshot last;
  std::vector<Field> fields;  ///< what is known at the end, such as activation times
  std::vector<double> trace_times_ms;
  std::vector<Trace> traces;
  std::string digest;
};

/// A heart that beats.
struct MechanicsResult : Trajectory {
  std::vector<std::vector<VentricleBeat>> beats;  ///< of each beat, each ventricle
  std::optional<double> change_percent;           ///< BeatRecord::change_percent()
  bool has_cycle = false;                         ///< whether that is what the recipe asks for
  int steps = 0, newton_iterations = 0;
};

/// Bytes that a result holds, without those that it shares with others.
std::size_t memory_bytes(const VolumeResult& result);
std::size_t memory_bytes(const SurfaceMesh& surface);
std::size_t memory_bytes(const TetMesh& mesh);
std::size_t memory_bytes(const WallsResult& result);
std::size_t memory_bytes(const SizingField& sizing);
std::size_t memory_bytes(const LayersResult& result);
std::size_t memory_bytes(const LabelTransfer& found);
std::size_t memory_bytes(const QualityReport& report);
std::size_t memory_bytes(const AnatomyResult& result);
std::size_t memory_bytes(const FibresResult& result);
std::size_t memory_bytes(const TissueResult& result);
std::size_t memory_bytes(const EikonalResult& result);
std::size_t memory_bytes(const Trajectory& result);
std::size_t memory_bytes(const MechanicsResult& result);
template <class Mesh>
std::size_t memory_bytes(const Built<Mesh>& result) {
  return memory_bytes(result.mesh) + (result.whole ? memory_bytes(*result.whole) : 0);
}

}  // namespace voxtet
