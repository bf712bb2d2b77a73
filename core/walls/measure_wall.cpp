#include "walls/measure_wall.h"

#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <string>

#include "base/parallel.h"
#include "geometry/grid/distance_transform.h"
#include "geometry/grid/fast_sweeping.h"
#include "geometry/topology/label_components.h"
#include "types/stage_names.h"
#include "walls/find_cavities.h"
#include "walls/wall_grid.h"
#include "walls/wall_lengths.h"
#include "walls/wall_potential.h"
#include "walls/wall_sides.h"

namespace voxtet {
namespace {

using wall::WallGrid;

constexpr double kThinVoxels = 3, kThinShare = 0.05;
constexpr std::size_t kMostFineVoxels = std::size_t{1} << 27;
constexpr float kLonger =
    1.25F;  ///< how much longer a line may be than the shortest and still give the potential
constexpr std::size_t kBeyond = 2;  ///< voxels by which values go on outside of the wall

/// The first complaint about the labels, if any.
std::optional<Error> find_label_error(const LabelVolume& anatomy, const WallLabels& labels,
                                      const std::string& name) {
  const auto refuse = [&](const std::string& message) {
    return Error{ErrorCode::kUsage, kSizingStage, name + message, {}};
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
  for_indices(0, input.meshed.labels.size(), [&](std::size_t v) {
    balance[input.meshed.labels[v]] += is_wall[input.anatomy.labels[v]] ? 1 : -1;
  });
  std::vector<Triangle> triangles;
  for_indices(0, input.surface.triangles.size(), [&](std::size_t t) {
    const Sides& sides = input.surface.sides[t];
    const bool behind = sides[0] != kBackground && balance[sides[0]] > 0;
    const bool front = sides[1] != kBackground && balance[sides[1]] > 0;
    if (behind == front) return;
    Triangle triangle = input.surface.triangles[t];
    if (front) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
  });
  return triangles;
}

/// Marks the wall voxels that can be reached through the wall in at most `most` steps from face to face, from
/// inner spaces of which `starts` approves; returns the number of steps taken.
template <class Starts>
std::size_t reach(const WallGrid& grid, Starts&& starts, std::size_t most, std::vector<std::uint8_t>& marks) {
  marks.assign(grid.kind.size(), 0);
  const std::array<std::size_t, 3> stride = grid.strides();  // no wall voxel is at the grid's border
  std::vector<std::size_t> front, next;
  const auto begins = [&](std::size_t other) {
    return grid.kind[other] >= wall::kInner && starts(grid.kind[other]);
  };
  for_indices(0, grid.kind.size(), [&](std::size_t at) {
    if (grid.kind[at] != wall::kWall) return;
    for (const std::size_t step : stride)
      if (begins(at - step) || begins(at + step)) marks[at] = 1;
    if (marks[at]) front.push_back(at);
  });
  std::size_t steps = 0;
  for (; steps < most && !front.empty(); ++steps) {
    next.clear();
    if (steps + 1 < most)
      for_indices(0, front.size(), [&](std::size_t f) {
        for (const std::size_t step : stride)
          for (const std::size_t other : {front[f] - step, front[f] + step}) {
            if (grid.kind[other] != wall::kWall || marks[other]) continue;
            marks[other] = 1;
            next.push_back(other);
          }
      });
    front.swap(next);
  }
  return steps;
}

/// Thickness and potential of the wall voxels of a grid; 0 where no line reaches both surfaces.
struct Measured {
  std::vector<float> thickness_mm, potential;
  std::vector<std::vector<float>> shares;  ///< by inner space, its harmonic measure; empty if not wanted

  /// All of them, the thickness first.
  std::vector<std::vector<float>*> all() {
    std::vector<std::vector<float>*> out{&thickness_mm, &potential};
    for (std::vector<float>& share : shares) out.push_back(&share);
    return out;
  }
};

/// What the lines to one inner space say, by node of its graph.
struct Lines {
  std::vector<std::size_t> voxel;  ///< of the grid
  std::vector<float> length_mm;    ///< +infinity where no line reaches both surfaces
  std::vector<float> potential;
};

Lines follow_lines(const WallGrid& grid, std::uint8_t inner, const std::vector<std::uint8_t>& within,
                   int threads) {
  wall::WallGraph graph = wall::wall_graph(grid, inner, threads, within);
  Lines lines;
  lines.potential = wall::wall_potential(grid, graph, threads);
  wall::WallLengths lengths = wall::wall_lengths(grid, graph, lines.potential, threads);
  lines.length_mm = std::move(lengths.to_inner);
  for (std::size_t n = 0; n < lines.length_mm.size(); ++n) lines.length_mm[n] += lengths.to_outer[n];
  lines.voxel = std::move(graph.voxel);
  return lines;
}

Measured measure(const WallGrid& grid, std::size_t inner_count, bool shares, RunContext& ctx) {
  // All lines before any of what is as large as the grid, as the graphs need the most memory.
  std::vector<Lines> spaces;
  std::vector<std::uint8_t> within;
  const std::size_t deepest = reach(
      grid, [](std::uint8_t) { return true; }, grid.kind.size(), within);
  for (std::size_t space = 0; space < inner_count && !ctx.cancelled(); ++space) {
    const auto inner = static_cast<std::uint8_t>(wall::kInner + space);
    // Lines that begin further away than any voxel is from the inner space nearest to it are those of others.
    reach(
        grid, [&](std::uint8_t kind) { return kind == inner; }, deepest + deepest / 2, within);
    spaces.push_back(follow_lines(grid, inner, within, ctx.threads));
  }
  within = {};
  Measured out;
  out.thickness_mm.assign(grid.kind.size(), kFar);
  out.potential.assign(grid.kind.size(), 0);
  if (shares) out.shares.assign(inner_count, std::vector<float>(grid.kind.size(), 0));
  std::vector<float> chosen(grid.kind.size(), kFar);  // length of the line that gives the potential
  for (std::size_t space = 0; space < spaces.size(); ++space) {
    const Lines& lines = spaces[space];
    for_indices(0, lines.voxel.size(), [&](std::size_t n) {
      const float length = lines.length_mm[n];
      const std::size_t at = lines.voxel[n];
      if (shares) out.shares[space][at] = 1 - lines.potential[n];
      if (!(length < kFar)) return;
      out.thickness_mm[at] = std::min(out.thickness_mm[at], length);
      if (!(length * kLonger < chosen[at])) return;
      chosen[at] = length;
      out.potential[at] = lines.potential[n];
    });
  }
  std::replace(out.thickness_mm.begin(), out.thickness_mm.end(), kFar, 0.F);
  return out;
}

/// Gives values to voxels of which `wants` approves and that have none, the means of what their face
/// neighbours have, ring by ring.
template <class Wants>
void spread(const WallGrid& grid, std::size_t rings, Wants&& wants, Measured& values) {
  const std::vector<std::vector<float>*> all = values.all();
  const auto known = [&](std::size_t at) { return values.thickness_mm[at] > 0; };
  std::vector<std::size_t> front, next;
  const auto add_beside = [&](std::size_t at) {
    for_face_neighbours(grid.size, at, [&](std::size_t other, std::size_t) {
      if (wants(other) && !known(other)) next.push_back(other);
    });
  };
  const std::array<std::size_t, 3> stride = grid.strides();  // at first nothing is known at the grid's border
  const auto is_surrounded = [&](std::size_t at) {
    return std::all_of(stride.begin(), stride.end(),
                       [&](std::size_t step) { return known(at - step) && known(at + step); });
  };
  for_indices(0, grid.kind.size(), [&](std::size_t at) {
    if (known(at) && !is_surrounded(at)) add_beside(at);
  });
  for (std::size_t ring = 0; !next.empty() && ring < rings; ++ring) {
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    front.swap(next);
    next.clear();
    std::vector<float> found(front.size() * all.size(), 0);
    for (std::size_t f = 0; f < front.size(); ++f) {
      float count = 0;
      for_face_neighbours(grid.size, front[f], [&](std::size_t other, std::size_t) {
        if (!known(other)) return;
        for (std::size_t v = 0; v < all.size(); ++v) found[f * all.size() + v] += (*all[v])[other];
        count += 1;
      });
      for (std::size_t v = 0; v < all.size(); ++v) found[f * all.size() + v] /= count;
    }
    for (std::size_t f = 0; f < front.size(); ++f)
      for (std::size_t v = 0; v < all.size(); ++v) (*all[v])[front[f]] = found[f * all.size() + v];
    for (const std::size_t at : front) add_beside(at);
  }
}

/// The largest of the inner spaces' shares of a voxel.
float& largest_share(Measured& values, std::size_t at) {
  std::size_t best = 0;
  for (std::size_t s = 1; s < values.shares.size(); ++s)
    if (values.shares[s][at] > values.shares[best][at]) best = s;
  return values.shares[best][at];
}

/// Values beyond the wall: thickness as in the wall nearby, and the potential and the shares as they would go
/// on, so that they are 0 and 1 at the surfaces.
void continue_outside(const WallGrid& grid, std::size_t rings, Measured& values) {
  const auto outside = [&](std::size_t at) { return grid.kind[at] != wall::kWall; };
  spread(grid, rings, outside, values);
  for_indices(0, grid.kind.size(), [&](std::size_t at) {
    const std::uint8_t kind = grid.kind[at];
    if (!outside(at) || kind == wall::kSide || !(values.thickness_mm[at] > 0)) return;
    const float beyond = grid.distance_mm[at] / values.thickness_mm[at];
    values.potential[at] = values.potential[at] < 0.5F ? -beyond : 1 + beyond;
    if (values.shares.empty()) return;
    if (kind == wall::kOuter)
      largest_share(values, at) = -beyond;
    else
      values.shares[kind - wall::kInner][at] = 1 + beyond;
  });
}

/// Whether more than a few of the wall's voxels are thinner than three voxels. Cubes are compared, so that
/// every platform decides alike.
bool is_thin(const WallGrid& grid, const Measured& values, double voxel_mm3) {
  const double limit_mm3 = kThinVoxels * kThinVoxels * kThinVoxels * voxel_mm3;
  std::size_t thin = 0, count = 0;
  for_indices(0, grid.kind.size(), [&](std::size_t at) {
    const double t = values.thickness_mm[at];
    if (grid.kind[at] != wall::kWall || t == 0) return;
    ++count;
    thin += t * t * t < limit_mm3;
  });
  return static_cast<double>(thin) > kThinShare * static_cast<double>(count);
}

WallField field_of(const WallGrid& grid, Measured values, const std::vector<Label>& labels) {
  WallField field;
  field.wall = labels;
  static_cast<Grid&>(field) = grid;
  field.invert();
  field.thickness_mm = std::move(values.thickness_mm);
  field.potential = std::move(values.potential);
  field.inner_shares = std::move(values.shares);
  field.in_wall.resize(grid.kind.size());
  std::transform(grid.kind.begin(), grid.kind.end(), field.in_wall.begin(),
                 [](std::uint8_t kind) { return kind == wall::kWall; });
  return field;
}

Error without_sides(const std::string& name, const WallLabels& labels) {
  const std::string found = labels.inner.empty()
                                ? ": the background has no cavity that the wall encloses or surrounds"
                                : ": none of the inner labels touches the wall, or nothing else does";
  return Error{ErrorCode::kUsage,
               kSizingStage,
               name + found + "; expected a wall with an inner and an outer side, so that it has a thickness",
               {}};
}

}  // namespace

Result<WallField> measure_wall(const WallInput& input, const WallLabels& labels, const std::string& name,
                               RunContext& ctx) {
  if (const auto error = find_label_error(input.anatomy, labels, name)) return *error;
  if (!has_orthogonal_axes(input.anatomy.linear()))
    return Error{ErrorCode::kUsage,
                 kSizingStage,
                 name + ": the volume's axes are not at right angles, expected a volume that is not sheared",
                 {}};
  WallGrid coarse = wall::wall_grid(input.anatomy, labels.wall, labels.inner);
  const std::size_t inner_count = labels.inner.empty() ? wall::find_cavities(coarse) : labels.inner.size();
  wall::mark_base(coarse);
  const std::vector<Triangle> triangles = wall_triangles(input, labels.wall);

  WallGrid grid = coarse;
  wall::measure_distances(input.surface.points, triangles, 1, ctx.threads, grid);
  Measured values = measure(grid, inner_count, labels.shares, ctx);
  int factor = 1;
  if (is_thin(grid, values, input.anatomy.voxel_mm3()) && !ctx.cancelled() &&
      8 * grid.kind.size() <= kMostFineVoxels) {
    factor = 2;
    grid = wall::refined(coarse, factor);
    wall::measure_distances(input.surface.points, triangles, factor, ctx.threads, grid);
    values = measure(grid, inner_count, labels.shares, ctx);
  }
  if (ctx.cancelled()) return cancelled_error(kSizingStage);
  if (std::none_of(values.thickness_mm.begin(), values.thickness_mm.end(), [](float t) { return t > 0; }))
    return without_sides(name, labels);
  const auto in_wall = [&](std::size_t at) { return grid.kind[at] == wall::kWall; };
  spread(grid, grid.kind.size(), in_wall, values);
  continue_outside(grid, kBeyond * static_cast<std::size_t>(factor), values);
  return field_of(grid, std::move(values), labels.wall);
}

}  // namespace voxtet
