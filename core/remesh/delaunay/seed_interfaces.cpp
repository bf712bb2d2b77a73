#include "remesh/delaunay/seed_interfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "geometry/search/cube_grid.h"
#include "geometry/topology/label_components.h"
#include "remesh/delaunay/seed_junctions.h"

namespace voxtet::remesh {
namespace {

constexpr int kShrinkRounds = 6;  ///< how often the spacing shrinks to get them
constexpr double kShrink = 0.6;
constexpr double kSeparation = 0.5;         ///< of all points, in target edge lengths
constexpr double kSeparationVoxels = 0.25;  ///< the least it may shrink to
constexpr double kVerticesPerArea =
    0.8;  ///< measured: vertices of a finished surface per voxel-face area / edge^2

/// A lattice edge (voxel to its neighbour along `axis`) between two components.
struct Crossing {
  std::uint64_t pair;  ///< the two component ids, lower first
  std::uint32_t voxel;
  std::uint32_t axis;
};

std::vector<Crossing> find_crossings(const LabelField& field) {
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> ids = label_components(field.grid().size, field.centre_labels(), sizes);
  const std::array<int, 3>& size = field.grid().size;
  const std::array<std::size_t, 3> strides = field.grid().strides();
  std::vector<Crossing> out;
  field.grid().visit([&](int i, int j, int k, std::size_t v) {
    const std::array<bool, 3> inside{i + 1 < size[0], j + 1 < size[1], k + 1 < size[2]};
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      if (!inside[axis] || ids[v] == ids[v + strides[axis]]) continue;
      const std::uint64_t a = ids[v], b = ids[v + strides[axis]];
      out.push_back({(std::min(a, b) << 32) | std::max(a, b), static_cast<std::uint32_t>(v), axis});
    }
  });
  std::stable_sort(out.begin(), out.end(),
                   [](const Crossing& x, const Crossing& y) { return x.pair < y.pair; });
  return out;
}

/// Multiplicative congruential generator: the same sequence everywhere.
class Shuffler {
 public:
  template <class Iterator>
  void shuffle(Iterator first, Iterator last) {
    for (auto n = last - first; n > 1; --n) {
      state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
      const auto pick = static_cast<std::ptrdiff_t>((state_ >> 33) % static_cast<std::uint64_t>(n));
      std::swap(first[n - 1], first[pick]);
    }
  }

 private:
  std::uint64_t state_ = 20090920;
};

/// Cubes over the field, of that edge or larger ones.
CubeGrid cubes_over(const LabelField& field, double edge_mm) {
  constexpr double kMostOnAxis = 160;
  const Eigen::AlignedBox3d box = field.box();
  return {box.min(), box.max(), std::max(edge_mm, box.sizes().maxCoeff() / kMostOnAxis)};
}

/// Points in cubes, for distance queries while there come more.
class PointBuckets {
 public:
  explicit PointBuckets(const CubeGrid& cubes) : cubes_(cubes), head_(cubes.count(), kNone) {}

  void add(const Eigen::Vector3d& p, std::uint32_t group) {
    std::uint32_t& head = head_[cubes_.number(cubes_.steps_to(p))];
    items_.push_back({p, group, head});
    head = static_cast<std::uint32_t>(items_.size() - 1);
  }

  /// Whether a point lies closer than `separation`, or one of the same group closer than `distance`.
  bool occupied(const Eigen::Vector3d& p, std::uint32_t group, double distance, double separation) const {
    const double reach = std::max(distance, separation);
    const auto is_near_one_in = [&](const std::array<int, 3>& steps) {
      for (std::uint32_t e = head_[cubes_.number(steps)]; e != kNone; e = items_[e].next) {
        const double least = items_[e].group == group ? reach : separation;
        if ((items_[e].point - p).squaredNorm() < least * least) return true;
      }
      return false;
    };
    // By far most points are, and of one in their own cube.
    if (is_near_one_in(cubes_.steps_to(p))) return true;
    const std::array<int, 3> lo = cubes_.steps_to(p - Eigen::Vector3d::Constant(reach));
    const std::array<int, 3> hi = cubes_.steps_to(p + Eigen::Vector3d::Constant(reach));
    for (int k = lo[2]; k <= hi[2]; ++k)
      for (int j = lo[1]; j <= hi[1]; ++j)
        for (int i = lo[0]; i <= hi[0]; ++i)
          if (is_near_one_in({i, j, k})) return true;
    return false;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  struct Item {
    Eigen::Vector3d point;
    std::uint32_t group, next;
  };
  CubeGrid cubes_;
  std::vector<std::uint32_t> head_;
  std::vector<Item> items_;
};

/// Collects seeds, each as far from those before it as it has to be.
class Seeder {
 public:
  Seeder(const LabelField& field, const SizingField& sizing, double spacing)
      : field_(field),
        sizing_(sizing),
        spacing_(spacing),
        least_separation_(kSeparationVoxels * field.grid().smallest_spacing_mm()),
        buckets_(cubes_over(field, spacing * *std::max_element(sizing.h_mm.begin(), sizing.h_mm.end()))) {}

  void add_junctions(const std::vector<Eigen::Vector3d>& points) {
    for (const Eigen::Vector3d& p : points)
      if (!buckets_.occupied(p, group_, 0, std::max(kSeparation * sizing_.at(p), least_separation_))) add(p);
  }

