#include "physics/beat/make_heart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/cavities/cavity.h"
#include "physics/mechanics/elements/mass.h"
#include "physics/mechanics/loads/surface.h"

namespace voxtet::beat {
namespace {

constexpr double kCubicMm = 1e-9;  ///< m^3

/// The tetrahedra of the wall, with the faces that are named.
struct Wall {
  TetMesh mesh;
  HeartSurfaces surfaces;
  std::vector<std::uint32_t> points, tets;
};

Wall wall_of(const TetMesh& whole, const HeartSurfaces& surfaces) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  Wall wall;
  std::vector<std::uint32_t> number(whole.points.size(), kUnused);
  for (std::uint32_t t = 0; t < whole.tets.size(); ++t) {
    if (!surfaces.wall[t]) continue;
    wall.tets.push_back(t);
    for (const std::uint32_t point : whole.tets[t]) number[point] = 0;
  }
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] == kUnused) continue;
    number[i] = static_cast<std::uint32_t>(wall.points.size());
    wall.points.push_back(i);
    wall.mesh.points.push_back(whole.points[i]);
  }
  for (const std::uint32_t t : wall.tets) {
    const auto [a, b, c, d] = whole.tets[t];
    wall.mesh.tets.push_back({number[a], number[b], number[c], number[d]});
    wall.mesh.labels.push_back(whole.labels[t]);
  }
  for (std::size_t f = 0; f < whole.faces.size(); ++f) {
    if (surfaces.faces[f] == HeartSurface::kNone) continue;
    const auto [a, b, c] = whole.faces[f];
    wall.mesh.faces.push_back({number[a], number[b], number[c]});
    wall.mesh.face_sides.push_back(whole.face_sides[f]);
    wall.surfaces.faces.push_back(surfaces.faces[f]);
  }
  wall.surfaces.wall.assign(wall.tets.size(), true);
  wall.surfaces.apex = number[surfaces.apex];
  wall.surfaces.right = surfaces.right;
  return wall;
}

mechanics::Surface surface_of(const Wall& wall, const mechanics::Nodes& nodes, HeartSurface name) {
  std::vector<Triangle> faces;
  for (std::size_t f = 0; f < wall.mesh.faces.size(); ++f)
    if (wall.surfaces.faces[f] == name) faces.push_back(wall.mesh.faces[f]);
  return {nodes, faces};
}

/// The columns fibre, sheet, sheet normal of each sample of a tetrahedron of the wall.
std::vector<Eigen::Matrix3d> frames_of(const Wall& wall, const Anatomy& anatomy,
                                       const mechanics::Nodes& nodes) {
  const std::size_t samples = nodes.samples_per_tet();
  std::vector<Eigen::Matrix3d> frames;
  frames.reserve(wall.tets.size() * samples);
  for (const std::uint32_t t : wall.tets)
    for (std::size_t s = 0; s < samples; ++s) {
      const Fibres& fibres = anatomy.fine_fibres ? *anatomy.fine_fibres : anatomy.fibres;
      const std::size_t at = anatomy.fine_fibres ? t * samples + s : t;
      Eigen::Matrix3d frame;
      frame.col(0) = fibres.fibre[at];
      frame.col(1) = fibres.sheet[at];
      frame.col(2) = frame.col(0).cross(frame.col(1));
      frames.push_back(frame);
    }
  return frames;
}

/// The mean over the corners of a tetrahedron of the whole mesh.
double mean_on(const Tet& tet, std::span<const float> values) {
  double sum = 0;
  for (const std::uint32_t point : tet) sum += values[point] / 4.0;
  return sum;
}

/// How one tetrahedron contracts in each beat.
struct Contracting {
  double start_ms, end_ms;  ///< NaN: never
  double part;              ///< of the law's stress
  int law;                  ///< that of the left ventricle, or of the right one
};

std::vector<Contracting> contracting(const Wall& wall, const Anatomy& anatomy, const BeatParams& params) {
  const ContractionParams& contraction = params.contraction;
  std::vector<Contracting> all;
  for (const std::uint32_t t : wall.tets) {
    Contracting one{contraction.start_ms, 0, 1, anatomy.right[t] ? 1 : 0};
    double duration = std::numeric_limits<double>::quiet_NaN();
    if (contraction.by != ActivationBy::kSynchronous) {
      one.start_ms += mean_on(anatomy.mesh.tets[t], anatomy.activation_ms);
      if (!anatomy.duration_ms.empty()) duration = mean_on(anatomy.mesh.tets[t], anatomy.duration_ms);
    }
    one.end_ms = one.start_ms + (std::isnan(duration) ? contraction.duration_ms : duration);
    for (const MuscleLabels& kind : params.labels)
      if (std::find(kind.labels.begin(), kind.labels.end(), anatomy.mesh.labels[t]) != kind.labels.end())
        one.part = kind.contractility;
    all.push_back(one);
  }
  return all;
}

/// Active stress of all tetrahedra, beat after beat.
std::vector<double> tension_kpa(const std::vector<Contracting>& all,
                                const std::array<ActiveStressLaw, 2>& laws, double period_ms,
                                double time_ms) {
  std::vector<double> kpa;
  kpa.reserve(all.size());
  for (const Contracting& one : all) {
    // Of the beat that began last; nothing is left then of the stress before.
    const double beat = std::max(0.0, std::floor((time_ms - one.start_ms) / period_ms));
    kpa.push_back(one.part * active_stress_kpa(laws[static_cast<std::size_t>(one.law)], one.start_ms,
                                               one.end_ms, time_ms - beat * period_ms));
  }
  return kpa;
}

