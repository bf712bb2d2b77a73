#include "io/volume/formats/nrrd_geometry.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/bytes/header_text.h"
#include "io/volume/voxels/length_unit.h"
#include "io/volume/voxels/voxel_layout.h"

namespace voxtet {
namespace {

/// "(1,0,0) none (0, 1, 0)" -> one vector an axis, nothing for "none".
using Vectors = std::vector<std::optional<Eigen::Vector3d>>;
std::optional<Vectors> parse_vectors(std::string_view text) {
  Vectors vectors;
  text = trimmed(text);
  while (!text.empty()) {
    if (text.starts_with("none")) {
      vectors.emplace_back();
      text = trimmed(text.substr(4));
      continue;
    }
    const std::size_t close = text.find(')');
    if (text.front() != '(' || close == std::string_view::npos) return std::nullopt;
    std::string inside(text.substr(1, close - 1));
    if (std::count(inside.begin(), inside.end(), ',') != 2) return std::nullopt;
    std::replace(inside.begin(), inside.end(), ',', ' ');
    const auto numbers = parse_doubles(inside);
    if (!numbers || numbers->size() != 3) return std::nullopt;
    vectors.emplace_back(Eigen::Vector3d((*numbers)[0], (*numbers)[1], (*numbers)[2]));
    text = trimmed(text.substr(close + 1));
  }
  return vectors;
}

/// Signs that take the file's space to RAS. Without a patient space: as ITK, LPS.
Result<Eigen::Vector3d> signs_of(const NrrdHeader& header) {
  const std::string* space = header.find("space");
  if (space == nullptr) {
    const std::string* dimension = header.find("spacedimension");
    if (dimension != nullptr && *dimension != "3")
      return bad_nrrd("space dimension is " + in_quotes(*dimension) + "; expected 3");
    return Eigen::Vector3d(-1, -1, 1);
  }
  const std::string name = lower_case(*space);
  if (name == "right-anterior-superior" || name == "ras") return Eigen::Vector3d(1, 1, 1);
  if (name == "left-anterior-superior" || name == "las") return Eigen::Vector3d(-1, 1, 1);
  if (name == "left-posterior-superior" || name == "lps") return Eigen::Vector3d(-1, -1, 1);
  return bad_nrrd("space is " + in_quotes(*space) +
                  "; expected right-anterior-superior, left-anterior-superior or left-posterior-superior");
}

/// Quoted strings of `field`, each as mm per unit; one where the field is absent.
Result<std::vector<double>> mm_per_unit(const NrrdHeader& header, const std::string& field, std::size_t count,
                                        Reading& reading) {
  const std::optional<double> asked = mm_per_unit_of(reading.options);
  const std::string* text = header.find(field);
  if (asked || text == nullptr) return std::vector<double>(count, asked.value_or(1));
  std::vector<double> scales;
  std::string_view rest = *text;
  while (!(rest = trimmed(rest)).empty()) {
    const std::size_t close = rest.find('"', 1);
    if (rest.front() != '"' || close == std::string_view::npos)
      return bad_nrrd(field + " is " + in_quotes(*text) + "; expected strings in quotes");
    const std::string_view unit = trimmed(rest.substr(1, close - 1));
    rest.remove_prefix(close + 1);
    const bool unknown = unit.empty() || unit == "???" || unit == "none";
    const std::optional<double> mm = unknown ? 1 : mm_per_length_unit(unit);
    if (!mm)
      return bad_nrrd(field + " holds the unit " + in_quotes(unit) + "; expected mm, m, cm or um, or " +
                      kSayUnit);
    if (!unknown) reading.said_mm = *mm;
    scales.push_back(*mm);
  }
  if (scales.size() != count)
    return bad_nrrd(field + " has " + std::to_string(scales.size()) + " units; expected " +
                    std::to_string(count));
  return scales;
}

/// Per axis: true or false where the kind says spatial or not, nothing where it says neither.
Result<std::vector<std::optional<bool>>> spatial_kinds(const NrrdHeader& header, std::size_t dimension) {
  constexpr std::array<std::string_view, 29> kOther{"time",
                                                    "list",
                                                    "point",
                                                    "vector",
                                                    "covariant-vector",
                                                    "normal",
                                                    "stub",
                                                    "scalar",
                                                    "complex",
                                                    "2-vector",
                                                    "3-color",
                                                    "rgb-color",
                                                    "hsv-color",
                                                    "xyz-color",
                                                    "4-color",
                                                    "rgba-color",
                                                    "3-vector",
                                                    "3-gradient",
                                                    "3-normal",
                                                    "4-vector",
                                                    "quaternion",
                                                    "2d-symmetric-matrix",
                                                    "2d-masked-symmetric-matrix",
                                                    "2d-matrix",
                                                    "2d-masked-matrix",
                                                    "3d-symmetric-matrix",
                                                    "3d-masked-symmetric-matrix",
                                                    "3d-matrix",
                                                    "3d-masked-matrix"};
  std::vector<std::optional<bool>> spatial(dimension);
  const std::string* text = header.find("kinds");
  if (text == nullptr) return spatial;
  const std::vector<std::string> words = words_of(*text);
  if (words.size() != dimension)
    return bad_nrrd("kinds is " + in_quotes(*text) + "; expected " + std::to_string(dimension) + " words");
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    const std::string kind = lower_case(words[axis]);
    if (kind == "domain" || kind == "space")
      spatial[axis] = true;
    else if (std::find(kOther.begin(), kOther.end(), kind) != kOther.end())
      spatial[axis] = false;
    else if (kind != "none" && kind != "???")
      return bad_nrrd("kinds holds the unknown kind " + in_quotes(words[axis]));
  }
  return spatial;
}

/// Finds the one axis of a four-dimensional file that is not spatial.
Result<std::size_t> find_list_axis(const std::vector<std::optional<bool>>& spatial,
                                   const std::vector<std::int64_t>& sizes) {
  std::optional<std::size_t> found;
  for (std::size_t axis = 0; axis < sizes.size(); ++axis) {
    if (spatial[axis] != false) continue;
    if (found)
      return bad_nrrd("space directions or kinds leave fewer than three spatial axes; expected three");
    found = axis;
  }
  if (!found && sizes.back() == 1) found = sizes.size() - 1;
  if (!found)
    return bad_nrrd("dimension is 4, but no axis is marked as a list of layers; expected three spatial axes");
  if (*found != 0 && *found + 1 != sizes.size() && sizes[*found] != 1)
    return bad_nrrd("sizes has " + std::to_string(sizes[*found]) + " frames along axis " +
                    std::to_string(*found) + "; expected them along the first axis or the last");
  return *found;
}

Result<Vectors> directions_from_spacings(const NrrdHeader& header, std::size_t dimension,
                                         const std::vector<std::optional<bool>>& spatial, Reading& reading) {
  const Result<std::vector<double>> scales = mm_per_unit(header, "units", dimension, reading);
  if (!scales) return scales.error();
  std::vector<double> spacings(dimension, 1.0);
  if (const std::string* text = header.find("spacings"); text != nullptr) {
    const auto numbers = parse_doubles(*text);
    if (!numbers || numbers->size() != dimension)
      return bad_nrrd("spacings is " + in_quotes(*text) + "; expected " + std::to_string(dimension) +
                      " numbers");
    spacings = *numbers;
  }
  Vectors directions(dimension);
  int row = 0;
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    if (spatial[axis] == false || row == 3) continue;
    if (!(spacings[axis] > 0))
      return bad_nrrd("spacings holds " + number_text(spacings[axis]) + "; expected voxel sizes above 0");
    directions[axis] = Eigen::Vector3d::Unit(row++) * (spacings[axis] * (*scales)[axis]);
  }
  return directions;
}

