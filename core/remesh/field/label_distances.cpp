#include "remesh/field/label_distances.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "geometry/search/closest_point.h"
#include "remesh/field/thin_voxels.h"

namespace voxtet::remesh {
namespace {

constexpr std::uint32_t kNoPoint = 0xffffffffU;

/// By voxel that is not on the grid's border, whether the 27 around it have one label. A row of three, then
/// three rows, then three layers.
std::vector<std::uint8_t> find_uniform(const LabelVolume& grid) {
  const std::vector<Label>& labels = grid.labels;
  const std::size_t sx = static_cast<std::size_t>(grid.size[0]);
  const std::size_t sxy = sx * static_cast<std::size_t>(grid.size[1]);
  std::vector<std::uint8_t> narrow(labels.size(), 1), wide(labels.size(), 0);
  for (const std::size_t step : {std::size_t{1}, sx, sxy}) {
    for (std::size_t v = step; v + step < labels.size(); ++v) {
      const bool same = labels[v - step] == labels[v] && labels[v + step] == labels[v];
      wide[v] = narrow[v - step] & narrow[v] & narrow[v + step] & static_cast<std::uint8_t>(same);
    }
    std::swap(narrow, wide);
  }
  return narrow;
}

/// The labels among the 27 voxels around each voxel that has another label near.
void list_labels(const LabelVolume& grid, LabelDistances& out) {
  const std::size_t sx = static_cast<std::size_t>(grid.size[0]), sy = static_cast<std::size_t>(grid.size[1]),
                    sz = static_cast<std::size_t>(grid.size[2]), sxy = sx * sy;
  const std::vector<Label>& labels = grid.labels;
  const std::vector<std::uint8_t> uniform = find_uniform(grid);
  out.offsets.assign(labels.size() + 1, 0);
  std::array<Label, 27> near{};
  std::size_t v = 0;
  for (std::size_t z = 0; z < sz; ++z)
    for (std::size_t y = 0; y < sy; ++y) {
      const bool inner = z > 0 && z + 1 < sz && y > 0 && y + 1 < sy;
      for (std::size_t x = 0; x < sx; ++x, ++v) {
        out.offsets[v + 1] = static_cast<std::uint32_t>(out.labels.size());
        if (!inner || x == 0 || x + 1 == sx || uniform[v]) continue;
        std::size_t count = 0;
        for (std::size_t row = 0; row < 9; ++row) {
          const std::size_t at = v - sxy - sx - 1 + row % 3 * sx + row / 3 * sxy;
          for (std::size_t i = 0; i < 3; ++i) {
            const auto end = near.begin() + static_cast<std::ptrdiff_t>(count);
            if (std::find(near.begin(), end, labels[at + i]) == end) near[count++] = labels[at + i];
          }
        }
        const auto end = near.begin() + static_cast<std::ptrdiff_t>(count);
        std::sort(near.begin(), end);
        out.labels.insert(out.labels.end(), near.begin(), end);
        out.offsets[v + 1] = static_cast<std::uint32_t>(out.labels.size());
      }
    }
}

/// Which triangles meet at each point.
struct Stars {
  std::vector<std::uint32_t> start, triangles;

  explicit Stars(const SurfaceMesh& surface) : start(surface.points.size() + 1, 0) {
    for (const Triangle& t : surface.triangles)
      for (const std::uint32_t p : t) ++start[p + 1];
    for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
    std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
    triangles.resize(start.back());
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
      for (const std::uint32_t p : surface.triangles[t]) triangles[fill[p]++] = t;
  }
};

class Scatter {
 public:
  Scatter(const LabelVolume& grid, const SurfaceMesh& surface, LabelDistances& out)
      : grid_(grid),
        surface_(surface),
        stars_(surface),
        to_mm_(grid.linear()),
        origin_(grid.origin()),
        out_(out) {
    nearest_.assign(out.labels.size(), kNoPoint);
    distance2_.assign(out.labels.size(), std::numeric_limits<double>::max());
    on_one_pair_.assign(surface.points.size(), false);
  }

