#include "transfer/transfer_labels.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "geometry/elements/tet_measures.h"
#include "geometry/grid/rasterise.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

constexpr double kSamplesPerVoxel = 8;
constexpr std::size_t kTetsPerPoll = 1 << 14;

/// Weights of the four corners.
using Barycentric = std::array<double, 4>;

/// Barycentres of Kuhn's n^3 parts of a tet. In the coordinates in which the tet is n >= x >= y >= z >= 0, a
/// unit cube has six parts, one for each order of its axes; those inside the tet are parts of it.
std::vector<Barycentric> barycentres(int n) {
  std::vector<Barycentric> samples;
  for (int cube = 0; cube < n * n * n; ++cube) {
    std::array<int, 3> order{0, 1, 2};
    do {
      std::array<double, 3> x{static_cast<double>(cube % n), static_cast<double>(cube / n % n),
                              static_cast<double>(cube / n / n)};
      for (std::size_t step = 0; step < 3; ++step)
        x[static_cast<std::size_t>(order[step])] += 0.25 * static_cast<double>(3 - step);
      if (x[0] > x[1] && x[1] > x[2])
        samples.push_back({(n - x[0]) / n, (x[0] - x[1]) / n, (x[1] - x[2]) / n, x[2] / n});
    } while (std::next_permutation(order.begin(), order.end()));
  }
  return samples;
}

/// What a volume says at places given as continuous indices.
class NearestVoxel {
 public:
  explicit NearestVoxel(const LabelVolume& volume)
      : volume_(volume), to_index_(volume.linear().inverse()), origin_(volume.origin()) {}

  Eigen::Vector3d index_of(const Eigen::Vector3d& mm) const { return to_index_ * (mm - origin_); }

  Label at(const Eigen::Vector3d& index) const {
    std::array<int, 3> voxel{};
    for (int d = 0; d < 3; ++d) {
      const double shifted = index[d] + 0.5;
      const auto axis = static_cast<std::size_t>(d);
      if (!(shifted >= 0 && shifted < volume_.size[axis])) return kBackground;
      voxel[axis] = static_cast<int>(shifted);
    }
    return volume_.at(voxel[0], voxel[1], voxel[2]);
  }

 private:
  const LabelVolume& volume_;
  Eigen::Matrix3d to_index_;
  Eigen::Vector3d origin_;
};

/// How many samples of one tet each label has.
class Tally {
 public:
  void clear() { counts_.clear(); }
  /// Drops all labels but those that count, unless none does.
  void keep(const std::vector<bool>& counted) {
    const auto kept = std::stable_partition(counts_.begin(), counts_.end(),
                                            [&](const auto& entry) { return counted[entry.first]; });
    if (kept != counts_.begin()) counts_.erase(kept, counts_.end());
  }
  int total() const {
    int sum = 0;
    for (const auto& [label, count] : counts_) sum += count;
    return sum;
  }
  void add(Label label) {
    for (auto& [seen, count] : counts_)
      if (seen == label) {
        ++count;
        return;
      }
    counts_.emplace_back(label, 1);
  }
  int count(Label label) const {
    for (const auto& [seen, count] : counts_)
      if (seen == label) return count;
    return 0;
  }
  /// The most frequent label; `preferred` where that is one of them, else the lowest of them.
  Label majority(Label preferred) const {
    std::pair<Label, int> best{preferred, count(preferred)};
    for (const auto& [label, count] : counts_)
      if (count > best.second || (count == best.second && best.first != preferred && label < best.first))
        best = {label, count};
    return best.first;
  }

 private:
  std::vector<std::pair<Label, int>> counts_;
};

