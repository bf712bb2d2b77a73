#include "io/mesh/write/write_msh.h"

#include <algorithm>
#include <limits>
#include <string>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/element_nodes.h"
#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {
namespace {

/// Gmsh's numbers of the element types, of first and second order.
constexpr std::int32_t kGmshTriangle = 2, kGmshTriangle6 = 9;
constexpr std::int32_t kGmshTetrahedron = 4, kGmshTetrahedron10 = 11;

struct Box {
  Eigen::Vector3d lo = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d hi = -lo;
  void add(const Eigen::Vector3d& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
};

struct Entity {
  std::int32_t dimension = 0;
  std::int32_t tag = 0;
  std::vector<std::int32_t> groups;  ///< physical ones
  Box box;
  std::vector<std::int32_t> bounded_by;
  std::vector<std::uint32_t> nodes, elements;
};

/// Faces with the same two sides and of the same named surface.
struct Patch {
  std::uint32_t pair = 0;
  std::int32_t set = 0;  ///< number of the surface, from 1; 0: none
  auto operator<=>(const Patch&) const = default;
};

/// Surfaces first, a patch each, then volumes: the order in which Gmsh stores them.
struct Model {
  FaceGroups faces;
  std::vector<Patch> patches;  ///< ascending
  LabelGroups tets;
  std::vector<Entity> entities;
};

/// The patch of each face.
std::vector<Patch> patches_of_faces(const FaceGroups& faces, const std::vector<NamedSet>& sets) {
  const std::vector<std::int32_t> numbers = set_numbers(sets, faces.of_face.size());
  std::vector<Patch> patches;
  for (std::size_t f = 0; f < numbers.size(); ++f) patches.push_back({faces.of_face[f], numbers[f]});
  return patches;
}

std::uint32_t volume_place(const Model& model, Label label) {
  const auto& labels = model.tets.labels;
  const auto at = std::lower_bound(labels.begin(), labels.end(), label);
  return at == labels.end() || *at != label
             ? std::numeric_limits<std::uint32_t>::max()
             : static_cast<std::uint32_t>(model.patches.size() +
                                          static_cast<std::size_t>(at - labels.begin()));
}

void create_entities(Model& model) {
  const auto pairs = static_cast<std::int32_t>(model.faces.pairs.size());
  model.entities.resize(model.patches.size() + model.tets.labels.size());
  for (std::size_t i = 0; i < model.tets.labels.size(); ++i) {
    Entity& volume = model.entities[model.patches.size() + i];
    volume.dimension = 3;
    volume.tag = model.tets.labels[i];
    volume.groups = {volume.tag};
  }
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    const Patch& patch = model.patches[i];
    Entity& surface = model.entities[i];
    surface.dimension = 2;
    surface.tag = static_cast<std::int32_t>(i + 1);
    // The named surface first: some readers take only one group.
    if (patch.set > 0) surface.groups.push_back(pairs + patch.set);
    surface.groups.push_back(static_cast<std::int32_t>(patch.pair + 1));
    const std::uint32_t behind = volume_place(model, model.faces.pairs[patch.pair][0]);
    const std::uint32_t front = volume_place(model, model.faces.pairs[patch.pair][1]);
    if (behind < model.entities.size()) model.entities[behind].bounded_by.push_back(surface.tag);
    if (front < model.entities.size()) model.entities[front].bounded_by.push_back(-surface.tag);
  }
}

/// Gives elements to their entities, and each point to the first surface it lies on, else to its volume.
Model build_model(const TetMesh& mesh, const WriteMeshOptions& options) {
  Model model{group_faces(mesh.face_sides), {}, group_tets(mesh.labels), {}};
  const std::vector<Patch> patches = patches_of_faces(model.faces, options.surfaces);
  model.patches = patches;
  std::sort(model.patches.begin(), model.patches.end());
  model.patches.erase(std::unique(model.patches.begin(), model.patches.end()), model.patches.end());
  create_entities(model);
  const auto none = static_cast<std::uint32_t>(model.entities.size());
  std::vector<std::uint32_t> owner(mesh.points.size(), none);
  const auto add = [&](std::uint32_t place, std::size_t element, const ElementNodes& nodes) {
    Entity& entity = model.entities[place];
    entity.elements.push_back(static_cast<std::uint32_t>(element));
    for (const std::uint32_t node : nodes) {
      entity.box.add(in_space(mesh.points[node], options.space));
      owner[node] = std::min(owner[node], place);
    }
  };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto patch = std::lower_bound(model.patches.begin(), model.patches.end(), patches[f]);
    add(static_cast<std::uint32_t>(patch - model.patches.begin()), f,
        nodes_of_face(mesh.faces, f, mesh.points.size(), options));
  }
  const auto first_volume = static_cast<std::uint32_t>(model.patches.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    add(first_volume + model.tets.of_tet[t], t, gmsh_nodes_of_tet(mesh, t, options));
  for (std::size_t p = 0; p < owner.size(); ++p)
    model.entities[owner[p] == none ? none - 1 : owner[p]].nodes.push_back(static_cast<std::uint32_t>(p));
  return model;
}

void write_names(ByteWriter& out, const Model& model, const WriteMeshOptions& options) {
  const std::vector<Label>& labels = model.tets.labels;
  const std::vector<std::string> names = group_names(labels, options.infos);
  std::vector<std::string> surfaces;
  for (const Sides& pair : model.faces.pairs) surfaces.push_back(pair_name(pair, labels, names));
  for (const NamedSet& set : options.surfaces) surfaces.push_back(set.name);
  out.text("$PhysicalNames\n" + std::to_string(surfaces.size() + labels.size()) + "\n");
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    out.text("2 " + std::to_string(i + 1) + " \"" + surfaces[i] + "\"\n");
  for (std::size_t i = 0; i < labels.size(); ++i)
    out.text("3 " + std::to_string(labels[i]) + " \"" + names[i] + "\"\n");
  out.text("$EndPhysicalNames\n");
}

void write_entities(ByteWriter& out, const Model& model) {
  out.text("$Entities\n");
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{0}, model.patches.size(), model.tets.labels.size()})
    out.raw(std::uint64_t{count});
  for (const Entity& entity : model.entities) {
    out.raw(entity.tag);
    for (int d = 0; d < 3; ++d) out.raw(entity.box.lo[d]);
    for (int d = 0; d < 3; ++d) out.raw(entity.box.hi[d]);
    out.raw(std::uint64_t{entity.groups.size()});
    for (const std::int32_t group : entity.groups) out.raw(group);
    out.raw(std::uint64_t{entity.bounded_by.size()});
    for (const std::int32_t surface : entity.bounded_by) out.raw(surface);
  }
  out.text("\n$EndEntities\n");
}

