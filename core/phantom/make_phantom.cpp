#include "phantom/make_phantom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <sstream>

#include "geometry/elements/rotation.h"
#include "phantom/body.h"
#include "phantom/keep_large_components.h"

namespace voxtet {
namespace {

constexpr double kMaxVoxels = 512.0 * 512.0 * 512.0;
constexpr int kPadding = 2;
constexpr double kMaxRoughnessMm = 1.2;  // at scale 1: beyond it bumps would close the cavities' thin ends
constexpr int kMostRegions = 2000;
constexpr Label kScarCore = 5;
constexpr const char* kStage = "phantom";

/// Ranges within which all combinations give a heart of one piece a label.
struct HeartRange {
  const char* field;
  double PhantomParams::*value;
  double least, most;
  const char* unit;
};
constexpr std::array<HeartRange, 8> kHeartRanges{
    {{"wall_scale", &PhantomParams::wall_scale, 0.5, 2, "a factor"},
     {"length_scale", &PhantomParams::length_scale, 0.75, 1.35, "a factor"},
     {"rv_dilation", &PhantomParams::rv_dilation, 0.7, 3.5, "a factor"},
     {"rv_wall_mm", &PhantomParams::rv_wall_mm, 3, 10, "a thickness"},
     {"scar_angle_deg", &PhantomParams::scar_angle_deg, -180, 180, "an angle"},
     {"scar_height_mm", &PhantomParams::scar_height_mm, -20, 20, "a height"},
     {"scar_arc_mm", &PhantomParams::scar_arc_mm, 20, 72, "a width"},
     {"scar_length_mm", &PhantomParams::scar_length_mm, 16, 60, "a length"}}};

bool reads_radius(PhantomKind kind) {
  return kind != PhantomKind::kBiventricle && kind != PhantomKind::kAtlas;
}
bool reads_inner_radius(PhantomKind kind) {
  return kind == PhantomKind::kShell || kind == PhantomKind::kTorus;
}

/// The first parameter that is out of range, among those that the kind reads.
std::optional<Error> find_parameter_error(const PhantomParams& p) {
  const auto refuse = [](const std::string& field, double found, const std::string& expected) {
    std::ostringstream message;
    message << "phantom." << field << ": found " << found << ", expected " << expected;
    return usage_error(kStage, message.str());
  };
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  const std::string length = "a finite length > 0";
  for (int d = 0; d < 3; ++d) {
    std::string index = "[0]";
    index[1] = static_cast<char>('0' + d);
    if (!positive(p.spacing_mm[d])) return refuse("spacing_mm" + index, p.spacing_mm[d], length);
    if (!std::isfinite(p.rotation_deg[d]))
      return refuse("rotation_deg" + index, p.rotation_deg[d], "a finite angle");
  }
  if (reads_radius(p.kind) && !positive(p.radius_mm)) return refuse("radius_mm", p.radius_mm, length);
  if (reads_inner_radius(p.kind) && !(positive(p.inner_radius_mm) && p.inner_radius_mm < p.radius_mm))
    return refuse("inner_radius_mm", p.inner_radius_mm, length + " and less than radius_mm");
  if (p.kind == PhantomKind::kSlab && !positive(p.thickness_mm))
    return refuse("thickness_mm", p.thickness_mm, length);
  if (!reads_radius(p.kind) && !positive(p.scale)) return refuse("scale", p.scale, "a finite factor > 0");
  if (p.kind == PhantomKind::kAtlas && !(p.regions >= 1 && p.regions <= kMostRegions))
    return refuse("regions", p.regions, "a number from 1 to 2000");
  if (p.kind == PhantomKind::kBiventricle) {
    if (!(p.roughness_mm >= 0 && p.roughness_mm <= kMaxRoughnessMm * p.scale))
      return refuse("roughness_mm", p.roughness_mm, "a length from 0 to 1.2 * scale");
    for (const HeartRange& r : kHeartRanges)
      if (!(p.*r.value >= r.least && p.*r.value <= r.most)) {
        std::ostringstream expected;
        expected << r.unit << " from " << r.least << " to " << r.most;
        return refuse(r.field, p.*r.value, expected.str());
      }
    if (!(p.scar_depth > 0 && p.scar_depth <= 1))
      return refuse("scar_depth", p.scar_depth, "a share of the wall > 0 and at most 1");
    if (!(std::isfinite(p.border_mm) && p.border_mm >= 0))
      return refuse("border_mm", p.border_mm, "a finite width, 0 for none");
    if (!(std::isfinite(p.isthmus_mm) && p.isthmus_mm >= 0))
      return refuse("isthmus_mm", p.isthmus_mm, "a finite width, 0 for none");
  }
  return std::nullopt;
}

/// Only the scar core that an isthmus crosses may be in two pieces.
bool is_cut_core(const PhantomParams& params, Label label) {
  return params.kind == PhantomKind::kBiventricle && label == kScarCore && params.isthmus_mm > 0;
}

Body body_of(const PhantomParams& params) {
  switch (params.kind) {
    case PhantomKind::kBiventricle: return biventricle_body(params);
    case PhantomKind::kAtlas: return atlas_body(params);
    default: return simple_body(params);
  }
}

/// A grid whose axes are the columns of the body's rotation, wide enough for the body.
Result<Grid> grid_around(const Body& body, const PhantomParams& params) {
  const Eigen::Matrix3d rotation = rotation_from_degrees(params.rotation_deg);
  Grid grid;
  double voxels = 1;
  Eigen::Vector3d counts, middle;
  Eigen::Matrix3d linear;
  for (int d = 0; d < 3; ++d) {
    const double reach = std::min(rotation.col(d).cwiseAbs().dot(body.half_extent_mm), body.radius_mm);
    counts[d] = std::ceil(2 * reach / params.spacing_mm[d]) + 1 + 2 * kPadding;
    voxels *= counts[d];
    middle[d] = (counts[d] - 1) / 2;
    linear.col(d) =
        rotation.col(d) * (params.mirrored && d == 0 ? -params.spacing_mm[d] : params.spacing_mm[d]);
  }
  if (!(voxels <= kMaxVoxels)) {
    std::ostringstream message;
    message << "phantom.spacing_mm: " << counts[0] << " x " << counts[1] << " x " << counts[2]
            << " voxels would be needed, expected at most 512^3 in all";
    return usage_error(kStage, message.str());
  }
  for (int d = 0; d < 3; ++d) grid.size[d] = static_cast<int>(counts[d]);
  grid.index_to_mm.topLeftCorner<3, 3>() = linear;
  grid.index_to_mm.topRightCorner<3, 1>() = body.centre_mm - linear * middle;
  return grid;
}

LabelVolume sample(const Body& body, const Grid& grid) {
  LabelVolume volume{grid, {}, {}};
  volume.labels.resize(volume.voxel_count());
  grid.visit(
      [&](int i, int j, int k, std::size_t at) { volume.labels[at] = body.label_at(grid.to_mm(i, j, k)); });
  return volume;
}

/// The same volume cut down to its labels and `kPadding` voxels around them; empty if there are no labels.
LabelVolume cropped(const LabelVolume& volume) {
  std::array<int, 3> low = volume.size, high{-1, -1, -1};
  volume.visit([&](int i, int j, int k, std::size_t at) {
    if (volume.labels[at] == kBackground) return;
    const std::array<int, 3> voxel{i, j, k};
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], voxel[d]);
      high[d] = std::max(high[d], voxel[d]);
    }
  });
  LabelVolume result;
  if (high[0] < 0) return result;
  Eigen::Vector3d first;
  for (int d = 0; d < 3; ++d) {
    result.size[d] = high[d] - low[d] + 1 + 2 * kPadding;
    first[d] = low[d] - kPadding;
  }
  result.index_to_mm = volume.index_to_mm;
  result.index_to_mm.topRightCorner<3, 1>() = volume.to_mm(first);
  result.labels.assign(result.voxel_count(), kBackground);
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      std::copy_n(volume.labels.begin() + static_cast<std::ptrdiff_t>(volume.offset(low[0], j, k)),
                  high[0] - low[0] + 1,
                  result.labels.begin() + static_cast<std::ptrdiff_t>(result.offset(
                                              kPadding, j - low[1] + kPadding, k - low[2] + kPadding)));
  return result;
}

