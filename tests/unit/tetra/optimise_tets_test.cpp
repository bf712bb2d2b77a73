#include "tetra/optimise/optimise_tets.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/digest.h"
#include "geometry/intersect/self_intersections.h"
#include "geometry/search/closest_point.h"
#include "geometry/topology/adjacency.h"
#include "support/check_tets.h"
#include "support/labelled_mesh.h"
#include "support/test_surfaces.h"
#include "tetra/fill/fill_tets.h"
#include "tetra/mesh/edge_groups.h"
#include "tetra/mesh/tet_quality.h"
#include "tetra/mesh/vertices_apart.h"
#include "tetra/operations/size_guard.h"

namespace voxtet {
namespace {

TetMesh optimise(const TetMesh& mesh, const SurfaceMesh& reference, const SizingField& sizing,
                 const OptimiseParams& params = {}) {
  RunContext ctx;
  Result<TetMesh> optimised = optimise_tets(mesh, reference, sizing, params, ctx);
  EXPECT_TRUE(optimised.ok());
  return *std::move(optimised);
}

TetMesh optimise_fixed(const TetMesh& mesh, const SizingField& sizing, OptimiseParams params = {}) {
  params.slide = 0;
  return optimise(mesh, {}, sizing, params);
}

double lowest_quality(const TetMesh& mesh) {
  double lowest = 1;
  for (const auto& [a, b, c, d] : mesh.tets)
    lowest = std::min(lowest, tetra::quality(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]));
  return lowest;
}

std::map<Label, double> volumes(const TetMesh& mesh) {
  std::map<Label, double> volume;
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) volume[mesh.labels[t]] += test::tet_volume(mesh, t);
  return volume;
}

double median_edge(const TetMesh& mesh) {
  std::vector<double> lengths;
  for (const auto& [a, b] : tet_edges(mesh.tets, mesh.points.size()))
    lengths.push_back((mesh.points[b] - mesh.points[a]).norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

/// Reproducible on every platform.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double unit() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) / 9007199254740992.0;
  }
  Eigen::Vector3d point() {
    const double x = unit(), y = unit(), z = unit();
    return {x, y, z};
  }

 private:
  std::uint64_t state_;
};

/// The Delaunay tetrahedra of random points in a box of 10, labels by planes through its middle.
TetMesh random_mesh(std::uint64_t seed, std::size_t points, int planes) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
  using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex>>;
  Random random(seed);
  TetMesh mesh;
  Triangulation triangulation;
  for (std::uint32_t i = 0; i < points; ++i) {
    const Eigen::Vector3d p = 10 * random.point();
    mesh.points.push_back(p);
    triangulation.insert(Kernel::Point_3(p.x(), p.y(), p.z()))->info() = i;
  }
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(static_cast<std::size_t>(planes));
  for (int i = 0; i < planes; ++i) normals.push_back(random.point() - Eigen::Vector3d::Constant(0.5));
  for (auto cell = triangulation.finite_cells_begin(); cell != triangulation.finite_cells_end(); ++cell) {
    Tet tet{};
    for (int c = 0; c < 4; ++c) tet[static_cast<std::size_t>(c)] = cell->vertex(c)->info();
    mesh.tets.push_back(tet);
    Eigen::Vector3d middle = Eigen::Vector3d::Constant(-5);
    for (const std::uint32_t v : tet) middle += mesh.points[v] / 4;
    int label = 1;
    for (const Eigen::Vector3d& normal : normals) label = 2 * label + (normal.dot(middle) > 0);
    mesh.labels.push_back(static_cast<Label>(label));
    if (test::tet_volume(mesh, static_cast<std::uint32_t>(mesh.tets.size() - 1)) > 0) continue;
    mesh.tets.pop_back();
    mesh.labels.pop_back();
  }
  test::add_faces(mesh);
  return mesh;
}

/// A ball in a ball, the inner one off the centre; labels 1 and 2.
SurfaceMesh two_balls() {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 10, 3, 1, 0);
  test::append(surface, test::sphere({2, 1, 0}, 5, 2, 2, 1));
  return surface;
}

/// The same with points displaced by up to 0.15 along each axis.
SurfaceMesh rough_balls() {
  SurfaceMesh surface = two_balls();
  Random random(5);
  for (Eigen::Vector3d& p : surface.points) p += 0.3 * (random.point() - Eigen::Vector3d::Constant(0.5));
  return surface;
}

