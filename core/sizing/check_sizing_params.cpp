#include "sizing/check_sizing_params.h"

#include <cmath>
#include <sstream>

#include "types/stage_names.h"

namespace voxtet {
namespace {

std::string item(const std::string& list, std::size_t index) {
  std::ostringstream text;
  text << list << '[' << index << ']';
  return text.str();
}

/// Collects the first complaint; later checks do nothing once there is one.
class Checker {
 public:
  void require(bool fine, const std::string& field, double found, const std::string& expected) {
    if (fine || error_) return;
    std::ostringstream message;
    message << "sizing." << field << ": found " << found << ", expected " << expected;
    refuse(message.str());
  }
  void refuse(const std::string& message) {
    if (!error_) error_ = Error{ErrorCode::kUsage, kSizingStage, message, {}};
  }
  void positive(const std::string& field, double value) {
    require(std::isfinite(value) && value > 0, field, value, "a finite length > 0 mm");
  }
  void finite(const std::string& field, const Eigen::Vector3d& value) {
    for (int d = 0; d < 3; ++d)
      require(std::isfinite(value[d]), item(field, static_cast<std::size_t>(d)), value[d], "a finite number");
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  std::optional<Error> error_;
};

/// Which labels a volume holds, and how to say so.
class HeldLabels {
 public:
  explicit HeldLabels(const LabelVolume& volume) : held_(65536, false) {
    for (const Label label : volume.labels) held_[label] = true;
    held_[kBackground] = false;
  }
  bool has(Label label) const { return held_[label]; }
  std::string list() const {
    constexpr int kMost = 20;
    std::string text;
    int count = 0;
    for (std::size_t label = 1; label < held_.size(); ++label) {
      if (!held_[label]) continue;
      if (++count <= kMost) text += (text.empty() ? "" : ", ") + std::to_string(label);
    }
    if (count > kMost) text += " and " + std::to_string(count - kMost) + " more";
    return text.empty() ? "none" : text;
  }

