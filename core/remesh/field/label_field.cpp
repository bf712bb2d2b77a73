#include "remesh/field/label_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "remesh/field/keep_contacts_open.h"
#include "remesh/field/resolve_face_ambiguity.h"

namespace voxtet::remesh {
namespace {

constexpr std::int32_t kPairBase = 65536;
constexpr double kTolerance = 1e-4;  ///< of a crossing, voxels
constexpr int kMaxRounds = 100;

LabelVolume padded(const LabelVolume& volume) {
  constexpr int kPad = LabelField::kPad;
  LabelVolume out;
  for (std::size_t d = 0; d < 3; ++d) out.size[d] = volume.size[d] + 2 * kPad;
  out.index_to_mm.topLeftCorner<3, 3>() = volume.linear();
  out.index_to_mm.topRightCorner<3, 1>() =
      volume.origin() - volume.linear() * Eigen::Vector3d::Constant(kPad);
  out.labels.assign(out.voxel_count(), kBackground);
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j) {
      const auto from = volume.labels.begin() + static_cast<std::ptrdiff_t>(volume.offset(0, j, k));
      const std::size_t row = out.offset(kPad, j + kPad, k + kPad);
      std::copy(from, from + volume.size[0], out.labels.begin() + static_cast<std::ptrdiff_t>(row));
    }
  return out;
}

template <class Number>
double trilinear(const Number* v, const std::array<double, 3>& t) {
  const double a = v[0] + t[0] * (static_cast<double>(v[1]) - v[0]);
  const double b = v[2] + t[0] * (static_cast<double>(v[3]) - v[2]);
  const double c = v[4] + t[0] * (static_cast<double>(v[5]) - v[4]);
  const double d = v[6] + t[0] * (static_cast<double>(v[7]) - v[6]);
  const double ab = a + t[1] * (b - a);
  const double cd = c + t[1] * (d - c);
  return ab + t[2] * (cd - ab);
}

/// Linear on the tetrahedra around the diagonal from the first to the last corner.
template <class Number>
double kuhn(const Number* v, const std::array<double, 3>& t) {
  std::array<std::size_t, 3> axes{0, 1, 2};  // from the largest coordinate to the smallest
  if (t[axes[0]] < t[axes[1]]) std::swap(axes[0], axes[1]);
  if (t[axes[1]] < t[axes[2]]) std::swap(axes[1], axes[2]);
  if (t[axes[0]] < t[axes[1]]) std::swap(axes[0], axes[1]);
  const std::size_t second = std::size_t{1} << axes[0], third = second | std::size_t{1} << axes[1];
  return v[0] * (1 - t[axes[0]]) + v[second] * (t[axes[0]] - t[axes[1]]) +
         v[third] * (t[axes[1]] - t[axes[2]]) + v[7] * t[axes[2]];
}

/// How the extraction of a surface joins voxels: that of several labels along diagonals too.
Connectivity connectivity_of(const SurfaceMesh& surface) {
  const bool many = std::any_of(surface.sides.begin(), surface.sides.end(),
                                [&](const Sides& sides) { return sides != surface.sides.front(); });
  return many ? Connectivity::kKuhn : Connectivity::kFaces;
}

/// Gradient of `trilinear` with respect to t.
Eigen::Vector3d trilinear_gradient(const std::array<double, 8>& v, const std::array<double, 3>& t) {
  const std::array<double, 3> u{1 - t[0], 1 - t[1], 1 - t[2]};
  return {u[2] * (u[1] * (v[1] - v[0]) + t[1] * (v[3] - v[2])) +
              t[2] * (u[1] * (v[5] - v[4]) + t[1] * (v[7] - v[6])),
          u[2] * (u[0] * (v[2] - v[0]) + t[0] * (v[3] - v[1])) +
              t[2] * (u[0] * (v[6] - v[4]) + t[0] * (v[7] - v[5])),
          u[1] * (u[0] * (v[4] - v[0]) + t[0] * (v[5] - v[1])) +
              t[1] * (u[0] * (v[6] - v[2]) + t[0] * (v[7] - v[3]))};
}

/// The labels of one cell's eight corners with their distances.
struct CellTable {
  std::vector<Label> labels;
  std::vector<std::array<float, 8>> values;

  std::array<float, 8>& row(Label label) {
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (labels[i] == label) return values[i];
    labels.push_back(label);
    values.emplace_back().fill(-LabelDistances::kFarthest);
    return values.back();
  }

