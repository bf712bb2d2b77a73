// Writes the result of each stage of a case to files that viewers open.
#pragma once

#include <string>
#include <vector>

#include "pipeline/session.h"
#include "types/result.h"

namespace voxtet {

/// The files that dump_results() may write into a folder.
std::vector<std::string> files_of_dump(const std::string& folder);

/// Writes the result of every stage that has one into `folder`, which has to be there:
/// volume.nii.gz (the labels to be meshed, as prepared), surface.ply, smooth.ply, sizing.nii.gz (edge
/// lengths, mm, on the voxels of the volume), remesh.ply, tetra.vtu, optimise.vtu, and report.json. mm, RAS.
/// All of them or none. Errors: kBadInput naming a path that cannot be written; those of the writers.
Status dump_results(const Session& session, const std::string& folder);

}  // namespace voxtet
