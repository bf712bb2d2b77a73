#include "geometry/cut/triangulate_section.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace voxtet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// The info of a vertex is its number, that of a face its region.
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_predicates_tag>;
using Face = Triangulation::Face_handle;

using Ends = std::pair<std::uint32_t, std::uint32_t>;  ///< ascending

constexpr double kClearance = 0.5;  ///< of added points from edges, in spacings
constexpr int kNoRegion = -1;

class Section {
 public:
  Section(const std::vector<Eigen::Vector2d>& points, const std::vector<SectionEdge>& edges)
      : points_(points), edges_(edges) {}

  /// False where edges meet beyond common ends.
  bool build() {
    std::vector<Triangulation::Vertex_handle> vertices(points_.size());
    Face near;
    for (const SectionEdge& edge : edges_)
      for (const std::uint32_t p : {edge.from, edge.to})
        if (vertices[p] == nullptr) {
          vertices[p] = plane_.insert({points_[p].x(), points_[p].y()}, near);
          vertices[p]->info() = p;
          near = vertices[p]->face();
          ++inserted_;
        }
    for (const SectionEdge& edge : edges_) {
      plane_.insert_constraint(vertices[edge.from], vertices[edge.to]);
      between_[std::minmax(edge.from, edge.to)].push_back(&edge);
    }
    return plane_.dimension() == 2 && is_sound();
  }

  /// Finds the label of every face: that on which most edges around its region agree.
  void find_labels() {
    for (const Face face : plane_.all_face_handles()) face->info() = kNoRegion;
    regions_.clear();
    for (const Face first : plane_.all_face_handles()) {
      if (first->info() != kNoRegion) continue;
      Votes votes;
      std::vector<Face> reached{first};
      first->info() = static_cast<int>(regions_.size());
      for (std::size_t next = 0; next < reached.size(); ++next) {
        const Face face = reached[next];
        for (int i = 0; i < 3; ++i) {
          if (face->is_constrained(i)) {
            vote(face, i, votes);
          } else if (const Face other = face->neighbor(i); other->info() == kNoRegion) {
            other->info() = first->info();
            reached.push_back(other);
          }
        }
      }
      Region region{kBackground, votes.covered};
      std::size_t most = 0;
      for (const auto& [of, count] : votes.labels)
        if (count > most) region.label = of, most = count;
      regions_.push_back(region);
    }
  }

  /// Points of a triangular lattice in the regions of wanted labels, away from edges.
  std::vector<Eigen::Vector2d> lattice(const std::function<bool(Label)>& is_wanted, double spacing) const {
    Eigen::AlignedBox2d box;
    for (const SectionEdge& edge : edges_) box.extend(points_[edge.from]);
    const auto cell = [&](double at) { return static_cast<int>(std::floor(at / spacing)); };
    std::map<std::array<int, 2>, std::vector<const SectionEdge*>> near_cell;
    for (const SectionEdge& edge : edges_) {
      const Eigen::Vector2d low = points_[edge.from].cwiseMin(points_[edge.to]),
                            high = points_[edge.from].cwiseMax(points_[edge.to]);
      for (int i = cell(low.x() - spacing); i <= cell(high.x() + spacing); ++i)
        for (int j = cell(low.y() - spacing); j <= cell(high.y() + spacing); ++j)
          near_cell[{i, j}].push_back(&edge);
    }
    const auto is_clear = [&](const Eigen::Vector2d& p) {
      const auto found = near_cell.find({cell(p.x()), cell(p.y())});
      return found == near_cell.end() ||
             std::none_of(found->second.begin(), found->second.end(),
                          [&](const SectionEdge* edge) { return distance(p, *edge) < kClearance * spacing; });
    };
    std::vector<Eigen::Vector2d> out;
    const double step = std::sqrt(0.75) * spacing;
    const int rows = static_cast<int>(std::ceil(box.sizes().y() / step)),
              columns = static_cast<int>(std::ceil(box.sizes().x() / spacing));
    Face near;
    for (int row = 0; row <= rows; ++row)
      for (int column = 0; column <= columns; ++column) {
        const Eigen::Vector2d p =
            box.min() + Eigen::Vector2d((column + 0.5 * (row % 2)) * spacing, row * step);
        near = plane_.locate({p.x(), p.y()}, near);
        if (!plane_.is_infinite(near) && takes(near, is_wanted) && is_clear(p)) out.push_back(p);
      }
    return out;
  }

