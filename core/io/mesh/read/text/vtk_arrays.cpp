#include "io/mesh/read/text/vtk_arrays.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

enum class VtkType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat,
  kDouble,
  kBit,
  kText
};

struct VtkTypeName {
  std::string_view name;
  VtkType type;
};
// A long has eight bytes in VTK's files, as where most of them are written.
constexpr std::array<VtkTypeName, 19> kVtkTypes{{{"bit", VtkType::kBit},
                                                 {"unsigned_char", VtkType::kUint8},
                                                 {"char", VtkType::kInt8},
                                                 {"signed_char", VtkType::kInt8},
                                                 {"vtktypeint8", VtkType::kInt8},
                                                 {"vtktypeuint8", VtkType::kUint8},
                                                 {"unsigned_short", VtkType::kUint16},
                                                 {"short", VtkType::kInt16},
                                                 {"unsigned_int", VtkType::kUint32},
                                                 {"int", VtkType::kInt32},
                                                 {"vtkidtype", VtkType::kInt32},
                                                 {"unsigned_long", VtkType::kUint64},
                                                 {"long", VtkType::kInt64},
                                                 {"vtktypeint64", VtkType::kInt64},
                                                 {"vtktypeuint64", VtkType::kUint64},
                                                 {"vtktypeint32", VtkType::kInt32},
                                                 {"float", VtkType::kFloat},
                                                 {"double", VtkType::kDouble},
                                                 {"string", VtkType::kText}}};

std::size_t bytes_of(VtkType type) {
  switch (type) {
    case VtkType::kInt8:
    case VtkType::kUint8:
    case VtkType::kBit:
    case VtkType::kText: return 1;
    case VtkType::kInt16:
    case VtkType::kUint16: return 2;
    case VtkType::kInt32:
    case VtkType::kUint32:
    case VtkType::kFloat: return 4;
    case VtkType::kInt64:
    case VtkType::kUint64:
    case VtkType::kDouble: break;
  }
  return 8;
}

/// A number of `bytes` bytes, the most significant first.
std::uint64_t read_big_endian(MeshCursor& in, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value = value << 8 | in.raw<std::uint8_t>("a value");
  return value;
}

double as_number(std::uint64_t bits, VtkType type) {
  switch (type) {
    case VtkType::kInt8: return static_cast<std::int8_t>(bits);
    case VtkType::kInt16: return static_cast<std::int16_t>(bits);
    case VtkType::kInt32: return static_cast<std::int32_t>(bits);
    case VtkType::kInt64: return static_cast<double>(static_cast<std::int64_t>(bits));
    case VtkType::kFloat: return Eigen::numext::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case VtkType::kDouble: return Eigen::numext::bit_cast<double>(bits);
    default: return static_cast<double>(bits);
  }
}

class VtkFileReader {
 public:
  explicit VtkFileReader(MeshCursor& in) : in_(in) {}

  VtkFile read() {
    read_head();
    while (in_.ok() && !in_.at_end()) read_section(lower_case(in_.word("a keyword")));
    if (in_.ok()) check();
    return std::move(file_);
  }

 private:
  void read_head() {
    if (!in_.rest_of_line().starts_with("# vtk DataFile Version"))
      in_.fail("expected \"# vtk DataFile Version\" in the first line");
    file_.title = in_.rest_of_line();
    const std::string form = lower_case(in_.rest_of_line());
    binary_ = form == "binary";
    if (!binary_ && form != "ascii")
      in_.fail("the third line is " + in_quotes(form) + ", expected ASCII or BINARY");
    in_.expect("DATASET");
    const std::string_view type = in_.word("the type of the data set");
    if (in_.ok() && lower_case(type) != "unstructured_grid")
      in_.fail("DATASET " + std::string(type) + ", expected UNSTRUCTURED_GRID");
  }

  void read_section(const std::string& keyword) {
    if (keyword == "points") {
      const std::int64_t count = read_count("the number of points");
      file_.points = values(read_type(), count, 3);
      points_ = count;
    } else if (keyword == "cells") {
      read_cells();
    } else if (keyword == "cell_types") {
      file_.types = whole(values(VtkType::kInt32, read_count("the number of cell types"), 1), "a cell type");
    } else if (keyword == "cell_data" || keyword == "point_data") {
      attributes_ = keyword == "cell_data" ? &file_.cell_data : &file_.point_data;
      tuples_ = read_count("the number of values");
    } else if (keyword == "metadata") {
      skip_metadata();
    } else if (keyword == "field") {
      read_field();
    } else {
      read_attribute(keyword);
    }
  }

