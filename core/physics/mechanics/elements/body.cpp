#include "physics/mechanics/elements/body.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "physics/mechanics/elements/node_matrix.h"

namespace voxtet::mechanics {
namespace {

using Shapes = std::array<Shape, 10>;

Error wrong_count(const std::string& list, std::size_t found, std::size_t expected) {
  return {ErrorCode::kInternal,
          kMechanicsStage,
          list + ": found " + std::to_string(found) + " entries, expected " + std::to_string(expected),
          {}};
}

/// det F times the inverse transpose of F: how an area vector is deformed.
Eigen::Matrix3d cofactor(const Eigen::Matrix3d& f) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; ++i) out.col(i) = f.col((i + 1) % 3).cross(f.col((i + 2) % 3));
  return out;
}

/// dE / du of one node, by the numbers of Tensor6 with shears doubled.
Eigen::Matrix<double, 6, 3> strain_of(const Eigen::Matrix3d& f, const Eigen::Vector3d& g) {
  Eigen::Matrix<double, 6, 3> b;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) b(k, i) = f(i, k) * g[k];
    b(3, i) = f(i, 0) * g[1] + f(i, 1) * g[0];
    b(4, i) = f(i, 1) * g[2] + f(i, 2) * g[1];
    b(5, i) = f(i, 0) * g[2] + f(i, 2) * g[0];
  }
  return b;
}

}  // namespace

struct Body::Sample {
  std::size_t tet, index;  ///< index: among all samples
  double weight;           ///< mm^3
  Eigen::Matrix3d f;
  double j;
  Shapes shapes;
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
    return wrong_count("material", muscle.material.size(), tets);
  for (const std::uint16_t m : muscle.material)
    if (m >= muscle.materials.size()) return wrong_count("materials", muscle.materials.size(), m + 1U);
  for (std::size_t t = 0; t < tets; ++t)
    if (!(fem::element_of(mesh, t).volume > 0))
      return Error{ErrorCode::kBadInput,
                   kMechanicsStage,
                   "tetrahedron " + std::to_string(t) + ": found no positive volume",
                   {{mesh.points[mesh.tets[t][0]]}, {}}};
  Body body;
  body.nodes_ = Nodes(mesh, formulation);
  const std::size_t samples = tets * body.nodes_.samples_per_tet();
  if (!muscle.frames.empty() && muscle.frames.size() != samples)
    return wrong_count("frames", muscle.frames.size(), samples);
  if (muscle.frames.empty()) muscle.frames.assign(samples, Eigen::Matrix3d::Identity());
  body.muscle_ = std::move(muscle);
  body.tets_of_ = fem::tets_of_points(mesh);
  if (formulation == Formulation::kAverageNodalPressure)
    body.node_volumes_ = body.node_volumes(Eigen::VectorXd::Zero(body.unknowns()));
  return body;
}

fem::SparseMatrix Body::empty_tangent() const {
  const std::size_t count = nodes_.places().size();
  std::vector<std::vector<std::uint32_t>> near(count), coupled;
  const auto sort_all = [](std::vector<std::vector<std::uint32_t>>& lists) {
    for (auto& list : lists) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  };
  for (std::size_t t = 0; t < nodes_.tets(); ++t)
    for (std::size_t a = 0; a < nodes_.per_tet(); ++a)
      near[nodes_.of_tet(t)[a]].insert(near[nodes_.of_tet(t)[a]].end(), nodes_.of_tet(t),
                                       nodes_.of_tet(t) + nodes_.per_tet());
  sort_all(near);
  if (node_volumes_.empty()) return empty_node_matrix(near);
  coupled.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    for (const std::uint32_t via : near[i])
      coupled[i].insert(coupled[i].end(), near[via].begin(), near[via].end());
  sort_all(coupled);
  return empty_node_matrix(coupled);
}

Eigen::Matrix3d Body::deformation(const Eigen::VectorXd& u, std::size_t t, const Shape* shapes) const {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  for (std::size_t a = 0; a < nodes_.per_tet(); ++a)
    f += u.segment<3>(3 * static_cast<Eigen::Index>(nodes_.of_tet(t)[a])) * shapes[a].gradient.transpose();
  return f;
}

