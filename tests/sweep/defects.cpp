#include "sweep/defects.h"

#include <algorithm>
#include <map>
#include <regex>

#include "geometry/elements/surface_measures.h"
#include "geometry/intersect/exact_intersections.h"
#include "geometry/topology/label_topology.h"
#include "support/caught_failures.h"
#include "support/check_surface.h"
#include "support/check_tets.h"
#include "tetra/fill/check_surface.h"
#include "volume/select_labels.h"

namespace voxtet::sweep {
namespace {

/// What the tetrahedra of a label fill is what their faces enclose, and what the surface does but for the
/// flips that fill_tets.h allows.
void check_boundary(const TetMesh& mesh, const SurfaceMesh& surface) {
  constexpr double kFlips = 5e-3;
  const SurfaceMesh faces{mesh.points, mesh.faces, mesh.face_sides};
  std::map<Label, double> filled;
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) filled[mesh.labels[t]] += test::tet_volume(mesh, t);
  for (const Label label : test::labels_of(surface)) {
    EXPECT_NEAR(filled[label] / enclosed_volume_mm3(faces, label), 1, 1e-9) << "label " << label;
    EXPECT_NEAR(filled[label] / enclosed_volume_mm3(surface, label), 1, kFlips) << "label " << label;
  }
  EXPECT_EQ(label_topology(faces), label_topology(surface));
}

}  // namespace

void find_surface_defects(const std::string& stage, const SurfaceMesh& surface,
                          std::vector<Defect>& defects) {
  const std::string fault = test::surface_fault(surface);
  if (fault.find("missing point") != std::string::npos) return defects.push_back({stage, "unsound", fault});
  if (!fault.empty()) {
    std::size_t edges = 0, points = 0;
    for (const test::LabelTopology& label : test::label_topologies(surface)) {
      edges += label.bad_edges;
      points += label.pinched_points;
    }
    if (edges) defects.push_back({stage, "edge", std::to_string(edges) + " edges"});
    if (points) defects.push_back({stage, "point", std::to_string(points) + " points"});
    if (edges + points == 0) defects.push_back({stage, "unsound", fault});
  }
  if (const std::size_t pairs = count_self_intersections(surface))
    defects.push_back({stage, "intersection", std::to_string(pairs) + " pairs of triangles"});
  if (const Status apart = check_overlaps(surface, EdgeGroups(surface)); !apart)
    defects.push_back({stage, "overlap", apart.error().message});
}

void find_tet_defects(const TetMesh& mesh, const SurfaceMesh& surface, std::vector<Defect>& defects) {
  const std::string failures = test::caught_failures([&] {
    test::check_tets(mesh);
    check_boundary(mesh, surface);
  });
  if (!failures.empty()) defects.push_back({"tetra", "unsound", failures});
}

bool names_label(const Session& session, Label label) {
  std::vector<std::string> messages = session.warnings();
  for (int i = 0; i < kStageCount; ++i) {
    const std::vector<std::string>& notes = session.record(static_cast<Stage>(i)).notes;
    messages.insert(messages.end(), notes.begin(), notes.end());
  }
  // "label 3", or one of "labels 1, 3 and 4"; other numbers of a message name nobody.
  const std::regex name("\\blabels? (\\d+(, | and ))*" + std::to_string(label) + "\\b");
  return std::any_of(messages.begin(), messages.end(),
                     [&](const std::string& text) { return std::regex_search(text, name); });
}

void find_lost_labels(const std::string& stage, const Session& session, const std::vector<Label>& present,
                      std::vector<Defect>& defects) {
  for (const auto& [label, voxels] : count_labels(*session.volume()))
    if (std::find(present.begin(), present.end(), label) == present.end() && !names_label(session, label))
      defects.push_back(
          {stage, "lost", "label " + std::to_string(label) + " of " + std::to_string(voxels) + " voxels"});
}

}  // namespace voxtet::sweep
