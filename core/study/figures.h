// What the table says of a case that was run.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/session.h"

namespace voxtet {

/// The columns of figures, in their order. Lengths in mm, angles in degrees, times in ms.
inline constexpr std::array<const char*, 22> kFigures{
    "tets",
    "points",
    "smallest_dihedral_deg",
    "largest_dihedral_deg",
    "median_mean_ratio",
    "passed",            ///< the hard checks
    "mean_distance_mm",  ///< between mesh and label surface, the larger of both directions
    "largest_distance_mm",
    "worst_volume_error_percent",  ///< of the label that is farthest off
    "least_dice",
    "topology_differences",  ///< between the mesh and its labels
    "warnings",
    "eikonal_activated",  ///< part of the points that conduct
    "eikonal_last_ms",
    "monodomain_activated",
    "monodomain_last_ms",
    "lv_ejection_fraction",  ///< of the last beat
    "rv_ejection_fraction",
    "mesh_digest",
    "eikonal_digest",
    "monodomain_digest",
    "mechanics_digest"};

/// All of them null.
nlohmann::ordered_json no_figures();

/// An object with those that the stages which have run can give; the others are null.
nlohmann::ordered_json figures_of(const Session& session);

/// What a link of the case promises: engine and digests of the mesh and of what was simulated on it.
Expected promise_of(const Session& session);

}  // namespace voxtet
