#include "io/mesh/read/text/read_vtk.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes/header_text.h"
#include "io/mesh/read/shared/found_labels.h"
#include "io/mesh/read/text/vtk_arrays.h"
#include "io/mesh/write/text/write_vtk.h"
#include "io/mesh/write/write_vtu.h"

namespace voxtet {
namespace {

const VtkArray* find_array(const std::vector<VtkArray>& arrays, std::string_view name) {
  const auto found =
      std::find_if(arrays.begin(), arrays.end(), [&](const VtkArray& array) { return array.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}

std::string names_of_arrays(const std::vector<VtkArray>& arrays) {
  std::string names;
  for (const VtkArray& array : arrays) {
    names += ' ';
    names += in_quotes(array.name);
  }
  return names.empty() ? " none" : names;
}

/// The tetrahedra, and the cell of each.
TetMesh tets_of(MeshCursor& in, const VtkFile& file, std::vector<std::size_t>& cells, std::uint64_t& curved) {
  TetMesh mesh;
  for (std::size_t i = 0; i + 2 < file.points.size() && in.ok(); i += 3) {
    mesh.points.emplace_back(file.points[i], file.points[i + 1], file.points[i + 2]);
    if (!mesh.points.back().allFinite())
      in.fail("POINTS: point " + std::to_string(i / 3) + " has a coordinate that is not finite");
  }
  for (std::size_t c = 0; c < file.types.size() && in.ok(); ++c) {
    if (file.types[c] != kVtkTetra && file.types[c] != kVtkQuadraticTetra) continue;
    const std::int64_t points = file.types[c] == kVtkTetra ? 4 : 10;
    if (file.offsets[c + 1] - file.offsets[c] != points) {
      in.fail("cell " + std::to_string(c) + " is a tetrahedron of type " + std::to_string(file.types[c]) +
              ", but has not " + std::to_string(points) + " points");
      break;
    }
    curved += points > 4 ? 1 : 0;
    Tet tet{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int64_t point = file.connectivity[static_cast<std::size_t>(file.offsets[c]) + k];
      if (point < 0 || static_cast<std::uint64_t>(point) >= mesh.points.size()) {
        in.fail("cell " + std::to_string(c) + ": point " + std::to_string(point) + ", expected 0 to " +
                std::to_string(static_cast<std::int64_t>(mesh.points.size()) - 1));
        break;
      }
      tet[k] = static_cast<std::uint32_t>(point);
    }
    mesh.tets.push_back(tet);
    cells.push_back(c);
  }
  return mesh;
}

void label_tets(MeshCursor& in, TetMesh& mesh, const VtkFile& file, const std::vector<std::size_t>& cells,
                const std::string& label_array, MeshArrays* arrays) {
  const std::string name = label_array.empty() ? "label" : label_array;
  const VtkArray* array = find_array(file.cell_data, name);
  if (!in.ok()) return;
  if (!array && label_array.empty() && !file.title.starts_with(kVtkTitle))
    return set_one_region(mesh,
                          "no cell array \"label\", found" + names_of_arrays(file.cell_data) +
                              " (--label-array NAME takes one)",
                          arrays);
  if (!array || array->components != 1 || array->values.size() != file.types.size())
    return in.fail("no cell array " + in_quotes(name) + " of one number for each cell, found" +
                   names_of_arrays(file.cell_data));
  std::vector<std::int64_t> labels;
  for (const std::size_t cell : cells) {
    const double value = array->values[cell];
    if (!(std::abs(value) < 1e15 && value == std::floor(value)))
      return in.fail("cell array " + in_quotes(name) + ": cell " + std::to_string(cell) + " has " +
                     number_text(value) + ", expected a whole number");
    labels.push_back(static_cast<std::int64_t>(value));
  }
  set_labels(in, mesh, labels, name, arrays);
}

void take_arrays(const VtkFile& file, const std::vector<std::size_t>& cells, const std::string& label_array,
                 MeshArrays& arrays) {
  for (const VtkArray& array : file.cell_data) {
    if (array.name == (label_array.empty() ? "label" : label_array)) continue;
    Field field{array.name, "", "1", On::kTets, Scale::kSequential, static_cast<int>(array.components), {}};
    const auto components = static_cast<std::size_t>(array.components);
    if (!array.values.empty())
      for (const std::size_t cell : cells)
        for (std::size_t c = 0; c < components; ++c)
          field.values.push_back(static_cast<float>(array.values[components * cell + c]));
    const bool fits = (components == 1 || components == 3) && is_field_name(array.name) &&
                      all_finite(field.values) && field.values.size() == components * cells.size();
    if (fits)
      arrays.cell_data.push_back(std::move(field));
    else
      arrays.left_out.push_back(array.name);
  }
  const auto whole = [&](std::string_view name) {
    std::vector<std::int64_t> values;
    if (const VtkArray* array = find_array(file.field_data, name))
      for (const double value : array->values)
        values.push_back(value >= 0 && value <= 65535 ? static_cast<std::int64_t>(value) : 0);
    return values;
  };
  arrays.infos = named_labels(whole(kLabelValues), whole(kLabelNames));
}

}  // namespace

Result<TetMesh> read_vtk(const VolumeFile& file, MeshArrays* arrays, const std::string& label_array) {
  MeshCursor in(file.bytes, file.name, "read_vtk");
  const VtkFile vtk = read_vtk_file(in);
  if (in.ok() && !file.bytes.empty() && !is_space(file.bytes.back()) &&
      std::string_view(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()).find("\nASCII") !=
          std::string_view::npos)
    in.fail("the file ends inside a line");
  std::vector<std::size_t> cells;
  std::uint64_t curved = 0;
  TetMesh mesh = tets_of(in, vtk, cells, curved);
  if (in.ok() && arrays) take_arrays(vtk, cells, label_array, *arrays);
  label_tets(in, mesh, vtk, cells, label_array, arrays);
  if (in.ok()) keep_corners(mesh, curved, arrays);
  const bool lps = vtk.title.starts_with(std::string(kVtkTitle) + "LPS");
  return finish_mesh(in, std::move(mesh), lps);
}

}  // namespace voxtet
