#include "surface/smooth/join_diagonals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/topology/uniform_block.h"
#include "surface/smooth/lattice_edge.h"
#include "surface/smooth/voxel_centres.h"

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kFarthest = 0.1;  ///< of a joined vertex from the planes of its triangles, voxels
/// Of the angle by which a triangle turns, as it is and at its start.
constexpr double kLeastCosine = 0.8, kLeastStartCosine = 0.3;
constexpr double kLeastQuality = 0.2;  ///< of a triangle, see quality_after()

class DiagonalJoiner {
 public:
  DiagonalJoiner(const LabelVolume& volume, const SurfaceMesh& surface, const Points& start,
                 const Points& points, int threads);

  /// False when cancelled.
  bool run(const RunContext& ctx);
  JoinedSurface left() const;

 private:
  enum class Kind : std::uint8_t { kKept, kAxis, kDiagonal };
  struct Facet {
    std::uint32_t triangle, a, b;  ///< corners after the vertex, in its order
    Eigen::Vector3d start_cross, cross;
  };

  Kind kind_of(const Eigen::Vector3d& at) const;
  bool is_thin(const std::array<int, 3>& voxel) const;
  bool join(std::uint32_t v);
  void gather_ring(std::uint32_t v);
  double quality_after(std::uint32_t v, std::uint32_t onto) const;
  bool passes_centre(std::uint32_t v, std::uint32_t onto) const;
  bool link_allows(std::uint32_t v, std::uint32_t onto);
  void collapse(std::uint32_t v, std::uint32_t onto);

  const LabelVolume& volume_;
  const Points &start_, &points_;
  std::vector<Triangle> triangles_;
  std::vector<Kind> kinds_;
  std::vector<std::uint32_t> first_, next_;  ///< corners of triangles around each vertex, as lists
  std::vector<std::uint32_t> marks_;         ///< vertices around the one that is looked at
  std::uint32_t mark_ = 0;
  std::vector<Facet> ring_;
  std::vector<std::pair<double, std::uint32_t>> ways_;  ///< quality of its triangles, and the vertex
};

DiagonalJoiner::DiagonalJoiner(const LabelVolume& volume, const SurfaceMesh& surface, const Points& start,
                               const Points& points, int threads)
    : volume_(volume),
      start_(start),
      points_(points),
      triangles_(surface.triangles),
      kinds_(start.size()),
      first_(start.size(), kNone),
      next_(3 * surface.triangles.size()),
      marks_(start.size(), 0) {
  parallel_for(threads, start.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) kinds_[v] = kind_of(start[v]);
  });
  for (std::uint32_t corner = static_cast<std::uint32_t>(next_.size()); corner-- > 0;) {
    const std::uint32_t v = triangles_[corner / 3][corner % 3];
    next_[corner] = first_[v];
    first_[v] = corner;
  }
}

DiagonalJoiner::Kind DiagonalJoiner::kind_of(const Eigen::Vector3d& at) const {
  const std::optional<LatticeEdge> edge = lattice_edge_of(at);
  if (!edge) return Kind::kKept;
  if (edge->direction().lpNorm<1>() == 1) return Kind::kAxis;
  return is_thin(edge->p) || is_thin(edge->q) ? Kind::kKept : Kind::kDiagonal;
}

/// Background around the volume is not thin; at its border, where blocks would reach beyond, all is.
bool DiagonalJoiner::is_thin(const std::array<int, 3>& voxel) const {
  bool outside = false, border = false;
  for (std::size_t d = 0; d < 3; ++d) {
    outside = outside || voxel[d] < 0 || voxel[d] >= volume_.size[d];
    border = border || voxel[d] == 0 || voxel[d] == volume_.size[d] - 1;
  }
  if (outside) return false;
  return border ||
         !in_uniform_block(volume_.size, volume_.labels, volume_.offset(voxel[0], voxel[1], voxel[2]));
}

/// What cannot be joined yet may be when its neighbours are.
bool DiagonalJoiner::run(const RunContext& ctx) {
  constexpr int kRounds = 3;
  constexpr std::size_t kBetweenQuestions = 4096;
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t v = 0; v < kinds_.size(); ++v)
    if (kinds_[v] == Kind::kDiagonal) waiting.push_back(v);
  for (int round = 0; round < kRounds; ++round) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      if (i % kBetweenQuestions == 0 && ctx.cancelled()) return false;
      if (!join(waiting[i])) waiting[kept++] = waiting[i];
    }
    if (kept == waiting.size()) break;
    waiting.resize(kept);
  }
  return true;
}

/// To the neighbour on an axis that leaves the best triangles, and of equal ones to the first.
bool DiagonalJoiner::join(std::uint32_t v) {
  gather_ring(v);
  ways_.clear();
  for (const Facet& facet : ring_) {
    if (kinds_[facet.a] != Kind::kAxis) continue;
    const double quality = quality_after(v, facet.a);
    if (quality >= kLeastQuality) ways_.emplace_back(-quality, facet.a);
  }
  std::sort(ways_.begin(), ways_.end());
  for (const auto& [quality, onto] : ways_) {
    if (!link_allows(v, onto) || passes_centre(v, onto)) continue;
    collapse(v, onto);
    return true;
  }
  return false;
}

