#include <algorithm>
#include <optional>

#include "anatomy/look_across.h"
#include "anatomy/name_faces.h"
#include "anatomy/surface_parts.h"
#include "base/parallel.h"

namespace voxtet::anatomy {

FaceKinds look_at_sides(const Points& points, const WallSurface& surface, const wall::WallGrid& grid,
                        int threads) {
  const LookAcross look(grid);
  const auto kind_at = [&](int i, int j, int k) -> std::optional<std::uint16_t> {
    if (!grid.contains(i, j, k)) return wall::kOuter;
    const std::uint8_t kind = grid.kind[grid.offset(i, j, k)];
    if (kind == wall::kWall) return std::nullopt;
    return kind == wall::kSide ? std::uint8_t{wall::kOuter} : kind;
  };
  FaceKinds kinds(surface.faces.size());
  parallel_for(threads, kinds.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const WallFace& face = surface.faces[f];
      const auto& [a, b, c] = face.corners;
      const std::optional<std::uint16_t> seen =
          look.vote({points[a], points[b], points[c]}, face.normal, kind_at);
      kinds[f] = static_cast<std::uint8_t>(seen.value_or(wall::kWall));
    }
  });
  const SurfaceParts parts = surface_parts(surface, kinds);
  std::vector<Fate> fates = largest_stay(parts);
  for (std::size_t part = 0; part < fates.size(); ++part)
    if (parts.name[part] == wall::kWall) fates[part] = Fate::kGives;
  give_away(surface, parts, fates, wall::kWall, kinds);
  return kinds;
}

}  // namespace voxtet::anatomy
