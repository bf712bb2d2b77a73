// A heart that can beat, from its mesh.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "physics/beat/beat_params.h"
#include "physics/beat/heart_steps.h"
#include "types/heart_surfaces.h"
#include "types/result.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet::beat {

/// What is known of a heart's mesh.
struct Anatomy {
  const TetMesh& mesh;
  const HeartSurfaces& surfaces;
  const Fibres& fibres;                        ///< at the centroid of each tetrahedron
  const std::vector<Eigen::Vector3d>& across;  ///< of the tetrahedra: unit vectors through the wall
  const std::vector<bool>& right;  ///< by tetrahedron: whether it is of the right ventricle's free wall
  /// The same at the four samples of each (mechanics::Nodes); null: as at the centroid.
  const Fibres* fine_fibres = nullptr;
  /// By point, since time 0 of a beat, NaN: never. May be empty where all contracts at once.
  std::span<const float> activation_ms = {};
  /// By point, from activation to recovery, NaN: as BeatParams has it. Empty: everywhere so.
  std::span<const float> duration_ms = {};
};

/// The wall of the ventricles alone, without what is in them.
struct MadeHeart {
  std::shared_ptr<const Heart> heart;
  HeartMotion start;                  ///< unloaded, at rest, before it is filled
  std::vector<std::uint32_t> points;  ///< of each corner its number in the whole mesh, ascending
  std::vector<std::uint32_t> tets;    ///< of each tetrahedron
};

/// Returns kUsage, naming the field, for parameters out of range and for what does not go together, kMeshing
/// for cavities that cannot be closed, and the errors of mechanics::Body::make().
Result<MadeHeart> make_heart(const Anatomy& anatomy, const BeatParams& params);

}  // namespace voxtet::beat