template <class Visit>
Status Body::for_samples(const Eigen::VectorXd& u, Visit&& visit) const {
  const std::size_t per_tet = nodes_.samples_per_tet();
  Sample sample{};
  for (std::size_t t = 0; t < nodes_.tets(); ++t)
    for (std::size_t s = 0; s < per_tet; ++s) {
      sample.tet = t;
      sample.index = t * per_tet + s;
      sample.weight = nodes_.volume_mm3(t) / static_cast<double>(per_tet);
      nodes_.shapes_at(t, s, sample.shapes.data());
      sample.f = deformation(u, t, sample.shapes.data());
      sample.j = sample.f.determinant();
      if (!(sample.j > 0))
        return Error{ErrorCode::kMeshing,
                     kMechanicsStage,
                     "tetrahedron " + std::to_string(t) + " is inverted: found a volume of " +
                         std::to_string(sample.j) + " times that at rest, expected more than 0",
                     {{nodes_.sample_place(t, s)}, {}}};
      visit(sample);
    }
  return std::monostate{};
}

std::vector<double> Body::node_volumes(const Eigen::VectorXd& u) const {
  std::vector<double> volumes(nodes_.places().size(), 0.0);
  Shapes shapes;
  for (std::size_t t = 0; t < nodes_.tets(); ++t) {
    nodes_.shapes_at(t, 0, shapes.data());
    const double now = nodes_.volume_mm3(t) * deformation(u, t, shapes.data()).determinant();
    for (std::size_t a = 0; a < 4; ++a) volumes[nodes_.of_tet(t)[a]] += now / 4;
  }
  return volumes;
}

Volumetric Body::at_node(const std::vector<double>& volumes_now, std::size_t node) const {
  return volumetric(muscle_.bulk_kpa, volumes_now[node] / node_volumes_[node]);
}

Status Body::add_forces(const Eigen::VectorXd& u, std::span<const double> tension_kpa, Eigen::VectorXd& force,
                        fem::SparseMatrix* tangent, const StrainRate* rate) const {
  if (!tension_kpa.empty() && tension_kpa.size() != nodes_.tets())
    return wrong_count("tension_kpa", tension_kpa.size(), nodes_.tets());
  if (rate && rate->before.size() != unknowns())
    return wrong_count("before", static_cast<std::size_t>(rate->before.size()),
                       static_cast<std::size_t>(unknowns()));
  const bool nodal = !node_volumes_.empty();
  const std::vector<double> volumes_now = nodal ? node_volumes(u) : std::vector<double>();
  Status done = for_samples(u, [&](const Sample& sample) {
    const Eigen::Matrix3d c = sample.f.transpose() * sample.f;
    const Eigen::Matrix3d& frame = muscle_.frames[sample.index];
    const std::size_t material = muscle_.material.empty() ? 0 : muscle_.material[sample.tet];
    Response response = response_of(muscle_.materials[material], c, frame);
    if (!tension_kpa.empty()) add_active_stress(tension_kpa[sample.tet], frame.col(0), response);
    if (rate) {
      const Eigen::Matrix3d before = deformation(rate->before, sample.tet, sample.shapes.data());
      add_viscous_stress(muscle_.viscosity_kpa_s / rate->step_s, (c - before.transpose() * before) / 2,
                         response);
    }
    if (nodal) {
      double pressure = 0;
      for (std::size_t a = 0; a < 4; ++a)
        pressure += at_node(volumes_now, nodes_.of_tet(sample.tet)[a]).pressure_kpa / 4;
      add_pressure(pressure, 0, c, sample.j, response);
    } else {
      const Volumetric now = volumetric(muscle_.bulk_kpa, sample.j);
      add_pressure(now.pressure_kpa, now.modulus_kpa, c, sample.j, response);
    }
    add_sample(sample, response, force, tangent);
  });
  if (done && nodal && tangent) add_node_pressures(u, volumes_now, *tangent);
  return done;
}

