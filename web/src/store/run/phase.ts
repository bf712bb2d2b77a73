/** The phase of excitation, from what the voltage is and what it was a little earlier. */
import { noValue } from '../../engine/contract';

/** What is earlier by so much, ms, is held against what is now. */
export const phaseDelayMs = 20;

/** Halfway between rest and excitation: activation is told where it is crossed. */
const middleMv = -30;

/**
 * Phase of each point, degrees, more than -180 to 180: atan2(v(t - delay) - v*, v(t) - v*), by time-delay embedding as in
 * Gray, Pertsov and Jalife, "Spatial and temporal organization during cardiac fibrillation", Nature 392 (1998). Rest is
 * about -135, the front of a wave -45, excited tissue 45, and its recovery 135; where all of them meet in a point a wave
 * turns around it.
 */
export function phaseDegrees(now: Float32Array, before: Float32Array): Float32Array {
  return now.map((voltage, i) => {
    if (voltage <= noValue || before[i] <= noValue) return noValue;
    return (Math.atan2(before[i] - middleMv, voltage - middleMv) * 180) / Math.PI;
  });
}