std::vector<LabelInfo> describe_regions(const LabelVolume& volume) {
  std::set<Label> held(volume.labels.begin(), volume.labels.end());
  held.erase(kBackground);
  std::vector<LabelInfo> infos;
  const auto spread = [](Label label, float step) {  // irrational steps: neighbours in number differ
    const float at = step * static_cast<float>(label);
    return at - std::floor(at);
  };
  for (const Label label : held)
    infos.push_back({label,
                     "region " + std::to_string(label),
                     {spread(label, 0.8192F), spread(label, 0.6711F), spread(label, 0.5497F)}});
  return infos;
}

/// Names and colours that stay apart for colour-blind readers, of the labels that the volume holds; the
/// atlas has more than can be told apart.
std::vector<LabelInfo> describe(const LabelVolume& volume, PhantomKind kind) {
  if (kind == PhantomKind::kAtlas) return describe_regions(volume);
  static const std::vector<LabelInfo> kHeart{
      {1, "LV myocardium", {0.70F, 0.25F, 0.20F}}, {2, "RV myocardium", {0.93F, 0.62F, 0.20F}},
      {3, "LV blood pool", {0.00F, 0.45F, 0.70F}}, {4, "RV blood pool", {0.35F, 0.70F, 0.90F}},
      {5, "scar core", {0.24F, 0.10F, 0.36F}},     {6, "border zone", {0.94F, 0.89F, 0.26F}}};
  static const std::vector<LabelInfo> kBoxes{{1, "outer box", {0.70F, 0.25F, 0.20F}},
                                             {2, "middle box", {0.93F, 0.62F, 0.20F}},
                                             {3, "inner box", {0.00F, 0.45F, 0.70F}}};
  static const std::vector<LabelInfo> kBody{{1, "body", {0.70F, 0.25F, 0.20F}}};
  const std::vector<LabelInfo>& all =
      kind == PhantomKind::kBiventricle ? kHeart : (kind == PhantomKind::kNestedBoxes ? kBoxes : kBody);
  std::array<bool, 7> present{};
  for (const Label label : volume.labels) present[label] = true;
  std::vector<LabelInfo> held;
  for (const LabelInfo& info : all)
    if (present[info.label]) held.push_back(info);
  return held;
}

}  // namespace

