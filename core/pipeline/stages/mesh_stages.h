// The stages from a volume to the evidence of its mesh, as stage_table() runs them.
#pragma once

#include <string>

#include "pipeline/stages/stage.h"

namespace voxtet {

void add_volume(const LoadedFiles& files, const Recipe& recipe, std::string& key);
Status run_volume(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
Status run_surface(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
Status run_smooth(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
Status run_walls(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
void add_side_volumes(const LoadedFiles& files, const Recipe& recipe, std::string& key);
Status run_sizing(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
Status run_layers(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
Status run_remesh(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
Status run_tetra(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
Status run_optimise(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
Status run_transfer(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);
Status run_quality(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx);

}  // namespace voxtet
