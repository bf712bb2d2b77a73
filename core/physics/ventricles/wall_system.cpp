#include "physics/ventricles/wall_system.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "physics/fem/assemble.h"
#include "physics/fem/element.h"
#include "physics/fem/solve_held.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

constexpr double kFree = std::numeric_limits<double>::quiet_NaN();

Error surfaces_error(const std::string& field, const std::string& found, const std::string& expected) {
  return usage_error(kFibresStage, "heart_surfaces." + field + ": found " + found + ", expected " + expected);
}

std::optional<Error> check_sizes(const TetMesh& mesh, const HeartSurfaces& surfaces) {
  if (surfaces.faces.size() != mesh.faces.size())
    return surfaces_error("faces", std::to_string(surfaces.faces.size()) + " faces",
                          std::to_string(mesh.faces.size()) + ", those of the mesh");
  if (surfaces.wall.size() != mesh.tets.size())
    return surfaces_error("wall", std::to_string(surfaces.wall.size()) + " tetrahedra",
                          std::to_string(mesh.tets.size()) + ", those of the mesh");
  if (std::find(surfaces.wall.begin(), surfaces.wall.end(), true) == surfaces.wall.end())
    return surfaces_error("wall", "no tetrahedron of the wall", "at least one");
  return std::nullopt;
}

/// Whether a face of this kind has a point in the wall.
bool is_there(const WallSystem& system, HeartSurface surface) {
  for (std::size_t f = 0; f < system.mesh.faces.size(); ++f)
    if (system.surfaces.faces[f] == surface)
      for (const std::uint32_t point : system.mesh.faces[f])
        if (!system.outside[point]) return true;
  return false;
}

std::optional<Error> check_surfaces(const WallSystem& system) {
  struct Needed {
    HeartSurface surface;
    const char* name;
    bool of_right;
  };
  constexpr std::array<Needed, 5> kNeeded{{{HeartSurface::kBase, "base", false},
                                           {HeartSurface::kEpicardium, "epicardium", false},
                                           {HeartSurface::kLvEndocardium, "lv_endocardium", false},
                                           {HeartSurface::kRvEndocardium, "rv_endocardium", true},
                                           {HeartSurface::kRvSeptum, "rv_septum", true}}};
  for (const auto& [surface, name, of_right] : kNeeded)
    if ((!of_right || system.surfaces.right) && !is_there(system, surface))
      return surfaces_error(name, "no face at the wall", "at least one");
  const std::uint32_t apex = system.surfaces.apex;
  if (apex >= system.outside.size() || system.outside[apex])
    return surfaces_error("apex", "point " + std::to_string(apex), "a point of the wall");
  for (std::size_t f = 0; f < system.mesh.faces.size(); ++f)
    if (system.surfaces.faces[f] == HeartSurface::kBase)
      for (const std::uint32_t point : system.mesh.faces[f])
        if (point == apex)
          return surfaces_error("apex", "point " + std::to_string(apex) + " of the base", "one far from it");
  return std::nullopt;
}

}  // namespace

Result<WallSystem> wall_system(const TetMesh& mesh, const HeartSurfaces& surfaces) {
  if (auto error = check_sizes(mesh, surfaces)) return *std::move(error);
  WallSystem system{mesh, surfaces, {}, std::vector<bool>(mesh.points.size(), true)};
  std::vector<double> coefficient(mesh.tets.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!surfaces.wall[t]) continue;
    coefficient[t] = 1;
    for (const std::uint32_t point : mesh.tets[t]) system.outside[point] = false;
  }
  if (auto error = check_surfaces(system)) return *std::move(error);
  auto stiffness = fem::assemble_stiffness(mesh, coefficient);
  if (!stiffness) return stiffness.error();
  system.stiffness = *std::move(stiffness);
  return system;
}

PointValues values_on(const WallSystem& system,
                      std::initializer_list<std::pair<HeartSurface, double>> values) {
  const TetMesh& mesh = system.mesh;
  PointValues held = PointValues::Constant(static_cast<Eigen::Index>(mesh.points.size()), kFree);
  for (const auto& [surface, value] : values)
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      if (system.surfaces.faces[f] == surface)
        for (const std::uint32_t point : mesh.faces[f])
          if (!system.outside[point]) held[point] = value;
  return held;
}

Result<Eigen::VectorXd> solve_on_wall(const WallSystem& system, const PointValues& held,
                                      const Eigen::VectorXd& load, const RunContext& ctx) {
  std::vector<bool> fixed = system.outside;
  Eigen::VectorXd start = Eigen::VectorXd::Zero(held.size());
  for (Eigen::Index i = 0; i < held.size(); ++i) {
    if (std::isnan(held[i])) continue;
    fixed[static_cast<std::size_t>(i)] = true;
    start[i] = held[i];
  }
  auto solved = fem::solve_held(system.stiffness, load, fixed, start, kFibresStage, ctx);
  if (!solved) return solved;
  for (Eigen::Index i = 0; i < solved->size(); ++i)
    if (system.outside[static_cast<std::size_t>(i)]) (*solved)[i] = kFree;
  return solved;
}

Eigen::Vector3d gradient_on(const TetMesh& mesh, const Eigen::VectorXd& u, std::size_t tet) {
  const fem::Element element = fem::element_of(mesh, tet);
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) gradient += u[mesh.tets[tet][i]] * element.gradient[i];
  return gradient;
}

double mean_on(const TetMesh& mesh, const Eigen::VectorXd& u, std::size_t tet) {
  double sum = 0;
  for (const std::uint32_t point : mesh.tets[tet]) sum += u[point];
  return sum / 4;
}

}  // namespace voxtet