  /// Removes every label that another one beats or equals at all corners (the lower label on equality).
  void drop_dominated() {
    std::vector<std::uint8_t> dominated(labels.size(), 0);
    for (std::size_t i = 0; i < labels.size(); ++i)
      for (std::size_t j = 0; j < labels.size() && !dominated[i]; ++j) {
        if (i == j || dominated[j]) continue;
        bool beats = true, differs = false;
        for (int c = 0; c < 8; ++c) {
          beats = beats && values[j][c] >= values[i][c];
          differs = differs || values[j][c] != values[i][c];
        }
        dominated[i] = beats && (differs || labels[j] < labels[i]);
      }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (!dominated[i]) {
        labels[kept] = labels[i];
        values[kept++] = values[i];
      }
    labels.resize(kept);
    values.resize(kept);
  }
};

}  // namespace

const WallLayers LabelField::kNoLayers;

LabelField::LabelField(const LabelVolume& volume, const SurfaceMesh& surface, const WallLayers& layers,
                       int threads)
    : layers_(layers) {
  connectivity_ = connectivity_of(surface);
  LabelVolume grid = padded(volume);
  grid_.size = grid.size;
  grid_.index_to_mm = grid.index_to_mm;
  smallest_spacing_mm_ = grid_.smallest_spacing_mm();
  const Eigen::Matrix3d inverse = grid.linear().inverse();
  grid_.mm_to_index.topLeftCorner<3, 3>() = inverse;
  grid_.mm_to_index.topRightCorner<3, 1>() = -(inverse * grid.origin());
  LabelDistances distances = label_distances(grid, surface, threads);
  if (connectivity_ == Connectivity::kFaces)
    resolve_face_ambiguity(grid, distances);
  else
    keep_contacts_open(grid, distances);
  centre_labels_ = std::move(grid.labels);
  build_cells(distances);
  if (!layers_.empty())
    for (std::size_t v = 0, k = 0; k < static_cast<std::size_t>(grid_.size[2]); ++k)
      for (std::size_t j = 0; j < static_cast<std::size_t>(grid_.size[1]); ++j)
        for (std::size_t i = 0; i < static_cast<std::size_t>(grid_.size[0]); ++i, ++v)
          centre_labels_[v] = layers_.at(centre_labels_[v], to_mm(Eigen::Vector3d(i, j, k)));
}

void LabelField::build_cells(const LabelDistances& distances) {
  const std::size_t sx = static_cast<std::size_t>(grid_.size[0]),
                    sxy = sx * static_cast<std::size_t>(grid_.size[1]);
  cells_.assign(centre_labels_.size(), kBackground);
  for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(grid_.size[2]); ++k)
    for (std::size_t j = 0; j + 1 < static_cast<std::size_t>(grid_.size[1]); ++j)
      for (std::size_t i = 0; i + 1 < sx; ++i) {
        const std::size_t v = i + sx * j + sxy * k;
        const std::array<std::size_t, 8> corners{v,       v + 1,       v + sx,       v + sx + 1,
                                                 v + sxy, v + sxy + 1, v + sxy + sx, v + sxy + sx + 1};
        bool one = true;
        for (const std::size_t c : corners) one = one && centre_labels_[c] == centre_labels_[v];
        // The same winner at all eight corners wins everywhere between them.
        cells_[v] = centre_labels_[v];
        if (!one) cells_[v] = store_mixed_cell(distances, corners);
      }
}

std::int32_t LabelField::store_mixed_cell(const LabelDistances& distances,
                                          const std::array<std::size_t, 8>& corners) {
  CellTable table;
  for (int c = 0; c < 8; ++c) {
    const std::size_t v = corners[c];
    for (std::uint32_t e = distances.offsets[v]; e < distances.offsets[v + 1]; ++e)
      table.row(distances.labels[e])[c] = distances.values[e];
  }
  table.drop_dominated();
  if (table.labels.size() == 2) {
    Pair pair{{}, table.labels[0], table.labels[1]};
    for (int c = 0; c < 8; ++c) pair.difference[c] = table.values[0][c] - table.values[1][c];
    pairs_.push_back(pair);
    return kPairBase + static_cast<std::int32_t>(pairs_.size() - 1);
  }
  if (many_start_.empty()) many_start_.push_back(0);
  for (std::size_t i = 0; i < table.labels.size(); ++i) {
    many_labels_.push_back(table.labels[i]);
    many_values_.insert(many_values_.end(), table.values[i].begin(), table.values[i].end());
  }
  many_start_.push_back(static_cast<std::uint32_t>(many_labels_.size()));
  return 1 - static_cast<std::int32_t>(many_start_.size());
}

