#include "remesh/delaunay/find_missed.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/search/closest_point.h"
#include "geometry/search/near_triangles.h"

namespace voxtet::remesh {
namespace {

constexpr std::size_t kMostSamples = 100'000;
constexpr std::size_t kThoroughStride = 2;
constexpr double kNarrowVoxels = 2;   ///< labels that end within so many of a triangle are narrow
constexpr double kTurnedShare = 0.1;  ///< of the limit: nearer than this, a turned triangle does no harm

std::uint32_t pair_of(const Sides& sides) {
  return (static_cast<std::uint32_t>(sides[0]) << 16) | sides[1];
}

bool beside_any(const Sides& sides, const std::vector<Label>& labels) {
  return std::binary_search(labels.begin(), labels.end(), sides[0]) ||
         std::binary_search(labels.begin(), labels.end(), sides[1]);
}

/// Triangles for which `wanted` holds, grouped by their two labels.
template <class Wanted>
std::vector<std::uint32_t> by_pair(const std::vector<Sides>& sides, Wanted&& wanted) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t t = 0; t < sides.size(); ++t)
    if (wanted(t)) ids.push_back(t);
  std::stable_sort(ids.begin(), ids.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return pair_of(sides[a]) < pair_of(sides[b]); });
  return ids;
}

/// Every so many-th triangle is a sample, whatever its labels.
std::size_t stride_of(const SurfaceMesh& reference) {
  return std::max<std::size_t>(1, reference.triangles.size() / kMostSamples);
}

/// By triangle, a number that stands for its corners' places, whatever their order and numbers.
std::vector<std::uint64_t> names_of(const SurfaceMesh& surface) {
  std::vector<std::uint64_t> of_point;
  for (const Eigen::Vector3d& p : surface.points) {
    std::uint64_t name = 0;
    for (const double x : p) {  // splitmix64 (Steele et al. 2014)
      std::uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      name = (name ^ bits) + 0x9e3779b97f4a7c15;
      name = (name ^ (name >> 30)) * 0xbf58476d1ce4e5b9;
      name = (name ^ (name >> 27)) * 0x94d049bb133111eb;
      name ^= name >> 31;
    }
    of_point.push_back(name);
  }
  std::vector<std::uint64_t> names;
  for (const auto& [a, b, c] : surface.triangles) names.push_back(of_point[a] + of_point[b] + of_point[c]);
  return names;
}

Eigen::Vector3d cross_of(const SurfaceMesh& surface, const Triangle& t) {
  return triangle_cross(surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]);
}

bool is_turned(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double cosine) {
  return a.dot(b) < cosine * std::sqrt(a.squaredNorm() * b.squaredNorm());
}

Eigen::Vector3d centroid(const SurfaceMesh& surface, std::uint32_t t) {
  const auto [a, b, c] = surface.triangles[t];
  return (surface.points[a] + surface.points[b] + surface.points[c]) / 3;
}

double distance_to(const SurfaceMesh& surface, std::uint32_t t, const Eigen::Vector3d& point) {
  const auto [a, b, c] = surface.triangles[t];
  return (closest_on_triangle(point, surface.points[a], surface.points[b], surface.points[c]) - point).norm();
}

/// The point near one of a triangle, along its normal, where the field changes between its two labels.
std::optional<Eigen::Vector3d> onto_field(const SurfaceMesh& surface, std::uint32_t t,
                                          const Eigen::Vector3d& middle, const LabelField& field,
                                          double reach_mm) {
  const Eigen::Vector3d normal = cross_of(surface, surface.triangles[t]).normalized();
  const auto [behind, front] = surface.sides[t];
  for (const double reach : {0.2 * reach_mm, 0.5 * reach_mm, reach_mm}) {
    const Eigen::Vector3d from = middle - reach * normal, to = middle + reach * normal;
    const Label at_from = field.at(from), at_to = field.at(to);
    if (field.layers().parent(at_from) != behind || field.layers().parent(at_to) != front) continue;
    Label other = kBackground;
    return field.crossing(from, at_from, to, at_to, other);
  }
  return std::nullopt;
}

