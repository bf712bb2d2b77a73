#include "quality/measure_quality.h"
#include "quality/tet_measure_table.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "quality/fidelity.h"
#include "support/labelled_mesh.h"
#include "support/test_surfaces.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

const MetricSummary& metric(const QualityReport& report, const std::string& name) {
  for (const MetricSummary& m : report.metrics)
    if (m.name == name) return m;
  throw std::runtime_error("no metric " + name);
}

std::vector<std::string> failed(const QualityReport& report) {
  std::vector<std::string> names;
  for (const ChecklistItem& item : report.checklist)
    if (!item.passed) names.push_back(item.name);
  return names;
}

QualityReport measured(const TetMesh& mesh) {
  RunContext ctx;
  const Result<QualityReport> report = measure_mesh(mesh, {}, ctx);
  EXPECT_TRUE(report.ok());
  return *report;
}

/// Voxels of size 10/n on the cells of kuhn_cube's undisplaced lattice, labelled alike, one background voxel
/// around.
LabelVolume cube_voxels(int n) {
  LabelVolume volume;
  volume.size = {n + 2, n + 2, n + 2};
  const double edge = 10.0 / n;
  volume.index_to_mm.topLeftCorner<3, 3>() *= edge;
  volume.index_to_mm.topRightCorner<3, 1>() = Vector3d(-10, 15, -2) - 0.5 * edge * Vector3d::Ones();
  volume.labels.assign(volume.voxel_count(), 0);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        volume.labels[volume.offset(i + 1, j + 1, k + 1)] = i + j + k == 0 ? 7 : 2 * k < n ? 1 : 300;
  return volume;
}

/// kuhn_cube without its displacement.
TetMesh straight_cube(std::uint32_t n) {
  TetMesh mesh = test::kuhn_cube(n);
  std::size_t at = 0;
  for (std::uint32_t k = 0; k <= n; ++k)
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i)
        mesh.points[at++] = Vector3d(-10, 15, -2) + 10.0 / n * Vector3d(i, j, k);
  return mesh;
}

SizingField constant_size(double h_mm) {
  SizingField field;
  field.size = {2, 2, 2};
  field.h_mm.assign(8, static_cast<float>(h_mm));
  return field;
}

SurfaceMesh faces_of(const TetMesh& mesh) {
  return {mesh.points, mesh.faces, mesh.face_sides};
}

TEST(MeasureQuality, IsExactOnAMeshMadeOfVoxels) {
  const TetMesh mesh = straight_cube(6);
  const LabelVolume volume = cube_voxels(6);
  const SizingField sizing = constant_size(10.0 / 6);
  const SurfaceMesh surface = faces_of(mesh);
  RunContext ctx;
  const Result<QualityReport> report =
      measure_quality(mesh, {volume, volume, surface, surface, sizing}, {}, ctx);
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(failed(*report).empty()) << failed(*report).front();
  ASSERT_EQ(report->labels.size(), 3U);
  for (const LabelFidelity& f : report->labels) {
    EXPECT_EQ(f.dice, 1) << f.label;
    EXPECT_NEAR(f.volume_error_percent, 0, 1e-9);
    EXPECT_NEAR(f.mesh_mm3, f.voxel_mm3, 1e-9);
    EXPECT_EQ(f.tets, 6 * f.voxels);
    EXPECT_NEAR(f.target_edge_mm, 10.0 / 6, 1e-6);
  }
  EXPECT_EQ(report->labels[0].label, 1);
  EXPECT_EQ(report->labels[1].voxels, 1U);
  EXPECT_NEAR(report->mesh_to_surface.max_mm, 0, 1e-12);
  EXPECT_NEAR(report->surface_to_mesh.max_mm, 0, 1e-12);
  // Kuhn's tetrahedron: edges 1, sqrt 2, sqrt 3; dihedral angles 45, 60 and 90 degrees.
  EXPECT_NEAR(metric(*report, "min_dihedral_deg").min, 45, 1e-4);
  EXPECT_NEAR(metric(*report, "max_dihedral_deg").max, 90, 1e-4);
  EXPECT_NEAR(metric(*report, "edge_mm").min, 10.0 / 6, 1e-6);
  EXPECT_NEAR(metric(*report, "edge_mm").max, 10.0 / 6 * std::sqrt(3), 1e-6);
  EXPECT_NEAR(metric(*report, "size_log2").max, std::log2(std::sqrt(3)), 1e-6);
  EXPECT_NEAR(metric(*report, "triangle_min_angle_deg").min, 45, 1e-4);
  EXPECT_EQ(metric(*report, "dihedral_deg").count, 6 * mesh.tets.size());
}

