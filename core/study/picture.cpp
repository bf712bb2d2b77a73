#include "study/picture.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "geometry/topology/adjacency.h"
#include "io/bytes/write_png.h"

namespace voxtet {
namespace {

constexpr int kPictureWide = 320, kPictureTall = 240;
constexpr int kFiner = 2;  // each pixel is the mean of so many in each direction
constexpr Rgb kPaper{255, 255, 255};

using Colour = Eigen::Vector3d;  // 0 to 255

/// Colours of labels that stay apart for those who see few (Okabe and Ito 2008), lighter, without black.
Colour colour_of_label(Label label) {
  static const std::array<Colour, 7> colours{
      Colour(214, 120, 100), Colour(110, 160, 205), Colour(225, 190, 90), Colour(110, 185, 150),
      Colour(190, 130, 180), Colour(235, 155, 70),  Colour(140, 140, 150)};
  return colours[(label - 1U) % colours.size()];
}

/// Early red to late blue through yellow and green; `t` in [0, 1].
Colour colour_of_time(double t) {
  static const std::array<Colour, 5> stops{Colour(215, 48, 39), Colour(253, 174, 97), Colour(255, 240, 170),
                                           Colour(116, 190, 180), Colour(49, 84, 149)};
  const double at = std::clamp(t, 0.0, 1.0) * (stops.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  return stops[first] + (at - static_cast<double>(first)) * (stops[first + 1] - stops[first]);
}

/// Pixels with the depth of what is seen in them.
class Canvas {
 public:
  Canvas(int width, int height)
      : width_(width),
        height_(height),
        colours_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                 Colour(kPaper[0], kPaper[1], kPaper[2])),
        depths_(colours_.size(), -std::numeric_limits<double>::infinity()) {}

  /// Corners in pixels, z towards the eye.
  void draw(const std::array<Eigen::Vector3d, 3>& corners, const Colour& colour) {
    const auto& [a, b, c] = corners;
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
    if (std::abs(area) < 1e-12) return;
    const auto [left, right] = std::minmax({a.x(), b.x(), c.x()});
    const auto [top, bottom] = std::minmax({a.y(), b.y(), c.y()});
    for (int y = std::max(0, static_cast<int>(top)); y <= std::min(height_ - 1, static_cast<int>(bottom));
         ++y)
      for (int x = std::max(0, static_cast<int>(left)); x <= std::min(width_ - 1, static_cast<int>(right));
           ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double u = ((px - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (py - a.y())) / area;
        const double v = ((b.x() - a.x()) * (py - a.y()) - (px - a.x()) * (b.y() - a.y())) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const double depth = a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z());
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (depth <= depths_[at]) continue;
        depths_[at] = depth;
        colours_[at] = colour;
      }
  }

  Picture smaller(int by) const {
    Picture out{width_ / by, height_ / by, {}};
    for (int y = 0; y < out.height; ++y)
      for (int x = 0; x < out.width; ++x) {
        Colour sum = Colour::Zero();
        for (int j = 0; j < by; ++j)
          for (int i = 0; i < by; ++i)
            sum += colours_[static_cast<std::size_t>(y * by + j) * static_cast<std::size_t>(width_) +
                            static_cast<std::size_t>(x * by + i)];
        sum /= by * by;
        out.pixels.push_back({static_cast<std::uint8_t>(sum.x() + 0.5),
                              static_cast<std::uint8_t>(sum.y() + 0.5),
                              static_cast<std::uint8_t>(sum.z() + 0.5)});
      }
    return out;
  }

 private:
  int width_, height_;
  std::vector<Colour> colours_;
  std::vector<double> depths_;
};

/// What is seen: the half of the tetrahedra that lies behind the plane y = middle.
struct BackHalf {
  std::vector<Tet> tets;
  std::vector<std::uint32_t> ids;
};

BackHalf back_half(const TetMesh& mesh, double middle) {
  BackHalf half;
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    double sum = 0;
    for (const std::uint32_t corner : mesh.tets[t]) sum += mesh.points[corner].y();
    if (sum / 4 > middle) continue;
    half.tets.push_back(mesh.tets[t]);
    half.ids.push_back(t);
  }
  return half;
}

}  // namespace

Bytes picture_of(const Session& session) {
  const TetMesh& mesh = *session.mesh();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.points) box.extend(p);
  const BackHalf half = back_half(mesh, box.center().y());
  // Seen from the front (+y, with -x to the right) and from a little above.
  const double sine = 0.35, cosine = std::sqrt(1 - sine * sine);
  Eigen::Matrix3d turn;
  turn << -1, 0, 0, 0, sine, -cosine, 0, cosine, sine;
  Eigen::AlignedBox3d seen;
  for (const Tet& tet : half.tets)
    for (const std::uint32_t corner : tet) seen.extend(turn * mesh.points[corner]);
  Canvas canvas(kPictureWide * kFiner, kPictureTall * kFiner);
  if (!seen.isEmpty()) {
    const double margin = 0.94;
    const double scale = margin * kFiner *
                         std::min(kPictureWide / std::max(seen.sizes().x(), 1e-9),
                                  kPictureTall / std::max(seen.sizes().y(), 1e-9));
    const Eigen::Vector3d shift(0.5 * kPictureWide * kFiner, 0.5 * kPictureTall * kFiner, 0);
    const std::vector<float>* times = session.eikonal() ? &session.eikonal()->fields[0].values : nullptr;
    double last = 0;
    for (std::size_t i = 0; times && i < times->size(); ++i)
      if (std::isfinite((*times)[i])) last = std::max(last, static_cast<double>((*times)[i]));
    for (const TetFace& face : tet_faces(half.tets, mesh.points.size())) {
      if (face.count != 1) continue;
      std::array<Eigen::Vector3d, 3> corners;
      double time = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] = shift + scale * (turn * mesh.points[face.corners[c]] - seen.center());
        if (times) time += static_cast<double>((*times)[face.corners[c]]) / 3;
      }
      const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
      const double light = 0.45 + 0.55 * std::abs(normal.dot(Eigen::Vector3d(-0.3, -0.45, 0.84)));
      const bool has_time = times && std::isfinite(time) && last > 0;
      const Colour colour =
          has_time ? colour_of_time(time / last) : colour_of_label(mesh.labels[half.ids[face.first]]);
      canvas.draw(corners, light * colour);
    }
  }
  return write_png(canvas.smaller(kFiner));
}

}  // namespace voxtet