ClosestPointTree tree_of(const SurfaceMesh& surface, std::span<const std::uint32_t> ids) {
  std::vector<Triangle> triangles;
  for (const std::uint32_t t : ids) triangles.push_back(surface.triangles[t]);
  return ClosestPointTree(surface.points, triangles);
}

/// Whether, straight behind or before a triangle, its label ends within so many mm.
bool is_narrow(const SurfaceMesh& surface, std::uint32_t t, const LabelField& field, double width_mm) {
  const Eigen::Vector3d middle = centroid(surface, t);
  const Eigen::Vector3d step = width_mm * cross_of(surface, surface.triangles[t]).normalized();
  const auto [behind, front] = surface.sides[t];
  return field.at_index(field.to_index(middle - step)) != behind ||
         field.at_index(field.to_index(middle + step)) != front;
}

}  // namespace

/// Triangles by name.
class MissedPlaces::NamedTriangles {
 public:
  explicit NamedTriangles(const std::vector<std::uint64_t>& names) {
    for (std::uint32_t t = 0; t < names.size(); ++t) sorted_.push_back({names[t], t});
    std::sort(sorted_.begin(), sorted_.end());
  }

  std::optional<std::uint32_t> find(std::uint64_t name) const {
    const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{name, std::uint32_t{0}});
    if (at == sorted_.end() || at->first != name) return std::nullopt;
    return at->second;
  }

 private:
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted_;
};

MissedPlaces::MissedPlaces(const SurfaceMesh& reference, const LabelField& field)
    : reference_(reference), field_(field) {
  const std::size_t stride = stride_of(reference);
  samples_ =
      by_pair(reference.sides, [&](std::uint32_t t) { return t % stride == 0 || t % kThoroughStride == 0; });
  followed_by_.assign(samples_.size(), 0);
}

std::vector<Eigen::Vector3d> MissedPlaces::of(const SurfaceMesh& surface, const MissedCriteria& criteria,
                                              const RunContext& ctx) {
  constexpr std::size_t kSamplesPerQuestion = 1024, kWorthThreads = 4096;
  const std::vector<std::uint32_t> ids = by_pair(surface.sides, [](std::uint32_t) { return true; });
  const std::vector<std::uint64_t> names = names_of(surface);
  const NamedTriangles named(names);
  std::vector<Eigen::Vector3d> missed;
  std::size_t from = 0, asked_at = 0;
  for (std::size_t first = 0, last = 0; first < samples_.size(); first = last) {
    const Sides& sides = reference_.sides[samples_[first]];
    while (last < samples_.size() && reference_.sides[samples_[last]] == sides) ++last;
    if (last >= asked_at + kSamplesPerQuestion) {
      if (ctx.cancelled()) return missed;
      asked_at = last;
    }
    while (from < ids.size() && pair_of(surface.sides[ids[from]]) < pair_of(sides)) ++from;
    std::size_t to = from;
    while (to < ids.size() && surface.sides[ids[to]] == sides) ++to;
    const int threads = last - first < kWorthThreads ? 1 : ctx.threads;
    const std::vector<Question> questions = questions_between(first, last, criteria, threads);
    add_missed(answered(questions, surface, std::span(ids).subspan(from, to - from), names, named, criteria,
                        threads),
               criteria.separation_mm, missed);
    from = to;
  }
  return missed;
}

/// What is asked of the samples of one pair, those that are not looked at left out.
std::vector<MissedPlaces::Question> MissedPlaces::questions_between(std::size_t first, std::size_t last,
                                                                    const MissedCriteria& criteria,
                                                                    int threads) const {
  const std::size_t stride = stride_of(reference_);
  const bool broken = beside_any(reference_.sides[samples_[first]], criteria.thorough);
  std::vector<Question> all(last - first);
  parallel_for(threads, all.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t sample = samples_[first + i];
      const bool thorough = broken && (criteria.suspects.empty() ||
                                       criteria.suspects[field_.nearest_voxel(centroid(reference_, sample))]);
      if (!thorough && sample % stride != 0) continue;
      const bool narrow =
          thorough && criteria.narrow_share < 1 &&
          is_narrow(reference_, sample, field_, kNarrowVoxels * field_.grid().smallest_spacing_mm());
      all[i] = {first + i, (narrow ? criteria.narrow_share : 1) * criteria.limit_mm, thorough};
    }
  });
  std::erase_if(all, [](const Question& question) { return question.limit_mm == 0; });
  return all;
}

