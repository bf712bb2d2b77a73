// CGAL Mesh_3 from the label image, with perturb and exude, at a target number of tetrahedra:
// `peer_cgal VOLUME OUT EDGE_MM DISTANCE_MM TETS`. Sizes are scaled until refinement alone gives that number
// within a twentieth; the run that counts then does everything once more.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_3/initialize_triangulation_from_labeled_image.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/refine_mesh_3.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "bench/peers/peer.h"
#include "io/volume/read_volume.h"
#include "pipeline/memory.h"

using namespace voxtet;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace parameters = CGAL::parameters;

/// CGAL's sizes bound radii: of a facet's surface ball and of a cell. Median edges come out at the target
/// with these.
constexpr double kFacetRadiusPerEdge = 0.77, kCellRadiusPerEdge = 0.79;
constexpr int kMaxTrials = 5;
constexpr double kLikeCount = 0.05;

/// In a space of its own: axes along the voxels', mm. Image_3 knows no directions.
CGAL::Image_3 image_of(const LabelVolume& volume) {
  const auto n = [&](int d) { return static_cast<std::size_t>(volume.size[static_cast<std::size_t>(d)]); };
  const Eigen::Vector3d spacing = volume.spacing_mm();
  _image* image =
      _createImage(n(0), n(1), n(2), 1, spacing.x(), spacing.y(), spacing.z(), 2, WK_FIXED, SGN_UNSIGNED);
  std::copy(volume.labels.begin(), volume.labels.end(), static_cast<Label*>(image->data));
  return CGAL::Image_3(image);
}

Criteria criteria_of(double edge_mm, double distance_mm) {
  return Criteria(parameters::facet_angle = 30, parameters::facet_size = kFacetRadiusPerEdge * edge_mm,
                  parameters::facet_distance = distance_mm, parameters::cell_radius_edge_ratio = 2,
                  parameters::cell_size = kCellRadiusPerEdge * edge_mm);
}

/// Refined, perturbed and exuded, or as `steps` has it. The first points are those of CGAL's example of
/// labelled images: without them it finds none where the middle of the image is in no label.
template <class... Steps>
Complex mesh_of(const Domain& domain, const CGAL::Image_3& image, const Criteria& criteria,
                const Steps&... steps) {
  Complex mesh;
  initialize_triangulation_from_labeled_image(mesh, domain, image, criteria, Label{});
  CGAL::refine_mesh_3(mesh, domain, criteria, steps...);
  return mesh;
}

/// The edge length at which refinement gives the target number of tetrahedra.
double calibrated_edge(const Domain& domain, const CGAL::Image_3& image, double edge_mm, double distance_mm,
                       double tets) {
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    const Complex mesh = mesh_of(domain, image, criteria_of(edge_mm, distance_mm), parameters::no_perturb(),
                                 parameters::no_exude());
    const double ratio = static_cast<double>(mesh.number_of_cells_in_complex()) / tets;
    if (ratio == 0 || std::abs(ratio - 1) < kLikeCount) break;
    edge_mm *= std::cbrt(ratio);
  }
  return edge_mm;
}

TetMesh take(const Complex& complex, const LabelVolume& volume) {
  TetMesh mesh;
  std::map<Complex::Vertex_handle, std::uint32_t> place;
  const Eigen::Vector3d spacing = volume.spacing_mm();
  const bool mirrored = volume.linear().determinant() < 0;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    Tet tet{};
    for (int c = 0; c < 4; ++c) {
      const auto [at, added] =
          place.try_emplace(cell->vertex(c), static_cast<std::uint32_t>(mesh.points.size()));
      const auto& p = cell->vertex(c)->point();
      if (added)
        mesh.points.push_back(volume.to_mm({p.x() / spacing.x(), p.y() / spacing.y(), p.z() / spacing.z()}));
      tet[static_cast<std::size_t>(c)] = at->second;
    }
    if (mirrored) std::swap(tet[2], tet[3]);
    mesh.tets.push_back(tet);
    mesh.labels.push_back(static_cast<Label>(complex.subdomain_index(cell)));
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "peer_cgal: expected VOLUME OUT EDGE_MM DISTANCE_MM TETS\n");
    return 2;
  }
  const std::string out = argv[2];
  const double distance_mm = std::atof(argv[4]);
  const Result<LabelVolume> volume = read_volume_file(argv[1]);
  if (!volume) {
    std::fprintf(stderr, "%s\n", volume.error().message.c_str());
    return 1;
  }
  const CGAL::Image_3 image = image_of(*volume);
  const Domain domain = Domain::create_labeled_image_mesh_domain(image);
  const double edge_mm = calibrated_edge(domain, image, std::atof(argv[3]), distance_mm, std::atof(argv[5]));
  Complex mesh;
  nlohmann::json figures;
  figures["edge_mm"] = edge_mm;
  figures["seconds"] = peers::seconds_of([&] {
    const Domain fresh = Domain::create_labeled_image_mesh_domain(image);
    mesh = mesh_of(fresh, image, criteria_of(edge_mm, distance_mm));
  });
  figures["peak_mb"] = peak_memory_mb();
  if (mesh.number_of_cells_in_complex() == 0) figures["error"] = "CGAL gave no tetrahedra";
  return peers::finish(out, take(mesh, *volume), figures);
}
