// Muscle under pressure, beside its mesh, as a case for other programs: FEBio and svMultiPhysics.
#pragma once

#include <string>
#include <vector>

#include "io/mesh/shared/mesh_format.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// A body of muscle that is held at one surface and inflated in even steps, without inertia. Its energy is
///
///     c1 (I1' - 3) + c2 (I2' - 3) + a / 2b (exp(b (I4f - 1)+^2) - 1) + k/4 (J^2 - 1 - 2 ln J)
///
/// with isochoric I1' and I2', and I4f the squared stretch of fibres. Where there are none, a is 0.
struct MechanicsCase {
  double c1_kpa = 0, c2_kpa = 0, a_kpa = 0, b = 0, bulk_kpa = 0;
  double pressure_kpa = 0;  ///< at the end
  int steps = 0;
  std::vector<std::string> loaded;  ///< names of surfaces of WriteMeshOptions, pressed against their normals
  std::string held;                 ///< the name of another one, which does not move
  std::vector<std::string> notes;   ///< what else is not the same as in voxtet, a line each
};

/// Programs that a case is written for.
enum class MechanicsProgram { kFebio, kSvMultiPhysics };
/// By the ending of a path: .feb FEBio, .xml svMultiPhysics. Errors: kUsage for others.
Result<MechanicsProgram> mechanics_program_of(const std::string& path);

/// FEBio: .feb of version 4.0. svMultiPhysics: .xml, the mesh .mesh.vtu with the arrays GlobalNodeID and
/// GlobalElementID, a .NAME.vtp for each named surface, fibres and sheets in .fibersLong.vtu and
/// .fibersSheet.vtu, and .pressure.dat. Both: .README.txt, which says what is the same in the program as here
/// and what is not. `options` have the named surfaces, and as cell data `fibre` and `sheet`, zeros where
/// there are none. The names of tags are those of the programs' manuals, sources and public cases; none of
/// the files was run there. Errors: kUsage for labels of which some tetrahedra have fibres and others have
/// not, and for svMultiPhysics for tetrahedra without fibres and for second-order elements; kInternal for
/// `options` without these fields and surfaces.
Result<std::vector<OutputFile>> write_mechanics_case(const TetMesh& mesh, const MechanicsCase& wanted,
                                                     MechanicsProgram program,
                                                     const WriteMeshOptions& options);

}  // namespace voxtet