/// The labels asked for, ascending and once each, with the volume of their voxels.
Result<std::vector<TransferredLabel>> asked_labels(const LabelVolume& volume, const TransferParams& params) {
  if (params.samples_min < 1 || params.samples_max < params.samples_min)
    return usage_error(kTransferStage, "samples_min " + std::to_string(params.samples_min) +
                                           ", samples_max " + std::to_string(params.samples_max) +
                                           ": expected 1 <= samples_min <= samples_max");
  std::vector<std::uint64_t> voxels(65536, 0);
  for (const Label label : volume.labels) ++voxels[label];
  std::vector<TransferredLabel> asked;
  for (std::size_t label = 0; label < voxels.size(); ++label) {
    if (std::find(params.labels.begin(), params.labels.end(), label) == params.labels.end()) continue;
    if (label != kBackground && voxels[label] > 0) {
      asked.emplace_back().label = static_cast<Label>(label);
      asked.back().voxel_mm3 = static_cast<double>(voxels[label]) * volume.voxel_mm3();
      continue;
    }
    std::string held;
    for (std::size_t other = 1; other < voxels.size(); ++other)
      if (voxels[other] > 0) held += (held.empty() ? "" : ", ") + std::to_string(other);
    return usage_error(kTransferStage,
                       "label " + std::to_string(label) + " is to be transferred; the volume holds " + held);
  }
  return asked;
}

std::optional<Error> check_mesh(const TetMesh& mesh) {
  if (mesh.labels.size() != mesh.tets.size())
    return Error{ErrorCode::kInternal, kTransferStage, "the mesh has not one label per tetrahedron", {}};
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
    for (const std::uint32_t v : mesh.tets[t])
      if (v >= mesh.points.size())
        return Error{ErrorCode::kInternal,
                     kTransferStage,
                     "tetrahedron " + std::to_string(t) + " uses point " + std::to_string(v) + " of " +
                         std::to_string(mesh.points.size()),
                     {{}, {t}}};
  return {};
}

/// Barycentres for n = 1, 2, ... up to the last that stays within `samples_max`.
std::vector<std::vector<Barycentric>> sample_sets(int samples_max) {
  std::vector<std::vector<Barycentric>> sets;
  for (int n = 1; n * n * n <= samples_max; ++n) sets.push_back(barycentres(n));
  return sets;
}

const std::vector<Barycentric>& enough_samples(const std::vector<std::vector<Barycentric>>& sets,
                                               double wanted) {
  for (const std::vector<Barycentric>& set : sets)
    if (static_cast<double>(set.size()) >= wanted) return set;
  return sets.back();
}

/// Whether each label counts: it was asked for, or most of its voxels' centres are in the mesh.
std::vector<bool> counted_labels(const TetMesh& mesh, const LabelVolume& volume,
                                 const std::vector<TransferredLabel>& asked) {
  const std::vector<Label> raster = rasterise(mesh, mesh.labels, volume);
  std::vector<std::int64_t> balance(65536, 0);
  for (std::size_t i = 0; i < raster.size(); ++i)
    balance[volume.labels[i]] += raster[i] == kBackground ? -1 : 1;
  std::vector<bool> counts(balance.size());
  for (std::size_t label = 1; label < balance.size(); ++label) counts[label] = balance[label] > 0;
  for (const TransferredLabel& label : asked) counts[label.label] = true;
  return counts;
}

/// Overlap of the voxels of a label with the tets that carry it.
double dice_of(Label label, const std::vector<Label>& voxels, const std::vector<Label>& raster) {
  std::uint64_t both = 0, either = 0;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    both += voxels[i] == label && raster[i] == label;
    either += (voxels[i] == label) + (raster[i] == label);
  }
  return either > 0 ? 2.0 * static_cast<double>(both) / static_cast<double>(either) : 0;
}

/// Adds what tet `t` has of the label to its volumes.
/// Fields of a mesh's tetrahedra, all 0.
std::vector<Field> blank_fields(const std::vector<TransferredLabel>& labels, std::size_t tets) {
  const std::vector<float> blank(tets, 0);
  std::vector<Field> fields{
      {"centroid_label", "Label at the centroid", "1", On::kTets, Scale::kLabel, 1, blank},
      {"majority_label", "Majority label", "1", On::kTets, Scale::kLabel, 1, blank}};
  for (const TransferredLabel& asked : labels) {
    const std::string number = std::to_string(asked.label);
    fields.push_back(
        {"fraction_" + number, "Share of label " + number, "1", On::kTets, Scale::kSequential, 1, blank});
  }
  return fields;
}

