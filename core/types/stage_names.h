// The names of the stages, as errors, warnings, notes, progress and reports use them.
#pragma once

namespace voxtet {

inline constexpr const char* kVolumeStage = "volume";
inline constexpr const char* kSurfaceStage = "surface";
inline constexpr const char* kSmoothStage = "smooth";
inline constexpr const char* kWallsStage = "walls";
inline constexpr const char* kSizingStage = "sizing";
inline constexpr const char* kLayersStage = "layers";
inline constexpr const char* kRemeshStage = "remesh";
inline constexpr const char* kTetraStage = "tetra";
inline constexpr const char* kOptimiseStage = "optimise";
inline constexpr const char* kTransferStage = "transfer";
inline constexpr const char* kQualityStage = "quality";
inline constexpr const char* kAnatomyStage = "anatomy";
inline constexpr const char* kDiffusionStage = "diffusion";
inline constexpr const char* kFibresStage = "fibres";
inline constexpr const char* kTissueStage = "tissue";
inline constexpr const char* kEikonalStage = "eikonal";
inline constexpr const char* kMechanicsStage = "mechanics";
inline constexpr const char* kMonodomainStage = "monodomain";

}  // namespace voxtet
