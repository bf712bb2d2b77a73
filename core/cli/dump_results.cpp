#include "cli/dump_results.h"

#include <filesystem>

#include "io/bytes/files.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/write_volume.h"
#include "pipeline/exports/field_volume.h"
#include "pipeline/report.h"

namespace voxtet {
namespace {

/// Files in the making; once one has failed, the others are not made.
struct Dump {
  const Session& session;
  std::vector<std::pair<std::string, Bytes>> files{};
  Status made = std::monostate{};

  void add(const std::string& name, Result<Bytes> bytes) {
    if (!bytes) made = bytes.error();
    if (made) files.emplace_back(name, std::move(bytes).value());
  }
  void add(const std::string& name, Result<std::vector<OutputFile>> written) {
    if (!written) made = written.error();
    if (made) files.emplace_back(name, std::move(written->front().bytes));
  }
  WriteMeshOptions options() const { return {.infos = session.label_infos()}; }
  void add_surface(const std::string& name, const SurfaceMesh* surface) {
    if (made && surface) add(name, write_surface(*surface, MeshFormat::kPly, options()));
  }
  void add_tets(const std::string& name, const TetMesh* mesh) {
    if (made && mesh) add(name, write_tet_mesh(*mesh, MeshFormat::kVtu, options()));
  }
};

Bytes report_of(const Session& session) {
  const std::string text = report_json(session).dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
  return {text.begin(), text.end()};
}

std::string inside(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

}  // namespace

std::vector<std::string> files_of_dump(const std::string& folder) {
  std::vector<std::string> paths;
  for (const char* name : {"volume.nii.gz", "surface.ply", "smooth.ply", "sizing.nii.gz", "remesh.ply",
                           "tetra.vtu", "optimise.vtu", "report.json"})
    paths.push_back(inside(folder, name));
  return paths;
}

Status dump_results(const Session& session, const std::string& folder) {
  Dump dump{session};
  if (session.volume()) dump.add("volume.nii.gz", write_nifti(*session.volume(), true));
  dump.add_surface("surface.ply", session.surface());
  dump.add_surface("smooth.ply", session.smooth());
  if (session.sizing()) {
    const Result<ScalarVolume> sizes = field_volume(session, "size");
    dump.add("sizing.nii.gz", sizes ? write_nifti(*sizes, true) : sizes.error());
  }
  dump.add_surface("remesh.ply", session.remeshed());
  dump.add_tets("tetra.vtu", session.filled());
  if (session.is_current(Stage::kOptimise)) dump.add_tets("optimise.vtu", session.mesh());
  dump.add("report.json", report_of(session));
  if (!dump.made) return dump.made;

  std::vector<TargetFile> targets;
  for (const auto& [name, bytes] : dump.files) targets.push_back({inside(folder, name), bytes});
  return place_files(targets);
}

}  // namespace voxtet
