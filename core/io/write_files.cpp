#include "io/files.h"
#include "io/header_text.h"
#include "io/write_mesh.h"

namespace voxtet {

Status write_files(const std::string& path, const std::vector<OutputFile>& files) {
  if (const Result<MeshFormat> format = mesh_format_of(path); !format.ok()) return format.error();
  const std::string base = path.substr(0, path.size() - mesh_ending_of(path).size());
  std::vector<TargetFile> targets;
  for (const OutputFile& file : files) {
    // The ending that was asked for keeps its case.
    const bool asked = lower_case(mesh_ending_of(path)) == file.suffix;
    targets.push_back({asked ? path : base + file.suffix, file.bytes});
  }
  return place_files(targets);
}

}  // namespace voxtet
