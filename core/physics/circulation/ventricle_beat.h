// What is read off a beat of one ventricle.
#pragma once

#include <algorithm>

namespace voxtet {

struct VentricleBeat {
  double most_ml = 0, least_ml = 0;  ///< end-diastolic and end-systolic volume
  double most_kpa = 0;
  double stroke_work_j = 0;  ///< the area of the loop of pressure and volume

  /// As a beat begins.
  static VentricleBeat from(double ml, double kpa) { return {ml, ml, kpa, 0}; }
  /// A step from one volume and pressure to others.
  void add(double before_ml, double before_kpa, double ml, double kpa) {
    most_ml = std::max(most_ml, ml);
    least_ml = std::min(least_ml, ml);
    most_kpa = std::max(most_kpa, kpa);
    // 1 kPa ml is 1 mJ.
    stroke_work_j -= (kpa + before_kpa) / 2 * (ml - before_ml) / 1000;
  }

  double stroke_ml() const { return most_ml - least_ml; }
  double ejection_fraction() const { return stroke_ml() / most_ml; }
};

}  // namespace voxtet
