#include "sizing/measure_wall.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "geometry/label_components.h"
#include "sizing/find_cavities.h"
#include "sizing/limit_gradation.h"
#include "sizing/wall_grid.h"
#include "sizing/wall_lengths.h"
#include "sizing/wall_potential.h"
#include "sizing/wall_sides.h"

namespace voxtet {
namespace {

using wall::WallGrid;

constexpr const char* kStage = "sizing";
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr double kThinVoxels = 3, kThinShare = 0.05;
constexpr std::size_t kMostFineVoxels = std::size_t{1} << 27;
constexpr std::uint16_t kUnreached = 0xffff;
constexpr float kLonger =
    1.25F;                  ///< how much longer a line may be than the shortest and still give the potential
constexpr int kBeyond = 2;  ///< voxels by which values go on outside of the wall

/// The first complaint about the labels, if any.
std::optional<Error> find_label_error(const LabelVolume& anatomy, const WallLabels& labels,
                                      const std::string& name) {
  const auto refuse = [&](const std::string& message) {
    return Error{ErrorCode::kUsage, kStage, name + message, {}};
  };
  if (labels.wall.empty()) return refuse(".wall: found no labels, expected those that form the wall");
  if (labels.inner.size() > wall::kMaxInner)
    return refuse(".inner: found " + std::to_string(labels.inner.size()) + " labels, expected at most " +
                  std::to_string(wall::kMaxInner));
  std::vector<std::uint8_t> held(65536, 0), listed(65536, 0);
  for (const Label label : anatomy.labels) held[label] = 1;
  for (const auto& [field, list] : {std::pair(".wall", &labels.wall), std::pair(".inner", &labels.inner)})
    for (const Label label : *list) {
      if (label == kBackground || !held[label])
        return refuse(std::string(field) + ": found " + std::to_string(label) +
                      ", which the volume does not hold");
      if (listed[label]++)
        return refuse(std::string(field) + ": label " + std::to_string(label) + " is listed twice");
    }
  return std::nullopt;
}

/// The triangles of the surface that bound the wall, normals outwards. A meshed region belongs to the wall if
/// most of its voxels do.
std::vector<Triangle> wall_triangles(const WallInput& input, const std::vector<Label>& wall) {
  std::vector<std::uint8_t> is_wall(65536, 0);
  for (const Label label : wall) is_wall[label] = 1;
  std::vector<std::int64_t> balance(65536, 0);
  for (std::size_t v = 0; v < input.meshed.labels.size(); ++v)
    balance[input.meshed.labels[v]] += is_wall[input.anatomy.labels[v]] ? 1 : -1;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < input.surface.triangles.size(); ++t) {
    const Sides& sides = input.surface.sides[t];
    const bool behind = sides[0] != kBackground && balance[sides[0]] > 0;
    const bool front = sides[1] != kBackground && balance[sides[1]] > 0;
    if (behind == front) continue;
    Triangle triangle = input.surface.triangles[t];
    if (front) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
  }
  return triangles;
}

/// How many voxels one must go through the wall from each inner space, from face to face.
std::vector<std::vector<std::uint16_t>> steps_from_inner(const WallGrid& grid, std::size_t inner_count) {
  std::vector<std::vector<std::uint16_t>> steps(inner_count);
  for (std::size_t space = 0; space < inner_count; ++space) {
    std::vector<std::uint16_t>& here = steps[space];
    here.assign(grid.kind.size(), kUnreached);
    std::vector<std::size_t> front, next;
    for (std::size_t at = 0; at < grid.kind.size(); ++at)
      if (grid.kind[at] == wall::kInner + space) front.push_back(at);
    for (std::uint16_t step = 1; !front.empty() && step < kUnreached; ++step) {
      next.clear();
      for (const std::size_t at : front)
        for_face_neighbours(grid.size, at, [&](std::size_t other, std::size_t) {
          if (grid.kind[other] != wall::kWall || here[other] != kUnreached) return;
          here[other] = step;
          next.push_back(other);
        });
      front.swap(next);
    }
  }
  return steps;
}

/// Per inner space the voxels worth looking at: no further from it than half as much again as any voxel is
/// from the inner space nearest to it. The lines that begin elsewhere in the wall are those of other spaces.
std::vector<std::vector<std::uint8_t>> reaches(const WallGrid& grid, std::size_t inner_count) {
  const auto steps = steps_from_inner(grid, inner_count);
  std::uint16_t deepest = 0;
  for (std::size_t at = 0; at < grid.kind.size(); ++at) {
    std::uint16_t least = kUnreached;
    for (const auto& from : steps) least = std::min(least, from[at]);
    if (least != kUnreached) deepest = std::max(deepest, least);
  }
  std::vector<std::vector<std::uint8_t>> within(inner_count);
  for (std::size_t space = 0; space < inner_count; ++space) {
    within[space].resize(grid.kind.size());
    for (std::size_t at = 0; at < grid.kind.size(); ++at)
      within[space][at] = steps[space][at] <= deepest + deepest / 2;
  }
  return within;
}

/// Thickness and potential of the wall voxels of a grid; 0 where no line reaches both surfaces.
struct Measured {
  std::vector<float> thickness_mm, potential;
};

Measured measure(const WallGrid& grid, std::size_t inner_count, RunContext& ctx) {
  Measured out;
  out.thickness_mm.assign(grid.kind.size(), kFar);
  out.potential.assign(grid.kind.size(), 0);
  std::vector<float> chosen(grid.kind.size(), kFar);  // length of the line that gives the potential
  const std::vector<std::vector<std::uint8_t>> within = reaches(grid, inner_count);
  for (std::size_t space = 0; space < inner_count && !ctx.cancelled(); ++space) {
    const wall::WallGraph graph =
        wall::wall_graph(grid, static_cast<std::uint8_t>(wall::kInner + space), within[space]);
    const std::vector<float> potential = wall::wall_potential(grid, graph, ctx.threads);
    const wall::WallLengths lengths = wall::wall_lengths(grid, graph, potential, ctx.threads);
    for (std::size_t n = 0; n < graph.voxel.size(); ++n) {
      const float length = lengths.to_inner[n] + lengths.to_outer[n];
      if (!(length < kFar)) continue;
      const std::size_t at = graph.voxel[n];
      out.thickness_mm[at] = std::min(out.thickness_mm[at], length);
      if (!(length * kLonger < chosen[at])) continue;
      chosen[at] = length;
      out.potential[at] = potential[n];
    }
  }
  std::replace(out.thickness_mm.begin(), out.thickness_mm.end(), kFar, 0.F);
  return out;
}

/// Values for the voxels without any, from face neighbours with them, ring by ring: all of the wall that can
/// be reached, and `rings` voxels outside of it.
void spread(const WallGrid& grid, int rings, Measured& values) {
  const std::array<std::size_t, 3> stride = grid.strides();
  std::vector<std::size_t> front;
  for (const bool outside : {false, true}) {
    front.clear();
    const auto wants = [&](std::size_t at) {
      return values.thickness_mm[at] == 0 && (outside || grid.kind[at] == wall::kWall);
    };
    const auto for_neighbours = [&](std::size_t at, auto&& visit) {
      for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t place = at / stride[d] % static_cast<std::size_t>(grid.size[d]);
        if (place > 0) visit(at - stride[d]);
        if (place + 1 < static_cast<std::size_t>(grid.size[d])) visit(at + stride[d]);
      }
    };
    for (std::size_t at = 0; at < grid.kind.size(); ++at) {
      if (!wants(at)) continue;
      bool beside = false;
      for_neighbours(at, [&](std::size_t other) { beside = beside || values.thickness_mm[other] > 0; });
      if (beside) front.push_back(at);
    }
    for (int ring = 0; !front.empty() && (!outside || ring < rings); ++ring) {
      std::vector<std::array<float, 2>> found;
      for (const std::size_t at : front) {
        float thickness = 0, potential = 0, count = 0;
        for_neighbours(at, [&](std::size_t other) {
          if (!(values.thickness_mm[other] > 0)) return;
          thickness += values.thickness_mm[other];
          potential += values.potential[other];
          count += 1;
        });
        thickness /= count;
        potential /= count;
        if (outside && grid.kind[at] != wall::kSide) {
          const float beyond = grid.distance_mm[at] / thickness;
          potential = potential < 0.5F ? -beyond : 1 + beyond;
        }
        found.push_back({thickness, potential});
      }
      for (std::size_t f = 0; f < front.size(); ++f) {
        values.thickness_mm[front[f]] = found[f][0];
        values.potential[front[f]] = found[f][1];
      }
      std::vector<std::size_t> next;
      for (const std::size_t at : front)
        for_neighbours(at, [&](std::size_t other) {
          if (wants(other)) next.push_back(other);
        });
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      front = std::move(next);
    }
  }
}

