// The simulation of a session as a case for openCARP, and openCARP's results on the mesh of the session.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/mesh/read_values.h"
#include "io/mesh/write_mesh.h"
#include "pipeline/session.h"
#include "types/field.h"
#include "types/result.h"

namespace voxtet {

/// The membrane's voltage where nothing is excited.
inline constexpr float kRestingVoltageMv = -80;

/// Whether a session has simulated a wave: kTissue, and kMonodomain or kEikonal, have results.
bool has_wave(const Session& session);

/// The mesh with what was found on it (exported_fields.h) and the case that finds it in openCARP
/// (write_carp_case.h). Needs has_wave(). Regions are the labels; where a label is of several kinds of tissue
/// (transferred labels), all but one of these have numbers above the labels. Tissue without fibres conducts
/// alike in all directions, but openCARP needs one: (1, 0, 0). Errors: kUsage where no numbers are left for
/// regions; those of stimulated_points() and write_tet_mesh().
Result<std::vector<OutputFile>> carp_case_files(const Session& session, PatientSpace space,
                                                const std::string& name);

/// A frame of values at the points of Session::mesh(). openCARP gives values at the points that conduct
/// alone: as many as these, where kTissue has a result, are taken for theirs, and the other points have none
/// (NaN). Errors: kBadInput naming the file and the numbers; those of PointValues::frame().
Result<Field> values_on_mesh(const Session& session, const PointValues& values, std::size_t frame);

}  // namespace voxtet