  /// One of the attributes that a keyword of their own begins.
  void read_attribute(const std::string& keyword) {
    VtkArray array;
    if (attributes_ == nullptr) return in_.fail("found " + in_quotes(keyword) + ", expected a section");
    if (keyword == "metadata") return skip_metadata();
    array.name = in_.word("the name of an array");
    VtkType type = binary_ ? VtkType::kUint8 : VtkType::kFloat;  // of colours
    if (keyword == "lookup_table") {
      const std::int64_t colours = read_count("the number of colours");
      values(type, colours, 4);
      return;
    }
    if (keyword == "color_scalars") {
      array.components = in_.integer("the number of components", 1, kMostComponents);
    } else if (keyword == "texture_coordinates") {
      array.components = in_.integer("the number of components", 1, 3);
      type = read_type();
    } else {
      type = read_type();
      if (keyword == "vectors" || keyword == "normals")
        array.components = 3;
      else if (keyword == "tensors" || keyword == "tensors6")
        array.components = keyword == "tensors" ? 9 : 6;
      else if (keyword == "scalars")
        begin_scalars(array);
      else if (keyword != "global_ids" && keyword != "pedigree_ids")
        in_.fail("found " + in_quotes(keyword) + ", expected a section");
    }
    array.values = values(type, tuples_, array.components);
    attributes_->push_back(std::move(array));
  }

  void begin_scalars(VtkArray& array) {
    if (!in_.at_line_end()) array.components = in_.integer("the number of components", 1, kMostComponents);
    in_.expect("LOOKUP_TABLE");
    in_.word("the name of a table");
  }

  void read_field() {
    in_.word("the name of a field");
    const std::int64_t arrays = read_count("the number of arrays");
    auto& to = attributes_ ? *attributes_ : file_.field_data;
    for (std::int64_t i = 0; i < arrays && in_.ok(); ++i) {
      while (lower_case(in_.peek_word()) == "metadata") {
        in_.word("METADATA");
        skip_metadata();
      }
      VtkArray array;
      array.name = in_.word("the name of an array");
      array.components = in_.integer("the number of components", 0, kMostComponents);
      const std::int64_t tuples = read_count("the number of values");
      const VtkType type = read_type();
      array.values = values(type, tuples, array.components);
      if (type == VtkType::kText) continue;
      if (attributes_ && tuples != tuples_ && in_.ok())
        in_.fail("array " + array.name + " has " + std::to_string(tuples) + " tuples, expected " +
                 std::to_string(tuples_));
      to.push_back(std::move(array));
    }
  }

  /// Before version 5: the number of a cell's points and then these, for each cell. From then on two arrays.
  void read_cells() {
    const std::int64_t first = read_count("the number of cells"), second = read_count("the size of cells");
    if (in_.next_line_begins("OFFSETS")) {
      in_.word("OFFSETS");
      file_.offsets = whole(values(read_type(), first, 1), "an offset");
      in_.expect("CONNECTIVITY");
      file_.connectivity = whole(values(read_type(), second, 1), "a point of a cell");
      return;
    }
    const std::vector<std::int64_t> rows = whole(values(VtkType::kInt32, second, 1), "a point of a cell");
    file_.offsets.push_back(0);
    std::size_t at = 0;
    for (std::int64_t c = 0; c < first && in_.ok(); ++c) {
      const std::int64_t points = at < rows.size() ? rows[at] : -1;
      if (points < 0 || static_cast<std::size_t>(points) > rows.size() - at - 1)
        return in_.fail("CELLS: cell " + std::to_string(c) + " of " + std::to_string(first) +
                        " is longer than the list");
      for (std::int64_t i = 1; i <= points; ++i)
        file_.connectivity.push_back(rows[at + static_cast<std::size_t>(i)]);
      at += static_cast<std::size_t>(points) + 1;
      file_.offsets.push_back(static_cast<std::int64_t>(file_.connectivity.size()));
    }
  }

