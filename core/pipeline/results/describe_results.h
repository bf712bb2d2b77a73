// What reports and viewers get of each stage's result: numbers, arrays, and its digest.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/digest.h"
#include "pipeline/results/stage_arrays.h"
#include "pipeline/results/stage_results.h"

namespace voxtet {

/// The `counts` of a stage in the report.
nlohmann::json counts_of(const VolumeResult& result);   ///< volume_json, and the prepared grid
nlohmann::json counts_of(const SurfaceMesh& surface);   ///< {points, triangles}
nlohmann::json counts_of(const TetMesh& mesh);          ///< {points, tets, faces}
nlohmann::json counts_of(const WallsResult& result);    ///< {walls}
nlohmann::json counts_of(const SizingField& field);     ///< {size, index_to_mm, min_mm, max_mm}
nlohmann::json counts_of(const LayersResult& result);   ///< {walls}: those with exact layers
nlohmann::json counts_of(const LabelTransfer& found);   ///< {labels}
nlohmann::json counts_of(const QualityReport& report);  ///< {}: the report has it all elsewhere
nlohmann::json counts_of(
    const AnatomyResult& result);                      ///< {surfaces: {name: faces}}, {} where there are none
nlohmann::json counts_of(const FibresResult& result);  ///< {tets}: those with a fibre
nlohmann::json counts_of(const TissueResult& result);  ///< {kinds, conducting_tets}
nlohmann::json counts_of(const EikonalResult& result);  ///< {last_ms}: when the last point is activated
nlohmann::json counts_of(const Trajectory& result);     ///< {frames, end_ms}

/// The arrays that a viewer may ask for, besides those of stage_arrays.h.
void add_arrays(const VolumeResult& result, StageArrays& out);
void add_arrays(const SizingField& field, StageArrays& out);
void add_arrays(const Trajectory& result,
                StageArrays& out);  ///< of the last frame, and what is known at the end

std::string digest_of(const VolumeResult& result);  ///< of the prepared volume
std::string digest_of(const EikonalResult& result);
std::string digest_of(const Trajectory& result);  ///< of all frames, fields and traces

template <class T>
concept HasFields = requires(const T& result) {
  result.fields;
};
/// Of the other results that have fields: these.
template <HasFields T>
void add_arrays(const T& result, StageArrays& out) {
  add_arrays(result.fields, out);
}

// Of a mesh with layers, others see only the mesh without them.
template <class Mesh>
nlohmann::json counts_of(const Built<Mesh>& result) {
  return counts_of(result.mesh);
}
template <class Mesh>
void add_arrays(const Built<Mesh>& result, StageArrays& out) {
  add_arrays(result.mesh, out);
}
template <class Mesh>
std::string digest_of(const Built<Mesh>& result) {
  return digest_of(result.mesh);
}

}  // namespace voxtet
