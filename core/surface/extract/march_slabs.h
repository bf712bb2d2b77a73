// Extraction of a label volume in slabs of cell layers, one slab per thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <vector>

#include "base/parallel.h"
#include "surface/extract/lattice_walk.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/stage_names.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Triangles of cell layers [begin, end). Vertices on the lowest plane belong to the layer below. That layer
/// is walked too, to find their order: `points` begins with the `borrowed` points that it makes.
struct MarchedSlab {
  SurfaceMesh mesh;
  std::size_t borrowed = 0;
};

/// Joins the slabs; the borrowed points of a slab are the last points of the slab before it.
inline SurfaceMesh join_slabs(std::vector<MarchedSlab> slabs) {
  SurfaceMesh out = std::move(slabs.front().mesh);
  std::size_t points = out.points.size(), triangles = out.triangles.size();
  for (std::size_t s = 1; s < slabs.size(); ++s) {
    points += slabs[s].mesh.points.size() - slabs[s].borrowed;
    triangles += slabs[s].mesh.triangles.size();
  }
  out.points.reserve(points);
  out.triangles.reserve(triangles);
  out.sides.reserve(triangles);
  for (std::size_t s = 1; s < slabs.size(); ++s) {
    const SurfaceMesh& mesh = slabs[s].mesh;
    const auto shift = static_cast<std::uint32_t>(out.points.size() - slabs[s].borrowed);
    out.points.insert(out.points.end(), mesh.points.begin() + static_cast<std::ptrdiff_t>(slabs[s].borrowed),
                      mesh.points.end());
    for (const Triangle& t : mesh.triangles)
      out.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    out.sides.insert(out.sides.end(), mesh.sides.begin(), mesh.sides.end());
    slabs[s] = {};
  }
  return out;
}

/// Walks all mixed cells, each slab with its own visitor from make(SurfaceMesh& out). A visitor must add the
/// points of a cell's highest corner in an order that depends only on the cell. For any number of threads the
/// result is that of a single slab.
template <class Make>
Result<SurfaceMesh> march_slabs(const LabelVolume& volume, bool binary, const RunContext& ctx, Make&& make) {
  const int layers = volume.size[2] + 1, count = std::clamp(ctx.threads, 1, layers);
  std::vector<MarchedSlab> slabs(static_cast<std::size_t>(count));
  std::atomic<bool> cancelled = false;
  const auto march = [&](int s) {
    MarchedSlab& slab = slabs[static_cast<std::size_t>(s)];
    const int begin = layers * s / count, end = layers * (s + 1) / count;
    auto visitor = make(slab.mesh);
    LabelSlab labels(volume, binary);
    labels.load(std::max(begin - 1, 0));
    for (int z = std::max(begin - 1, 0); z < end && !cancelled; ++z) {
      if (s == 0) {  // on the caller's own thread
        if (ctx.cancelled()) cancelled = true;
        if (cancelled) return;
        ctx.progress(kSurfaceStage, static_cast<double>(z) / end);
      }
      labels.load(z + 1);
      walk_mixed_cells(volume, labels, z, visitor);
      if (z >= begin) continue;
      slab.borrowed = slab.mesh.points.size();
      slab.mesh.triangles.clear();
      slab.mesh.sides.clear();
    }
  };
  parallel_for(ctx.threads, slabs.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) march(static_cast<int>(s));
  });
  if (cancelled) return cancelled_error(kSurfaceStage);
  SurfaceMesh out = join_slabs(std::move(slabs));
  ctx.progress(kSurfaceStage, 1.0);
  return out;
}

}  // namespace voxtet
