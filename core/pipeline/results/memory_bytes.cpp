#include <algorithm>
#include <numeric>

#include "pipeline/results/stage_results.h"

namespace voxtet {
namespace {

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::size_t bytes_of(const std::vector<Field>& fields) {
  return std::accumulate(fields.begin(), fields.end(), std::size_t{0},
                         [](std::size_t sum, const Field& field) { return sum + bytes_of(field.values); });
}

}  // namespace

std::size_t memory_bytes(const VolumeResult& result) {
  std::size_t bytes = 0;
  std::vector<const LabelVolume*> counted;
  for (const LabelVolume* volume :
       {result.source.get(), result.prepared.selected.get(), result.prepared.prepared.get(),
        result.prepared.anatomy.get(), result.prepared.meshed.get(), result.prepared.placed.get(),
        result.prepared.extracted.get()}) {
    if (!volume || std::find(counted.begin(), counted.end(), volume) != counted.end()) continue;
    counted.push_back(volume);
    bytes += bytes_of(volume->labels);
  }
  return bytes;
}

std::size_t memory_bytes(const SurfaceMesh& surface) {
  return bytes_of(surface.points) + bytes_of(surface.triangles) + bytes_of(surface.sides);
}

std::size_t memory_bytes(const TetMesh& mesh) {
  return bytes_of(mesh.points) + bytes_of(mesh.tets) + bytes_of(mesh.labels) + bytes_of(mesh.faces) +
         bytes_of(mesh.face_sides);
}

std::size_t memory_bytes(const WallsResult& result) {
  std::size_t bytes = bytes_of(result.fields);
  for (const WallField& wall : result.walls) {
    bytes += bytes_of(wall.thickness_mm) + bytes_of(wall.potential) + bytes_of(wall.in_wall);
    for (const std::vector<float>& share : wall.inner_shares) bytes += bytes_of(share);
  }
  return bytes;
}

std::size_t memory_bytes(const SizingField& sizing) {
  return bytes_of(sizing.h_mm);
}

std::size_t memory_bytes(const LayersResult&) {
  return sizeof(LayersResult);
}

std::size_t memory_bytes(const LabelTransfer& found) {
  return bytes_of(found.fields);
}

std::size_t memory_bytes(const QualityReport& report) {
  return bytes_of(report.fields);
}

std::size_t memory_bytes(const AnatomyResult& result) {
  const VentricularPotentials& p = result.potentials;
  std::size_t bytes = bytes_of(result.fields);
  for (const Eigen::VectorXd* potential : {&p.epi, &p.lv, &p.rv, &p.base, &p.free_wall})
    bytes += static_cast<std::size_t>(potential->size()) * sizeof(double);
  if (result.surfaces) bytes += bytes_of(result.surfaces->faces) + result.surfaces->wall.size() / 8;
  return bytes;
}

std::size_t memory_bytes(const FibresResult& result) {
  return bytes_of(result.fibres.fibre) + bytes_of(result.fibres.sheet) + bytes_of(result.fields);
}

std::size_t memory_bytes(const TissueResult& result) {
  const Tissue& tissue = result.tissue;
  return bytes_of(tissue.kind) + bytes_of(tissue.share) + bytes_of(tissue.fibre) + bytes_of(result.fields);
}

std::size_t memory_bytes(const EikonalResult& result) {
  return bytes_of(result.fields);
}

std::size_t memory_bytes(const MechanicsResult& result) {
  return memory_bytes(static_cast<const Trajectory&>(result)) +
         result.beats.size() * 2 * sizeof(VentricleBeat);
}

std::size_t memory_bytes(const Trajectory& result) {
  std::size_t bytes = bytes_of(result.times_ms) + bytes_of(result.last.fields) + bytes_of(result.fields) +
                      bytes_of(result.trace_times_ms);
  for (const Trace& trace : result.traces) bytes += bytes_of(trace.values);
  return bytes;
}

}  // namespace voxtet