/// The part of the wall's voxels that are thinner than `limit_mm`, of those that have a thickness.
double share_thinner(const WallGrid& grid, const Measured& values, double limit_mm) {
  std::size_t thin = 0, count = 0;
  for (std::size_t at = 0; at < grid.kind.size(); ++at) {
    if (grid.kind[at] != wall::kWall || values.thickness_mm[at] == 0) continue;
    ++count;
    thin += values.thickness_mm[at] < limit_mm;
  }
  return count > 0 ? static_cast<double>(thin) / static_cast<double>(count) : 0;
}

WallField field_of(const WallGrid& grid, Measured values, const std::vector<Label>& labels) {
  WallField field;
  field.wall = labels;
  field.size = grid.size;
  field.index_to_mm = grid.index_to_mm;
  field.mm_to_index = grid.index_to_mm.inverse();
  field.thickness_mm = std::move(values.thickness_mm);
  field.potential = std::move(values.potential);
  field.in_wall.resize(grid.kind.size());
  for (std::size_t at = 0; at < grid.kind.size(); ++at) field.in_wall[at] = grid.kind[at] == wall::kWall;
  return field;
}

Error without_sides(const std::string& name, const WallLabels& labels) {
  const std::string found = labels.inner.empty()
                                ? ": the background has no cavity that the wall encloses or surrounds"
                                : ": none of the inner labels touches the wall, or nothing else does";
  return Error{ErrorCode::kUsage,
               kStage,
               name + found + "; expected a wall with an inner and an outer side, so that it has a thickness",
               {}};
}

}  // namespace

