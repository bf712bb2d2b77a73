#include "bench/peers/peer.h"

#include <cstdio>
#include <ctime>

#include "io/bytes/files.h"
#include "io/mesh/write_mesh.h"

namespace voxtet::peers {

double seconds_of(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

int finish(const std::string& out, const TetMesh& mesh, const nlohmann::json& figures) {
  Status written = write_text_file(out + ".json", figures.dump(1));
  if (written && !mesh.tets.empty()) {
    const Result<std::vector<OutputFile>> files = write_tet_mesh(mesh, MeshFormat::kVtu, {});
    written = files ? write_files(out + ".vtu", *files) : files.error();
  }
  if (written) return 0;
  std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return 1;
}

}  // namespace voxtet::peers
