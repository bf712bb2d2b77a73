#include "walls/wall_layers.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/topology/unused_points.h"

namespace voxtet {
namespace {

constexpr std::uint32_t kNowhere = 0xffffffffU;

/// The number of the wall that most voxels of each label lie in, or kNowhere.
std::vector<std::uint32_t> walls_of_labels(const LabelVolume& volume, std::span<const LayeredWall> walls) {
  std::vector<std::uint32_t> wall_of(65536, kNowhere);
  for (std::uint32_t w = 0; w < walls.size(); ++w) {
    const Eigen::Matrix4d to_wall = walls[w].field.mm_to_index * volume.index_to_mm;
    std::vector<std::int64_t> balance(65536, 0);
    volume.visit([&](int i, int j, int k, std::size_t at) {
      if (volume.labels[at] == kBackground) return;
      const Eigen::Vector4d index = to_wall * Eigen::Vector4d(i, j, k, 1);
      balance[volume.labels[at]] += walls[w].field.holds(index.head<3>()) ? 1 : -1;
    });
    for (std::size_t label = 1; label < balance.size(); ++label)
      if (balance[label] > 0 && wall_of[label] == kNowhere) wall_of[label] = w;
  }
  return wall_of;
}

/// Appends a triangle between two labels, the higher one behind it.
void add_triangle(Triangle triangle, Sides sides, std::vector<Triangle>& triangles,
                  std::vector<Sides>& all_sides) {
  if (sides[0] < sides[1]) {
    std::swap(sides[0], sides[1]);
    std::swap(triangle[1], triangle[2]);
  }
  triangles.push_back(triangle);
  all_sides.push_back(sides);
}

}  // namespace

WallLayers::WallLayers(const LabelVolume& volume, std::span<const LayeredWall> walls) {
  for (const LayeredWall& wall : walls) walls_.push_back({&wall.field, wall.layers});
  const std::vector<std::uint32_t> wall_of = walls_of_labels(volume, walls);
  const Label last =
      volume.labels.empty() ? kBackground : *std::max_element(volume.labels.begin(), volume.labels.end());
  first_ = static_cast<Label>(last + 1);
  first_of_.assign(65536, kNowhere);
  for (std::uint32_t label = 1; label <= last; ++label) {
    const std::uint32_t w = wall_of[label];
    if (w == kNowhere || walls[w].layers == 0) continue;
    const std::uint32_t each = walls[w].layers / 2, odd = walls[w].layers % 2;
    const auto surfaces = static_cast<std::uint32_t>(1 + walls[w].field.inner_shares.size());
    if (last + layers_.size() + std::size_t{surfaces} * each + odd > std::numeric_limits<Label>::max()) {
      lacks_labels_ = true;
      return;
    }
    first_of_[label] = static_cast<std::uint32_t>(layers_.size());
    for (std::uint32_t surface = 0; surface < surfaces; ++surface)
      for (std::uint32_t step = 0; step < each; ++step)
        layers_.push_back({static_cast<Label>(label), w, surface, step, false});
    if (odd > 0) layers_.push_back({static_cast<Label>(label), w, 0, each, true});
  }
}

bool WallLayers::has_wall(std::size_t wall) const {
  return std::any_of(layers_.begin(), layers_.end(), [wall](const Layer& own) { return own.wall == wall; });
}

Label WallLayers::at(Label label, const Eigen::Vector3d& mm) const {
  const std::uint32_t first = first_of_.empty() ? kNowhere : first_of_[label];
  if (first == kNowhere) return label;
  const Wall& wall = walls_[layers_[first].wall];
  const WallField::Shares shares = wall.field->shares_at(mm);
  if (shares.size() == 0) return label;
  Eigen::Index surface = 0;
  const double away = std::max(wall.layers * (1 - shares.maxCoeff(&surface)), 0.0);
  const std::uint32_t each = wall.layers / 2;
  std::uint32_t step = away < each ? static_cast<std::uint32_t>(away) : each;
  if (step == each && wall.layers % 2 == 0) --step;
  const std::uint32_t place =
      each * static_cast<std::uint32_t>(step == each ? shares.size() : surface) + (step == each ? 0 : step);
  return static_cast<Label>(first_ + first + place);
}

double WallLayers::lead(const Eigen::Vector3d& mm, Label a, Label b) const {
  const Layer &x = layer(a), &y = layer(b);
  const Wall& wall = walls_[x.wall];
  const WallField::Shares shares = wall.field->shares_at(mm);
  if (shares.size() == 0) return 0;
  if (x.surface != y.surface && !x.middle && !y.middle) return shares[x.surface] - shares[y.surface];
  const double sign = x.step < y.step ? 1 : -1;
  const std::uint32_t surface = x.step < y.step ? x.surface : y.surface;
  return sign * (shares[surface] - (1 - static_cast<double>(std::max(x.step, y.step)) / wall.layers));
}

Eigen::Vector3d WallLayers::lead_gradient(const Eigen::Vector3d& mm, Label a, Label b) const {
  const WallField& field = *walls_[layer(a).wall].field;
  const double step = 0.5 * field.index_to_mm.topLeftCorner<3, 3>().colwise().norm().minCoeff();
  Eigen::Vector3d gradient;
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d offset = step * Eigen::Vector3d::Unit(d);
    gradient[d] = (lead(mm + offset, a, b) - lead(mm - offset, a, b)) / (2 * step);
  }
  return gradient;
}