void add_tet(TransferredLabel& asked, Label centroid, Label majority, double mm3, float fraction) {
  asked.fraction_mm3 += static_cast<double>(fraction) * mm3;
  if (centroid == asked.label) asked.centroid_mm3 += mm3;
  if (majority == asked.label) asked.majority_mm3 += mm3;
}

std::vector<Label> as_labels(const std::vector<float>& values) {
  return {values.begin(), values.end()};
}

Status transfer_to_tets(const TetMesh& mesh, const LabelVolume& volume, const TransferParams& params,
                        const RunContext& ctx, LabelTransfer& found) {
  const NearestVoxel voxels(volume);
  const std::vector<std::vector<Barycentric>> sets = sample_sets(params.samples_max);
  const std::vector<bool> counted = counted_labels(mesh, volume, found.labels);
  Tally tally;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (t % kTetsPerPoll == 0) {
      if (ctx.cancelled()) return cancelled_error(kTransferStage);
      ctx.progress(kTransferStage, static_cast<double>(t) / static_cast<double>(mesh.tets.size()));
    }
    const auto [a, b, c, d] = mesh.tets[t];
    const TetCorners p{mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]};
    const double mm3 = std::abs(tet_volume_mm3(p));
    const TetCorners index{voxels.index_of(p[0]), voxels.index_of(p[1]), voxels.index_of(p[2]),
                           voxels.index_of(p[3])};
    const double wanted =
        std::max(kSamplesPerVoxel * mm3 / volume.voxel_mm3(), static_cast<double>(params.samples_min));
    const std::vector<Barycentric>& samples = enough_samples(sets, wanted);
    tally.clear();
    for (const Barycentric& w : samples)
      tally.add(voxels.at(w[0] * index[0] + w[1] * index[1] + w[2] * index[2] + w[3] * index[3]));
    tally.keep(counted);
    const Label centroid = voxels.at((index[0] + index[1] + index[2] + index[3]) / 4);
    const Label majority = tally.majority(centroid);
    found.fields[0].values[t] = centroid;
    found.fields[1].values[t] = majority;
    for (std::size_t i = 0; i < found.labels.size(); ++i) {
      float& fraction = found.fields[2 + i].values[t];
      fraction = static_cast<float>(tally.count(found.labels[i].label)) / static_cast<float>(tally.total());
      add_tet(found.labels[i], centroid, majority, mm3, fraction);
    }
  }
  return std::monostate{};
}

}  // namespace

Status check_transfer(const LabelVolume& volume, const TransferParams& params) {
  if (params.labels.empty()) return std::monostate{};
  const Result<std::vector<TransferredLabel>> asked = asked_labels(volume, params);
  if (!asked) return asked.error();
  return std::monostate{};
}

Result<LabelTransfer> transfer_labels(const TetMesh& mesh, const LabelVolume& volume,
                                      const TransferParams& params, RunContext& ctx) {
  LabelTransfer found;
  if (params.labels.empty()) return found;
  if (std::optional<Error> broken = check_mesh(mesh)) return *std::move(broken);
  Result<std::vector<TransferredLabel>> asked = asked_labels(volume, params);
  if (!asked) return asked.error();
  found.labels = *std::move(asked);
  found.fields = blank_fields(found.labels, mesh.tets.size());
  if (Status done = transfer_to_tets(mesh, volume, params, ctx.part(0, 0.8), found); !done)
    return done.error();

  const std::vector<Label> by_centroid = rasterise(mesh, as_labels(found.centroid()), volume);
  const std::vector<Label> by_majority = rasterise(mesh, as_labels(found.majority()), volume);
  for (TransferredLabel& label : found.labels) {
    label.centroid_dice = dice_of(label.label, volume.labels, by_centroid);
    label.majority_dice = dice_of(label.label, volume.labels, by_majority);
  }
  ctx.progress(kTransferStage, 1);
  return found;
}

}  // namespace voxtet
