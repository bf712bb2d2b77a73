// A simulation beside its mesh for openCARP: parameters (.par) and stimulated points (.vtx).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/mesh/shared/mesh_format.h"
#include "types/label_volume.h"
#include "types/tissue.h"

namespace voxtet {

/// The monodomain model on a mesh of write_carp().
struct CarpCase {
  /// Elements of these regions are one kind of tissue. Conductivities in S/m, for kSurfacePerUm and a
  /// capacitance of 1 uF/cm^2.
  struct Tissue {
    std::vector<Label> regions;
    double along_s_per_m = 0, across_s_per_m = 0;
    CellParams cell;
  };
  /// A current into the points of an electrode.
  struct Current {
    std::string name;
    std::size_t electrode = 0;
    double start_ms = 0, duration_ms = 0;
    double strength_ua_per_cm2 = 0;
    int count = 1;
    double interval_ms = 0;
  };

  std::vector<std::string> notes;  ///< comments at the head of the .par, a line each
  std::vector<Tissue> tissues;
  std::vector<std::vector<std::uint32_t>> electrodes;  ///< points of the mesh
  std::vector<Current> currents;
  double step_ms = 0, end_ms = 0, frame_ms = 0;
  bool lumped = true;               ///< mass matrix
  double rest_mv = 0, peak_mv = 0;  ///< of the cells' voltage
  double activated_mv = 0;          ///< crossed upwards, it is the activation
  /// Of each element, factors of its conductivities; empty: none.
  std::vector<float> conductivity_factors;
  /// What openCARP should find: the activation of each conducting point, ms, NaN where there is none.
  std::vector<float> expected_ms;
};

/// openCARP's default surface-to-volume ratio, 1/um, with its capacitance of 1 uF/cm^2: a diffusivity of 1
/// mm^2/ms is a conductivity of 1.4 S/m.
inline constexpr double kSurfacePerUm = 0.14;
inline constexpr double kSiemensPerM = 10 * kSurfacePerUm;

/// .par, .stimN.vtx for each electrode, .expected_ms.dat and, for conductivity_factors, .gi_scale.dat. `name`
/// is that of the mesh files. The names of parameters are those of openCARP's list (opencarp.org/parameters)
/// and of public cases; none of the files was run here.
std::vector<OutputFile> write_carp_case(const CarpCase& simulation, const std::string& name);

}  // namespace voxtet