TEST(MeasureQuality, NoticesALabelThatIsMissingOrOfTheWrongSize) {
  const TetMesh mesh = straight_cube(6);
  const SizingField sizing = constant_size(1);
  const SurfaceMesh surface = faces_of(mesh);
  RunContext ctx;
  const auto failures = [&](const std::function<void(LabelVolume&)>& change) {
    LabelVolume volume = cube_voxels(6);
    change(volume);
    return failed(*measure_quality(mesh, {volume, volume, surface, surface, sizing}, {}, ctx));
  };
  EXPECT_EQ(failures([](LabelVolume& v) { v.labels[v.offset(7, 7, 7)] = 9; }),
            (std::vector<std::string>{"labels_present"}));
  EXPECT_EQ(failures([](LabelVolume& v) {
              for (Label& label : v.labels) label = label == 7 ? Label{1} : label;
            }),
            (std::vector<std::string>{"labels_present"}))
      << "label 7 of the mesh is in no voxel";
  EXPECT_EQ(failures([](LabelVolume& v) {
              for (int i = 1; i < 4; ++i) v.labels[v.offset(i, 6, 6)] = 0;
            }),
            (std::vector<std::string>{"label_volumes"}));
}

TEST(MeasureQuality, WarnsOfVolumesThatAreOffWithARemedy) {
  const TetMesh mesh = straight_cube(6);
  LabelVolume volume = cube_voxels(6);
  for (int i = 1; i < 4; ++i) volume.labels[volume.offset(i, 6, 6)] = 0;
  const SizingField sizing = constant_size(1);
  const SurfaceMesh surface = faces_of(mesh);
  std::vector<std::string> warnings;
  RunContext ctx;
  ctx.on_warning = [&](const std::string&, const std::string& text) { warnings.push_back(text); };
  ASSERT_TRUE(measure_quality(mesh, {volume, volume, surface, surface, sizing}, {}, ctx).ok());
  ASSERT_EQ(warnings.size(), 1U);
  for (const char* part : {"voxels (", "% more volume", "--edge-label "})
    EXPECT_NE(warnings[0].find(part), std::string::npos) << part << " in: " << warnings[0];
}

TEST(MeasureQuality, NamesWhatTheMeshHasNotKeptOfTheLabelSurface) {
  const TetMesh mesh = straight_cube(6);
  const LabelVolume volume = cube_voxels(6);
  const SizingField sizing = constant_size(1);
  RunContext ctx;
  // The surface has one more cell of label 300, apart from the rest, that the mesh lost.
  SurfaceMesh surface = faces_of(mesh);
  test::append(surface, test::sphere({50, 0, 0}, 1, 1, 300, 0));
  const Result<QualityReport> report =
      measure_quality(mesh, {volume, volume, surface, surface, sizing}, {}, ctx);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(failed(*report), (std::vector<std::string>{"topology_kept"}));
  EXPECT_TRUE(report->passed()) << "a warning, not a failure";
  for (const ChecklistItem& item : report->checklist)
    if (item.name == "topology_kept") {
      EXPECT_EQ(item.found, "label 300: components 2 -> 1");
    }
  EXPECT_EQ(report->topology.before.labels.size(), 3U);
  EXPECT_EQ(report->topology.before.contacts, report->topology.after.contacts);
  EXPECT_EQ(report->topology.differences.size(), 1U);
}

