// The membrane's voltage in mV, from the model's v of 0 to 1.
#pragma once

namespace voxtet {

inline constexpr double kRest_mV = -80, kVoltageRange_mV = 100;
inline double membrane_mV(double v) {
  return kRest_mV + kVoltageRange_mV * v;
}

}  // namespace voxtet