/// One vector in mm an axis, in the file's own space.
Result<Vectors> directions_of(const NrrdHeader& header, std::size_t dimension,
                              std::vector<std::optional<bool>>& spatial,
                              const std::vector<double>& space_scales, Reading& reading) {
  const std::string* text = header.find("spacedirections");
  if (text == nullptr) return directions_from_spacings(header, dimension, spatial, reading);
  auto directions = parse_vectors(*text);
  if (!directions || directions->size() != dimension)
    return bad_nrrd("space directions is " + in_quotes(*text) + "; expected " + std::to_string(dimension) +
                    " vectors (x,y,z) or none");
  if (const std::string* spacings = header.find("spacings"); spacings != nullptr)
    for (const std::string& word : words_of(*spacings))
      if (lower_case(word) != "nan")
        return bad_nrrd("spacings is " + in_quotes(*spacings) +
                        " although there are space directions; expected one of both");
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    if ((*directions)[axis] && spatial[axis] == false)
      return bad_nrrd("kinds says that axis " + std::to_string(axis) +
                      " is not spatial, but space directions has a vector");
    spatial[axis] = (*directions)[axis].has_value();
    if (!(*directions)[axis]) continue;
    for (int row = 0; row < 3; ++row)
      (*(*directions)[axis])[row] *= space_scales[static_cast<std::size_t>(row)];
  }
  return *directions;
}