double WallLayers::depth_mm(const Eigen::Vector3d& mm, Label label) const {
  const Layer& own = layer(label);
  const Wall& wall = walls_[own.wall];
  const WallField::Shares shares = wall.field->shares_at(mm);
  if (shares.size() == 0) return 0;
  const double steps = static_cast<double>(own.step) / wall.layers, next = 1.0 / wall.layers;
  const double share = own.middle ? shares.maxCoeff() : shares[own.surface];
  double depth = own.step > 0 ? 1 - steps - share : std::numeric_limits<double>::infinity();
  if (own.middle) return depth * wall.field->thickness_at(mm);
  depth = std::min(depth, share - (1 - steps - next));
  for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(shares.size()); ++s)
    if (s != own.surface) depth = std::min(depth, share - shares[s]);
  return depth * wall.field->thickness_at(mm);
}

SurfaceMesh merge_layers(const SurfaceMesh& surface, const WallLayers& layers) {
  SurfaceMesh merged{surface.points, {}, {}};
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Sides sides{layers.parent(surface.sides[t][0]), layers.parent(surface.sides[t][1])};
    if (sides[0] != sides[1]) add_triangle(surface.triangles[t], sides, merged.triangles, merged.sides);
  }
  drop_unused_points(merged);
  return merged;
}

std::vector<std::uint32_t> merged_triangles(const std::vector<std::uint32_t>& triangles,
                                            const SurfaceMesh& surface, const WallLayers& layers) {
  std::vector<std::uint32_t> merged(surface.triangles.size()), out;
  std::vector<bool> stays(surface.triangles.size());
  std::uint32_t next = 0;
  for (std::size_t t = 0; t < merged.size(); ++t) {
    stays[t] = layers.parent(surface.sides[t][0]) != layers.parent(surface.sides[t][1]);
    merged[t] = next;
    next += stays[t] ? 1 : 0;
  }
  for (const std::uint32_t t : triangles)
    if (t < stays.size() && stays[t]) out.push_back(merged[t]);
  return out;
}

TetMesh merge_layers(TetMesh mesh, const WallLayers& layers) {
  for (Label& label : mesh.labels) label = layers.parent(label);
  std::vector<Triangle> faces;
  std::vector<Sides> face_sides;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Sides sides{layers.parent(mesh.face_sides[f][0]), layers.parent(mesh.face_sides[f][1])};
    if (sides[0] != sides[1]) add_triangle(mesh.faces[f], sides, faces, face_sides);
  }
  mesh.faces = std::move(faces);
  mesh.face_sides = std::move(face_sides);
  return mesh;
}

SurfaceMesh with_layers(const SurfaceMesh& surface, const SurfaceMesh& adapted, const WallLayers& layers) {
  SurfaceMesh out{surface.points, {}, {}};
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    const Eigen::Vector3d middle =
        (surface.points[triangle[0]] + surface.points[triangle[1]] + surface.points[triangle[2]]) / 3;
    const auto& [behind, front] = surface.sides[t];
    add_triangle(triangle, {layers.at(behind, middle), layers.at(front, middle)}, out.triangles, out.sides);
  }
  const auto offset = static_cast<std::uint32_t>(out.points.size());
  out.points.insert(out.points.end(), adapted.points.begin(), adapted.points.end());
  for (std::size_t t = 0; t < adapted.triangles.size(); ++t) {
    const auto& [a, b, c] = adapted.triangles[t];
    const auto& [behind, front] = adapted.sides[t];
    if (layers.parent(behind) != layers.parent(front)) continue;
    out.triangles.push_back({offset + a, offset + b, offset + c});
    out.sides.push_back(adapted.sides[t]);
  }
  drop_unused_points(out);
  return out;
}

}  // namespace voxtet
