#include "physics/mechanics/elements/nodal_volumes.h"

#include <array>
#include <cstddef>
#include <utility>

#include "physics/mechanics/elements/element_forces.h"

namespace voxtet::mechanics {

NodalVolumes::NodalVolumes(const Nodes& nodes, NodeGraph around) : around_(std::move(around)) {
  for (std::size_t t = 0; t < nodes.tets(); ++t) around_.append_places({nodes.of_tet(t), 4}, places_);
  undeformed_ = volumes(nodes, Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(nodes.places().size())));
}

NodeGraph NodalVolumes::coupled() const {
  std::vector<NodeGroup> groups;
  for (std::size_t i = 0; i < around_.nodes(); ++i) groups.push_back(around_.of(i));
  return NodeGraph(around_.nodes(), groups);
}

void NodalVolumes::find_blocks(const NodeGraph& coupled) {
  for (std::size_t i = 0; i < around_.nodes(); ++i) coupled.append_places(around_.of(i), blocks_);
}

std::vector<double> NodalVolumes::volumes(const Nodes& nodes, const Eigen::VectorXd& u) const {
  std::vector<double> volumes(nodes.places().size(), 0.0);
  std::array<Shape, 4> shapes;
  for (std::size_t t = 0; t < nodes.tets(); ++t) {
    nodes.shapes_at(t, 0, shapes.data());
    const double now = nodes.volume_mm3(t) * nodes.deformation(u, t, shapes.data()).determinant();
    for (std::size_t a = 0; a < 4; ++a) volumes[nodes.of_tet(t)[a]] += now / 4;
  }
  return volumes;
}

std::vector<Volumetric> NodalVolumes::at_nodes(const Nodes& nodes, const Eigen::VectorXd& u,
                                               double bulk_kpa) const {
  const std::vector<double> now = volumes(nodes, u);
  std::vector<Volumetric> out;
  for (std::size_t i = 0; i < now.size(); ++i) out.push_back(volumetric(bulk_kpa, now[i] / undeformed_[i]));
  return out;
}

double NodalVolumes::energy(const std::vector<Volumetric>& at_nodes) const {
  double sum = 0;
  for (std::size_t i = 0; i < at_nodes.size(); ++i) sum += undeformed_[i] * at_nodes[i].energy_kpa;
  return sum;
}

void NodalVolumes::add_tangent(const Nodes& nodes, const Eigen::VectorXd& u,
                               const std::vector<Volumetric>& at_nodes, fem::SparseMatrix& tangent) const {
  // The gradients of each node's volume by the places of the nodes around it.
  std::vector<Eigen::Vector3d> gradient(around_.couplings(), Eigen::Vector3d::Zero());
  std::array<Shape, 4> shapes;
  for (std::size_t t = 0; t < nodes.tets(); ++t) {
    nodes.shapes_at(t, 0, shapes.data());
    const Eigen::Matrix3d area = nodes.volume_mm3(t) / 4 * cofactor(nodes.deformation(u, t, shapes.data()));
    for (std::size_t b = 0; b < 4; ++b) {
      const Eigen::Vector3d change = area * shapes[b].gradient;
      for (std::size_t a = 0; a < 4; ++a)
        gradient[around_.begin(nodes.of_tet(t)[a]) + places_[16 * t + 4 * a + b]] += change;
    }
  }
  const std::uint32_t* block = blocks_.data();
  for (std::size_t i = 0; i < at_nodes.size(); ++i) {
    const NodeGroup around = around_.of(i);
    const Eigen::Vector3d* const of = gradient.data() + around_.begin(i);
    const double modulus = at_nodes[i].modulus_kpa / undeformed_[i];
    for (std::size_t a = 0; a < around.size(); ++a) {
      const Eigen::Vector3d stiff = modulus * of[a];
      for (std::size_t b = 0; b < around.size(); ++b)
        add_block_at(around[a], *block++, stiff * of[b].transpose(), tangent);
    }
  }
}

}  // namespace voxtet::mechanics