std::array<ActiveStressLaw, 2> laws_of(const ContractionParams& params) {
  constexpr const char* kNames[] = {"fast", "ambit", "elastodynamics"};
  const ActiveStressPreset preset = active_stress_preset(kNames[static_cast<int>(params.preset)]).value();
  return {params.lv.value_or(preset.lv), params.rv.value_or(preset.rv)};
}

/// The pressures to which the cavities are filled before the first beat.
Eigen::VectorXd filled_kpa(const BeatParams& params, Eigen::Index cavities) {
  Eigen::VectorXd kpa(cavities);
  const VentricleLoad* loads[] = {&params.windkessel.systemic, &params.windkessel.pulmonary};
  for (Eigen::Index c = 0; c < cavities; ++c) kpa[c] = loads[c]->atrium.rest_kpa;
  return kpa;
}

void set_circulation(const BeatParams& params, int cavities, Heart& heart, HeartMotion& start) {
  if (params.closed_loop) {
    ClosedLoopParams loop = *params.closed_loop;
    loop.period_s = params.period_ms / 1000;
    if (params.closed_loop->regurgitation > 0)
      loop.pulmonary = regurgitant(loop.pulmonary, params.closed_loop->regurgitation);
    heart.circulation = std::make_unique<ClosedLoop>(loop);
    start.circulation = regazzoni_heart().states;
    return;
  }
  VentricleLoad pulmonary = params.windkessel.pulmonary;
  if (params.windkessel.regurgitation > 0)
    pulmonary.outlet = regurgitant(pulmonary.outlet, params.windkessel.regurgitation);
  std::vector<VentricleLoad> loads{params.windkessel.systemic, pulmonary};
  loads.resize(static_cast<std::size_t>(cavities));
  start.circulation = Eigen::VectorXd(cavities);
  const double kpa[] = {params.windkessel.systemic_start_kpa, params.windkessel.pulmonary_start_kpa};
  for (int c = 0; c < cavities; ++c) start.circulation[c] = kpa[c];
  heart.circulation = std::make_unique<VentricleLoads>(std::move(loads), params.period_ms / 1000);
}

}  // namespace

Result<MadeHeart> make_heart(const Anatomy& anatomy, const BeatParams& params) {
  if (Status checked = check_beat_params(params); !checked) return checked.error();
  if (params.closed_loop && !anatomy.surfaces.right)
    return usage_error(kMechanicsStage,
                       "physics.mechanics.closed_loop: found a heart without a right ventricle, expected two "
                       "ventricles in a closed loop");
  const Wall wall = wall_of(anatomy.mesh, anatomy.surfaces);

  mechanics::Muscle muscle;
  muscle.bulk_kpa = params.bulk_kpa;
  muscle.viscosity_kpa_s = params.viscosity_kpa_s;
  muscle.materials = {params.material.chosen()};
  muscle.material.assign(wall.tets.size(), 0);
  for (const MuscleLabels& kind : params.labels) {
    for (std::size_t t = 0; t < wall.tets.size(); ++t)
      if (std::find(kind.labels.begin(), kind.labels.end(), wall.mesh.labels[t]) != kind.labels.end())
        muscle.material[t] = static_cast<std::uint16_t>(muscle.materials.size());
    muscle.materials.push_back(scaled(params.material.chosen(), kind.stiffness));
  }
  const mechanics::Nodes nodes(wall.mesh, params.element, anatomy.fine_fibres != nullptr);
  muscle.frames = frames_of(wall, anatomy, nodes);
  Result<mechanics::Body> body = mechanics::Body::make(wall.mesh, params.element, std::move(muscle));
  if (!body) return body.error();

  MadeHeart made;
  auto heart = std::make_shared<Heart>(Heart{std::move(body).value(), {}, {}, {}, {}, {}, {}, {}});
  heart->mass = heart->springs = heart->dampers = heart->body.empty_tangent();
  mechanics::add_mass(nodes, params.density_kg_per_m3 * kCubicMm, heart->mass);
  const SupportParams& support = params.support;
  const auto epicardium = surface_of(wall, nodes, HeartSurface::kEpicardium),
             base = surface_of(wall, nodes, HeartSurface::kBase);
  epicardium.add_springs(nodes, support.epicardium_kpa_per_mm, 0, heart->springs);
  base.add_springs(nodes, support.base_kpa_per_mm, support.base_kpa_per_mm, heart->springs);
  epicardium.add_springs(nodes, support.damping_kpa_s_per_mm, 0, heart->dampers);
  base.add_springs(nodes, support.damping_kpa_s_per_mm, support.damping_kpa_s_per_mm, heart->dampers);

  std::vector<Ventricle> ventricles{Ventricle::kLeft};
  if (wall.surfaces.right) ventricles.push_back(Ventricle::kRight);
  for (const Ventricle ventricle : ventricles) {
    const Result<Cavity> cavity = ventricle_cavity(wall.mesh, wall.surfaces, ventricle);
    if (!cavity) return cavity.error();
    heart->cavities.emplace_back(nodes, *cavity);
  }

  heart->tension_kpa = [all = contracting(wall, anatomy, params), laws = laws_of(params.contraction),
                        period_ms = params.period_ms](double time_s) {
    return tension_kpa(all, laws, period_ms, 1000 * time_s);
  };
  const double fill_s = params.fill_ms / 1000;
  heart->given_kpa = [full = filled_kpa(params, static_cast<Eigen::Index>(ventricles.size())),
                      fill_s](double time_s) -> Eigen::VectorXd {
    return std::clamp(1 + time_s / fill_s, 0.0, 1.0) * full;
  };
  set_circulation(params, static_cast<int>(ventricles.size()), *heart, made.start);
  made.start.time_s = -fill_s;
  made.heart = std::move(heart);
  made.points = wall.points;
  made.tets = wall.tets;
  return made;
}

}  // namespace voxtet::beat
