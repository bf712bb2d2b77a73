#include "pipeline/exports/exported_fields.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "anatomy/facet_sets.h"
#include "geometry/cut/cut_faces.h"
#include "pipeline/exports/unmeshed_sides.h"

namespace voxtet {
namespace {

void append(const std::vector<Field>& from, std::vector<Field>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Of `more` those on a kind of elements that all have values.
void append_on(On on, const std::vector<Field>& more, std::vector<Field>& fields) {
  std::copy_if(more.begin(), more.end(), std::back_inserter(fields),
               [on](const Field& field) { return field.on == on && all_finite(field.values); });
}

std::vector<Field> tet_fields(const Session& session, bool measures) {
  std::vector<Field> fields;
  if (session.transfer()) append(session.transfer()->fields, fields);
  if (const auto* fibres = session.result<FibresResult>(Stage::kFibres)) append(fibres->fields, fields);
  if (session.mechanics()) append_on(On::kTets, session.mechanics()->last.fields, fields);
  if (measures && session.quality())
    std::copy_if(session.quality()->fields.begin(), session.quality()->fields.end(),
                 std::back_inserter(fields),
                 [](const Field& field) { return field.on == On::kTets && all_finite(field.values); });
  return fields;
}

std::vector<Field> point_fields(const Session& session) {
  std::vector<Field> fields;
  if (session.eikonal()) append(session.eikonal()->fields, fields);
  if (session.monodomain()) append(session.monodomain()->fields, fields);
  if (session.mechanics()) append_on(On::kPoints, session.mechanics()->last.fields, fields);
  return fields;
}

/// Of all faces whether one of these sets has them.
std::vector<bool> faces_in(std::span<const NamedSet> sets, std::size_t face_count) {
  std::vector<bool> faces(face_count, false);
  for (const NamedSet& set : sets)
    for (const std::uint32_t face : set.members) faces[face] = true;
  return faces;
}

void leave_out_of(NamedSet& set, const std::vector<bool>& faces) {
  std::erase_if(set.members, [&](std::uint32_t face) { return faces[face]; });
}

/// Adds of each set what no other surface has.
void add_rest(std::vector<NamedSet> sets, std::size_t face_count, std::vector<NamedSet>& surfaces) {
  const std::vector<bool> named = faces_in(surfaces, face_count);
  for (NamedSet& set : sets) {
    leave_out_of(set, named);
    if (!set.members.empty()) surfaces.push_back(std::move(set));
  }
}

/// Cuts that were asked for have all of their faces, and take the place of a surface of the same name. Those
/// of the image's border have what no other surface has.
void add_cuts(const TetMesh& mesh, const CutPlanes& cuts, std::vector<NamedSet>& surfaces) {
  CutPlanes given = cuts;
  std::erase_if(given, [](const CutPlane& cut) { return !cut.is_given(); });
  for (NamedSet& set : cut_sets(mesh, given)) {
    const std::vector<bool> own = faces_in({&set, 1}, mesh.faces.size());
    for (NamedSet& other : surfaces) leave_out_of(other, own);
    std::erase_if(surfaces,
                  [&](const NamedSet& other) { return other.name == set.name || other.members.empty(); });
    surfaces.push_back(std::move(set));
  }
  add_rest(cut_sets(mesh, cuts_of_border(cuts)), mesh.faces.size(), surfaces);
}

/// Removes the fields that the format has no place for; returns their names.
std::vector<std::string> leave_out(std::vector<Field>& fields, MeshFormat format) {
  std::vector<std::string> names;
  std::erase_if(fields, [&](const Field& field) {
    const bool fits = has_place_for(field.on, field.components, format);
    if (!fits) names.push_back(field.name);
    return !fits;
  });
  return names;
}

}  // namespace

Exported exported_fields(const Session& session, MeshFormat format, bool measures) {
  Exported out;
  out.options.infos = session.label_infos();
  out.options.cell_data = tet_fields(session, measures);
  out.options.point_data = point_fields(session);
  for (auto* fields : {&out.options.cell_data, &out.options.point_data})
    for (std::string& name : leave_out(*fields, format)) out.left_out.push_back(std::move(name));
  const auto* anatomy = session.result<AnatomyResult>(Stage::kAnatomy);
  if (anatomy && anatomy->surfaces) out.options.surfaces = facet_sets(*anatomy->surfaces);
  add_cuts(*session.mesh(), session.result<VolumeResult>(Stage::kVolume)->prepared.cuts,
           out.options.surfaces);
  if (!session.opened_mesh()) {
    const LabelVolume& image = *session.result<VolumeResult>(Stage::kVolume)->prepared.anatomy;
    const auto infos = with_legend(session.source_volume()->infos, session.recipe().legend);
    add_rest(unmeshed_sides(*session.mesh(), image, infos), session.mesh()->faces.size(),
             out.options.surfaces);
  }
  if (!has_place_for_surfaces(format))
    for (NamedSet& set : std::exchange(out.options.surfaces, {})) out.left_out.push_back(std::move(set.name));
  return out;
}

}  // namespace voxtet
