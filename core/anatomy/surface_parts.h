// Connected parts of a surface whose faces have names, and what becomes of parts that are too many.
#pragma once

#include <cstdint>
#include <vector>

#include "anatomy/wall_surface.h"

namespace voxtet::anatomy {

/// Faces with the same name that are connected over edges are a part.
struct SurfaceParts {
  std::vector<std::uint32_t> of;   ///< the part of each face
  std::vector<std::uint8_t> name;  ///< of each part
  std::vector<double> area_mm2;    ///< of each part
};

/// `names` has an entry for each face. Parts are in the order of their first faces.
SurfaceParts surface_parts(const WallSurface& surface, const std::vector<std::uint8_t>& names);

enum class Fate {
  kStays,
  kGives,  ///< takes the name of a part that stays
  kApart,  ///< stays, but no other part takes its name
};

/// kStays for the largest part of each name, kGives for all others.
std::vector<Fate> largest_stay(const SurfaceParts& parts);

/// Parts that give take the name with which they have the longest border among the parts that stay, those
/// beside such parts first. Parts that none is beside get the name `lost`.
void give_away(const WallSurface& surface, const SurfaceParts& parts, std::vector<Fate> fates,
               std::uint8_t lost, std::vector<std::uint8_t>& names);

}  // namespace voxtet::anatomy