/// The questions whose samples the surface does not follow. `ids`: its triangles between the same labels.
std::vector<MissedPlaces::Question> MissedPlaces::answered(const std::vector<Question>& questions,
                                                           const SurfaceMesh& surface,
                                                           std::span<const std::uint32_t> ids,
                                                           const std::vector<std::uint64_t>& names,
                                                           const NamedTriangles& named,
                                                           const MissedCriteria& criteria, int threads) {
  constexpr std::size_t kOfTask = 1024;  // searches that go on from each other
  if (ids.empty() || questions.empty()) return questions;
  const auto follows = [&](const Question& asked, std::uint32_t t, double distance_mm) {
    return distance_mm <= asked.limit_mm &&
           (!asked.thorough || distance_mm <= kTurnedShare * asked.limit_mm ||
            !is_turned(cross_of(reference_, reference_.triangles[samples_[asked.sample]]),
                       cross_of(surface, surface.triangles[t]), criteria.turned_cosine));
  };
  std::vector<std::uint8_t> is_open(questions.size());
  parallel_for(threads, questions.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t q = begin; q < end; ++q) {
      const Question& asked = questions[q];
      const Eigen::Vector3d middle = centroid(reference_, samples_[asked.sample]);
      const std::optional<std::uint32_t> last = named.find(followed_by_[asked.sample]);
      is_open[q] = !last || surface.sides[*last] != surface.sides[ids.front()] ||
                   !follows(asked, *last, distance_to(surface, *last, middle));
    }
  });
  std::vector<Question> open;
  for (std::size_t q = 0; q < questions.size(); ++q)
    if (is_open[q] != 0) open.push_back(questions[q]);
  if (open.empty()) return open;
  const ClosestPointTree tree = tree_of(surface, ids);
  run_tasks(threads, (open.size() + kOfTask - 1) / kOfTask, [&](std::size_t task) {
    std::uint32_t hint = 0;
    for (std::size_t q = task * kOfTask; q < std::min(open.size(), (task + 1) * kOfTask); ++q) {
      Question& asked = open[q];
      const ClosestPointTree::Hit hit =
          tree.closest(centroid(reference_, samples_[asked.sample]), hint,
                       asked.thorough ? kTurnedShare * asked.limit_mm : asked.limit_mm);
      hint = hit.triangle;
      followed_by_[asked.sample] = names[ids[hit.triangle]];
      asked.is_missed = !follows(asked, ids[hit.triangle], hit.distance_mm);
    }
  });
  std::erase_if(open, [](const Question& question) { return !question.is_missed; });
  return open;
}

/// Where the label field has them, each at some distance from the others of its pair.
void MissedPlaces::add_missed(const std::vector<Question>& questions, double separation_mm,
                              std::vector<Eigen::Vector3d>& missed) const {
  const std::size_t known = missed.size();
  for (const Question& asked : questions) {
    const std::uint32_t sample = samples_[asked.sample];
    const std::optional<Eigen::Vector3d> p =
        onto_field(reference_, sample, centroid(reference_, sample), field_, asked.limit_mm);
    const auto close = [&](const Eigen::Vector3d& q) {
      return (q - *p).squaredNorm() < separation_mm * separation_mm;
    };
    if (p && std::none_of(missed.begin() + static_cast<std::ptrdiff_t>(known), missed.end(), close))
      missed.push_back(*p);
  }
}