TetMesh filled(const SurfaceMesh& surface, const SizingField& sizing) {
  RunContext ctx;
  return *fill_tets(surface, sizing, {TetBackend::kTetgen}, ctx);
}

/// What must hold with the boundary fixed.
void expect_better(const TetMesh& before, const TetMesh& after) {
  test::check_tets(after);
  EXPECT_GE(lowest_quality(after), lowest_quality(before));
  EXPECT_EQ(after.face_sides, before.face_sides);
  ASSERT_EQ(after.faces.size(), before.faces.size());
  for (std::size_t f = 0; f < before.faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_EQ(after.points[after.faces[f][c]], before.points[before.faces[f][c]]);
  const std::map<Label, double> volume = volumes(after);
  for (const auto& [label, wanted] : volumes(before))
    EXPECT_NEAR(volume.at(label) / wanted, 1, 1e-12) << label;
}

TEST(OptimiseTets, KeepsFacesAndVolumesOfRandomMeshesAndRaisesTheLowestQuality) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const TetMesh before = random_mesh(seed, 400, static_cast<int>(seed % 4));
    const TetMesh after = optimise_fixed(before, test::uniform_sizing(median_edge(before)));
    expect_better(before, after);
    EXPECT_GT(lowest_quality(after), lowest_quality(before));
  }
}

TEST(OptimiseTets, KeepsFacesAndVolumesOfALabelledCube) {
  const TetMesh before = test::kuhn_cube(8);
  expect_better(before, optimise_fixed(before, test::uniform_sizing(1.25)));
}

TEST(OptimiseTets, ReachesThirtyDegreesInFilledBalls) {
  const SurfaceMesh surface = two_balls();
  const SizingField sizing = test::uniform_sizing(1.4);
  const TetMesh before = filled(surface, sizing);
  const TetMesh fixed = optimise_fixed(before, sizing), slid = optimise(before, surface, sizing);
  expect_better(before, fixed);
  test::check_tets(slid);
  EXPECT_LT(test::smallest_dihedral_deg(before), 20);
  EXPECT_GT(test::smallest_dihedral_deg(fixed), 29);
  EXPECT_GT(test::smallest_dihedral_deg(slid), 30);
}

TEST(OptimiseTets, KeepsSlidingVerticesInTheEnvelope) {
  const SurfaceMesh reference = two_balls();
  const SizingField sizing = test::uniform_sizing(1.4);
  const SurfaceMesh rough = rough_balls();
  const TetMesh before = filled(rough, sizing);
  OptimiseParams params;
  params.insertion_deg = 42;
  params.min_dihedral_deg = 42;
  const TetMesh after = optimise(before, reference, sizing, params);
  test::check_tets(after);
  EXPECT_TRUE(find_self_intersections({after.points, after.faces, after.face_sides}).empty());
  const ClosestPointTree surface(reference.points, reference.triangles);
  std::size_t moved = 0;
  for (std::uint32_t v = 0; v < rough.points.size(); ++v) {
    moved += after.points[v] != before.points[v];
    const double was = surface.closest(before.points[v]).distance_mm;
    EXPECT_LE(surface.closest(after.points[v]).distance_mm, std::max(was, params.slide * 1.4) + 1e-9) << v;
  }
  EXPECT_GT(moved, 10U);
}

TEST(OptimiseTets, KeepsTheVolumeOfAThinWall) {
  SurfaceMesh shell = test::sphere({0, 0, 0}, 10, 3, 1, 0);
  test::append(shell, test::sphere({0, 0, 0}, 9.2, 3, 2, 1));
  const SizingField sizing = test::uniform_sizing(1.6);
  const TetMesh before = filled(shell, sizing), after = optimise(before, shell, sizing);
  test::check_tets(after);
  const std::map<Label, double> was = volumes(before), is = volumes(after);
  ASSERT_EQ(was.size(), 2U);
  for (const auto& [label, mm3] : was) EXPECT_NEAR(is.at(label), mm3, 0.002 * mm3) << label;
  EXPECT_GT(test::smallest_dihedral_deg(after), test::smallest_dihedral_deg(before));
  EXPECT_NE(std::vector<Eigen::Vector3d>(after.points.begin(), after.points.begin() + 600),
            std::vector<Eigen::Vector3d>(before.points.begin(), before.points.begin() + 600))
      << "none slides";
}