Result<std::vector<std::int64_t>> sizes_of(const NrrdHeader& header) {
  const std::string* dimension = header.find("dimension");
  const std::string* sizes = header.find("sizes");
  if (dimension == nullptr) return bad_nrrd("the header has no dimension");
  if (sizes == nullptr) return bad_nrrd("the header has no sizes");
  if (*dimension == "2") return one_slice(kNrrdReader, "dimension", in_quotes(*dimension));
  if (*dimension != "3" && *dimension != "4")
    return bad_nrrd("dimension is " + in_quotes(*dimension) + "; expected 3, or 4 with layers or frames");
  const std::size_t count = *dimension == "3" ? 3 : 4;
  const auto extents = parse_integers(*sizes);
  if (!extents || extents->size() != count)
    return bad_nrrd("sizes is " + in_quotes(*sizes) + "; expected " + std::to_string(count) +
                    " whole numbers");
  return *extents;
}

}  // namespace

Result<NrrdGeometry> nrrd_geometry(const NrrdHeader& header, Reading& reading) {
  NrrdGeometry geometry;
  const Result<std::vector<std::int64_t>> sizes = sizes_of(header);
  if (!sizes) return sizes.error();
  geometry.sizes = *sizes;
  const Result<Eigen::Vector3d> signs = signs_of(header);
  if (!signs) return signs.error();
  const Result<std::vector<double>> space_scales = mm_per_unit(header, "spaceunits", 3, reading);
  if (!space_scales) return space_scales.error();
  Result<std::vector<std::optional<bool>>> spatial = spatial_kinds(header, sizes->size());
  if (!spatial) return spatial.error();
  if (header.find("spacedirections") == nullptr && sizes->size() == 4) {
    const Result<std::size_t> list = find_list_axis(*spatial, *sizes);
    if (!list) return list.error();
    (*spatial)[*list] = false;
  }
  const Result<Vectors> directions = directions_of(header, sizes->size(), *spatial, *space_scales, reading);
  if (!directions) return directions.error();
  if (sizes->size() == 4) {
    const Result<std::size_t> list = find_list_axis(*spatial, *sizes);
    if (!list) return list.error();
    geometry.list_axis = *list;
  }

  Eigen::Matrix4d affine = Eigen::Matrix4d::Identity();
  std::size_t found = 0;
  for (std::size_t axis = 0; axis < sizes->size(); ++axis) {
    if (axis == geometry.list_axis) continue;
    if (!(*directions)[axis])
      return bad_nrrd("axis " + std::to_string(axis) + " is not spatial; expected three spatial axes");
    affine.block<3, 1>(0, static_cast<int>(found)) = *(*directions)[axis];
    geometry.axes[found++] = axis;
  }
  if (const std::string* origin = header.find("spaceorigin"); origin != nullptr) {
    const auto vectors = parse_vectors(*origin);
    if (!vectors || vectors->size() != 1 || !vectors->front())
      return bad_nrrd("space origin is " + in_quotes(*origin) + "; expected one vector (x,y,z)");
    for (int row = 0; row < 3; ++row)
      affine(row, 3) = (*vectors->front())[row] * (*space_scales)[static_cast<std::size_t>(row)];
  }
  for (int row = 0; row < 3; ++row) affine.row(row) *= (*signs)[row];
  if (Status good = check_affine(kNrrdReader, "space directions, space origin or spacings", affine); !good)
    return good.error();
  geometry.index_to_mm = affine;
  return geometry;
}

}  // namespace voxtet
