#include "io/mesh/read/xdmf/read_xdmf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/bytes/header_text.h"
#include "io/mesh/read/shared/found_labels.h"
#include "io/mesh/read/shared/xml_tags.h"
#include "io/mesh/read/xdmf/hdf5_file.h"

namespace voxtet {
namespace {

constexpr const char* kXdmfReader = "read_xdmf";

Error xdmf_error(const std::string& message) {
  return {ErrorCode::kBadInput, kXdmfReader, message, {}};
}

/// A <DataItem> with its text, which may be the reference to an array.
struct FoundItem {
  std::string format;
  std::string_view text;
};

struct FoundAttribute {
  std::string name, center;
  FoundItem item;
};

struct FoundGrid {
  std::string topology;  ///< in small letters
  FoundItem points, cells;
  std::vector<FoundAttribute> attributes;
};

const std::map<std::string_view, char> kEntities{
    {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};

std::string without_entities(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t end = text[i] == '&' ? text.find(';', i) : std::string_view::npos;
    const auto entity =
        end == std::string_view::npos ? kEntities.end() : kEntities.find(text.substr(i, end - i + 1));
    out += entity == kEntities.end() ? text[i] : entity->second;
    if (entity != kEntities.end()) i = end;
  }
  return out;
}

bool has_tetrahedra(const FoundGrid& grid) {
  return grid.topology == "tetrahedron" || grid.topology == "tetrahedron_10" || grid.topology == "tet_10";
}

/// The grids of a file.
class XdmfReader {
 public:
  explicit XdmfReader(std::string_view text) : tags_(text, "Xdmf") {}

  bool read() {
    XmlTag tag;
    std::string_view text;
    do {
      if (!tags_.next(tag, text)) return false;
      if (tag.closing) {
        if (tag.name == "DataItem" && item_) item_->text = trimmed(text);
        item_ = nullptr;
      } else {
        open(tag);
      }
    } while (!tags_.at_end());
    return true;
  }
  const std::string& error() const { return tags_.error(); }

  std::vector<FoundGrid> grids;

 private:
  static std::string_view either(const XmlTag& tag, std::string_view one, std::string_view other) {
    return tag[one].empty() ? tag[other] : tag[one];
  }

  void open(const XmlTag& tag) {
    const std::string_view parent = tags_.parent();
    if (tag.name == "Grid") grids.emplace_back();
    if (grids.empty()) return;
    FoundGrid& grid = grids.back();
    if (tag.name == "Topology") grid.topology = lower_case(either(tag, "TopologyType", "Type"));
    if (tag.name == "Attribute")
      grid.attributes.push_back({without_entities(tag["Name"]), lower_case(tag["Center"]), {}});
    if (tag.name != "DataItem") return;
    item_ = parent == "Geometry"                                ? &grid.points
            : parent == "Topology"                              ? &grid.cells
            : parent == "Attribute" && !grid.attributes.empty() ? &grid.attributes.back().item
                                                                : nullptr;
    if (item_) item_->format = lower_case(tag["Format"]);
  }

  XmlTags tags_;
  FoundItem* item_ = nullptr;
};

/// The numbers of items, with the files that they refer to.
class XdmfNumbers {
 public:
  explicit XdmfNumbers(const VolumeFile& file) : file_(file) {}

  Result<std::vector<double>> operator()(const FoundItem& item, const std::string& what) {
    if (item.format.empty() || item.format == "xml") {
      std::vector<double> values;
      std::string_view rest = item.text;
      while (!(rest = trimmed(rest)).empty()) {
        const auto end = std::find_if(rest.begin(), rest.end(), [](char c) { return is_space(c); });
        const std::string_view word = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
        const auto value = parse_double(word);
        if (!value) return xdmf_error(what + ": found " + in_quotes(word) + ", expected a number");
        values.push_back(*value);
        rest.remove_prefix(word.size());
      }
      return values;
    }
    if (item.format != "hdf")
      return xdmf_error(what + ": numbers of the format " + in_quotes(item.format) + ", expected HDF or XML");
    const std::string reference = without_entities(item.text);
    const std::size_t colon = reference.rfind(":/");
    if (colon == std::string::npos)
      return xdmf_error(what + ": found " + in_quotes(reference) + ", expected FILE.h5:/ARRAY");
    const Result<const Bytes*> content = content_of(reference.substr(0, colon));
    if (!content) return content.error();
    Result<Hdf5Values> values = read_hdf5(**content, reference.substr(colon + 1));
    if (!values) return xdmf_error(reference.substr(0, colon) + ": " + values.error().message);
    return std::move(values->values);
  }