std::vector<Eigen::Vector3d> points_between(const SurfaceMesh& reference, const LabelField& field,
                                            const std::vector<Sides>& pairs, double spacing_mm,
                                            double reach_mm) {
  std::vector<Eigen::Vector3d> points;
  for (std::uint32_t t = 0; t < reference.triangles.size(); ++t) {
    if (!std::binary_search(pairs.begin(), pairs.end(), reference.sides[t])) continue;
    const auto& [a, b, c] = reference.triangles[t];
    const Eigen::Vector3d &p = reference.points[a], u = reference.points[b] - p, w = reference.points[c] - p;
    const double longest = std::sqrt(std::max({u.squaredNorm(), w.squaredNorm(), (u - w).squaredNorm()}));
    const int parts = std::max(1, static_cast<int>(std::ceil(longest / spacing_mm)));
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        const Eigen::Vector3d middle = p + ((i + 1.0 / 3) * u + (j + 1.0 / 3) * w) / parts;
        if (const auto on = onto_field(reference, t, middle, field, reach_mm)) points.push_back(*on);
      }
  }
  return points;
}

std::vector<FarPoint> far_points(const SurfaceMesh& reference, const SurfaceMesh& surface,
                                 const WallLayers& layers, double limit_mm) {
  std::vector<std::uint32_t> pairs;
  pairs.reserve(surface.sides.size());
  for (Sides sides : surface.sides) {
    for (Label& label : sides) label = layers.parent(label);
    std::sort(sides.begin(), sides.end(), std::greater());
    pairs.push_back(pair_of(sides));
  }
  const std::size_t stride = std::max<std::size_t>(1, reference.points.size() / kMostSamples);
  std::vector<NearQuery> queries;
  queries.reserve(reference.points.size());
  std::vector<std::uint32_t> seen_at(reference.points.size(), 0);  // a number that stands for two labels
  for (const std::uint32_t t : by_pair(reference.sides, [](std::uint32_t) { return true; })) {
    const std::uint32_t pair = pair_of(reference.sides[t]);
    for (const std::uint32_t p : reference.triangles[t])
      if (p % stride == 0 && std::exchange(seen_at[p], pair) != pair)
        queries.push_back({reference.points[p], limit_mm, pair});
  }
  const std::vector<NearTriangle> near = near_triangles(queries, surface.points, surface.triangles, pairs);
  std::vector<FarPoint> far;
  for (std::size_t q = 0; q < queries.size(); ++q)
    if (!near[q].within && near[q].triangle != NearTriangle::kNone)
      far.push_back({queries[q].point, near[q].triangle});
  return far;
}

std::vector<Eigen::Vector3d> missed_junctions(const SurfaceMesh& reference, const std::vector<Edge>& edges,
                                              const SurfaceMesh& surface, double limit_mm) {
  std::vector<Eigen::Vector3d> missed;
  if (edges.empty()) return missed;
  const std::vector<Edge> found = junction_edges(surface);
  const auto middle = [](const SurfaceMesh& mesh, const Edge& edge) -> Eigen::Vector3d {
    return 0.5 * (mesh.points[edge[0]] + mesh.points[edge[1]]);
  };
  if (found.empty()) {
    for (const Edge& edge : edges) missed.push_back(middle(reference, edge));
    return missed;
  }
  const auto curves = [](const SurfaceMesh& mesh, const std::vector<Edge>& of) {
    std::vector<Triangle> segments;
    segments.reserve(of.size());
    for (const auto& [a, b] : of) segments.push_back({a, b, b});
    return ClosestPointTree(mesh.points, segments);
  };
  const ClosestPointTree wanted = curves(reference, edges), have = curves(surface, found);
  std::uint32_t hint = 0;
  for (const Edge& edge : edges) {
    const ClosestPointTree::Hit hit = have.closest(middle(reference, edge), hint, limit_mm);
    hint = hit.triangle;
    if (hit.distance_mm > limit_mm) missed.push_back(middle(reference, edge));
  }
  for (const Edge& edge : found) {
    const ClosestPointTree::Hit hit = wanted.closest(middle(surface, edge), hint, limit_mm);
    hint = hit.triangle;
    if (hit.distance_mm > limit_mm) missed.push_back(hit.point);
  }
  return missed;
}

}  // namespace voxtet::remesh
