// Fields of one and of three components, on tetrahedra and on points, in the files that have a place for
// them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "io/mesh/write_mesh.h"
#include "mesh_texts.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using test::text_of;
using test::two_tets;
using test::written;

Field tet_vectors(const std::string& name, std::vector<float> values) {
  return {name, "", "1", On::kTets, Scale::kSequential, 3, std::move(values)};
}

Field point_values(const std::string& name, std::vector<float> values, int components = 1) {
  return {name, "", "ms", On::kPoints, Scale::kSequential, components, std::move(values)};
}

const Field kFibre = tet_vectors("fibre", {1, 0.5F, 0.25F, 0, 0, 0});
const Field kSheet = tet_vectors("sheet", {-0.5F, 0, 1, 0, 0, 0});
const Field kTimes = point_values("time_ms", {0, 1.5F, kNan, 3, 4});
const Field kFlow = point_values("flow", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, 3);
/// In LPS: x and y change their signs, zeros have none.
const std::vector<float> kFibreLps{-1, -0.5F, 0.25F, 0, 0, 0};
const std::vector<float> kFlowLps{-1, -2, 3, -4, -5, 6, -7, -8, 9, -10, -11, 12, -13, -14, 15};

std::vector<std::string> suffixes_of(const std::vector<OutputFile>& files) {
  std::vector<std::string> suffixes;
  for (const OutputFile& file : files) suffixes.push_back(file.suffix);
  return suffixes;
}

std::vector<float> floats_at(const std::string& bytes, std::size_t at, std::size_t count) {
  std::vector<float> values(count);
  if (at + 4 * count <= bytes.size()) std::memcpy(values.data(), bytes.data() + at, 4 * count);
  return values;
}

/// The appended array that a VTU declares with this opening.
std::vector<float> appended(const std::string& vtu, const std::string& declared) {
  const std::string offset = "\" format=\"appended\" offset=\"";
  const std::size_t at = vtu.find("<DataArray type=\"Float32\" Name=\"" + declared + offset);
  if (at == std::string::npos) return {};
  const std::size_t begin =
      vtu.find("encoding=\"raw\">\n_") + 17 + std::stoul(vtu.substr(vtu.find(offset, at) + offset.size()));
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, vtu.data() + begin, 8);
  return floats_at(vtu, begin + 8, bytes / 4);
}

/// Equal values; NaN equals NaN.
void expect_values(const std::vector<float>& found, const std::vector<float>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (std::isnan(wanted[i])) {
      EXPECT_TRUE(std::isnan(found[i])) << i;
    } else {
      EXPECT_EQ(found[i], wanted[i]) << i;
      EXPECT_EQ(std::signbit(found[i]), std::signbit(wanted[i])) << i;
    }
  }
}

TEST(Fields, StandInVtuAtTheirElementsWithVectorsInTheSpaceOfTheFile) {
  for (const PatientSpace space : {PatientSpace::kRas, PatientSpace::kLps}) {
    const std::string vtu =
        text_of(written(two_tets(), MeshFormat::kVtu,
                        {.space = space, .cell_data = {kFibre}, .point_data = {kTimes, kFlow}}),
                ".vtu");
    const std::size_t cells = vtu.find("<CellData"), points = vtu.find("<PointData>");
    EXPECT_LT(cells, vtu.find("Name=\"fibre\""));
    EXPECT_LT(vtu.find("Name=\"fibre\""), vtu.find("</CellData>"));
    EXPECT_LT(points, vtu.find("Name=\"time_ms\""));
    EXPECT_LT(vtu.find("Name=\"flow\""), vtu.find("</PointData>"));
    const bool ras = space == PatientSpace::kRas;
    expect_values(appended(vtu, "fibre\" NumberOfComponents=\"3"), ras ? kFibre.values : kFibreLps);
    expect_values(appended(vtu, "time_ms"), kTimes.values);
    expect_values(appended(vtu, "flow\" NumberOfComponents=\"3"), ras ? kFlow.values : kFlowLps);
  }
}

TEST(Fields, AreAttributesOfCellsAndNodesInXdmf) {
  const std::vector<OutputFile> files = written(
      two_tets(), MeshFormat::kXdmf,
      {.space = PatientSpace::kLps, .cell_data = {kFibre}, .point_data = {kTimes, kFlow}, .name = "a"});
  const std::string xml = text_of(files, ".xdmf");
  for (const char* part :
       {"<Attribute Name=\"fibre\" AttributeType=\"Vector\" Center=\"Cell\">\n<DataItem DataType=\"Float\" "
        "Precision=\"4\" Dimensions=\"2 3\" Format=\"HDF\">a.h5:/fibre</DataItem>",
        "<Attribute Name=\"time_ms\" AttributeType=\"Scalar\" Center=\"Node\">\n<DataItem DataType=\"Float\" "
        "Precision=\"4\" Dimensions=\"5\" Format=\"HDF\">a.h5:/time_ms</DataItem>",
        "<Attribute Name=\"flow\" AttributeType=\"Vector\" Center=\"Node\">\n<DataItem DataType=\"Float\" "
        "Precision=\"4\" Dimensions=\"5 3\" Format=\"HDF\">a.h5:/flow</DataItem>"})
    EXPECT_NE(xml.find(part), std::string::npos) << part;
  // The arrays are the end of the file, in this order.
  const std::string numbers = text_of(files, ".h5");
  const std::size_t begin = numbers.size() - 4 * (6 + 5 + 15);
  expect_values(floats_at(numbers, begin, 6), kFibreLps);
  expect_values(floats_at(numbers, begin + 24, 5), kTimes.values);
  expect_values(floats_at(numbers, begin + 44, 15), kFlowLps);
}

