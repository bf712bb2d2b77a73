// A folder of its own for a test, with a study of small spheres in it.
#pragma once

#include <string>

#include "io/bytes/files.h"
#include "study/study.h"
#include "support/test_folder.h"

namespace voxtet {

class StudyTest : public test::FolderTest {
 protected:
  /// A study file of which these are the fields besides its version and its case.
  Result<Study> study_with(const std::string& fields, const std::string& body = kSphere) const {
    return read_study(
        write("study.json", R"({"study":1,"case":)" + body + (fields.empty() ? "" : ",") + fields + "}"));
  }
  std::string text_of(const std::string& name) const {
    const Result<Bytes> bytes = read_file(at(name));
    return bytes ? std::string(bytes->begin(), bytes->end()) : "";
  }

  static constexpr const char* kSphere =
      R"({"source":{"phantom":{"kind":"sphere","radius_mm":8,"spacing_mm":[2,2,2]}},"sizing":{"edge_mm":4}})";
};

}  // namespace voxtet