std::int32_t LabelField::code_at(const Eigen::Vector3d& index, std::array<double, 3>& t) const {
  std::size_t offset = 0;
  // Compared as doubles first: circumcentres of flat cells do not fit into an int, or are not numbers.
  for (int d = 2; d >= 0; --d) {
    if (!(index[d] >= 0 && index[d] < grid_.size[d] - 1)) return kBackground;
    const int base = static_cast<int>(index[d]);
    t[d] = index[d] - base;
    offset = offset * static_cast<std::size_t>(grid_.size[d]) + static_cast<std::size_t>(base);
  }
  return cells_[offset];
}

template <class Number>
double LabelField::interpolate(const Number* corners, const std::array<double, 3>& t) const {
  return connectivity_ == Connectivity::kKuhn ? kuhn(corners, t) : trilinear(corners, t);
}

Eigen::AlignedBox3d LabelField::box() const {
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d index;
    for (int d = 0; d < 3; ++d)
      index[d] = (corner >> d) & 1 ? grid_.size[static_cast<std::size_t>(d)] - 1 : 0;
    box.extend(to_mm(index));
  }
  return box;
}

std::size_t LabelField::nearest_voxel(const Eigen::Vector3d& mm) const {
  const Eigen::Vector3d index = to_index(mm);
  Eigen::Vector3i voxel;
  for (int d = 0; d < 3; ++d)
    voxel[d] = static_cast<int>(
        std::clamp(std::floor(index[d] + 0.5), 0.0, grid_.size[static_cast<std::size_t>(d)] - 1.0));
  return grid_.offset(voxel);
}

Label LabelField::at_index(const Eigen::Vector3d& index) const {
  Sample sample{};
  margin(index, kBackground, sample);
  return sample.label;
}

double LabelField::margin(const Eigen::Vector3d& index, Label wanted, Sample& sample) const {
  std::array<double, 3> t{};
  const std::int32_t code = code_at(index, t);
  if (code >= 0 && code < kPairBase) {
    sample = {static_cast<Label>(code), false};
    return sample.label == wanted ? 1 : -1;
  }
  if (code >= kPairBase) {
    const Pair& pair = pairs_[static_cast<std::size_t>(code - kPairBase)];
    const double difference = interpolate(pair.difference.data(), t);
    sample = {difference >= 0 ? pair.a : pair.b, pair.a == wanted || pair.b == wanted};
    return pair.a == wanted ? difference : pair.b == wanted ? -difference : -1;
  }
  const std::size_t many = static_cast<std::size_t>(-(code + 1));
  double best = -1, own = -1, rival = -1;
  sample.mixed = false;
  for (std::uint32_t e = many_start_[many]; e < many_start_[many + 1]; ++e) {
    const double value = interpolate(&many_values_[8 * static_cast<std::size_t>(e)], t);
    if (value > best) {
      best = value;
      sample.label = many_labels_[e];
    }
    if (many_labels_[e] == wanted) {
      own = value;
      sample.mixed = true;
    } else {
      rival = std::max(rival, value);
    }
  }
  return sample.mixed ? own - rival : -1;
}

bool LabelField::corner_differences(const Eigen::Vector3d& mm, Label a, Label b,
                                    std::array<double, 8>& difference, std::array<double, 3>& t) const {
  const std::int32_t code = code_at(to_index(mm), t);
  difference.fill(0);
  if (code >= kPairBase) {
    const Pair& pair = pairs_[static_cast<std::size_t>(code - kPairBase)];
    if (!((pair.a == a && pair.b == b) || (pair.a == b && pair.b == a))) return false;
    const double sign = pair.a == a ? 1 : -1;
    for (std::size_t c = 0; c < 8; ++c) difference[c] = sign * pair.difference[c];
    return true;
  }
  if (code >= 0) return false;
  const std::size_t many = static_cast<std::size_t>(-(code + 1));
  int found = 0;
  for (std::uint32_t e = many_start_[many]; e < many_start_[many + 1]; ++e) {
    const double sign = many_labels_[e] == a ? 1 : many_labels_[e] == b ? -1 : 0;
    if (sign == 0) continue;
    ++found;
    for (std::size_t c = 0; c < 8; ++c)
      difference[c] += sign * many_values_[8 * static_cast<std::size_t>(e) + c];
  }
  return found == 2;
}

Eigen::Vector3d LabelField::gradient(const Eigen::Vector3d& mm, Label a, Label b) const {
  if (share_parent(a, b))
    return both_layers(a, b) ? layers_.lead_gradient(mm, a, b) : Eigen::Vector3d::Zero();
  a = layers_.parent(a), b = layers_.parent(b);
  std::array<double, 3> t{};
  std::array<double, 8> difference{};
  if (!corner_differences(mm, a, b, difference, t)) return Eigen::Vector3d::Zero();
  return grid_.mm_to_index.topLeftCorner<3, 3>().transpose() * trilinear_gradient(difference, t);
}

