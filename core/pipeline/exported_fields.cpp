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

std::vector<Field> exported_point_fields(const Session& session) {
  std::vector<Field> fields;
  if (session.eikonal()) fields = session.eikonal()->fields;
  if (session.monodomain())
    fields.insert(fields.end(), session.monodomain()->fields.begin(), session.monodomain()->fields.end());
  return fields;
}

}  // namespace voxtet