void write_msh_nodes(ByteWriter& out, const Model& model, const TetMesh& mesh, PatientSpace space) {
  out.text("$Nodes\n");
  const auto blocks = std::count_if(model.entities.begin(), model.entities.end(),
                                    [](const Entity& entity) { return !entity.nodes.empty(); });
  for (const std::uint64_t value : {static_cast<std::uint64_t>(blocks), std::uint64_t{mesh.points.size()},
                                    std::uint64_t{1}, std::uint64_t{mesh.points.size()}})
    out.raw(value);
  for (const Entity& entity : model.entities) {
    if (entity.nodes.empty()) continue;
    out.raw(entity.dimension);
    out.raw(entity.tag);
    out.raw(std::int32_t{0});
    out.raw(std::uint64_t{entity.nodes.size()});
    for (const std::uint32_t node : entity.nodes) out.raw(std::uint64_t{node} + 1);
    for (const std::uint32_t node : entity.nodes) {
      const Eigen::Vector3d p = in_space(mesh.points[node], space);
      for (int d = 0; d < 3; ++d) out.raw(p[d]);
    }
  }
  out.text("\n$EndNodes\n");
}

void write_elements(ByteWriter& out, const Model& model, const TetMesh& mesh,
                    const WriteMeshOptions& options) {
  const std::int32_t tetrahedron = options.midside ? kGmshTetrahedron10 : kGmshTetrahedron;
  const std::int32_t triangle = options.midside ? kGmshTriangle6 : kGmshTriangle;
  const std::uint64_t count = mesh.tets.size() + mesh.faces.size();
  out.text("$Elements\n");
  for (const std::uint64_t value : {std::uint64_t{model.entities.size()}, count, std::uint64_t{1}, count})
    out.raw(value);
  for (const Entity& entity : model.entities) {
    out.raw(entity.dimension);
    out.raw(entity.tag);
    out.raw(entity.dimension == 3 ? tetrahedron : triangle);
    out.raw(std::uint64_t{entity.elements.size()});
    for (const std::uint32_t element : entity.elements) {
      if (entity.dimension == 3) {
        out.raw(std::uint64_t{element} + 1);
        for (const std::uint32_t node : gmsh_nodes_of_tet(mesh, element, options))
          out.raw(std::uint64_t{node} + 1);
      } else {
        out.raw(std::uint64_t{mesh.tets.size() + element + 1});
        for (const std::uint32_t node : nodes_of_face(mesh.faces, element, mesh.points.size(), options))
          out.raw(std::uint64_t{node} + 1);
      }
    }
  }
  out.text("\n$EndElements\n");
}

void write_format(ByteWriter& out) {
  out.text("$MeshFormat\n4.1 1 8\n");
  out.raw(std::int32_t{1});
  out.text("\n$EndMeshFormat\n");
}

Bytes write_cell_data(const std::vector<Field>& cell_data, std::size_t tets, PatientSpace space) {
  ByteWriter out(cell_data.size() * (28 * tets + 128) + 64);
  write_format(out);
  for (const Field& data : cell_data) {
    // One string tag: the name; one real: the time; three integers: step, components, elements.
    const auto components = static_cast<std::size_t>(data.components);
    out.text("$ElementData\n1\n\"" + data.name + "\"\n1\n0\n3\n0\n" + std::to_string(components) + "\n" +
             std::to_string(tets) + "\n");
    const std::vector<float> values = in_space(data, space);
    for (std::size_t t = 0; t < tets; ++t) {
      out.raw(static_cast<std::int32_t>(t + 1));
      for (std::size_t c = 0; c < components; ++c) out.raw(static_cast<double>(values[components * t + c]));
    }
    out.text("\n$EndElementData\n");
  }
  return out.take();
}

}  // namespace

std::vector<OutputFile> write_msh(const TetMesh& mesh, const WriteMeshOptions& options) {
  const Model model = build_model(mesh, options);
  ByteWriter out(32 * mesh.points.size() + 40 * mesh.tets.size() + 32 * mesh.faces.size() +
                 512 * (model.entities.size() + 1));
  write_format(out);
  out.text(std::string("$Comments\nspace ") + to_string(options.space) + "\nunit mm\n$EndComments\n");
  write_names(out, model, options);
  write_entities(out, model);
  write_msh_nodes(out, model, mesh, options.space);
  write_elements(out, model, mesh, options);
  std::vector<OutputFile> files{{".msh", out.take()}};
  if (!options.cell_data.empty())
    files.push_back({"_data.msh", write_cell_data(options.cell_data, mesh.tets.size(), options.space)});
  return files;
}

}  // namespace voxtet
