#include "io/mesh/shared/mesh_format.h"

#include <array>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

struct Ending {
  std::string_view text;
  MeshFormat format;
};
constexpr std::array<Ending, 18> kEndings{{{".vtu", MeshFormat::kVtu},
                                           {".vtk", MeshFormat::kVtk},
                                           {".msh", MeshFormat::kMsh},
                                           {".mesh", MeshFormat::kMedit},
                                           {".pts", MeshFormat::kCarp},
                                           {".elem", MeshFormat::kCarp},
                                           {".lon", MeshFormat::kCarp},
                                           {".carp", MeshFormat::kCarp},
                                           {".inp", MeshFormat::kAbaqus},
                                           {".bdf", MeshFormat::kNastran},
                                           {".nas", MeshFormat::kNastran},
                                           {".feb", MeshFormat::kFebio},
                                           {".xdmf", MeshFormat::kXdmf},
                                           {".node", MeshFormat::kTetgen},
                                           {".ele", MeshFormat::kTetgen},
                                           {".face", MeshFormat::kTetgen},
                                           {".stl", MeshFormat::kStl},
                                           {".ply", MeshFormat::kPly}}};

}  // namespace

Result<MeshFormat> mesh_format_of(const std::string& path) {
  const std::string ending = lower_case(mesh_ending_of(path));
  std::string known;
  for (const Ending& candidate : kEndings) {
    if (ending == candidate.text) return candidate.format;
    known += ' ';
    known += candidate.text;
  }
  return Error{
      ErrorCode::kUsage, kMeshWriter, path + ": ending \"" + ending + "\", expected one of" + known, {}};
}

bool has_place_for(On on, int components, MeshFormat format) {
  switch (format) {
    case MeshFormat::kVtu:
    case MeshFormat::kVtk:
    case MeshFormat::kXdmf:
    case MeshFormat::kCarp: return true;
    case MeshFormat::kMsh:
    case MeshFormat::kMsh22: return on == On::kTets;
    case MeshFormat::kMedit:
    case MeshFormat::kAbaqus:
    case MeshFormat::kFebio: return on == On::kTets && components == 1;
    case MeshFormat::kNastran:
    case MeshFormat::kTetgen:
    case MeshFormat::kStl:
    case MeshFormat::kLabelStl:
    case MeshFormat::kPly: break;
  }
  return false;
}

bool has_place_for_surfaces(MeshFormat format) {
  return format != MeshFormat::kMedit && format != MeshFormat::kStl && format != MeshFormat::kLabelStl &&
         format != MeshFormat::kPly;
}

bool has_second_order(MeshFormat format) {
  return format == MeshFormat::kVtu || format == MeshFormat::kMsh || format == MeshFormat::kMsh22 ||
         format == MeshFormat::kAbaqus || format == MeshFormat::kFebio || format == MeshFormat::kXdmf;
}

bool has_fibres(const std::vector<Field>& cell_data) {
  const Field* fibre = find_field(cell_data, kFibreField);
  return fibre && fibre->components == 3;
}

std::string_view mesh_ending_of(std::string_view path) {
  const std::size_t name = path.find_last_of("/\\");
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos || (name != std::string_view::npos && dot < name)) return {};
  return path.substr(dot);
}

std::string mesh_name_of(std::string_view path) {
  const std::size_t ending = mesh_ending_of(path).size();
  const std::size_t folder = path.find_last_of("/\\");
  path.remove_suffix(ending);
  return std::string(path.substr(folder == std::string_view::npos ? 0 : folder + 1));
}

}  // namespace voxtet
