#include "io/mesh/write_mechanics_case.h"

#include <algorithm>
#include <map>

#include "io/bytes/header_text.h"
#include "io/mesh/write_febio_case.h"
#include "io/mesh/write_svmultiphysics_case.h"

namespace voxtet {
namespace {

bool has_surface(const std::vector<NamedSet>& surfaces, const std::string& name) {
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const NamedSet& set) { return set.name == name; });
}

Status check_parts(const TetMesh& mesh, const MechanicsCase& wanted, const WriteMeshOptions& options) {
  for (const std::string_view name : {kFibreField, kSheetField}) {
    const Field* field = find_field(options.cell_data, name);
    if (!field || field->values.size() != 3 * mesh.tets.size())
      return Error{ErrorCode::kInternal, kMeshWriter, "found no field " + std::string(name), {}};
  }
  std::vector<std::string> names = wanted.loaded;
  names.push_back(wanted.held);
  for (const std::string& name : names)
    if (!has_surface(options.surfaces, name))
      return Error{ErrorCode::kInternal, kMeshWriter, "found no surface " + name, {}};
  return std::monostate{};
}

/// Whether each label has fibres.
Result<std::map<Label, bool>> labels_with_fibres(const TetMesh& mesh, const std::vector<float>& fibre) {
  std::map<Label, bool> found;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const bool has = fibre[3 * t] != 0 || fibre[3 * t + 1] != 0 || fibre[3 * t + 2] != 0;
    if (found.try_emplace(mesh.labels[t], has).first->second != has)
      return usage_error(kMeshWriter, "label " + std::to_string(mesh.labels[t]) +
                                          ": found tetrahedra with fibres and others without, expected one "
                                          "material for a label");
  }
  return found;
}

}  // namespace

Result<MechanicsProgram> mechanics_program_of(const std::string& path) {
  const std::string ending = lower_case(mesh_ending_of(path));
  if (ending == ".feb") return MechanicsProgram::kFebio;
  if (ending == ".xml") return MechanicsProgram::kSvMultiPhysics;
  return usage_error(kMeshWriter, path + ": found the ending \"" + ending +
                                      "\", expected .feb for FEBio or .xml for svMultiPhysics");
}

Result<std::vector<OutputFile>> write_mechanics_case(const TetMesh& mesh, const MechanicsCase& wanted,
                                                     MechanicsProgram program,
                                                     const WriteMeshOptions& options) {
  if (Status whole = check_parts(mesh, wanted, options); !whole) return whole.error();
  const Result<std::map<Label, bool>> labels =
      labels_with_fibres(mesh, find_field(options.cell_data, kFibreField)->values);
  if (!labels) return labels.error();
  if (program == MechanicsProgram::kFebio) return write_febio_case(mesh, wanted, options);
  if (options.midside)
    return usage_error(
        kMeshWriter, "second-order elements: a case for svMultiPhysics has none, expected --order 1 or .feb");
  for (const auto& [label, has] : *labels)
    if (!has)
      return usage_error(kMeshWriter,
                         "label " + std::to_string(label) +
                             ": found no fibres, which a case for svMultiPhysics has everywhere; "
                             "expected a mesh of the wall alone, or .feb");
  return write_svmultiphysics_case(mesh, wanted, options);
}

}  // namespace voxtet
