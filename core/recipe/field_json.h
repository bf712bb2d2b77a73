// Values of fields as JSON.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace voxtet {

template <class Value>
nlohmann::json json_of(const Value& value) {
  return value;
}
inline nlohmann::json json_of(const Eigen::Vector3d& value) {
  return nlohmann::json::array({value.x(), value.y(), value.z()});
}

}  // namespace voxtet
