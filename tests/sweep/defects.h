// What a sweep can find wrong with the results of one case.
#pragma once

#include <string>
#include <vector>

#include "pipeline/session.h"
#include "types/surface_mesh.h"

namespace voxtet::sweep {

struct Defect {
  std::string stage, kind, detail;
};

/// Every label's boundary closed with two triangles an edge ("edge") and one fan a point ("point"), nothing
/// else wrong with the complex ("unsound"), no triangles that meet apart from their common corners
/// ("intersection", by exact_intersections.h), no labels that overlap ("overlap").
void find_surface_defects(const std::string& stage, const SurfaceMesh& surface, std::vector<Defect>& defects);

/// Positive tetrahedra, their faces closed around every label, the volume and the topology of each label
/// those of the adapted surface, as fill_tets.h promises.
void find_tet_defects(const TetMesh& mesh, const SurfaceMesh& surface, std::vector<Defect>& defects);

/// Whether a warning or note of the session speaks of this label.
bool names_label(const Session& session, Label label);

/// Labels of the volume that a stage's result lacks although no warning or note names them ("lost").
void find_lost_labels(const std::string& stage, const Session& session, const std::vector<Label>& present,
                      std::vector<Defect>& defects);

}  // namespace voxtet::sweep
