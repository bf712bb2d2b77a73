#include "physics/mechanics/elements/body.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "physics/mechanics/elements/element_forces.h"

namespace voxtet::mechanics {
struct Body::Sample {
  std::size_t tet, index;  ///< index: among all samples
  double weight;           ///< mm^3
  Eigen::Matrix3d f;
  double j;
  std::array<Shape, 10> shapes;
};

Result<Body> Body::make(const TetMesh& mesh, Formulation formulation, Muscle muscle) {
  if (!(std::isfinite(muscle.bulk_kpa) && muscle.bulk_kpa > 0))
    return usage_error(kMechanicsStage, "bulk_kpa: found " + std::to_string(muscle.bulk_kpa) +
                                            ", expected a finite number above 0");
  if (!(std::isfinite(muscle.viscosity_kpa_s) && muscle.viscosity_kpa_s >= 0))
    return usage_error(kMechanicsStage, "viscosity_kpa_s: found " + std::to_string(muscle.viscosity_kpa_s) +
                                            ", expected a finite number not below 0");
  for (const Material& material : muscle.materials)
    if (const auto fault = fault_of(material)) return usage_error(kMechanicsStage, *fault);
  const std::size_t tets = mesh.tets.size();
  if (!muscle.material.empty() && muscle.material.size() != tets)
    return wrong_length("material", muscle.material.size(), tets);
  for (const std::uint16_t m : muscle.material)
    if (m >= muscle.materials.size()) return wrong_length("materials", muscle.materials.size(), m + 1U);
  for (std::size_t t = 0; t < tets; ++t)
    if (!(fem::element_of(mesh, t).volume > 0))
      return Error{ErrorCode::kBadInput,
                   kMechanicsStage,
                   "tetrahedron " + std::to_string(t) + ": found no positive volume",
                   {{mesh.points[mesh.tets[t][0]]}, {}}};
  Body body;
  body.nodes_ = Nodes(mesh, formulation, muscle.frames.size() == 4 * tets);
  const std::size_t samples = tets * body.nodes_.samples_per_tet();
  if (!muscle.frames.empty() && muscle.frames.size() != samples)
    return wrong_length("frames", muscle.frames.size(), samples);
  if (muscle.frames.empty()) muscle.frames.assign(samples, Eigen::Matrix3d::Identity());
  body.formulation_ = formulation;
  body.muscle_ = std::move(muscle);
  for (const Material& material : body.muscle_.materials) {
    body.shear_kpa_.push_back(mean_shear_modulus_kpa(material));
    if (body.stabilised() && !(body.shear_kpa_.back() > 0))
      return usage_error(kMechanicsStage,
                         "materials: found no resistance to shear, which stabilised pressures need");
  }
  std::vector<NodeGroup> groups;
  for (std::size_t t = 0; t < tets; ++t) groups.emplace_back(body.nodes_.of_tet(t), body.nodes_.per_tet());
  body.graph_ = NodeGraph(body.nodes_.places().size(), groups);
  for (const NodeGroup& group : groups) body.graph_.append_places(group, body.places_);
  return body;
}

template <class Visit>
Status Body::for_tets(const Eigen::VectorXd& u, Visit&& visit) const {
  std::array<Sample, 4> samples;
  const std::span<Sample> used(samples.data(), nodes_.samples_per_tet());
  for (std::size_t t = 0; t < nodes_.tets(); ++t) {
    for (std::size_t s = 0; s < used.size(); ++s) {
      Sample& sample = used[s];
      sample.tet = t;
      sample.index = t * used.size() + s;
      sample.weight = nodes_.volume_mm3(t) / static_cast<double>(used.size());
      nodes_.shapes_at(t, s, sample.shapes.data());
      sample.f = nodes_.deformation(u, t, sample.shapes.data());
      sample.j = sample.f.determinant();
      if (!(sample.j > 0))
        return Error{ErrorCode::kMeshing,
                     kMechanicsStage,
                     "tetrahedron " + std::to_string(t) + " is inverted: found a volume of " +
                         std::to_string(sample.j) + " times that at rest, expected more than 0",
                     {{nodes_.sample_place(t, s)}, {}}};
    }
    visit(used);
  }
  return std::monostate{};
}

Response Body::response_at(const Sample& sample) const {
  return response_of(muscle_.materials[material_of(sample.tet)], sample.f.transpose() * sample.f,
                     muscle_.frames[sample.index]);
}

LinearPressure Body::pressure_of(std::size_t t, const Eigen::VectorXd& u) const {
  LinearPressure::Corners kpa{};
  for (std::size_t a = 0; a < 4; ++a) kpa[a] = u[displacements() + nodes_.of_tet(t)[a]];
  const double volume = nodes_.volume_mm3(t);
  return stabilised() ? LinearPressure::stabilised(volume, muscle_.bulk_kpa, shear_kpa_[material_of(t)], kpa)
                      : LinearPressure::averaged(volume, muscle_.bulk_kpa, kpa);
}

void Body::add_pressures(const Sample& sample, const LinearPressure& pressure, Eigen::VectorXd& force,
                         fem::SparseMatrix* tangent) const {
  const std::uint32_t* const node = nodes_.of_tet(sample.tet);
  const std::uint32_t* const place = places_.data() + 16 * sample.tet;
  for (std::size_t a = 0; a < 4; ++a) force[displacements() + node[a]] += pressure.force(a, sample.j);
  if (!tangent) return;
  const Eigen::Matrix3d area = nodes_.volume_mm3(sample.tet) / 4 * cofactor(sample.f);
  for (std::size_t a = 0; a < 4; ++a) {
    const Eigen::Vector3d gradient = area * sample.shapes[a].gradient;
    for (std::size_t b = 0; b < 4; ++b) {
      add_gradient_at(node[a], place[4 * a + b], node[b], place[4 * b + a], gradient, *tangent);
      add_pressure_at(node[a], place[4 * a + b], pressure.tangent(a, b), *tangent);
    }
  }
}

Status Body::add_forces(const Eigen::VectorXd& u, std::span<const double> tension_kpa, Eigen::VectorXd& force,
                        fem::SparseMatrix* tangent, const StrainRate* rate) const {
  if (!tension_kpa.empty() && tension_kpa.size() != nodes_.tets())
    return wrong_length("tension_kpa", tension_kpa.size(), nodes_.tets());
  if (rate && rate->before.size() != unknowns())
    return wrong_length("before", rate->before.size(), unknowns());
  return for_tets(u, [&](std::span<const Sample> samples) {
    const std::size_t t = samples.front().tet, count = nodes_.per_tet();
    const std::uint32_t* const node = nodes_.of_tet(t);
    ElementForces element(count, tangent != nullptr);
    for (const Sample& sample : samples) {
      const Eigen::Matrix3d c = sample.f.transpose() * sample.f;
      Response response = response_at(sample);
      if (!tension_kpa.empty())
        add_active_stress(tension_kpa[t], muscle_.frames[sample.index].col(0), response);
      if (rate) {
        const Eigen::Matrix3d before = nodes_.deformation(rate->before, t, sample.shapes.data());
        add_viscous_stress(muscle_.viscosity_kpa_s / rate->step_s, (c - before.transpose() * before) / 2,
                           response);
      }
      if (has_pressures()) {
        const LinearPressure pressure = pressure_of(t, u);
        add_pressure(pressure.mean_kpa(), 0, c, sample.j, response);
        if (&sample == &samples.front()) add_pressures(sample, pressure, force, tangent);
      } else {
        const Volumetric now = volumetric(muscle_.bulk_kpa, sample.j);
        add_pressure(now.pressure_kpa, now.modulus_kpa, c, sample.j, response);
      }
      element.add(sample.weight, sample.f, response, sample.shapes.data());
    }
    for (std::size_t a = 0; a < count; ++a)
      force.segment<3>(3 * static_cast<Eigen::Index>(node[a])) += element.force(a);
    if (!tangent) return;
    const std::uint32_t* const place = places_.data() + t * count * count;
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a; b < count; ++b) {
        add_block_at(node[a], place[count * a + b], element.tangent(a, b), *tangent);
        if (b > a) add_block_at(node[b], place[count * b + a], element.tangent(a, b).transpose(), *tangent);
      }
  });
}

Result<double> Body::energy(const Eigen::VectorXd& u) const {
  double sum = 0;
  const Status done = for_tets(u, [&](std::span<const Sample> samples) {
    for (const Sample& sample : samples) {
      sum += sample.weight * response_at(sample).energy_kpa;
      if (!has_pressures()) sum += sample.weight * volumetric(muscle_.bulk_kpa, sample.j).energy_kpa;
    }
    if (has_pressures()) sum += pressure_of(samples[0].tet, u).energy(samples[0].j);
  });
  if (!done) return done.error();
  return sum;
}

}  // namespace voxtet::mechanics
