#include "physics/tissue/stimulated_points.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "geometry/elements/region_distance.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

std::optional<Error> check(const Stimulus& stimulus, const std::string& field) {
  const auto error = [&](const char* name, double found, const char* expected) {
    std::ostringstream text;
    text << field << "." << name << ": found " << found << ", expected " << expected;
    return usage_error(kTissueStage, text.str());
  };
  if (!(std::isfinite(stimulus.start_ms) && stimulus.start_ms >= 0))
    return error("start_ms", stimulus.start_ms, "a finite number of at least 0 ms");
  if (!(stimulus.duration_ms > 0)) return error("duration_ms", stimulus.duration_ms, "more than 0 ms");
  if (!(std::isfinite(stimulus.strength_per_ms) && stimulus.strength_per_ms > 0))
    return error("strength_per_ms", stimulus.strength_per_ms, "a finite number > 0 1/ms");
  if (stimulus.count < 1) return error("count", stimulus.count, "at least 1");
  return std::nullopt;
}

}  // namespace

Result<std::vector<std::uint32_t>> stimulated_points(const std::vector<Eigen::Vector3d>& points,
                                                     const std::vector<bool>& tissue,
                                                     const Stimulus& stimulus, const std::string& field) {
  if (auto error = check(stimulus, field)) return *std::move(error);
  const RegionDistance distance(stimulus);
  std::vector<std::uint32_t> found;
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!tissue.empty() && !tissue[i]) continue;
    const double away = distance.at(points[i]);
    nearest = std::min(nearest, away);
    if (away == 0) found.push_back(static_cast<std::uint32_t>(i));
  }
  if (!found.empty()) return found;
  std::ostringstream text;
  text << field << (stimulus.name.empty() ? "" : " (" + stimulus.name + ")")
       << ": found no point of conducting tissue in its region, expected at least one; the nearest is "
       << nearest << " mm away";
  return usage_error(kTissueStage, text.str());
}

}  // namespace voxtet
