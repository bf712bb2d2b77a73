#include "anatomy/labels_across.h"

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "anatomy/look_across.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/grid/rasterise.h"

namespace voxtet {
namespace anatomy {

std::vector<bool> labels_within(const TetMesh& mesh, const LabelVolume& image,
                                const std::function<bool(Label)>& counts) {
  const std::vector<Label> filled = rasterise(mesh, mesh.labels, image);
  std::vector<bool> counted(65536);
  for (std::size_t label = 1; label < counted.size(); ++label)
    counted[label] = counts(static_cast<Label>(label));
  std::vector<std::int64_t> balance(65536, 0);
  for (std::size_t v = 0; v < filled.size(); ++v) balance[image.labels[v]] += counted[filled[v]] ? 1 : -1;
  std::vector<bool> within(65536, false);
  for (std::size_t label = 1; label < within.size(); ++label) within[label] = balance[label] > 0;
  return within;
}

}  // namespace anatomy

std::vector<Label> labels_across(const TetMesh& mesh, const LabelVolume& image) {
  const std::vector<bool> meshed = anatomy::labels_within(mesh, image, [](Label) { return true; });
  const anatomy::LookAcross look(image);
  const auto label_at = [&](int i, int j, int k) -> std::optional<std::uint16_t> {
    const Label label = image.at_or_background(i, j, k);
    if (meshed[label]) return std::nullopt;
    return label;
  };
  std::vector<Label> across;
  across.reserve(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = mesh.faces[f];
    const std::array<Eigen::Vector3d, 3> corners{mesh.points[a], mesh.points[b], mesh.points[c]};
    const Label front = mesh.face_sides[f][1];
    across.push_back(
        front != kBackground
            ? front
            : look.vote(corners, triangle_cross(corners[0], corners[1], corners[2]).normalized(), label_at)
                  .value_or(kBackground));
  }
  return across;
}

}  // namespace voxtet