void Body::add_sample(const Sample& sample, const Response& response, Eigen::VectorXd& force,
                      fem::SparseMatrix* tangent) const {
  const std::uint32_t* const node = nodes_.of_tet(sample.tet);
  const std::size_t count = nodes_.per_tet();
  std::array<Eigen::Matrix<double, 6, 3>, 10> strain;
  for (std::size_t a = 0; a < count; ++a) {
    strain[a] = strain_of(sample.f, sample.shapes[a].gradient);
    force.segment<3>(3 * static_cast<Eigen::Index>(node[a])) +=
        sample.weight * (strain[a].transpose() * response.stress);
  }
  if (!tangent) return;
  const Eigen::Matrix3d stress = matrix_of(response.stress);
  for (std::size_t a = 0; a < count; ++a) {
    const Eigen::Matrix<double, 3, 6> stiff = sample.weight * (strain[a].transpose() * response.tangent);
    const Eigen::Vector3d pull = sample.weight * (stress * sample.shapes[a].gradient);
    for (std::size_t b = 0; b < count; ++b) {
      Eigen::Matrix3d block = stiff * strain[b];
      block.diagonal().array() += pull.dot(sample.shapes[b].gradient);
      add_block(node[a], node[b], block, *tangent);
    }
  }
}

void Body::add_node_pressures(const Eigen::VectorXd& u, const std::vector<double>& volumes_now,
                              fem::SparseMatrix& tangent) const {
  // The gradient of a node's volume by the places of the nodes around it.
  std::vector<std::uint32_t> around;
  std::vector<Eigen::Vector3d> gradient;
  Shapes shapes;
  for (std::size_t i = 0; i < volumes_now.size(); ++i) {
    around.clear();
    for (std::size_t at = tets_of_.begin[i]; at < tets_of_.begin[i + 1]; ++at)
      around.insert(around.end(), nodes_.of_tet(tets_of_.tets[at]), nodes_.of_tet(tets_of_.tets[at]) + 4);
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    gradient.assign(around.size(), Eigen::Vector3d::Zero());
    for (std::size_t at = tets_of_.begin[i]; at < tets_of_.begin[i + 1]; ++at) {
      const std::size_t t = tets_of_.tets[at];
      nodes_.shapes_at(t, 0, shapes.data());
      const Eigen::Matrix3d area = nodes_.volume_mm3(t) / 4 * cofactor(deformation(u, t, shapes.data()));
      for (std::size_t a = 0; a < 4; ++a) {
        const auto found = std::lower_bound(around.begin(), around.end(), nodes_.of_tet(t)[a]);
        gradient[static_cast<std::size_t>(found - around.begin())] += area * shapes[a].gradient;
      }
    }
    const double modulus = at_node(volumes_now, i).modulus_kpa / node_volumes_[i];
    for (std::size_t a = 0; a < around.size(); ++a)
      for (std::size_t b = 0; b < around.size(); ++b)
        add_block(around[a], around[b], modulus * gradient[a] * gradient[b].transpose(), tangent);
  }
}

Result<double> Body::energy(const Eigen::VectorXd& u) const {
  const bool nodal = !node_volumes_.empty();
  double sum = 0;
  const Status done = for_samples(u, [&](const Sample& sample) {
    const std::size_t material = muscle_.material.empty() ? 0 : muscle_.material[sample.tet];
    const Response response = response_of(muscle_.materials[material], sample.f.transpose() * sample.f,
                                          muscle_.frames[sample.index]);
    sum += sample.weight * response.energy_kpa;
    if (!nodal) sum += sample.weight * volumetric(muscle_.bulk_kpa, sample.j).energy_kpa;
  });
  if (!done) return done.error();
  if (!nodal) return sum;
  const std::vector<double> volumes_now = node_volumes(u);
  for (std::size_t i = 0; i < volumes_now.size(); ++i)
    sum += node_volumes_[i] * at_node(volumes_now, i).energy_kpa;
  return sum;
}

}  // namespace voxtet::mechanics
