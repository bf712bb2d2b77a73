// How wrong the speed of an excitation wave is on a mesh of tetrahedra.
#pragma once

namespace voxtet {

/// The error of a plane wave's speed on unstructured tetrahedra of this mean edge length, in percent: below 0
/// where the wave is slow. Measured in bars of TetGen's tetrahedra with the part `consistent_mass` of the
/// mass consistent and the rest lumped (explicit steps: 0), of Mitchell and Schaeffer's cell with its usual
/// times. It depends on the edge length over the root of the diffusivity alone. Between measured values it is
/// interpolated. Beyond the last, 3 mm at 0.5 mm/ms, it is a guess: it goes on with the same slope at first,
/// and never falls below -100.
double wave_speed_error_percent(double edge_mm, double diffusivity_mm2_per_ms, double consistent_mass);

/// The diffusivity at which a wave on such a mesh has the speed that `diffusivity` gives it on a fine one.
/// Beyond the longest edge that was measured the correction is that of this edge.
double diffusivity_on_mesh(double edge_mm, double diffusivity_mm2_per_ms, double consistent_mass);

/// The longest mean edge (mm) up to which the size of that error is at most so many percent. `percent` > 0.
double edge_for_wave_speed_error(double percent, double diffusivity_mm2_per_ms, double consistent_mass);

}  // namespace voxtet