  /// The closest point of the surface on the boundary of each listed label.
  void find_nearest_points() {
    const Eigen::Matrix3d to_index = to_mm_.inverse();
    const std::size_t sx = static_cast<std::size_t>(grid_.size[0]);
    const std::size_t sxy = sx * static_cast<std::size_t>(grid_.size[1]);
    std::array<Eigen::Vector3d, 27> steps;
    for (int n = 0; n < 27; ++n)
      steps[static_cast<std::size_t>(n)] = to_mm_ * Eigen::Vector3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    for_indices(0, surface_.points.size(), [&](std::size_t point) {
      const auto p = static_cast<std::uint32_t>(point);
      collect_labels(p);
      on_one_pair_[p] = here_.size() == 2;
      const Eigen::Vector3d index = to_index * (surface_.points[p] - origin_);
      std::array<std::size_t, 3> at{};
      for (int d = 0; d < 3; ++d)
        at[static_cast<std::size_t>(d)] =
            static_cast<std::size_t>(std::clamp(std::floor(index[d] + 0.5), 1.0, grid_.size[d] - 2.0));
      const Eigen::Vector3d centre =
          origin_ + to_mm_ * Eigen::Vector3d(static_cast<double>(at[0]), static_cast<double>(at[1]),
                                             static_cast<double>(at[2]));
      const Eigen::Vector3d offset = centre - surface_.points[p];
      const std::size_t middle = at[0] + sx * at[1] + sxy * at[2];
      for (std::size_t n = 0; n < 27; ++n) {
        const std::size_t v = middle + n % 3 + n / 3 % 3 * sx + n / 9 * sxy - 1 - sx - sxy;
        const std::uint32_t first = out_.offsets[v], last = out_.offsets[v + 1];
        if (first == last) continue;
        const double distance2 = (offset + steps[n]).squaredNorm();
        for (std::uint32_t e = first; e < last; ++e) {
          if (!(distance2 < distance2_[e])) continue;
          if (std::find(here_.begin(), here_.end(), out_.labels[e]) == here_.end()) continue;
          distance2_[e] = distance2;
          nearest_[e] = p;
        }
      }
    });
  }

  void measure(double unit_mm, int threads) {
    out_.values.resize(out_.labels.size());
    const std::size_t sx = static_cast<std::size_t>(grid_.size[0]);
    const std::size_t sy = static_cast<std::size_t>(grid_.size[1]);
    const auto measure_at = [&](std::size_t v) {
      if (out_.offsets[v] == out_.offsets[v + 1]) return;
      const Eigen::Vector3d centre =
          origin_ + to_mm_ * Eigen::Vector3d(static_cast<double>(v % sx), static_cast<double>(v / sx % sy),
                                             static_cast<double>(v / (sx * sy)));
      const float nearest = is_thin(grid_, v) ? LabelDistances::kNearestThin : LabelDistances::kNearest;
      double distance = 0;
      for (std::uint32_t e = out_.offsets[v]; e < out_.offsets[v + 1]; ++e) {
        const bool known = e > out_.offsets[v] && nearest_[e] == nearest_[e - 1] && is_on_one_pair(e);
        if (!known) distance = to_boundary(centre, e) / unit_mm;
        const float value = std::clamp(static_cast<float>(distance), nearest, LabelDistances::kFarthest);
        out_.values[e] = out_.labels[e] == grid_.labels[v] ? value : -value;
      }
    };
    parallel_for(threads, grid_.labels.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) measure_at(v);
    });
  }

 private:
  void collect_labels(std::uint32_t p) {
    here_.clear();
    for (std::uint32_t k = stars_.start[p]; k < stars_.start[p + 1]; ++k)
      for (const Label label : surface_.sides[stars_.triangles[k]])
        if (std::find(here_.begin(), here_.end(), label) == here_.end()) here_.push_back(label);
  }

  /// Whether an entry's nearest point lies between two labels only, whose boundaries are one there.
  bool is_on_one_pair(std::uint32_t entry) const {
    return nearest_[entry] != kNoPoint && on_one_pair_[nearest_[entry]];
  }

  double to_boundary(const Eigen::Vector3d& centre, std::uint32_t entry) const {
    const std::uint32_t p = nearest_[entry];
    if (p == kNoPoint) return std::numeric_limits<double>::max();
    double best = distance2_[entry];
    for (std::uint32_t k = stars_.start[p]; k < stars_.start[p + 1]; ++k) {
      const std::uint32_t t = stars_.triangles[k];
      const Sides& sides = surface_.sides[t];
      if (sides[0] != out_.labels[entry] && sides[1] != out_.labels[entry]) continue;
      const auto [a, b, c] = surface_.triangles[t];
      const Eigen::Vector3d q =
          closest_on_triangle(centre, surface_.points[a], surface_.points[b], surface_.points[c]);
      best = std::min(best, (q - centre).squaredNorm());
    }
    return std::sqrt(best);
  }

  const LabelVolume& grid_;
  const SurfaceMesh& surface_;
  const Stars stars_;
  const Eigen::Matrix3d to_mm_;
  const Eigen::Vector3d origin_;
  LabelDistances& out_;
  std::vector<std::uint32_t> nearest_;
  std::vector<double> distance2_;
  std::vector<bool> on_one_pair_;  ///< by point
  std::vector<Label> here_;
};

}  // namespace

LabelDistances label_distances(const LabelVolume& volume, const SurfaceMesh& surface, int threads) {
  LabelDistances out;
  list_labels(volume, out);
  Scatter scatter(volume, surface, out);
  scatter.find_nearest_points();
  scatter.measure(volume.smallest_spacing_mm(), threads);
  return out;
}

}  // namespace voxtet::remesh