TEST(Fields, AreALineForEachElementBesideOpenCarp) {
  const std::vector<OutputFile> files =
      written(two_tets(), MeshFormat::kCarp, {.space = PatientSpace::kLps, .point_data = {kTimes, kFlow}});
  EXPECT_EQ(suffixes_of(files),
            (std::vector<std::string>{".pts", ".elem", ".lon.txt", ".time_ms.dat", ".flow.dat"}));
  // openCARP knows no NaN.
  EXPECT_EQ(text_of(files, ".time_ms.dat"), "0\n1.5\n-1\n3\n4\n");
  EXPECT_EQ(text_of(files, ".flow.dat"), "-1 -2 3\n-4 -5 6\n-7 -8 9\n-10 -11 12\n-13 -14 15\n");
}

TEST(Fields, OfThreeComponentsAreElementDataOfGmsh) {
  const std::string data =
      text_of(written(two_tets(), MeshFormat::kMsh, {.space = PatientSpace::kLps, .cell_data = {kFibre}}),
              "_data.msh");
  const std::string head = "$ElementData\n1\n\"fibre\"\n1\n0\n3\n0\n3\n2\n";
  const std::size_t at = data.find(head);
  ASSERT_NE(at, std::string::npos);
  for (std::size_t t = 0; t < 2; ++t) {
    std::int32_t tag = 0;
    double vector[3];
    std::memcpy(&tag, data.data() + at + head.size() + 28 * t, 4);
    std::memcpy(vector, data.data() + at + head.size() + 28 * t + 4, 24);
    EXPECT_EQ(tag, static_cast<std::int32_t>(t + 1));
    for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(vector[d], kFibreLps[3 * t + d]);
  }
}

TEST(Fibres, AreTheLonOfOpenCarpWithZerosWhereThereAreNone) {
  const std::vector<OutputFile> one = written(two_tets(), MeshFormat::kCarp, {.cell_data = {kFibre}});
  EXPECT_EQ(suffixes_of(one), (std::vector<std::string>{".pts", ".elem", ".lon"}));
  EXPECT_EQ(text_of(one, ".lon"), "1\n1 0.5 0.25\n0 0 0\n");

  const std::vector<OutputFile> both =
      written(two_tets(), MeshFormat::kCarp, {.space = PatientSpace::kLps, .cell_data = {kSheet, kFibre}});
  EXPECT_EQ(suffixes_of(both), (std::vector<std::string>{".pts", ".elem", ".lon"}));
  EXPECT_EQ(text_of(both, ".lon"), "2\n-1 -0.5 0.25 0.5 0 1\n0 0 0 0 0 0\n");
}

TEST(Fibres, OfOpenCarpAreVectorsOfThatNameAlone) {
  // A sheet without a fibre, a fibre at points, and a number that is called fibre.
  for (const WriteMeshOptions& options :
       {WriteMeshOptions{.cell_data = {kSheet}},
        WriteMeshOptions{.point_data = {point_values("fibre", kFlow.values, 3)}},
        WriteMeshOptions{.cell_data = {{"fibre", "", "1", On::kTets, Scale::kSequential, 1, {1, 2}}}}}) {
    const std::vector<OutputFile> files = written(two_tets(), MeshFormat::kCarp, options);
    EXPECT_FALSE(has_fibres(options.cell_data));
    EXPECT_EQ(text_of(files, ".lon.txt"), std::string(kNoFibres) + "\n");
    EXPECT_EQ(files.size(), 4U);
  }
}

TEST(Fields, AreRefusedWhereTheFormatHasNoPlaceForThem) {
  for (const MeshFormat format : {MeshFormat::kMedit, MeshFormat::kAbaqus, MeshFormat::kFebio}) {
    EXPECT_FALSE(has_place_for(On::kTets, 3, format));
    const auto files = write_tet_mesh(two_tets(), format, {.cell_data = {kFibre}});
    ASSERT_FALSE(files.ok());
    EXPECT_EQ(files.error().code, ErrorCode::kUsage);
    EXPECT_EQ(files.error().message,
              "vectors on tetrahedra (fibre): this format has no place for them, expected .vtu, .vtk, .xdmf, "
              ".carp or "
              ".msh");
  }
  for (const MeshFormat format :
       {MeshFormat::kMsh, MeshFormat::kMedit, MeshFormat::kAbaqus, MeshFormat::kFebio}) {
    EXPECT_FALSE(has_place_for(On::kPoints, 1, format));
    const auto files = write_tet_mesh(two_tets(), format, {.point_data = {kTimes}});
    ASSERT_FALSE(files.ok());
    EXPECT_EQ(files.error().code, ErrorCode::kUsage);
    EXPECT_EQ(
        files.error().message,
        "values at points (time_ms): this format has no place for them, expected .vtu, .vtk, .xdmf or .carp");
  }
}

TEST(Fields, AreRefusedWithValuesOfOtherElementsOrTooFew) {
  const auto error_of = [](const WriteMeshOptions& options) {
    const auto files = write_tet_mesh(two_tets(), MeshFormat::kVtu, options);
    return files.ok() ? std::string("none") : files.error().message;
  };
  EXPECT_EQ(error_of({.cell_data = {kTimes}}), "cell data time_ms hold a value that is not finite");
  EXPECT_EQ(error_of({.cell_data = {kFlow}}), "data flow: found values of points, expected values of tets");
  EXPECT_EQ(error_of({.point_data = {kFibre}}),
            "data fibre: found values of tets, expected values of points");
  EXPECT_EQ(error_of({.point_data = {point_values("few", {1, 2, 3})}}), "data few: 3 values for 5 points");
  EXPECT_EQ(error_of({.cell_data = {tet_vectors("fibre", {1, 2})}}), "data fibre: 2 values for 2 tets");
}

}  // namespace
}  // namespace voxtet