Result<WallField> measure_wall(const WallInput& input, const WallLabels& labels, const std::string& name,
                               RunContext& ctx) {
  if (const auto error = find_label_error(input.anatomy, labels, name)) return *error;
  if (!has_orthogonal_axes(input.anatomy.linear()))
    return Error{ErrorCode::kUsage,
                 kStage,
                 name + ": the volume's axes are not at right angles, expected a volume that is not sheared",
                 {}};
  WallGrid coarse = wall::wall_grid(input.anatomy, labels.wall, labels.inner);
  const std::size_t inner_count = labels.inner.empty() ? wall::find_cavities(coarse) : labels.inner.size();
  wall::mark_base(coarse);
  const std::vector<Triangle> triangles = wall_triangles(input, labels.wall);

  WallGrid grid = coarse;
  wall::measure_distances(input.surface.points, triangles, 1, ctx.threads, grid);
  Measured values = measure(grid, inner_count, ctx);
  const double voxel = std::cbrt(input.anatomy.voxel_mm3());
  int factor = 1;
  if (share_thinner(grid, values, kThinVoxels * voxel) > kThinShare && !ctx.cancelled() &&
      8 * grid.kind.size() <= kMostFineVoxels) {
    factor = 2;
    grid = wall::refined(coarse, factor);
    wall::measure_distances(input.surface.points, triangles, factor, ctx.threads, grid);
    values = measure(grid, inner_count, ctx);
  }
  if (ctx.cancelled()) return cancelled_error(kStage);
  if (std::none_of(values.thickness_mm.begin(), values.thickness_mm.end(), [](float t) { return t > 0; }))
    return without_sides(name, labels);
  spread(grid, kBeyond * factor, values);
  return field_of(grid, std::move(values), labels.wall);
}

}  // namespace voxtet
