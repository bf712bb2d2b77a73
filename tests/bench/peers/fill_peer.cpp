#include "bench/peers/fill_peer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>

#include "base/union_find.h"
#include "bench/peers/peer.h"
#include "geometry/elements/tet_measures.h"
#include "geometry/topology/adjacency.h"
#include "pipeline/memory.h"
#include "tetra/fill/label_tets.h"

namespace voxtet::peers {
namespace {

constexpr int kMaxTrials = 6;
constexpr double kLikeCount = 0.05;

double volume_mm3(const Filled& filled, const Tet& t) {
  return tet_volume_mm3({filled.points[t[0]], filled.points[t[1]], filled.points[t[2]], filled.points[t[3]]});
}

/// Makes the volumes positive where the mesher counts the other orientation as such.
void turn(Filled& filled) {
  double sum = 0;
  for (const Tet& t : filled.tets) sum += volume_mm3(filled, t);
  if (sum >= 0) return;
  for (Tet& t : filled.tets) std::swap(t[2], t[3]);
}

/// Finds a triangle of the surface by its corners, in any order.
class TriangleFinder {
 public:
  explicit TriangleFinder(const SurfaceMesh& surface) {
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
      entries_.push_back({ascending(surface.triangles[t]), t});
    std::sort(entries_.begin(), entries_.end());
  }
  std::optional<std::uint32_t> find(const Triangle& corners) const {
    const auto at = std::lower_bound(entries_.begin(), entries_.end(), std::pair{ascending(corners), 0U});
    if (at == entries_.end() || at->first != ascending(corners)) return std::nullopt;
    return at->second;
  }

 private:
  static Triangle ascending(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  }
  std::vector<std::pair<Triangle, std::uint32_t>> entries_;
};

/// Scales the target sizes until the number of tetrahedra is as asked for, as nearly as a few trials get.
void calibrate(FillTask& task, double tets, const FillSurface& fill, const std::string& variant) {
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    const Result<Filled> filled = fill(task, variant);
    if (!filled || filled->tets.empty()) return;
    const double ratio = static_cast<double>(filled->tets.size()) / tets;
    if (std::abs(ratio - 1) < kLikeCount) return;
    for (float& h : task.sizing.h_mm) h *= static_cast<float>(std::cbrt(ratio));
  }
}

/// The label on that side of a triangle where the tetrahedron lies.
Label side_of(const SurfaceMesh& surface, std::uint32_t triangle, const Filled& filled, std::uint32_t tet) {
  const auto [a, b, c] = surface.triangles[triangle];
  for (const std::uint32_t v : filled.tets[tet])
    if (v != a && v != b && v != c)
      return surface.sides[triangle][volume_mm3(filled, {a, b, c, v}) < 0 ? 0 : 1];
  return kBackground;
}

/// The parts that the surface's triangles bound, without those in background.
FilledParts parts_of(const SurfaceMesh& surface, Filled filled) {
  turn(filled);
  const TriangleFinder triangles(surface);
  const std::uint32_t count = static_cast<std::uint32_t>(filled.tets.size());
  UnionFind parts(count);
  std::vector<Label> touched(count, kBackground);
  for (const TetFace& face : tet_faces(filled.tets, filled.points.size())) {
    const auto triangle = triangles.find(face.corners);
    if (!triangle && face.second != TetFace::kNoTet) parts.join(face.first, face.second);
    if (!triangle) continue;
    touched[face.first] = std::max(touched[face.first], side_of(surface, *triangle, filled, face.first));
    if (face.second != TetFace::kNoTet)
      touched[face.second] = std::max(touched[face.second], side_of(surface, *triangle, filled, face.second));
  }
  std::vector<Label> label(count, kBackground);
  for (std::uint32_t t = 0; t < count; ++t) label[parts.find(t)] = std::max(label[parts.find(t)], touched[t]);
  FilledParts kept;
  kept.points = std::move(filled.points);
  for (std::uint32_t t = 0; t < count; ++t) {
    if (label[parts.find(t)] == kBackground) continue;
    kept.tets.push_back(filled.tets[t]);
    kept.regions.push_back(parts.find(t) + 1);
  }
  return kept;
}

/// Drops the points beyond the surface's that no tetrahedron uses.
void drop_unused(std::size_t surface_points, FilledParts& mesh) {
  std::vector<std::uint32_t> place(mesh.points.size(), 0);
  for (const Tet& t : mesh.tets)
    for (const std::uint32_t v : t) place[v] = 1;
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (v >= surface_points && place[v] == 0) continue;
    mesh.points[next] = mesh.points[v];
    place[v] = next++;
  }
  mesh.points.resize(next);
  for (Tet& t : mesh.tets)
    for (std::uint32_t& v : t) v = place[v];
}

}  // namespace

int fill_main(int argc, char** argv, const FillSurface& fill) {
  if (argc != 5) {
    std::fprintf(stderr, "%s: expected SURFACE OUT VARIANT TETS\n", argv[0]);
    return 2;
  }
  Result<FillTask> task = read_fill_task(argv[1]);
  if (!task) {
    std::fprintf(stderr, "%s\n", task.error().message.c_str());
    return 1;
  }
  const std::string out = argv[2], variant = argv[3];
  if (const double tets = std::atof(argv[4]); tets > 0) calibrate(*task, tets, fill, variant);
  Result<Filled> filled = Filled{};
  nlohmann::json figures;
  figures["seconds"] = seconds_of([&] { filled = fill(*task, variant); });
  figures["peak_mb"] = peak_memory_mb();
  if (!filled) {
    figures["error"] = filled.error().message;
    return finish(out, {}, figures);
  }
  FilledParts parts = parts_of(task->surface, *std::move(filled));
  drop_unused(task->surface.points.size(), parts);
  const TetMesh unlabelled{parts.points, parts.tets, std::vector<Label>(parts.tets.size(), 1), {}, {}};
  const Result<TetMesh> mesh = label_tets(task->surface, std::move(parts));
  if (mesh) return finish(out, *mesh, figures);
  // Measured all the same: what it gave has shapes, though not the surface that was asked for.
  figures["error"] = mesh.error().message;
  return finish(out, unlabelled, figures);
}

}  // namespace voxtet::peers
