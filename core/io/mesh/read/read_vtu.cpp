#include "io/mesh/read/read_vtu.h"

#include <algorithm>

#include "io/bytes/header_text.h"
#include "io/mesh/read/shared/found_labels.h"
#include "io/mesh/read/shared/mesh_cursor.h"
#include "io/mesh/read/vtu_arrays.h"
#include "io/mesh/write/write_vtu.h"

namespace voxtet {
namespace {

/// Appends the pieces of one file to one mesh; messages are without the file's name.
class PieceReader {
 public:
  /// `label_array` may be empty: then it is `label`, and may be absent.
  PieceReader(const VtuDocument& document, std::string label_array)
      : label_array_(std::move(label_array)), arrays_(document) {}

  Status read(const VtuPiece& piece) {
    std::uint64_t points = 0, cells = 0;
    if (!count_of(piece.points, points)) return refuse("Piece NumberOfPoints is " + in_quotes(piece.points));
    if (!count_of(piece.cells, cells)) return refuse("Piece NumberOfCells is " + in_quotes(piece.cells));
    const std::size_t first_point = mesh.points.size();
    if (Status status = read_points(piece, points); !status.ok()) return status;
    const std::size_t first_tet = mesh.tets.size();
    if (Status status = read_cells(piece, cells, first_point); !status.ok()) return status;
    read_cell_data(piece, first_tet);
    return std::monostate{};
  }

  /// The cell arrays that every piece has; the names of those that are no field.
  MeshArrays arrays() {
    MeshArrays out;
    for (Field& data : cell_data_)
      if (data.values.size() == mesh.tets.size() && is_field_name(data.name) && all_finite(data.values))
        out.cell_data.push_back(std::move(data));
      else
        out.left_out.push_back(data.name);
    return out;
  }

  TetMesh mesh;
  std::vector<std::int64_t> labels;  ///< of the tetrahedra in pieces that have some
  std::uint64_t curved = 0;          ///< tetrahedra with points on their edges
  std::string other_arrays;          ///< what there is in the last piece without labels

 private:
  static Error refuse(const std::string& message) { return {ErrorCode::kBadInput, "read_vtu", message, {}}; }

  static bool count_of(std::string_view text, std::uint64_t& count) {
    const std::optional<std::int64_t> value = parse_integer(text);
    count = static_cast<std::uint64_t>(value.value_or(0));
    return value && *value >= 0 && *value <= 0xffffffff;
  }

  static const VtuArray* find(const VtuPiece& piece, std::string_view section, std::string_view name) {
    for (const VtuArray& array : piece.arrays)
      if (array.section == section && (name.empty() || array.name == name)) return &array;
    return nullptr;
  }

  Result<std::vector<std::int64_t>> integers(const VtuPiece& piece, std::string_view section,
                                             std::string_view name, std::uint64_t count) const {
    if (const VtuArray* array = find(piece, section, name)) return arrays_.integers(*array, count);
    return refuse("no " + std::string(section) + " array \"" + std::string(name) + "\", found" +
                  names_in(piece, section));
  }

  static std::string names_in(const VtuPiece& piece, std::string_view section) {
    std::string found;
    for (const VtuArray& array : piece.arrays)
      if (array.section == section) {
        found += ' ';
        found += in_quotes(array.name);
      }
    return found.empty() ? " none" : found;
  }

  /// Those of all cells; none where the array may be absent and is.
  Result<std::vector<std::int64_t>> labels_of(const VtuPiece& piece, std::uint64_t count) {
    if (label_array_.empty() && find(piece, "CellData", "label") == nullptr) {
      other_arrays = names_in(piece, "CellData");
      return std::vector<std::int64_t>{};
    }
    return integers(piece, "CellData", label_array_.empty() ? "label" : label_array_, count);
  }

  Status read_points(const VtuPiece& piece, std::uint64_t count) {
    const VtuArray* array = find(piece, "Points", "");
    if (array == nullptr) return refuse("a Piece without Points");
    if (array->components != "3")
      return refuse("Points have " + in_quotes(array->components) + " components, expected 3");
    const Result<std::vector<double>> values = arrays_.reals(*array, 3 * count);
    if (!values.ok()) return values.error();
    mesh.points.reserve(mesh.points.size() + static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < count; ++i)
      mesh.points.emplace_back((*values)[3 * i], (*values)[3 * i + 1], (*values)[3 * i + 2]);
    return std::monostate{};
  }

  Status read_cells(const VtuPiece& piece, std::uint64_t count, std::size_t first_point) {
    const auto offsets = integers(piece, "Cells", "offsets", count);
    if (!offsets.ok()) return offsets.error();
    for (std::size_t c = 0; c < count; ++c)
      if ((*offsets)[c] < (c == 0 ? 0 : (*offsets)[c - 1]))
        return refuse("Cells offsets: cell " + std::to_string(c) + " ends before it begins");
    const auto types = integers(piece, "Cells", "types", count);
    if (!types.ok()) return types.error();
    const auto connectivity = integers(piece, "Cells", "connectivity",
                                       count == 0 ? 0 : static_cast<std::uint64_t>(offsets->back()));
    if (!connectivity.ok()) return connectivity.error();
    const auto cell_labels = labels_of(piece, count);
    if (!cell_labels.ok()) return cell_labels.error();
    tet_cells_.clear();
    cell_count_ = count;
    for (std::size_t c = 0; c < count; ++c) {
      if ((*types)[c] != kVtkTetra && (*types)[c] != kVtkQuadraticTetra) continue;
      const bool is_curved = (*types)[c] == kVtkQuadraticTetra;
      curved += is_curved ? 1 : 0;
      tet_cells_.push_back(c);
      const auto begin = static_cast<std::size_t>(c == 0 ? 0 : (*offsets)[c - 1]);
      if ((*offsets)[c] - static_cast<std::int64_t>(begin) != (is_curved ? 10 : 4))
        return refuse("cell " + std::to_string(c) + " is a tetrahedron, but has not " +
                      (is_curved ? "10" : "4") + " points");
      if (Status status = add_tet(c, &(*connectivity)[begin], first_point); !status.ok()) return status;
      if (!cell_labels->empty()) labels.push_back((*cell_labels)[c]);
    }
    return std::monostate{};
  }