TEST(OptimiseTets, KeepsJunctionsOnTheirCurves) {
  const TetMesh before = test::kuhn_cube(6);
  const SurfaceMesh reference{before.points, before.faces, before.face_sides};
  OptimiseParams params;
  params.min_dihedral_deg = 42;
  params.insertion_deg = 42;
  const SizingField sizing = test::uniform_sizing(1.6);
  const TetMesh after = optimise(before, reference, sizing, params);
  test::check_tets(after);
  const EdgeGroups edges(reference);
  std::vector<Triangle> curves;  // without area
  std::set<std::uint32_t> junctions;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].size() < 3) continue;
    curves.push_back({edges[e][0].low, edges[e][0].high, edges[e][0].high});
    junctions.insert({edges[e][0].low, edges[e][0].high});
  }
  const ClosestPointTree curve(reference.points, curves);
  std::size_t moved = 0;
  for (const std::uint32_t v : junctions) {
    moved += after.points[v] != before.points[v];
    EXPECT_LE(curve.closest(after.points[v]).distance_mm, params.slide * sizing.at(before.points[v]) + 1e-9)
        << v;
  }
  EXPECT_GT(moved, 0U);
  EXPECT_GT(junctions.size(), 20U);
}

double largest_misfit(const TetMesh& mesh, const SizingField& sizing) {
  const tetra::SizeGuard guard(sizing);
  double misfit = 1;
  for (const auto& [a, b] : tet_edges(mesh.tets, mesh.points.size()))
    misfit = std::max(misfit, guard.misfit(mesh.points[a], mesh.points[b]));
  return misfit;
}

TEST(OptimiseTets, MakesNoEdgeFartherFromTheTargetThanThereWas) {
  const TetMesh before = random_mesh(7, 800, 1);
  const SizingField sizing = test::uniform_sizing(0.8 * median_edge(before));
  const double largest = largest_misfit(before, sizing);
  OptimiseParams params;
  EXPECT_LE(largest_misfit(optimise_fixed(before, sizing, params), sizing), 1.5 * largest);
  params.insertion_deg = 1;
  EXPECT_LE(largest_misfit(optimise_fixed(before, sizing, params), sizing), largest);
}

/// Of all edges, the part longer or shorter than the target by a factor of 1.41.
double share_far_off(const TetMesh& mesh, const SizingField& sizing) {
  const tetra::SizeGuard guard(sizing);
  const auto edges = tet_edges(mesh.tets, mesh.points.size());
  const auto far_off = std::count_if(edges.begin(), edges.end(), [&](const auto& e) {
    const double ratio = guard.ratio(mesh.points[e[0]], mesh.points[e[1]]);
    return ratio > std::sqrt(2) || ratio < std::sqrt(0.5);
  });
  return static_cast<double>(far_off) / static_cast<double>(edges.size());
}

TEST(OptimiseTets, BringsEdgesNearerToTheTarget) {
  const SurfaceMesh surface = two_balls();
  const SizingField sizing = test::uniform_sizing(1.4);
  const TetMesh before = filled(surface, sizing), after = optimise(before, surface, sizing);
  EXPECT_LT(share_far_off(after, sizing), 0.7 * share_far_off(before, sizing));
}

TEST(OptimiseTets, InsertedVerticesDoNotAllowEachOtherEverShorterEdges) {
  OptimiseParams params;
  params.rounds = 10;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const TetMesh before = random_mesh(seed, 400, 4);
    const SizingField sizing = test::uniform_sizing(2 * median_edge(before));
    const TetMesh after = optimise_fixed(before, sizing, params);
    EXPECT_GT(after.points.size(), before.points.size()) << seed;
    EXPECT_LE(largest_misfit(after, sizing), 1.5 * largest_misfit(before, sizing)) << seed;
  }
}

