#include "physics/mechanics/loads/surface.h"

#include <Eigen/Geometry>

#include "physics/mechanics/elements/node_matrix.h"

namespace voxtet::mechanics {
namespace {

/// A node's function at one place of a triangle, and its derivatives along the first two sides' directions.
struct FaceShape {
  double value, along_1, along_2;
};
struct FacePoint {
  double weight;
  std::array<FaceShape, 6> shape;
};

/// Corner shares b, of which b0 = 1 - b1 - b2.
FacePoint face_point(std::size_t nodes, double weight, double b1, double b2) {
  const std::array<double, 3> b{1 - b1 - b2, b1, b2};
  constexpr std::array<double, 3> kD1{-1, 1, 0}, kD2{-1, 0, 1};
  FacePoint point{weight, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    if (nodes == 3) {
      point.shape[i] = {b[i], kD1[i], kD2[i]};
      continue;
    }
    const std::size_t j = (i + 1) % 3;
    point.shape[i] = {b[i] * (2 * b[i] - 1), (4 * b[i] - 1) * kD1[i], (4 * b[i] - 1) * kD2[i]};
    point.shape[3 + i] = {4 * b[i] * b[j], 4 * (b[i] * kD1[j] + b[j] * kD1[i]),
                          4 * (b[i] * kD2[j] + b[j] * kD2[i])};
  }
  return point;
}

/// Six places, exact for polynomials of degree 4: Dunavant, International Journal for Numerical Methods in
/// Engineering 21 (1985).
std::array<FacePoint, 6> face_points(std::size_t nodes) {
  constexpr double kA = 0.445948490915965, kB = 0.091576213509771;
  constexpr double kWeightA = 0.223381589678011 / 2, kWeightB = 0.109951743655322 / 2;
  return {face_point(nodes, kWeightA, kA, kA),         face_point(nodes, kWeightA, 1 - 2 * kA, kA),
          face_point(nodes, kWeightA, kA, 1 - 2 * kA), face_point(nodes, kWeightB, kB, kB),
          face_point(nodes, kWeightB, 1 - 2 * kB, kB), face_point(nodes, kWeightB, kB, 1 - 2 * kB)};
}

struct Place {
  Eigen::Vector3d x, side_1, side_2;
};

Place place_of(const Eigen::VectorXd& x, const std::uint32_t* face, std::size_t count,
               const FacePoint& point) {
  Place place{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::size_t i = 0; i < count; ++i) {
    const auto node = x.segment<3>(3 * static_cast<Eigen::Index>(face[i]));
    place.x += point.shape[i].value * node;
    place.side_1 += point.shape[i].along_1 * node;
    place.side_2 += point.shape[i].along_2 * node;
  }
  return place;
}

/// The matrix of a: times b it is a x b.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

}  // namespace

Surface::Surface(const Nodes& nodes, std::span<const Triangle> faces) : per_face_(nodes.quadratic() ? 6 : 3) {
  for (const auto& [a, b, c] : faces) {
    faces_.push_back({a, b, c, 0, 0, 0});
    if (nodes.quadratic())
      faces_.back() = {a, b, c, nodes.middle(a, b), nodes.middle(b, c), nodes.middle(c, a)};
  }
}

double Surface::volume_mm3(const Eigen::VectorXd& x) const {
  const auto points = face_points(per_face_);
  double volume = 0;
  for (const auto& face : faces_)
    for (const FacePoint& point : points) {
      const Place at = place_of(x, face.data(), per_face_, point);
      volume += point.weight * at.x.dot(at.side_1.cross(at.side_2)) / 3;
    }
  return volume;
}

void Surface::add_area_vectors(const Eigen::VectorXd& x, double factor, Eigen::VectorXd& force) const {
  const auto points = face_points(per_face_);
  for (const auto& face : faces_)
    for (const FacePoint& point : points) {
      const Place at = place_of(x, face.data(), per_face_, point);
      const Eigen::Vector3d area = factor * point.weight * at.side_1.cross(at.side_2);
      for (std::size_t i = 0; i < per_face_; ++i)
        force.segment<3>(3 * static_cast<Eigen::Index>(face[i])) += point.shape[i].value * area;
    }
}

void Surface::add_area_tangent(const Eigen::VectorXd& x, double factor, fem::SparseMatrix& tangent) const {
  const auto points = face_points(per_face_);
  for (const auto& face : faces_)
    for (const FacePoint& point : points) {
      const Place at = place_of(x, face.data(), per_face_, point);
      const Eigen::Matrix3d cross_1 = cross_matrix(at.side_1), cross_2 = cross_matrix(at.side_2);
      for (std::size_t j = 0; j < per_face_; ++j) {
        const Eigen::Matrix3d turned =
            factor * point.weight * (point.shape[j].along_2 * cross_1 - point.shape[j].along_1 * cross_2);
        for (std::size_t i = 0; i < per_face_; ++i)
          add_block(face[i], face[j], point.shape[i].value * turned, tangent);
      }
    }
}

void Surface::add_springs(const Nodes& nodes, double normal_kpa_per_mm, double tangential_kpa_per_mm,
                          fem::SparseMatrix& matrix) const {
  const auto points = face_points(per_face_);
  const Eigen::VectorXd rest = nodes.places_after(Eigen::VectorXd());
  for (const auto& face : faces_)
    for (const FacePoint& point : points) {
      const Place at = place_of(rest, face.data(), per_face_, point);
      const Eigen::Vector3d area = at.side_1.cross(at.side_2);
      const Eigen::Matrix3d normal = area.normalized() * area.normalized().transpose();
      const Eigen::Matrix3d stiff =
          point.weight * area.norm() *
          (normal_kpa_per_mm * normal + tangential_kpa_per_mm * (Eigen::Matrix3d::Identity() - normal));
      for (std::size_t i = 0; i < per_face_; ++i)
        for (std::size_t j = 0; j < per_face_; ++j)
          add_block(face[i], face[j], point.shape[i].value * point.shape[j].value * stiff, matrix);
    }
}

}  // namespace voxtet::mechanics