 private:
  std::vector<bool> held_;
};

void check_label(Checker& check, const HeldLabels& held, const std::string& field, Label label) {
  if (label == kBackground)
    check.refuse("sizing." + field +
                 ": found 0, the background, which takes its size from the labels around it");
  else if (!held.has(label))
    check.refuse("sizing." + field + ": found " + std::to_string(label) +
                 ", but the labels of the volume are " + held.list());
}

void check_region(Checker& check, const SizeRegion& region, const std::string& field) {
  check.finite(field + ".centre_mm", region.centre_mm);
  check.positive(field + ".edge_mm", region.edge_mm);
  check.require(std::isfinite(region.band_mm) && region.band_mm >= 0, field + ".band_mm", region.band_mm,
                "a finite length >= 0 mm");
  if (region.shape == RegionShape::kBox) {
    check.finite(field + ".axes_deg", region.axes_deg);
    for (int d = 0; d < 3; ++d)
      check.positive(item(field + ".half_size_mm", static_cast<std::size_t>(d)), region.half_size_mm[d]);
  } else {
    check.positive(field + ".radius_mm", region.radius_mm);
  }
  if (region.shape == RegionShape::kCapsule) check.finite(field + ".end_mm", region.end_mm);
}

void check_thickness(Checker& check, const ThicknessSize& rule, const std::string& field) {
  check.require(rule.layers > 0 || rule.layering == Layering::kSize, field + ".layers", rule.layers,
                "at least 1 where layering is exact");
  if (rule.layers > 0) return;
  check.positive(field + ".edge_thin_mm", rule.edge_thin_mm);
  check.positive(field + ".edge_thick_mm", rule.edge_thick_mm);
  check.require(std::isfinite(rule.thin_mm) && rule.thin_mm >= 0, field + ".thin_mm", rule.thin_mm,
                "a finite length >= 0 mm");
  const bool measured = rule.thin_mm == 0 && rule.thick_mm == 0;
  check.require(measured || (std::isfinite(rule.thick_mm) && rule.thick_mm > rule.thin_mm),
                field + ".thick_mm", rule.thick_mm, "more than thin_mm, or both 0");
}

void check_wave(Checker& check, const HeldLabels& held, const WaveSize& rule, const std::string& field) {
  for (std::size_t l = 0; l < rule.labels.size(); ++l)
    check_label(check, held, item(field + ".labels", l), rule.labels[l]);
  check.require(std::isfinite(rule.speed_mm_per_ms) && rule.speed_mm_per_ms > 0, field + ".speed_mm_per_ms",
                rule.speed_mm_per_ms, "a finite speed > 0 mm/ms");
  check.require(std::isfinite(rule.error_percent) && rule.error_percent > 0, field + ".error_percent",
                rule.error_percent, "a finite number > 0 %");
  check.require(rule.consistent_mass >= 0 && rule.consistent_mass <= 1, field + ".consistent_mass",
                rule.consistent_mass, "a number from 0 to 1");
}

void check_curvature(Checker& check, const HeldLabels& held, const CurvatureSize& rule,
                     const std::string& field) {
  for (std::size_t i = 0; i < rule.labels.size(); ++i)
    check_label(check, held, item(field + ".labels", i), rule.labels[i]);
  check.require(std::isfinite(rule.edges_per_turn) && rule.edges_per_turn >= 3, field + ".edges_per_turn",
                rule.edges_per_turn, "a number of at least 3");
  check.positive(field + ".edge_min_mm", rule.edge_min_mm);
}

void check_labels(Checker& check, const SizingParams& params, const HeldLabels& held) {
  std::vector<int> given_by(65536, -1);
  for (std::size_t i = 0; i < params.labels.size(); ++i) {
    const std::string field = item("labels", i);
    const Label label = params.labels[i].label;
    check_label(check, held, field + ".label", label);
    if (given_by[label] >= 0)
      check.refuse("sizing." + field + ".label: label " + std::to_string(label) +
                   " already has a size in sizing." +
                   item("labels", static_cast<std::size_t>(given_by[label])));
    given_by[label] = static_cast<int>(i);
    check.positive(field + ".edge_mm", params.labels[i].edge_mm);
  }
}

}  // namespace

std::optional<Error> find_sizing_error(const LabelVolume& volume, const SizingParams& params) {
  Checker check;
  check.positive("edge_mm", params.edge_mm);
  check.positive("edge_min_mm", params.edge_min_mm);
  check.positive("edge_max_mm", params.edge_max_mm);
  check.require(params.edge_min_mm <= params.edge_max_mm, "edge_min_mm", params.edge_min_mm,
                "at most edge_max_mm");
  check.require(params.gradation > 0 && params.gradation <= 1, "gradation", params.gradation,
                "a slope > 0 and at most 1");
  const HeldLabels held(volume);
  check_labels(check, params, held);
  for (std::size_t i = 0; i < params.regions.size(); ++i)
    check_region(check, params.regions[i], item("regions", i));
  for (std::size_t i = 0; i < params.distances.size(); ++i) {
    const DistanceSize& distance = params.distances[i];
    const std::string field = item("distances", i);
    check_label(check, held, field + ".label", distance.label);
    check.positive(field + ".edge_mm", distance.edge_mm);
    check.require(std::isfinite(distance.slope) && distance.slope >= 0, field + ".slope", distance.slope,
                  "a finite slope >= 0");
  }
  for (std::size_t i = 0; i < params.thickness.size(); ++i)
    check_thickness(check, params.thickness[i], item("thickness", i));
  for (std::size_t i = 0; i < params.waves.size(); ++i)
    check_wave(check, held, params.waves[i], item("waves", i));
  for (std::size_t i = 0; i < params.curvature.size(); ++i)
    check_curvature(check, held, params.curvature[i], item("curvature", i));
  return check.error();
}

}  // namespace voxtet