 private:
  Result<const Bytes*> content_of(const std::string& name) {
    const auto known = files_.find(name);
    if (known != files_.end()) return &known->second;
    if (!file_.sibling) return xdmf_error("needs " + name + " beside it");
    Result<Bytes> bytes = file_.sibling(name);
    if (!bytes) return bytes.error();
    return &(files_[name] = std::move(bytes).value());
  }

  const VolumeFile& file_;
  std::map<std::string, Bytes> files_;
};

bool is_whole(double value) {
  return std::abs(value) < 1e15 && value == std::floor(value);
}

Result<TetMesh> tets_of_grid(const FoundGrid& grid, XdmfNumbers& numbers) {
  TetMesh mesh;
  const Result<std::vector<double>> points = numbers(grid.points, "Geometry");
  if (!points) return points.error();
  const Result<std::vector<double>> cells = numbers(grid.cells, "Topology");
  if (!cells) return cells.error();
  const std::size_t corners = grid.topology == "tetrahedron" ? 4 : 10;
  if (points->size() % 3 != 0 || cells->size() % corners != 0)
    return xdmf_error("found " + std::to_string(points->size()) + " numbers of Geometry and " +
                      std::to_string(cells->size()) + " of Topology, expected three a point and " +
                      std::to_string(corners) + " a tetrahedron");
  for (std::size_t i = 0; i < points->size(); i += 3) {
    mesh.points.emplace_back((*points)[i], (*points)[i + 1], (*points)[i + 2]);
    if (!mesh.points.back().allFinite())
      return xdmf_error("Geometry: point " + std::to_string(i / 3) + " has a coordinate that is not finite");
  }
  for (std::size_t i = 0; i < cells->size(); i += corners) {
    Tet tet{};
    for (std::size_t c = 0; c < 4; ++c) {
      const double point = (*cells)[i + c];
      if (!is_whole(point) || point < 0 || point >= static_cast<double>(mesh.points.size()))
        return xdmf_error("Topology: tetrahedron " + std::to_string(i / corners) + " has the point " +
                          number_text(point) + ", expected 0 to " +
                          std::to_string(static_cast<std::int64_t>(mesh.points.size()) - 1));
      tet[c] = static_cast<std::uint32_t>(point);
    }
    mesh.tets.push_back(tet);
  }
  return mesh;
}

/// "; label 1 LV, 2 RV -->", as write_xdmf writes them.
std::vector<LabelInfo> names_in_comment(std::string_view text) {
  std::vector<LabelInfo> infos;
  constexpr std::string_view kLabels = "; label ";
  const std::size_t begin = text.find(kLabels), end = text.find(" -->");
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) return infos;
  std::string_view list = text.substr(begin + kLabels.size(), end - begin - kLabels.size());
  while (!list.empty()) {
    // A name may hold a comma: the next begins with a number.
    std::size_t comma = list.find(", ");
    while (comma != std::string_view::npos && comma + 2 < list.size() &&
           !(list[comma + 2] >= '0' && list[comma + 2] <= '9'))
      comma = list.find(", ", comma + 1);
    const std::string_view one = list.substr(0, comma);
    if (const std::size_t space = one.find(' '); space != std::string_view::npos)
      add_label_name(parse_integer(one.substr(0, space)).value_or(0), one.substr(space + 1), infos);
    list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 2);
  }
  return infos;
}

