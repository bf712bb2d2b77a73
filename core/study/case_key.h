// By what the results of cases are known.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "pipeline/session.h"
#include "study/study.h"

namespace voxtet {

/// Digests of cases; of each file once, as many cases may have it.
class CaseKeys {
 public:
  explicit CaseKeys(const StudyPlan& plan) : plan_(plan) {}

  /// A digest of all that decides the result of a case: the engine, its recipe, the stages, what is kept, and
  /// the bytes of its files and of those that they name, as a header names its voxels. A file that cannot be
  /// read counts as one without bytes.
  std::string of(const StudyCase& one);

 private:
  using Load = std::function<Status(Session&, const VolumeFile&)>;
  const std::string& digest_of_file(const std::string& path, const std::string& how, const Load& load);

  const StudyPlan& plan_;
  std::map<std::string, std::string> files_;  ///< digests by path, and by how the file is read
};

}  // namespace voxtet
