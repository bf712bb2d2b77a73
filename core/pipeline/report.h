// A session's results as JSON: what --json prints, what the browser shows.
#pragma once

#include <nlohmann/json.hpp>

#include "pipeline/session.h"

namespace voxtet {

/// engine, digest, tets, points, source, stages, transfer, physics, simulation, quality, fidelity, layers,
/// recipe, warnings; parts whose stage has not run are absent.
nlohmann::json report_json(const Session& session);

/// Name, size, spacing, affine, digest and labels of the volume as it was read, and the warnings of its
/// stage; of a file whose stage has not run, those of reading it.
nlohmann::json volume_json(const Session& session);

/// One entry of "stages" without its digest, which takes time to compute: name, seconds, cached, peak_mb,
/// notes, counts. Needs the stage's result.
nlohmann::json stage_json(const Session& session, Stage stage);

/// metrics, checklist and verdict of a report on its own (for `voxtet check`).
nlohmann::json quality_json(const QualityReport& report);

/// What the app and its types are made from: version, fields of the recipe, stages.
nlohmann::json schema_json();

/// {code, stage, message, where: {points, elements, stage, on}}.
nlohmann::json error_json(const Error& error);

}  // namespace voxtet
