#include "pipeline/exported_fields.h"

#include <algorithm>
#include <iterator>

namespace voxtet {

std::vector<Field> exported_fields(const Session& session, bool measures) {
  std::vector<Field> fields;
  if (session.transfer()) fields = session.transfer()->fields;
  if (measures && session.quality())
    std::copy_if(session.quality()->fields.begin(), session.quality()->fields.end(),
                 std::back_inserter(fields),
                 [](const Field& field) { return field.on == On::kTets && all_finite(field.values); });
  return fields;
}

}  // namespace voxtet