void DiagonalJoiner::gather_ring(std::uint32_t v) {
  ring_.clear();
  for (std::uint32_t corner = first_[v]; corner != kNone; corner = next_[corner]) {
    const std::uint32_t t = corner / 3, k = corner % 3;
    const Triangle& c = triangles_[t];
    const std::uint32_t a = c[(k + 1) % 3], b = c[(k + 2) % 3];
    ring_.push_back({t, a, b, triangle_cross(start_[v], start_[a], start_[b]),
                     triangle_cross(points_[v], points_[a], points_[b])});
  }
}

/// Area over edges squared of the worst triangle, 1 for equilateral ones; negative where one turns, or is far
/// from the vertex.
double DiagonalJoiner::quality_after(std::uint32_t v, std::uint32_t onto) const {
  const auto turns = [](const Eigen::Vector3d& before, const Eigen::Vector3d& after, double least_cosine) {
    const double along = before.dot(after);
    return !(along > 0) ||
           along * along < least_cosine * least_cosine * before.squaredNorm() * after.squaredNorm();
  };
  const double scale = 2 * std::sqrt(3.0);
  const Eigen::Vector3d &p = points_[onto], &start_p = start_[onto];
  double worst = 1;
  for (const Facet& facet : ring_) {
    if (facet.a == onto || facet.b == onto) continue;
    const Eigen::Vector3d &a = points_[facet.a], &b = points_[facet.b];
    const Eigen::Vector3d cross = triangle_cross(p, a, b);
    if (turns(facet.cross, cross, kLeastCosine)) return -1;
    if (turns(facet.start_cross, triangle_cross(start_p, start_[facet.a], start_[facet.b]),
              kLeastStartCosine))
      return -1;
    const double height = std::abs(cross.dot(points_[v] - p)), area2 = cross.squaredNorm();
    if (height * height > kFarthest * kFarthest * area2) return -1;
    const double edges2 = (a - p).squaredNorm() + (b - p).squaredNorm() + (b - a).squaredNorm();
    worst = std::min(worst, scale * std::sqrt(area2) / edges2);
  }
  return worst;
}

bool DiagonalJoiner::passes_centre(std::uint32_t v, std::uint32_t onto) const {
  const auto all = [](const Eigen::Vector3d&) { return true; };
  for (const Facet& facet : ring_) {
    if (facet.a == onto || facet.b == onto) continue;
    for (const Points* at : {&points_, &start_})
      if (reaches_centre<4>({&(*at)[v], &(*at)[onto], &(*at)[facet.a], &(*at)[facet.b]}, all)) return true;
  }
  return false;
}

/// Both are inside one interface, so that the plain link condition is enough.
bool DiagonalJoiner::link_allows(std::uint32_t v, std::uint32_t onto) {
  mark_ += 2;
  for (const Facet& facet : ring_) marks_[facet.a] = marks_[facet.b] = mark_;
  std::size_t common = 0, around = 0;
  for (std::uint32_t corner = first_[onto]; corner != kNone; corner = next_[corner]) {
    ++around;
    const Triangle& c = triangles_[corner / 3];
    for (const std::uint32_t k : {1U, 2U}) {
      const std::uint32_t w = c[(corner % 3 + k) % 3];
      if (w == v || marks_[w] != mark_) continue;
      marks_[w] = mark_ + 1;
      ++common;
    }
  }
  return common == 2 && (ring_.size() > 3 || around > 3);
}

void DiagonalJoiner::collapse(std::uint32_t v, std::uint32_t onto) {
  // The two triangles at the edge leave the lists of their corners.
  for (const Facet& facet : ring_) {
    if (facet.a != onto && facet.b != onto) continue;
    for (const std::uint32_t w : {facet.a, facet.b}) {
      std::uint32_t* link = &first_[w];
      while (*link / 3 != facet.triangle) link = &next_[*link];
      *link = next_[*link];
    }
    triangles_[facet.triangle] = {kNone, kNone, kNone};
  }
  std::uint32_t* end = &first_[onto];
  while (*end != kNone) end = &next_[*end];
  for (std::uint32_t corner = first_[v]; corner != kNone; corner = next_[corner]) {
    Triangle& t = triangles_[corner / 3];
    if (t[0] == kNone) continue;
    t[corner % 3] = onto;
    *end = corner;
    end = &next_[corner];
  }
  *end = kNone;
  first_[v] = kNone;
}

JoinedSurface DiagonalJoiner::left() const {
  JoinedSurface out;
  std::vector<std::uint32_t> id(first_.size(), kNone);
  for (std::uint32_t v = 0; v < id.size(); ++v) {
    if (first_[v] == kNone) continue;
    id[v] = static_cast<std::uint32_t>(out.vertex_of.size());
    out.vertex_of.push_back(v);
  }
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    if (a == kNone) continue;
    out.triangles.push_back({id[a], id[b], id[c]});
    out.triangle_of.push_back(t);
  }
  return out;
}

}  // namespace

std::optional<JoinedSurface> join_diagonals(const LabelVolume& volume, const SurfaceMesh& surface,
                                            const Points& start, const Points& points,
                                            const RunContext& ctx) {
  DiagonalJoiner joiner(volume, surface, start, points, ctx.threads);
  if (!joiner.run(ctx)) return std::nullopt;
  return joiner.left();
}

}  // namespace voxtet
