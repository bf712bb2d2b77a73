// Meshes for the readers of other people, and other people's files for our reader:
//   mesh_files write FOLDER    the cube of labelled_mesh.h in every format and space, with many cell data
//   in many.xdmf, and its numbers in raw.*
//   mesh_files read MESH OUT   reads MESH and writes its numbers to OUT.points, OUT.tets, OUT.labels
// Raw numbers: points float64, tets and faces uint32, labels and sides uint16.
#include <cstdio>
#include <string>
#include <string_view>

#include "geometry/curved/midside_nodes.h"
#include "io/bytes/files.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

bool succeeded(const Status& status) {
  if (!status.ok()) std::fprintf(stderr, "%s\n", status.error().message.c_str());
  return status.ok();
}

template <class T>
bool write_raw(const std::string& path, const std::vector<T>& values) {
  return succeeded(place_files(
      {{path, {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)}}}));
}

bool write_tets(const std::string& base, const TetMesh& mesh) {
  return write_raw(base + ".points", mesh.points) && write_raw(base + ".tets", mesh.tets) &&
         write_raw(base + ".labels", mesh.labels);
}

bool write_export(const std::string& path, const Result<std::vector<OutputFile>>& files) {
  return files.ok() ? succeeded(write_files(path, *files)) : succeeded(files.error());
}

bool write_all(const std::string& folder) {
  const TetMesh mesh = test::kuhn_cube(6);
  const SurfaceMesh surface{mesh.points, mesh.faces, mesh.face_sides};
  bool good = write_tets(folder + "/raw", mesh) && write_raw(folder + "/raw.faces", mesh.faces) &&
              write_raw(folder + "/raw.sides", mesh.face_sides);
  for (const auto& [name, space] :
       {std::pair{"ras", PatientSpace::kRas}, std::pair{"lps", PatientSpace::kLps}}) {
    const WriteMeshOptions options{
        .space = space, .infos = test::cube_infos(), .cell_data = test::cube_cell_data(mesh), .name = name};
    const std::string base = folder + "/" + name;
    for (const char* ending : {".vtu", ".vtk", ".msh", ".mesh", ".carp", ".inp", ".bdf", ".feb", ".xdmf",
                               ".node", ".stl", ".ply"}) {
      const auto format = mesh_format_of(ending);
      good = good && format.ok() && write_export(base + ending, write_tet_mesh(mesh, *format, options));
    }
    good = good && write_export(base + "_22.msh", write_tet_mesh(mesh, MeshFormat::kMsh22, options)) &&
           write_export(base + "_label.stl", write_tet_mesh(mesh, MeshFormat::kLabelStl, options));
    WriteMeshOptions second = options;
    second.name = std::string(name) + "_order2";
    second.midside = straight_midside_nodes(mesh);
    second.surfaces = {{"first", {0, 1, 2}}};
    for (const char* ending : {".vtu", ".msh", ".inp", ".feb", ".xdmf"}) {
      const auto format = mesh_format_of(ending);
      good = good && format.ok() &&
             write_export(base + "_order2" + ending, write_tet_mesh(mesh, *format, second));
    }
    good = good && write_export(base + "_order2_22.msh", write_tet_mesh(mesh, MeshFormat::kMsh22, second));
    for (const char* ending : {".vtu", ".vtk", ".stl", ".ply"}) {
      const auto format = mesh_format_of(ending);
      good = good && format.ok() &&
             write_export(base + "_surface" + ending, write_surface(surface, *format, options));
    }
  }
  WriteMeshOptions many{.name = "many"};
  for (std::size_t i = 0; i < 21; ++i)
    many.cell_data.push_back(test::tet_values("value_" + std::to_string(i),
                                              std::vector<float>(mesh.tets.size(), static_cast<float>(i))));
  return good && write_export(folder + "/many.xdmf", write_tet_mesh(mesh, MeshFormat::kXdmf, many));
}

}  // namespace
}  // namespace voxtet

int main(int argc, char** argv) {
  const std::string_view task = argc > 1 ? argv[1] : "";
  if (task == "write" && argc == 3) return voxtet::write_all(argv[2]) ? 0 : 1;
  if (task == "read" && argc == 4) {
    const auto mesh = voxtet::read_tet_mesh_file(argv[2]);
    if (!mesh.ok()) std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
    return mesh.ok() && voxtet::write_tets(argv[3], *mesh) ? 0 : 1;
  }
  std::fprintf(stderr, "usage: mesh_files write FOLDER | mesh_files read MESH OUT\n");
  return 2;
}