  Status add_tet(std::size_t cell, const std::int64_t* corners, std::size_t first_point) {
    const std::size_t points = mesh.points.size() - first_point;
    Tet tet{};
    for (std::size_t k = 0; k < 4; ++k) {
      if (corners[k] < 0 || static_cast<std::uint64_t>(corners[k]) >= points)
        return refuse("cell " + std::to_string(cell) + ": point " + std::to_string(corners[k]) +
                      ", expected 0 to " + std::to_string(static_cast<std::int64_t>(points) - 1));
      tet[k] = static_cast<std::uint32_t>(first_point + static_cast<std::size_t>(corners[k]));
    }
    mesh.tets.push_back(tet);
    return std::monostate{};
  }

  /// An array that is missing, or cannot be read, in one piece has too few values in the end.
  void read_cell_data(const VtuPiece& piece, std::size_t first_tet) {
    for (const VtuArray& array : piece.arrays) {
      if (array.section != "CellData" || array.name == (label_array_.empty() ? "label" : label_array_))
        continue;
      auto data = std::find_if(cell_data_.begin(), cell_data_.end(),
                               [&](const Field& known) { return known.name == array.name; });
      if (data == cell_data_.end()) {
        data = cell_data_.emplace(data);
        data->name = array.name;
      }
      std::vector<float>& values = data->values;
      if (values.size() != first_tet || !(array.components.empty() || array.components == "1")) continue;
      const Result<std::vector<double>> all = arrays_.reals(array, cell_count_);
      if (!all.ok()) continue;
      for (const std::size_t cell : tet_cells_) values.push_back(static_cast<float>((*all)[cell]));
    }
  }

  std::string label_array_;
  VtuArrays arrays_;
  std::vector<Field> cell_data_;
  std::vector<std::size_t> tet_cells_;  ///< those of the last piece
  std::uint64_t cell_count_ = 0;        ///< of the last piece
};

/// Whether a field-data array `space` holds the letters L, P, S. Other people's arrays of that name are none
/// of ours.
bool says_lps(const VtuDocument& document) {
  const VtuArrays arrays(document);
  for (const VtuArray& array : document.field_data) {
    if (array.name != "space") continue;
    for (const std::uint64_t length : {3, 4}) {
      const auto letters = arrays.integers(array, length);
      if (letters.ok() && (*letters)[0] == 'L' && (*letters)[1] == 'P' && (*letters)[2] == 'S') return true;
    }
  }
  return false;
}

/// The names of labels that write_vtu() put into field data; none where they are not as it writes them.
std::vector<LabelInfo> names_in(const VtuDocument& document) {
  const VtuArrays arrays(document);
  const auto values_of = [&](std::string_view name) -> std::vector<std::int64_t> {
    for (const VtuArray& array : document.field_data) {
      if (array.name != name) continue;
      const auto values = arrays.integers(array, static_cast<std::uint64_t>(std::max<std::int64_t>(
                                                     0, parse_integer(array.tuples).value_or(0))));
      if (values) return *values;
    }
    return {};
  };
  const std::vector<std::int64_t> labels = values_of(kLabelValues), bytes = values_of(kLabelNames);
  return named_labels(labels, bytes);
}

Result<TetMesh> read_document(MeshCursor& in, const VtuDocument& document, MeshArrays* arrays,
                              const std::string& label_array) {
  if (Status status = VtuArrays(document).check(); !status.ok()) return status.error();
  PieceReader reader(document, label_array);
  for (const VtuPiece& piece : document.pieces)
    if (Status status = reader.read(piece); !status.ok()) return status.error();
  if (arrays) {
    *arrays = reader.arrays();
    arrays->infos = names_in(document);
  }
  if (reader.labels.empty() && !reader.mesh.tets.empty())
    set_one_region(reader.mesh,
                   "no cell array \"label\", found" + reader.other_arrays + " (--label-array NAME takes one)",
                   arrays);
  else if (reader.labels.size() != reader.mesh.tets.size())
    return Error{ErrorCode::kBadInput,
                 "read_vtu",
                 "a Piece without CellData array \"label\", found" + reader.other_arrays,
                 {}};
  else
    set_labels(in, reader.mesh, reader.labels, "label", arrays);
  keep_corners(reader.mesh, reader.curved, arrays);
  return std::move(reader.mesh);
}

}  // namespace

Result<TetMesh> read_vtu(const VolumeFile& file, MeshArrays* arrays, const std::string& label_array) {
  const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
  const auto named = [&](Error error) {
    error.message = file.name + ": " + error.message;
    return error;
  };
  const Result<VtuDocument> document = parse_vtu_xml(text);
  if (!document.ok()) return named(document.error());
  MeshCursor end(file.bytes, file.name, "read_vtu");
  Result<TetMesh> mesh = read_document(end, *document, arrays, label_array);
  if (!mesh.ok()) return named(mesh.error());
  return finish_mesh(end, std::move(mesh).value(), says_lps(*document));
}

}  // namespace voxtet