TEST(MeasureMesh, FailsExactlyTheItemThatIsBroken) {
  const TetMesh good = test::kuhn_cube(3);
  EXPECT_TRUE(failed(measured(good)).empty());
  const auto failures = [&](const std::function<void(TetMesh&)>& break_it) {
    TetMesh mesh = good;
    break_it(mesh);
    const QualityReport report = measured(mesh);
    return failed(report);
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(failures([](TetMesh& m) { m.points.push_back({0, 0, 0}); }), (Names{"no_unused_points"}));
  EXPECT_EQ(failures([](TetMesh& m) { std::swap(m.tets[5][0], m.tets[5][1]); }).front(), "no_inverted_tets");
  const Names twice = failures([](TetMesh& m) {
    m.tets.push_back(m.tets[80]);
    m.labels.push_back(m.labels[80]);
  });
  EXPECT_NE(std::find(twice.begin(), twice.end(), "no_duplicate_tets"), twice.end());
  EXPECT_NE(std::find(twice.begin(), twice.end(), "faces_on_at_most_two_tets"), twice.end());
  const Names infinite =
      failures([](TetMesh& m) { m.points[21].x() = std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_EQ(infinite.front(), "finite_coordinates");
  const Names doubled = failures([](TetMesh& m) {
    m.points.push_back(m.points[m.tets[0][0]]);
    m.tets[0][0] = static_cast<std::uint32_t>(m.points.size() - 1);
  });
  EXPECT_NE(std::find(doubled.begin(), doubled.end(), "no_duplicate_points"), doubled.end());
}

/// A plate of 24 x 24 x t cells of 1 mm, and its voxels of which one in a hundred is missing.
ChecklistItem volume_item_of_plate(int t) {
  const TetMesh cube = straight_cube(24);
  TetMesh plate;
  for (const Vector3d& p : cube.points)
    plate.points.push_back((p - Vector3d(-10, 15, -2)) * 2.4 + Vector3d::Constant(0.5));
  for (const Tet& tet : cube.tets) {
    double top = 0;
    for (const std::uint32_t v : tet) top = std::max(top, plate.points[v].z());
    if (top > t + 0.6) continue;
    plate.tets.push_back(tet);
    plate.labels.push_back(1);
  }
  LabelVolume volume;
  volume.size = {26, 26, t + 2};
  volume.labels.assign(volume.voxel_count(), 0);
  int missing = 24 * 24 * t / 100;
  for (int k = 1; k <= t; ++k)
    for (int j = 1; j <= 24; ++j)
      for (int i = 1; i <= 24; ++i) volume.labels[volume.offset(i, j, k)] = missing-- > 0 ? 0 : 1;
  const SurfaceMesh surface = faces_of(test::kuhn_cube(1));
  const SizingField sizing = constant_size(1);
  RunContext ctx;
  const Result<QualityReport> report =
      measure_quality(plate, {volume, volume, surface, surface, sizing}, {}, ctx);
  EXPECT_NEAR(report->labels[0].volume_error_percent, 1, 0.1);
  for (const ChecklistItem& item : report->checklist)
    if (item.name == "label_volumes") return item;
  throw std::runtime_error("no label_volumes");
}

TEST(MeasureQuality, HoldsThinLabelsToTwoPercentAndThickOnesToHalfOfOne) {
  EXPECT_TRUE(volume_item_of_plate(2).passed);
  EXPECT_FALSE(volume_item_of_plate(8).passed);
}

TEST(MeasureQuality, SeesFacesThatAreNotThoseOfTheTets) {
  const TetMesh good = straight_cube(4);
  const LabelVolume volume = cube_voxels(4);
  const SizingField sizing = constant_size(1);
  const SurfaceMesh surface = faces_of(good);
  RunContext ctx;
  const auto found = [&](const std::function<void(TetMesh&)>& break_it) {
    TetMesh mesh = good;
    break_it(mesh);
    const Result<QualityReport> report =
        measure_quality(mesh, {volume, volume, surface, surface, sizing}, {}, ctx);
    EXPECT_EQ(failed(*report), (std::vector<std::string>{"faces_match_tets"}));
    EXPECT_FALSE(report->passed());
    for (const ChecklistItem& item : report->checklist)
      if (item.name == "faces_match_tets") return item.found.substr(0, item.found.find(' '));
    return std::string();
  };
  EXPECT_EQ(found([](TetMesh& m) {
              m.faces.pop_back();
              m.face_sides.pop_back();
            }),
            "1");
  EXPECT_EQ(found([](TetMesh& m) {
              m.faces.push_back(m.faces[3]);
              m.face_sides.push_back(m.face_sides[3]);
            }),
            "1");
  // The diagonal path of a cell: between two tetrahedra of one label.
  EXPECT_EQ(found([](TetMesh& m) { m.faces[7] = {m.tets[200][0], m.tets[200][1], m.tets[200][3]}; }), "2");
  EXPECT_EQ(found([](TetMesh& m) { std::swap(m.faces[5][0], m.faces[5][1]); }), "1");
  EXPECT_EQ(found([](TetMesh& m) { m.face_sides[5][0] = 9; }), "1");
}

TEST(MeasureQuality, GivesTheChecklistAloneWhenAPointHasNoPlace) {
  TetMesh mesh = straight_cube(4);
  const LabelVolume volume = cube_voxels(4);
  const SizingField sizing = constant_size(1);
  const SurfaceMesh surface = faces_of(mesh);
  for (std::size_t i = 10; i < 100; i += 7) mesh.points[i].y() = std::numeric_limits<double>::quiet_NaN();
  RunContext ctx;
  const Result<QualityReport> report =
      measure_quality(mesh, {volume, volume, surface, surface, sizing}, {}, ctx);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(failed(*report), (std::vector<std::string>{"finite_coordinates", "min_dihedral"}));
  EXPECT_EQ(report->checklist.front().found, "13 of 125 points not finite");
  EXPECT_TRUE(report->metrics.empty());
  EXPECT_EQ(find_field(measure_tets(mesh, &sizing, 1), "size_log2")->values.size(), mesh.tets.size());
}

TEST(MeasureQuality, StopsWhenCancelledAtEveryPoll) {
  const TetMesh mesh = straight_cube(4);
  const LabelVolume volume = cube_voxels(4);
  const SizingField sizing = constant_size(1);
  const SurfaceMesh surface = faces_of(mesh);
  for (int after = 0; after < 3; ++after) {
    RunContext ctx;
    int asked = 0;
    ctx.on_cancelled = [&] { return asked++ >= after; };
    const Result<QualityReport> report =
        measure_quality(mesh, {volume, volume, surface, surface, sizing}, {}, ctx);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, ErrorCode::kCancelled);
  }
}

TEST(MeasureQuality, IsTheSameForAnyNumberOfThreads) {
  const TetMesh mesh = test::kuhn_cube(9);
  const LabelVolume volume = cube_voxels(9);
  const SizingField sizing = constant_size(1);
  const SurfaceMesh surface = faces_of(mesh), other = faces_of(straight_cube(9));
  const auto with = [&](int threads) {
    RunContext ctx;
    ctx.threads = threads;
    return measure_quality(mesh, {volume, volume, other, surface, sizing}, {}, ctx).value();
  };
  const auto numbers = [](const QualityReport& report) {
    std::vector<double> all;
    for (const MetricSummary& m : report.metrics) {
      all.insert(all.end(), {m.min, m.p01, m.p1, m.p5, m.median, m.p95, m.p99, m.max, m.mean, m.sd});
      all.insert(all.end(), m.worst.begin(), m.worst.end());
    }
    for (const DistanceSummary& d : {report.mesh_to_surface, report.surface_to_mesh})
      all.insert(all.end(), {d.mean_mm, d.rms_mm, d.p95_mm, d.max_mm, d.uncertainty_mm});
    return all;
  };
  const std::vector<double> one = numbers(with(1));
  EXPECT_GT(one.size(), 100U);
  for (const int threads : {2, 3}) EXPECT_EQ(numbers(with(threads)), one) << threads;
}

TEST(MeasureMesh, CountsFlatTetsAndNearlyEqualPoints) {
  TetMesh flat;
  flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, 0.3, -1e-13}};
  flat.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  flat.labels = {1, 1};
  EXPECT_EQ(failed(measured(flat)), (std::vector<std::string>{"no_inverted_tets", "min_dihedral"}));
  TetMesh near;
  near.points = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1e-10, 0}, {0, 1 + 1e-10, 1e-10}};
  near.tets = {{0, 1, 2, 3}, {0, 6, 5, 4}};
  near.labels = {1, 1};
  EXPECT_EQ(failed(measured(near)),
            (std::vector<std::string>{"no_duplicate_points", "label_boundaries_manifold"}));
  near.points[5].x() += 1e-6;
  near.points[6].x() += 1e-6;
  EXPECT_EQ(failed(measured(near)), (std::vector<std::string>{"label_boundaries_manifold"}))
      << "the two share one corner";
}