Status label_grid(MeshCursor& in, TetMesh& mesh, const FoundGrid& grid, XdmfNumbers& numbers, bool ours,
                  const std::string& label_array, MeshArrays* arrays) {
  const std::string name = label_array.empty() ? "label" : label_array;
  std::string found;
  const FoundAttribute* labels = nullptr;
  for (const FoundAttribute& attribute : grid.attributes) {
    if (attribute.center != "cell") continue;
    found += ' ';
    found += in_quotes(attribute.name);
    if (attribute.name == name) labels = &attribute;
  }
  if (found.empty()) found = " none";
  if (!labels && (ours || !label_array.empty()))
    return xdmf_error("no cell attribute " + in_quotes(name) + ", found" + found);
  if (!labels) {
    set_one_region(mesh, "no cell attribute \"label\", found" + found + " (--label-array NAME takes one)",
                   arrays);
    return std::monostate{};
  }
  const Result<std::vector<double>> values = numbers(labels->item, "Attribute " + name);
  if (!values) return values.error();
  if (values->size() != mesh.tets.size() || !std::all_of(values->begin(), values->end(), is_whole))
    return xdmf_error("Attribute " + name + ": found " + std::to_string(values->size()) +
                      " numbers, expected a whole number for each of " + std::to_string(mesh.tets.size()) +
                      " tetrahedra");
  std::vector<std::int64_t> whole;
  for (const double value : *values) whole.push_back(static_cast<std::int64_t>(value));
  set_labels(in, mesh, whole, name, arrays);
  return std::monostate{};
}

void take_attributes(const FoundGrid& grid, XdmfNumbers& numbers, std::size_t tets,
                     const std::string& label_array, MeshArrays& arrays) {
  for (const FoundAttribute& attribute : grid.attributes) {
    if (attribute.center != "cell" || attribute.name == (label_array.empty() ? "label" : label_array))
      continue;
    const Result<std::vector<double>> values = numbers(attribute.item, attribute.name);
    const std::size_t components = values && tets > 0 ? values->size() / tets : 0;
    Field field{attribute.name, "", "1", On::kTets, Scale::kSequential, static_cast<int>(components), {}};
    if (values) field.values.assign(values->begin(), values->end());
    if ((components == 1 || components == 3) && field.values.size() == components * tets &&
        is_field_name(field.name) && all_finite(field.values))
      arrays.cell_data.push_back(std::move(field));
    else
      arrays.left_out.push_back(attribute.name);
  }
}

}  // namespace

Result<TetMesh> read_xdmf(const VolumeFile& file, MeshArrays* arrays, const std::string& label_array) {
  const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
  const auto named = [&](const Error& error) { return xdmf_error(file.name + ": " + error.message); };
  XdmfReader reader(text);
  if (!reader.read()) return named(xdmf_error(reader.error()));
  const auto grid = std::find_if(reader.grids.begin(), reader.grids.end(), has_tetrahedra);
  if (grid == reader.grids.end()) {
    std::string found;
    for (const FoundGrid& other : reader.grids) found += " " + in_quotes(other.topology);
    return named(xdmf_error("found grids of" + (found.empty() ? " none" : found) +
                            ", expected one of the topology Tetrahedron or Tetrahedron_10"));
  }
  XdmfNumbers numbers(file);
  Result<TetMesh> mesh = tets_of_grid(*grid, numbers);
  if (!mesh) return named(mesh.error());
  const bool ours = text.substr(0, 1024).find("<!-- voxtet mesh, space ") != std::string_view::npos;
  if (arrays) {
    take_attributes(*grid, numbers, mesh->tets.size(), label_array, *arrays);
    if (ours) arrays->infos = names_in_comment(text);
  }
  MeshCursor in(file.bytes, file.name, kXdmfReader);
  if (Status labelled = label_grid(in, *mesh, *grid, numbers, ours, label_array, arrays); !labelled)
    return named(labelled.error());
  keep_corners(*mesh, grid->topology == "tetrahedron" ? 0 : mesh->tets.size(), arrays);
  const bool lps = text.substr(0, 1024).find("<!-- voxtet mesh, space LPS") != std::string_view::npos;
  return finish_mesh(in, std::move(mesh).value(), lps);
}

}  // namespace voxtet