  void add(const std::vector<Eigen::Vector2d>& added) {
    auto number = static_cast<std::uint32_t>(points_.size());
    Face near;
    for (const Eigen::Vector2d& p : added) {
      const Triangulation::Vertex_handle vertex = plane_.insert({p.x(), p.y()}, near);
      vertex->info() = number++;
      near = vertex->face();
    }
  }

  void take(const std::function<bool(Label)>& is_wanted, SectionTriangles& out) const {
    for (const Face face : plane_.finite_face_handles()) {
      if (!takes(face, is_wanted)) continue;
      out.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
      out.labels.push_back(region_of(face).label);
    }
  }

 private:
  struct Region {
    Label label;
    bool covered;  ///< by the surface
  };
  struct Votes {
    std::map<Label, std::size_t> labels;
    bool covered = false;
  };

  const Region& region_of(Face face) const { return regions_[static_cast<std::size_t>(face->info())]; }
  bool takes(Face face, const std::function<bool(Label)>& is_wanted) const {
    return !region_of(face).covered && is_wanted(region_of(face).label);
  }

  bool is_sound() const {
    if (plane_.number_of_vertices() != inserted_) return false;
    for (const Triangulation::Edge& edge : plane_.constrained_edges())
      if (!between_.contains(ends_of(edge.first, edge.second))) return false;
    return true;
  }

  static Ends ends_of(Face face, int i) {
    return std::minmax(
        {face->vertex(Triangulation::cw(i))->info(), face->vertex(Triangulation::ccw(i))->info()});
  }

  /// Above and below the plane the same labels lie on both sides of an edge, unless several surfaces leave
  /// from it there: these say nothing.
  void vote(Face face, int i, Votes& votes) const {
    const std::uint32_t first =
        face->vertex(Triangulation::ccw(i))->info();  // a face is on the left of its edges
    std::array<const SectionEdge*, 2> only{};
    std::array<std::size_t, 2> count{};
    for (const SectionEdge* edge : between_.at(ends_of(face, i))) {
      if (edge->of == SectionEdge::Of::kWithin) {
        votes.covered = votes.covered || edge->from == first;
        continue;
      }
      const std::size_t side = edge->of == SectionEdge::Of::kAbove ? 0 : 1;
      only[side] = edge;
      ++count[side];
    }
    for (std::size_t side = 0; side < 2; ++side)
      if (count[side] == 1) ++votes.labels[only[side]->from == first ? only[side]->left : only[side]->right];
  }

  double distance(const Eigen::Vector2d& p, const SectionEdge& edge) const {
    const Eigen::Vector2d a = points_[edge.from], along = points_[edge.to] - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - a - t * along).norm();
  }

  const std::vector<Eigen::Vector2d>& points_;
  const std::vector<SectionEdge>& edges_;
  Triangulation plane_;
  std::size_t inserted_ = 0;
  std::map<Ends, std::vector<const SectionEdge*>> between_;
  std::vector<Region> regions_;
};

}  // namespace

std::optional<SectionTriangles> triangulate_section(const std::vector<Eigen::Vector2d>& points,
                                                    const std::vector<SectionEdge>& edges,
                                                    const std::function<bool(Label)>& is_wanted,
                                                    double spacing) {
  SectionTriangles out;
  if (edges.empty()) return out;
  Section section(points, edges);
  if (!section.build()) return std::nullopt;
  section.find_labels();
  out.added = section.lattice(is_wanted, spacing);
  section.add(out.added);
  section.find_labels();
  section.take(is_wanted, out);
  return out;
}

}  // namespace voxtet
