#include "pipeline/admission.h"

#include "pipeline/forecast.h"
#include "pipeline/session.h"
#include "transfer/transfer_labels.h"

namespace voxtet {
namespace {

Status admit_transfer(const Session& session, RunContext&) {
  return check_transfer(*session.source_volume(), session.recipe().transfer);
}

Status admit_size(const Session& session, RunContext& ctx) {
  return check_limits(session, ctx);
}

}  // namespace

const std::vector<Admission>& admissions() {
  static const std::vector<Admission> all{{Stage::kSurface, {"transfer"}, admit_transfer},
                                          {Stage::kRemesh, {"remesh", "limits"}, admit_size}};
  return all;
}

}  // namespace voxtet