TEST(MeasureMesh, SeesThreeTetsOnOneFace) {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.5, 0.5, 1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}};
  mesh.labels = {1, 1, 1};
  EXPECT_EQ(failed(measured(mesh)),
            (std::vector<std::string>{"faces_on_at_most_two_tets", "label_boundaries_closed",
                                      "label_boundaries_manifold"}));
}

TEST(MeasureMesh, SeesBranchingAndFlatness) {
  TetMesh pair;  // two tetrahedra that share one edge only
  pair.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  pair.tets = {{0, 1, 2, 3}, {0, 1, 4, 5}};
  pair.labels = {1, 1};
  EXPECT_EQ(failed(measured(pair)), (std::vector<std::string>{"label_boundaries_manifold"}));
  TetMesh flat;
  flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.01}};
  flat.tets = {{0, 1, 2, 3}};
  flat.labels = {1};
  EXPECT_EQ(failed(measured(flat)), (std::vector<std::string>{"min_dihedral"}));
  EXPECT_TRUE(measured(flat).passed()) << "a flat tetrahedron is bad but not unusable";
}

TEST(MeasureMesh, RefusesIndicesOutOfRangeAndEmptyMeshes) {
  TetMesh mesh = test::kuhn_cube(1);
  mesh.tets[2][1] = 99;
  RunContext ctx;
  const Result<QualityReport> report = measure_mesh(mesh, {}, ctx);
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.error().message.find("tetrahedron 2 refers to point 99 of 8"), std::string::npos);
  EXPECT_EQ(measure_mesh(TetMesh{}, {}, ctx).error().code, ErrorCode::kBadInput);
  ctx.on_cancelled = [] { return true; };
  EXPECT_EQ(measure_mesh(test::kuhn_cube(1), {}, ctx).error().code, ErrorCode::kCancelled);
}

