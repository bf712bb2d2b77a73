// The membrane's voltage in mV, from the model's v of 0 to 1.
#pragma once

namespace voxtet {

inline constexpr double kRestMv = -80, kVoltageRangeMv = 100;
inline double membrane_mv(double v) {
  return kRestMv + kVoltageRangeMv * v;
}

}  // namespace voxtet