  void add_interfaces(std::vector<Crossing> crossings, const RunContext& ctx) {
    const std::array<double, 3> face_mm2 = face_areas();
    for (std::size_t begin = 0, end = 0; begin < crossings.size() && !ctx.cancelled(); begin = end) {
      while (end < crossings.size() && crossings[end].pair == crossings[begin].pair) ++end;
      ++group_;
      add_interface(std::span(crossings).subspan(begin, end - begin), face_mm2);
    }
  }

  Seeds seeds;

 private:
  void add(const Eigen::Vector3d& p) {
    buckets_.add(p, group_);
    seeds.points.push_back(p);
  }

  /// Of a voxel's faces across each axis, mm2.
  std::array<double, 3> face_areas() const {
    std::array<double, 3> areas{};
    for (int d = 0; d < 3; ++d) {
      const Eigen::Vector3d origin = field_.to_mm(Eigen::Vector3d::Zero());
      const Eigen::Vector3d u = field_.to_mm(Eigen::Vector3d::Unit((d + 1) % 3)) - origin;
      const Eigen::Vector3d w = field_.to_mm(Eigen::Vector3d::Unit((d + 2) % 3)) - origin;
      areas[static_cast<std::size_t>(d)] = u.cross(w).norm();
    }
    return areas;
  }

  void add_interface(std::span<Crossing> crossings, const std::array<double, 3>& face_mm2) {
    shuffler_.shuffle(crossings.begin(), crossings.end());
    std::size_t found = 0;
    double shrink = 1;
    // Most interfaces are small: their own seeds are sooner looked at than the cubes around.
    const auto is_near_own = [&](const Eigen::Vector3d& p, double distance) {
      constexpr std::size_t kFew = 32;
      if (found > kFew) return buckets_.occupied(p, group_, distance, 0);
      const std::span<const Eigen::Vector3d> own = std::span(seeds.points).last(found);
      return std::any_of(own.begin(), own.end(), [&](const Eigen::Vector3d& seed) {
        return (seed - p).squaredNorm() < distance * distance;
      });
    };
    const auto is_enough = [&](int round) { return round > 0 && found >= kSeedsOfInterface; };
    for (int round = 0; round <= kShrinkRounds && !is_enough(round); ++round, shrink *= kShrink)
      for (const Crossing& crossing : crossings) {
        if (is_enough(round)) break;
        const Eigen::Vector3d index = index_of(crossing.voxel);
        const Eigen::Vector3d step = Eigen::Vector3d::Unit(crossing.axis);
        const Eigen::Vector3d middle = field_.to_mm(index + 0.5 * step);
        const double h = sizing_.at(middle);
        if (round == 0) seeds.predicted_vertices += kVerticesPerArea * face_mm2[crossing.axis] / (h * h);
        const double distance = spacing_ * h * shrink;
        const double separation = std::max(kSeparation * h * (found ? 1 : shrink), least_separation_);
        if (is_near_own(middle, distance)) continue;
        const Eigen::Vector3d a = field_.to_mm(index), b = field_.to_mm(index + step);
        const Label label_a = field_.at(a), label_b = field_.at(b);
        if (label_a == label_b) continue;
        Label behind = kBackground;
        const Eigen::Vector3d p = field_.crossing(a, label_a, b, label_b, behind);
        if (buckets_.occupied(p, group_, distance, separation)) continue;
        add(p);
        ++found;
      }
  }

  Eigen::Vector3d index_of(std::size_t voxel) const {
    const std::size_t row = field_.grid().strides()[1], slice = field_.grid().strides()[2];
    return {static_cast<double>(voxel % row), static_cast<double>(voxel % slice / row),
            static_cast<double>(voxel / slice)};
  }

  const LabelField& field_;
  const SizingField& sizing_;
  double spacing_, least_separation_;
  PointBuckets buckets_;
  Shuffler shuffler_;
  std::uint32_t group_ = 0;  ///< 0: junctions; then one for each pair of components
};

}  // namespace

Seeds seed_interfaces(const LabelField& field, const SurfaceMesh& reference, const SizingField& sizing,
                      const RunContext& ctx) {
  Seeder seeder(field, sizing, kSeedSpacing);
  seeder.add_junctions(seed_junctions(reference, sizing));
  seeder.add_interfaces(find_crossings(field), ctx);
  return seeder.seeds;
}

std::vector<Eigen::Vector3d> seed_between(const LabelField& field, const SizingField& sizing, double spacing,
                                          const std::vector<Sides>& between, const RunContext& ctx) {
  std::vector<Crossing> crossings = find_crossings(field);
  const std::array<std::size_t, 3> strides = field.grid().strides();
  std::erase_if(crossings, [&](const Crossing& crossing) {
    const auto label_at = [&](std::size_t voxel) {
      return field.layers().parent(field.centre_labels()[voxel]);
    };
    Sides sides{label_at(crossing.voxel), label_at(crossing.voxel + strides[crossing.axis])};
    if (sides[0] < sides[1]) std::swap(sides[0], sides[1]);
    return !std::binary_search(between.begin(), between.end(), sides);
  });
  Seeder seeder(field, sizing, spacing);
  seeder.add_interfaces(std::move(crossings), ctx);
  return seeder.seeds.points;
}

}  // namespace voxtet::remesh
