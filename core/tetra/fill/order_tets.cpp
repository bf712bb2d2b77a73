#include "tetra/fill/order_tets.h"

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "geometry/search/morton_curve.h"

namespace voxtet::tetra {
namespace {

template <class Item>
void rearrange(std::vector<Item>& items, const std::vector<std::uint32_t>& order) {
  std::vector<Item> sorted;
  sorted.reserve(items.size());
  for (const std::uint32_t i : order) sorted.push_back(items[i]);
  items.swap(sorted);
}

}  // namespace

void order_along_curve(TetMesh& mesh, std::size_t first_free) {
  if (mesh.tets.empty()) return;
  const MortonCurve curve(mesh.points);
  const std::size_t count = mesh.points.size();
  std::vector<std::uint32_t> order(first_free), place(count);
  std::iota(order.begin(), order.end(), 0U);
  for (const std::uint32_t i :
       curve.order(count - first_free, [&](std::size_t i) { return mesh.points[first_free + i]; }))
    order.push_back(static_cast<std::uint32_t>(first_free + i));
  for (std::uint32_t v = 0; v < count; ++v) place[order[v]] = v;
  rearrange(mesh.points, order);
  for (Tet& tet : mesh.tets)
    for (std::uint32_t& v : tet) v = place[v];
  const auto centroid = [&](std::size_t t) -> Eigen::Vector3d {
    const auto [a, b, c, d] = mesh.tets[t];
    return (mesh.points[a] + mesh.points[b] + mesh.points[c] + mesh.points[d]) / 4;
  };
  order = curve.order(mesh.tets.size(), centroid);
  rearrange(mesh.tets, order);
  rearrange(mesh.labels, order);
}

}  // namespace voxtet::tetra
