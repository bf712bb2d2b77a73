#include "pipeline/admission.h"

#include "lookup/look_up_labels.h"
#include "pipeline/forecast.h"
#include "pipeline/session.h"

namespace voxtet {
namespace {

Status admit_look_up(const Session& session, RunContext&) {
  return check_look_up(*session.source_volume(), session.recipe().lookup);
}

Status admit_size(const Session& session, RunContext& ctx) {
  return check_limits(session, ctx);
}

}  // namespace

const std::vector<Admission>& admissions() {
  static const std::vector<Admission> all{{Stage::kSurface, {"lookup"}, admit_look_up},
                                          {Stage::kRemesh, {"remesh", "limits"}, admit_size}};
  return all;
}

}  // namespace voxtet
