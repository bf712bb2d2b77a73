// openCARP's mesh files .pts, .elem, .lon (openCARP manual, "File formats").
#pragma once

#include <string_view>

#include "io/write_mesh.h"

namespace voxtet {

inline constexpr double kUmPerMm = 1000;

/// What is said of a mesh written without fibres. A placeholder in .lon, whatever its direction, would be
/// simulated as if it were real; openCARP requires the file, so that a missing one is noticed.
inline constexpr std::string_view kNoFibres =
    "no fibres are known, so no .lon file is written; openCARP requires one: make the fibres, a direction "
    "for "
    "each element of .elem, before simulating";

/// .pts in um; .elem of type Tt with region = label; .lon.txt, which says kNoFibres in place of .lon;
/// .NAME.dat for each cell data, one value a line, in the order of .elem. The files have no place to say
/// their space.
std::vector<OutputFile> write_carp(const TetMesh& mesh, const WriteMeshOptions& options);

}  // namespace voxtet
