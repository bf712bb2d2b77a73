#include "walls/count_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/union_find.h"
#include "walls/wall_mesh.h"

namespace voxtet {
namespace {

constexpr std::size_t kMostPlaces = 10;

using Part = WallMesh::Part;
using Face = WallMesh::Face;

void add(LayerShares& shares, std::uint32_t layers, double area) {
  if (shares.area_mm2.size() <= layers) shares.area_mm2.resize(layers + 1, 0);
  shares.area_mm2[layers] += area;
}

/// Both by_edges and places.
void count_edges(const TetMesh& mesh, const WallMesh& wall, LayerCount& count) {
  const std::vector<std::uint32_t>& from_inner = wall.from_inner();
  const std::vector<bool>& near_side = wall.near_side();
  const auto counts = [&](const Face& face, std::uint32_t v) {
    return face.part == Part::kOuter && from_inner[v] != kUnreached && !near_side[v];
  };
  UnionFind joined(mesh.points.size());
  for (const Face& face : wall.faces())
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = face.corners[i], w = face.corners[(i + 1) % 3];
      if (!counts(face, v)) continue;
      add(count.by_edges, from_inner[v], face.area / 3);
      if (counts(face, w) && from_inner[v] != count.target_layers && from_inner[w] != count.target_layers)
        joined.join(v, w);
    }
  std::map<std::uint32_t, LayerPlace> places;
  for (const Face& face : wall.faces())
    for (const std::uint32_t v : face.corners) {
      if (!counts(face, v) || from_inner[v] == count.target_layers) continue;
      LayerPlace& place =
          places.try_emplace(joined.find(v), LayerPlace{0, {0, 0, 0}, kUnreached, 0}).first->second;
      place.area_mm2 += face.area / 3;
      place.centre_mm += face.area / 3 * mesh.points[v];
      place.fewest = std::min(place.fewest, from_inner[v]);
      place.most = std::max(place.most, from_inner[v]);
    }
  for (auto& [vertex, place] : places) {
    place.centre_mm /= place.area_mm2;
    count.places.push_back(place);
  }
  std::stable_sort(count.places.begin(), count.places.end(),
                   [](const LayerPlace& a, const LayerPlace& b) { return a.area_mm2 > b.area_mm2; });
  count.places.resize(std::min(count.places.size(), kMostPlaces));
}

LayerShares count_lines(const WallMesh& wall, std::uint32_t layers) {
  const std::vector<bool>& near_side = wall.near_side();
  LayerShares shares;
  for (const Face& face : wall.faces()) {
    const auto beside = [&](std::uint32_t v) { return near_side[v]; };
    if (face.part != Part::kOuter || std::any_of(face.corners.begin(), face.corners.end(), beside)) continue;
    if (const std::uint32_t met = wall.layers_met(face, layers); met > 0) add(shares, met, face.area);
  }
  return shares;
}

void finish(LayerShares& shares, std::uint32_t layers) {
  double whole = 0, exact = 0, at_least = 0;
  for (std::size_t n = 0; n < shares.area_mm2.size(); ++n) {
    whole += shares.area_mm2[n];
    if (n == layers) exact += shares.area_mm2[n];
    if (n >= layers) at_least += shares.area_mm2[n];
  }
  shares.exact = whole > 0 ? exact / whole : 0;
  shares.at_least = whole > 0 ? at_least / whole : 0;
}

void map_layers(const TetMesh& mesh, const WallMesh& wall, std::uint32_t layers, std::vector<Field>& fields) {
  std::vector<float>&layer = fields[0].values, &across = fields[1].values;
  const std::vector<std::uint32_t> from_outer = wall.edges_through_from(Part::kOuter);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!wall.holds(t) || !std::isnan(layer[t])) continue;
    layer[t] = static_cast<float>(1 + wall.layer_of(t, layers));
    std::uint32_t fewest = kUnreached;
    for (const std::uint32_t v : mesh.tets[t])
      if (!wall.near_side()[v]) fewest = std::min(fewest, wall.from_inner()[v] + from_outer[v]);
    if (fewest < kUnreached) across[t] = static_cast<float>(fewest);
  }
}

}  // namespace

FoundLayers count_layers(const TetMesh& mesh, std::span<const LayeredWall> walls) {
  FoundLayers found;
  if (walls.empty()) return found;
  const std::vector<float> none(mesh.tets.size(), std::numeric_limits<float>::quiet_NaN());
  found.fields = {{"layer", "Layer, from the inner surface", "1", On::kTets, Scale::kWhole, 1, none},
                  {"layers_across", "Layers across the wall", "1", On::kTets, Scale::kWhole, 1, none}};
  for (const LayeredWall& wall : walls) {
    const WallMesh in_mesh(mesh, wall.field);
    LayerCount count{wall.field.wall, wall.layers, wall.exact, {}, count_lines(in_mesh, wall.layers), {}};
    count_edges(mesh, in_mesh, count);
    finish(count.by_edges, wall.layers);
    finish(count.by_lines, wall.layers);
    found.counts.push_back(std::move(count));
    map_layers(mesh, in_mesh, wall.layers, found.fields);
  }
  return found;
}

}  // namespace voxtet