  std::int64_t read_count(const char* what) { return in_.integer(what, 0, std::int64_t{1} << 40); }

  VtkType read_type() {
    const std::string name = lower_case(in_.word("the type of values"));
    for (const VtkTypeName& known : kVtkTypes)
      if (known.name == name) return known.type;
    if (in_.ok()) in_.fail("values of the type " + in_quotes(name) + ", expected a type of VTK");
    return VtkType::kInt8;
  }

  std::vector<double> values(VtkType type, std::int64_t tuples, std::int64_t components) {
    std::vector<double> all;
    if (!in_.ok()) return all;
    const auto count = static_cast<std::uint64_t>(tuples) * static_cast<std::uint64_t>(components);
    if (type == VtkType::kText) return skip_texts(count);
    if (binary_) in_.rest_of_line();
    if (binary_ && type == VtkType::kBit) {
      in_.skip_bytes((count + 7) / 8, "bits");
      return std::vector<double>();
    }
    if (!in_.can_hold(count, binary_ ? bytes_of(type) : 2, "values")) return all;
    all.reserve(static_cast<std::size_t>(count));
    for (std::uint64_t i = 0; i < count && in_.ok(); ++i)
      all.push_back(binary_ ? as_number(read_big_endian(in_, bytes_of(type)), type) : read_text_value());
    return all;
  }

  /// A number, which may be "nan".
  double read_text_value() {
    const std::string_view word = in_.word("a value");
    const std::optional<double> value = parse_double(word);
    if (!value && in_.ok()) in_.fail("found " + in_quotes(word) + ", expected a number");
    return value.value_or(0);
  }

  /// A line each in ASCII; lengths before them in binary are not read.
  std::vector<double> skip_texts(std::uint64_t count) {
    if (binary_) in_.fail("an array of texts, expected numbers alone in a binary file");
    in_.rest_of_line();
    for (std::uint64_t i = 0; i < count && in_.ok(); ++i) {
      if (in_.left() == 0) in_.fail("the file ends inside an array of texts");
      in_.rest_of_line();
    }
    return {};
  }

  /// Ends with an empty line.
  void skip_metadata() {
    in_.rest_of_line();
    while (in_.left() > 0 && !in_.rest_of_line().empty()) {
    }
  }

  std::vector<std::int64_t> whole(const std::vector<double>& numbers, const char* what) {
    std::vector<std::int64_t> out;
    out.reserve(numbers.size());
    for (const double number : numbers) {
      if (!(number >= -9e15 && number <= 9e15) ||
          static_cast<double>(static_cast<std::int64_t>(number)) != number) {
        if (in_.ok())
          in_.fail(std::string(what) + " is " + number_text(number) + ", expected a whole number");
        return {};
      }
      out.push_back(static_cast<std::int64_t>(number));
    }
    return out;
  }

  void check() {
    const std::size_t cells = file_.offsets.empty() ? 0 : file_.offsets.size() - 1;
    if (file_.types.size() != cells)
      return in_.fail(std::to_string(file_.types.size()) + " CELL_TYPES, expected " + std::to_string(cells));
    for (std::size_t c = 0; c <= cells && !file_.offsets.empty(); ++c)
      if (file_.offsets[c] < (c == 0 ? 0 : file_.offsets[c - 1]) ||
          static_cast<std::size_t>(file_.offsets[c]) > file_.connectivity.size())
        return in_.fail("OFFSETS: cell " + std::to_string(c) + " ends before it begins, or behind the list");
    for (const VtkArray& array : file_.cell_data)
      if (array.values.size() != cells * static_cast<std::size_t>(array.components) && !array.values.empty())
        return in_.fail("CELL_DATA " + array.name + ": " + std::to_string(array.values.size()) +
                        " values for " + std::to_string(cells) + " cells");
  }

  static constexpr std::int64_t kMostComponents = 1000;
  MeshCursor& in_;
  VtkFile file_;
  bool binary_ = false;
  std::int64_t points_ = 0, tuples_ = 0;
  std::vector<VtkArray>* attributes_ = nullptr;  ///< of the section that has begun
};

}  // namespace

VtkFile read_vtk_file(MeshCursor& in) {
  return VtkFileReader(in).read();
}

}  // namespace voxtet
