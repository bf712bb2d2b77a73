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

/// Of each tetrahedron of the wall which entry of BeatParams::labels it is of, from 1 on; 0: of none.
std::vector<std::uint16_t> kinds_of(const Wall& wall, const std::vector<MuscleLabels>& kinds) {
  std::vector<std::uint16_t> out(wall.tets.size(), 0);
  for (std::size_t t = 0; t < out.size(); ++t)
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (std::find(kinds[k].labels.begin(), kinds[k].labels.end(), wall.mesh.labels[t]) !=
          kinds[k].labels.end())
        out[t] = static_cast<std::uint16_t>(k + 1);
  return out;
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

std::vector<Contracting> contracting(const Wall& wall, const std::vector<std::uint16_t>& kinds,
                                     const Anatomy& anatomy, const BeatParams& params) {
  const ContractionParams& contraction = params.contraction;
  std::vector<Contracting> all;
  for (std::size_t i = 0; i < wall.tets.size(); ++i) {
    const std::uint32_t t = wall.tets[i];
    const double part = kinds[i] > 0 ? params.labels[kinds[i] - 1U].contractility : 1;
    Contracting one{contraction.start_ms, 0, part, anatomy.right[t] ? 1 : 0};
    double duration = std::numeric_limits<double>::quiet_NaN();
    if (contraction.by != ActivationBy::kSynchronous) {
      one.start_ms += mean_on(anatomy.mesh.tets[t], anatomy.activation_ms);
      if (!anatomy.duration_ms.empty()) duration = mean_on(anatomy.mesh.tets[t], anatomy.duration_ms);
    }
    one.end_ms = one.start_ms + (std::isnan(duration) ? contraction.duration_ms : duration);
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
  const ActiveStressPreset preset = active_stress_preset(params.preset);
  return {params.lv.value_or(preset.lv), params.rv.value_or(preset.rv)};
}

/// What a heart works against, its states as the first beat begins, and the pressures of the atria then, to
/// which the ventricles are filled.
struct Circulation {
  std::unique_ptr<const LumpedCirculation> model;
  Eigen::VectorXd states, atria_kpa;
};

Circulation closed_loop_of(const LoopParams& params, double period_s) {
  ClosedLoopParams loop = params;
  loop.period_s = period_s;
  if (params.regurgitation > 0) loop.pulmonary = regurgitant(loop.pulmonary, params.regurgitation);
  Circulation out{std::make_unique<ClosedLoop>(loop), regazzoni_heart().states, Eigen::VectorXd(2)};
  const auto pressure = [&](const Elastance& atrium, double ml) {
    return elastance_at(atrium, 0, period_s) * (ml - atrium.unloaded_ml);
  };
  out.atria_kpa << pressure(loop.left_atrium, out.states[loop::kLeftAtrium]),
      pressure(loop.right_atrium, out.states[loop::kRightAtrium]);
  return out;
}

Circulation windkessels_of(const WindkesselParams& params, bool right, double period_s) {
  VentricleLoad pulmonary = params.pulmonary;
  if (params.regurgitation > 0) pulmonary.outlet = regurgitant(pulmonary.outlet, params.regurgitation);
  std::vector<VentricleLoad> loads{params.systemic, pulmonary};
  Eigen::VectorXd states(2), atria(2);
  states << params.systemic_start_kpa, params.pulmonary_start_kpa;
  atria << params.systemic.atrium.rest_kpa, params.pulmonary.atrium.rest_kpa;
  const Eigen::Index cavities = right ? 2 : 1;
  loads.resize(static_cast<std::size_t>(cavities));
  return {std::make_unique<VentricleLoads>(std::move(loads), period_s), states.head(cavities),
          atria.head(cavities)};
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
  for (const MuscleLabels& kind : params.labels)
    muscle.materials.push_back(scaled(params.material.chosen(), kind.stiffness));
  const std::vector<std::uint16_t> kinds = kinds_of(wall, params.labels);
  muscle.material = kinds;
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

  heart->tension_kpa = [all = contracting(wall, kinds, anatomy, params), laws = laws_of(params.contraction),
                        period_ms = params.period_ms](double time_s) {
    return tension_kpa(all, laws, period_ms, 1000 * time_s);
  };
  const double period_s = params.period_ms / 1000, fill_s = params.fill_ms / 1000;
  Circulation circulation = params.closed_loop
                                ? closed_loop_of(*params.closed_loop, period_s)
                                : windkessels_of(params.windkessel, wall.surfaces.right, period_s);
  heart->circulation = std::move(circulation.model);
  made.start.circulation = std::move(circulation.states);
  heart->given_kpa = [full = circulation.atria_kpa, fill_s](double time_s) -> Eigen::VectorXd {
    return std::clamp(1 + time_s / fill_s, 0.0, 1.0) * full;
  };
  made.start.time_s = -fill_s;
  made.heart = std::move(heart);
  made.points = wall.points;
  made.tets = wall.tets;
  return made;
}

}  // namespace voxtet::beat
