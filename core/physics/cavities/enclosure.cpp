#include "physics/cavities/enclosure.h"

#include <algorithm>
#include <utility>

namespace voxtet {

Enclosure::Enclosure(const mechanics::Nodes& nodes, const Cavity& cavity) {
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    return nodes.quadratic() ? nodes.middle(a, b) : a;
  };
  for (const Triangle& triangle : cavity.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      nodes_.push_back(triangle[i]);
      nodes_.push_back(middle(triangle[i], triangle[(i + 1) % 3]));
    }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  const auto place = [&](std::uint32_t node) {
    return static_cast<std::uint32_t>(std::lower_bound(nodes_.begin(), nodes_.end(), node) - nodes_.begin());
  };
  std::vector<mechanics::Surface::Face> faces;
  for (const auto& [a, b, c] : cavity.triangles)
    faces.push_back(
        {place(a), place(b), place(c), place(middle(a, b)), place(middle(b, c)), place(middle(c, a))});
  auto next = static_cast<std::uint32_t>(nodes_.size());
  for (const auto& rim : cavity.rims) {
    const std::uint32_t centre = next++;
    const double part = 1 / static_cast<double>(rim.size());
    for (const std::uint32_t point : rim) shares_.push_back({centre, place(point), part});
    // Half way from the centre to each point of the rim.
    const std::uint32_t first = next;
    if (nodes.quadratic())
      for (const std::uint32_t point : rim) {
        shares_.push_back({next, centre, 0.5});
        shares_.push_back({next++, place(point), 0.5});
      }
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const std::size_t j = (i + 1) % rim.size();
      faces.push_back({centre, place(rim[i]), place(rim[j]), first + static_cast<std::uint32_t>(i),
                       place(middle(rim[i], rim[j])), first + static_cast<std::uint32_t>(j)});
    }
  }
  places_ = next;
  surface_ = mechanics::Surface(std::move(faces), nodes.quadratic());
}

Eigen::VectorXd Enclosure::gather(const Eigen::VectorXd& x) const {
  Eigen::VectorXd places = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(places_));
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    places.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        x.segment<3>(3 * static_cast<Eigen::Index>(nodes_[i]));
  // In their order: halves come after the centres that they refer to.
  for (const auto& [of, node, part] : shares_)
    places.segment<3>(3 * static_cast<Eigen::Index>(of)) +=
        part * places.segment<3>(3 * static_cast<Eigen::Index>(node));
  return places;
}

void Enclosure::scatter(const Eigen::VectorXd& at_places, double factor, Eigen::VectorXd& out) const {
  Eigen::VectorXd sums = at_places;
  for (auto share = shares_.rbegin(); share != shares_.rend(); ++share)
    sums.segment<3>(3 * static_cast<Eigen::Index>(share->node)) +=
        share->part * sums.segment<3>(3 * static_cast<Eigen::Index>(share->of));
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    out.segment<3>(3 * static_cast<Eigen::Index>(nodes_[i])) +=
        factor * sums.segment<3>(3 * static_cast<Eigen::Index>(i));
}

Eigen::VectorXd Enclosure::gradient_at(const Eigen::VectorXd& places) const {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(places.size());
  surface_.add_area_vectors(places, 1, gradient);
  return gradient;
}

double Enclosure::volume_mm3(const Eigen::VectorXd& x) const {
  // Relative to a point of the cavity: those of a heart may be far from the origin.
  Eigen::VectorXd places = gather(x);
  const Eigen::Vector3d origin = places.head<3>();
  for (Eigen::Index i = 0; i < places.size(); i += 3) places.segment<3>(i) -= origin;
  return surface_.volume_mm3(places);
}

void Enclosure::add_gradient(const Eigen::VectorXd& x, double factor, Eigen::VectorXd& gradient) const {
  scatter(gradient_at(gather(x)), factor, gradient);
}

void Enclosure::add_gradient_change(const Eigen::VectorXd& x, const Eigen::VectorXd& moves, double factor,
                                    Eigen::VectorXd& change) const {
  // The gradient is quadratic in x, so that a difference around x is its derivative, without an error.
  const Eigen::VectorXd places = gather(x), moved = gather(moves);
  scatter(gradient_at(places + moved) - gradient_at(places - moved), factor / 2, change);
}

double volume_mm3(const Cavity& cavity, std::span<const Eigen::Vector3d> points) {
  const mechanics::Nodes nodes({points.begin(), points.end()});
  return Enclosure(nodes, cavity).volume_mm3(nodes.places_after({}));
}

}  // namespace voxtet