TEST(OptimiseTets, GivesTheSameBytesOnAnyNumberOfThreads) {
  const SurfaceMesh surface = two_balls();
  const SizingField sizing = test::uniform_sizing(1.4);
  const TetMesh balls = filled(rough_balls(), sizing), random = random_mesh(9, 3000, 2);
  const auto on = [&](int threads) {
    RunContext ctx;
    ctx.threads = threads;
    const double edge_mm = 1.2 * median_edge(random);
    return digest_of(*optimise_tets(balls, surface, sizing, {}, ctx)) +
           digest_of(*optimise_tets(random, {}, test::uniform_sizing(edge_mm), {.slide = 0}, ctx));
  };
  const std::string first = on(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(on(threads), first) << threads;
}

TEST(VerticesApart, HaveNoTetInCommonInAGroupAndKeepTheirOrder) {
  const tetra::TetComplex complex(random_mesh(4, 3000, 1));
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < complex.point_count(); ++v)
    if (v % 5 > 0) vertices.push_back((v * 7) % complex.point_count());
  for (const int threads : {1, 3}) {
    const Buckets<std::uint32_t> groups = tetra::vertices_apart(complex, vertices, threads);
    constexpr std::size_t kNotListed = ~std::size_t{0};
    struct Place {
      std::size_t group = kNotListed, item = 0;
    };
    std::vector<Place> places(complex.point_count());
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const std::uint32_t i : groups.at(g)) places[vertices[i]] = {g, i};
    for (const std::uint32_t v : vertices) ASSERT_NE(places[v].group, kNotListed) << v;
    for (std::uint32_t t = 0; t < complex.places(); ++t)
      for (const std::uint32_t v : complex.corners(t))
        for (const std::uint32_t w : complex.corners(t)) {
          if (v == w || places[v].group == kNotListed || places[w].group == kNotListed) continue;
          EXPECT_EQ(places[v].group < places[w].group, places[v].item < places[w].item);
          EXPECT_NE(places[v].group, places[w].group);
        }
    EXPECT_LT(groups.size(), 100U) << "most of them at once";
  }
}

TEST(OptimiseTets, GivesTheSameBytesOnEveryPlatform) {
  const SurfaceMesh surface = two_balls();
  const SizingField sizing = test::uniform_sizing(1.4);
  const TetMesh before = filled(rough_balls(), sizing);
  OptimiseParams params;
  params.min_dihedral_deg = 40;
  params.insertion_deg = 38;
  RunContext ctx;
  std::string note;
  ctx.on_note = [&](const std::string&, const std::string& message) { note = message; };
  const Result<TetMesh> after = optimise_tets(before, surface, sizing, params, ctx);
  ASSERT_TRUE(after.ok());
  for (const char* what : {"edges removed: 0", "faces removed: 0", "moved: 0", "inserted: 0", "surface: 0"})
    EXPECT_EQ(note.find(what), std::string::npos) << note;
  EXPECT_EQ(digest_of(*after), digest_of(optimise(before, surface, sizing, params)));
  EXPECT_EQ(digest_of(*after), "2300ffc57ed9822da058549ec983477b6d39cd6213f2a86f89ed9de11a7ef4bb");
}

TEST(OptimiseTets, LeavesTheMeshAloneInNoRounds) {
  const TetMesh cube = test::kuhn_cube(2);
  OptimiseParams params;
  params.rounds = 0;
  EXPECT_EQ(digest_of(optimise_fixed(cube, test::uniform_sizing(5), params)), digest_of(cube));
}

TEST(OptimiseTets, StopsWhenCancelledAndReportsProgress) {
  const TetMesh cube = test::kuhn_cube(8);
  RunContext ctx;
  double reached = 0;
  ctx.on_progress = [&](const std::string& stage, double fraction) {
    EXPECT_EQ(stage, "optimise");
    EXPECT_GE(fraction, reached);
    reached = fraction;
  };
  std::string note;
  ctx.on_note = [&](const std::string&, const std::string& message) { note = message; };
  ASSERT_TRUE(optimise_tets(cube, {}, test::uniform_sizing(1.25), {}, ctx).ok());
  EXPECT_EQ(reached, 1);
  EXPECT_NE(note.find("edges removed"), std::string::npos);
  ctx.on_progress = nullptr;
  const TetMesh worse = random_mesh(8, 800, 1);
  for (const int answered : {0, 1, 5}) {
    int questions = 0;
    ctx.on_cancelled = [&] { return ++questions > answered; };
    const Result<TetMesh> cancelled = optimise_tets(worse, {}, test::uniform_sizing(1.25), {}, ctx);
    ASSERT_FALSE(cancelled.ok());
    EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(questions, answered + 1) << "asked again after the answer";
  }
}

}  // namespace
}  // namespace voxtet