TEST(MeasureTets, GivesOneValueForEachTet) {
  const TetMesh mesh = test::kuhn_cube(2);
  const SizingField sizing = constant_size(2);
  const std::vector<Field> fields = measure_tets(mesh, &sizing, 1);
  ASSERT_EQ(fields.size(), tet_measures().size());
  for (const Field& field : fields) EXPECT_EQ(field.values.size(), mesh.tets.size()) << field.name;
  EXPECT_NEAR(
      find_field(fields, "size_log2")->values[3],
      std::log2(find_field(fields, "edge_mm")->values[3] / find_field(fields, "target_mm")->values[3]), 1e-6);
  EXPECT_EQ(find_field(measure_tets(mesh, nullptr, 1), "size_log2"), nullptr);
}

TEST(MeasureTets, ScaledJacobianIsOneForTheRegularTetAndNegativeForAnInvertedOne) {
  TetMesh mesh;
  mesh.points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1},
                 {0, 0, 0}, {1, 0, 0},   {0, 1, 0},   {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 3}, {4, 5, 6, 7}};
  mesh.labels = {1, 1, 1};
  const std::vector<Field> fields = measure_tets(mesh, nullptr, 1);
  const std::vector<float>& found = find_field(fields, "scaled_jacobian")->values;
  const float sign = found[0] > 0 ? 1.F : -1.F;
  EXPECT_NEAR(sign * found[0], 1, 1e-6);
  EXPECT_NEAR(sign * found[1], -1, 1e-6);
  EXPECT_NEAR(found[2], std::sqrt(2.0) / 2, 1e-6) << "the corner of a cube";
}

}  // namespace
}  // namespace voxtet