std::optional<double> LabelField::distance(const Eigen::Vector3d& mm, Label a, Label b) const {
  if (share_parent(a, b)) {
    if (!both_layers(a, b)) return std::nullopt;
    const double slope = layers_.lead_gradient(mm, a, b).norm();
    return slope > 0 ? std::optional<double>(layers_.lead(mm, a, b) / slope) : std::nullopt;
  }
  a = layers_.parent(a), b = layers_.parent(b);
  std::array<double, 3> t{};
  std::array<double, 8> difference{};
  if (!corner_differences(mm, a, b, difference, t)) return std::nullopt;
  const double slope =
      (grid_.mm_to_index.topLeftCorner<3, 3>().transpose() * trilinear_gradient(difference, t)).norm();
  const double value = interpolate(difference.data(), t);
  return slope > 0 ? std::optional<double>(value / slope) : std::nullopt;
}

double LabelField::depth(const Eigen::Vector3d& mm, Label a) const {
  if (layers_.is_layer(a)) return std::min(depth(mm, layers_.parent(a)), layers_.depth_mm(mm, a));
  Sample sample{};
  const double lead = margin(to_index(mm), a, sample);
  if (!sample.mixed) return lead * smallest_spacing_mm_;
  // Distances of two labels fall and rise alike: the lead grows by two for a step of one.
  return 0.5 * lead * smallest_spacing_mm_;
}

Eigen::Vector3d LabelField::crossing(const Eigen::Vector3d& a, Label label_a, const Eigen::Vector3d& b,
                                     Label label_b, Label& other) const {
  Eigen::Vector3d inside = a, outside = b;
  other = label_b;
  if (!share_parent(label_a, label_b)) {
    outside = parent_crossing(a, layers_.parent(label_a), b, layers_.parent(label_b), other);
    const Label before = layers_.at(layers_.parent(label_a), outside);
    if (before == label_a) {
      other = layers_.at(other, outside);
      return outside;
    }
    other = before;
  }
  const double tolerance = kTolerance * smallest_spacing_mm_;
  while ((outside - inside).squaredNorm() > tolerance * tolerance) {
    const Eigen::Vector3d middle = 0.5 * (inside + outside);
    const Label label = at(middle);
    if (label == label_a) {
      inside = middle;
    } else {
      outside = middle;
      other = label;
    }
  }
  return inside;
}

Eigen::Vector3d LabelField::parent_crossing(const Eigen::Vector3d& a, Label label_a, const Eigen::Vector3d& b,
                                            Label label_b, Label& other) const {
  const Eigen::Vector3d origin = to_index(a);
  const Eigen::Vector3d step = to_index(b) - origin;
  // The surface stays inside the padded grid; what sticks out of it is background.
  double t0 = 0, t1 = 1;
  for (int d = 0; d < 3; ++d) {
    if (step[d] == 0) continue;
    const double lo = -origin[d] / step[d], hi = (grid_.size[d] - 1 - origin[d]) / step[d];
    t0 = std::max(t0, std::min(lo, hi));
    t1 = std::min(t1, std::max(lo, hi));
  }
  const double tolerance = kTolerance / step.norm();
  Sample s0{label_a, false}, s1{label_b, false};
  double g0 = 1, g1 = -1;
  int run = 0;  // how often in a row the same end moved: positive for t0, negative for t1
  for (int round = 0; round < kMaxRounds && t1 - t0 > tolerance; ++round) {
    double t = 0.5 * (t0 + t1);
    if (s0.mixed && s1.mixed && round % 4 != 3) {
      t = t0 + (t1 - t0) * (g0 / (g0 - g1));
      t = std::clamp(t, t0 + 0.4 * tolerance, t1 - 0.4 * tolerance);
    }
    Sample s{};
    const double g = margin(origin + t * step, label_a, s);
    // Illinois: an end that stays twice in a row counts half, so that both ends close in.
    if (s.label == label_a) {
      t0 = t, g0 = std::max(g, 0.0), s0 = s;
      run = std::max(run, 0) + 1;
      if (run > 1) g1 *= 0.5;
    } else {
      t1 = t, g1 = std::min(g, -1e-12), s1 = s;
      run = std::min(run, 0) - 1;
      if (run < -1) g0 *= 0.5;
    }
  }
  other = s1.label;
  return a + t0 * (b - a);
}

}  // namespace voxtet::remesh