Result<LabelVolume> make_phantom(const PhantomParams& params) {
  if (const auto error = find_parameter_error(params)) return *error;
  const Body body = body_of(params);
  const Result<Grid> grid = grid_around(body, params);
  if (!grid) return grid.error();
  LabelVolume sampled = sample(body, *grid);
  if (!reads_radius(params.kind))
    keep_large_components(sampled, [&](Label label) { return is_cut_core(params, label) ? 2U : 1U; });
  LabelVolume volume = cropped(sampled);
  if (volume.labels.empty())
    return usage_error(kStage,
                       "phantom.spacing_mm: no voxel centre lies inside the body, expected a finer spacing");
  if (params.kind == PhantomKind::kBiventricle && params.scar &&
      std::find(volume.labels.begin(), volume.labels.end(), kScarCore) == volume.labels.end())
    return usage_error(kStage,
                       "phantom.scar: no voxel of its core is left, expected a larger scar_arc_mm, "
                       "scar_length_mm or scar_depth, a smaller isthmus_mm, or a finer spacing_mm");
  volume.infos = describe(volume, params.kind);
  return volume;
}

std::function<Label(const Eigen::Vector3d&)> phantom_body(const PhantomParams& params) {
  if (find_parameter_error(params)) return [](const Eigen::Vector3d&) { return kBackground; };
  return body_of(params).label_at;
}

double phantom_volume_mm3(const PhantomParams& params, Label label) {
  constexpr double kPi = 3.14159265358979323846;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const double r = params.radius_mm;
  const double inner = params.inner_radius_mm;
  if (find_parameter_error(params)) return nothing;
  if (params.kind == PhantomKind::kNestedBoxes) {
    const double third = 8 * r * r * r / 27;
    return label == 1 ? 19 * third : (label == 2 ? 7 * third : (label == 3 ? third : nothing));
  }
  if (label != 1) return nothing;
  switch (params.kind) {
    case PhantomKind::kSphere: return 4 * kPi / 3 * r * r * r;
    case PhantomKind::kShell: return 4 * kPi / 3 * (r * r * r - inner * inner * inner);
    case PhantomKind::kTorus: return 2 * kPi * kPi * r * inner * inner;
    case PhantomKind::kSlab: return 4 * r * r * params.thickness_mm;
    default: return nothing;
  }
}

}  // namespace voxtet
