#include "io/mesh/read_values.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/bytes/byte_source.h"
#include "io/bytes/header_text.h"
#include "io/mesh/read/shared/mesh_cursor.h"
#include "io/mesh/shared/mesh_format.h"

namespace voxtet {
namespace {

constexpr const char* kValuesReader = "read_values";

Error in_file(const std::string& file, Error error) {
  error.message = file + ": " + error.message;
  return error;
}

Result<std::vector<float>> read_dat(const std::string& file, const Bytes& bytes) {
  MeshCursor in(bytes, file, kValuesReader);
  std::vector<float> values;
  while (in.ok() && !in.at_end()) {
    values.push_back(static_cast<float>(in.real("a value")));
    if (in.ok() && in.left() == 0) in.fail("the file ends inside the line of the last value");
  }
  if (in.ok() && values.empty()) in.fail("found no value, expected one for each point");
  if (!in.ok()) return in.error();
  const auto is_value = [](float value) { return value >= 0 || value == -1; };
  if (std::all_of(values.begin(), values.end(), is_value))
    std::replace(values.begin(), values.end(), -1.0F, std::numeric_limits<float>::quiet_NaN());
  return values;
}

/// The last word of a file's name, without its ending.
std::string field_name(const std::string& file) {
  std::string name = mesh_name_of(file);
  name = name.substr(name.find_last_of('.') + 1);
  for (char& c : name)
    if (!is_field_name({&c, 1})) c = '_';
  return name.empty() ? "values" : name;
}

/// The unit that a field's name ends with, as in `activation_ms`.
std::string unit_of_name(const std::string& name) {
  for (const char* unit : {"ms", "mV", "deg", "mm"})
    if (name.ends_with(std::string("_") + unit)) return unit;
  return "1";
}

}  // namespace

Result<PointValues> PointValues::open(std::string file, Bytes bytes) {
  PointValues values;
  const std::string ending = lower_case(mesh_ending_of(file));
  if (ending == ".dat") {
    Result<std::vector<float>> read = read_dat(file, bytes);
    if (!read) return read.error();
    values.values_ = std::move(read).value();
    values.count_ = values.values_.size();
    values.unit_ = unit_of_name(field_name(file));
  } else if (ending == ".igb") {
    Result<IgbHeader> header = read_igb_header(bytes);
    if (!header) return in_file(file, header.error());
    values.header_ = std::move(header).value();
    values.count_ = values.header_.values;
    values.unit_ = values.header_.unit;
    for (std::uint64_t k = 0; k < values.header_.frames; ++k)
      values.times_ms_.push_back(values.header_.first_ms +
                                 static_cast<double>(k) * values.header_.interval_ms);
    values.bytes_ = std::move(bytes);
  } else {
    return bad_input(kValuesReader, file + ": ending " + in_quotes(ending) + ", expected .dat or .igb");
  }
  values.file_ = std::move(file);
  return values;
}

Status PointValues::check_count(std::size_t points) const {
  if (count_ == points) return std::monostate{};
  return bad_input(kValuesReader, file_ + ": found " + std::to_string(count_) + " values" +
                                      (times_ms_.empty() ? "" : " in a frame") + ", expected " +
                                      std::to_string(points) + ", one for each point of the mesh");
}

Result<Field> PointValues::frame(std::size_t k) const {
  Field field{field_name(file_), file_, unit_, On::kPoints, Scale::kSequential, 1, values_};
  if (times_ms_.empty()) return field;
  Result<std::vector<float>> read = read_igb_frame(bytes_, header_, k);
  if (!read) return in_file(file_, read.error());
  field.values = std::move(read).value();
  return field;
}

}  // namespace voxtet
