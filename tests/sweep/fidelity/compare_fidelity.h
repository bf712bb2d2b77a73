// The figures of a case before a change and after it: as a row of a table, and what became worse.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace voxtet::sweep {

/// Heading, and a row of the table, of figures that measure_fidelity() gives; `before` may be null.
void print_fidelity_heading();
void print_fidelity(const std::string& name, const nlohmann::json* before, const nlohmann::json& now);

/// Everything that is worse by more than may be, in words.
std::vector<std::string> what_became_worse(const nlohmann::json& before, const nlohmann::json& now);

}  // namespace voxtet::sweep
