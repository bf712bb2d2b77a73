#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "io/bytes/header_text.h"
#include "io/mesh/shared/face_owners.h"
#include "io/mesh/shared/mesh_groups.h"
#include "io/mesh/write_mesh.h"
#include "mesh_texts.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

using test::two_tets;

const std::vector<LabelInfo> kInfos{{5, "scar, dense", {}}, {2, "3rd \"wall\"", {}}};

std::string only_file(MeshFormat format, const WriteMeshOptions& options) {
  const auto files = write_tet_mesh(two_tets(), format, options);
  EXPECT_TRUE(files.ok()) << files.error().message;
  return files.ok() ? test::text_of(files->front().bytes) : "";
}

TEST(WordName, IsAWordThatEndsWithItsLabel) {
  const std::vector<LabelInfo> infos{{1, " LV myocardium, (apex)_", {}}, {2, "2nd", {}},
                                     {3, "\xc3\xa9\xc3\xa9", {}},        {4, std::string(99, 'x'), {}},
                                     {5, "Lv Myocardium__apex", {}},     {6, "background", {}}};
  EXPECT_EQ(word_name(Label{1}, infos), "LV_myocardium_apex_1");
  EXPECT_EQ(word_name(Label{2}, infos), "label_2nd_2");
  EXPECT_EQ(word_name(Label{3}, infos), "label_3");
  EXPECT_EQ(word_name(Label{4}, infos), std::string(32, 'x') + "_4");
  EXPECT_EQ(word_name(Label{65535}, infos), "label_65535");
  EXPECT_EQ(word_name(Sides{6, 0}, infos), "background_6__background");
  std::set<std::string> distinct;
  for (Label label = 0; label < 9; ++label) distinct.insert(lower_case(word_name(label, infos)));
  EXPECT_EQ(distinct.size(), 9U);
}

TEST(FaceOwners, AreTheTetrahedraBehindTheFaces) {
  const TetMesh mesh = test::kuhn_cube(3);
  const auto owners = face_owners(mesh);
  ASSERT_TRUE(owners.ok());
  ASSERT_EQ(owners->size(), mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [tet, opposite] = (*owners)[f];
    EXPECT_EQ(mesh.labels[tet], mesh.face_sides[f][0]);
    std::set<std::uint32_t> corners(mesh.tets[tet].begin(), mesh.tets[tet].end());
    corners.erase(mesh.tets[tet][opposite]);
    EXPECT_EQ(corners, std::set<std::uint32_t>(mesh.faces[f].begin(), mesh.faces[f].end()));
  }
}

TEST(FaceOwners, AreMissedWhereAFaceLiesOnNoTetrahedronOfItsLabel) {
  TetMesh mesh = two_tets();
  mesh.face_sides[3] = {7, 0};
  const auto files = write_tet_mesh(mesh, MeshFormat::kAbaqus, {});
  ASSERT_FALSE(files.ok());
  EXPECT_EQ(files.error().code, ErrorCode::kInternal);
  EXPECT_EQ(files.error().message, "face 3 is on no tetrahedron of label 7");
}

TEST(WriteAbaqus, NumbersFromOneWithASetForEachLabelAndASurfaceForEachPair) {
  EXPECT_EQ(only_file(MeshFormat::kAbaqus, {PatientSpace::kLps, kInfos}),
            "*HEADING\nvoxtet mesh\n"
            "** space LPS, unit mm: x to the left of the patient, y posterior, z superior\n"
            "** 5 nodes, 2 elements\n"
            "*NODE\n1, 0, 0, 0\n2, -1, 0, 0\n3, 0, -0.25, 0\n4, 0, 0, 2\n5, 0, 0, -2\n"
            "*ELEMENT, TYPE=C3D4, ELSET=label_3rd_wall_2\n1, 1, 3, 2, 5\n"
            "*ELEMENT, TYPE=C3D4, ELSET=scar_dense_5\n2, 1, 2, 3, 4\n"
            "*SURFACE, NAME=label_3rd_wall_2__background, TYPE=ELEMENT\n1, S4\n1, S2\n1, S3\n"
            "*SURFACE, NAME=scar_dense_5__background, TYPE=ELEMENT\n2, S2\n2, S4\n2, S3\n"
            "*SURFACE, NAME=scar_dense_5__label_3rd_wall_2, TYPE=ELEMENT\n2, S1\n");
}

TEST(WriteAbaqus, KeepsEveryNumberToTwentyCharacters) {
  TetMesh mesh = two_tets();
  const std::vector<double> awkward{-0.012345678901234567, -1.2345678901234567e-5, -123.45678901234567,
                                    -1.2345678901234567e22, -9.8765432109876543e-300};
  for (std::size_t p = 0; p < awkward.size(); ++p) mesh.points[p].x() = awkward[p];
  const auto files = write_tet_mesh(mesh, MeshFormat::kAbaqus, {});
  ASSERT_TRUE(files.ok());
  std::istringstream in(test::text_of(files->front().bytes));
  std::string line;
  while (line != "*NODE") ASSERT_TRUE(std::getline(in, line));
  for (const double wanted : awkward) {
    std::getline(in, line);
    const std::size_t begin = line.find(", ") + 2;
    const std::string number = line.substr(begin, line.find(',', begin) - begin);
    EXPECT_LE(number.size(), 20U) << number;
    EXPECT_NEAR(std::stod(number), wanted, 1e-15 + 1e-12 * std::abs(wanted)) << number;
  }
}

TEST(WriteAbaqus, PutsCellDataIntoDistributionsOfTheirOwn) {
  const auto files = write_tet_mesh(two_tets(), MeshFormat::kAbaqus,
                                    {PatientSpace::kRas, {}, {test::tet_values("fraction_5", {0.25F, 1})}});
  ASSERT_TRUE(files.ok());
  ASSERT_EQ(files->size(), 2U);
  EXPECT_EQ((*files)[1].suffix, ".fraction_5.inp");
  EXPECT_EQ(test::text_of((*files)[1].bytes),
            "** fraction_5: data lines of *DISTRIBUTION, LOCATION=ELEMENT\n, 0\n1, 0.25\n2, 1\n");
}

TEST(WriteFebio, HasAPartAMaterialAndADomainForEachLabel) {
  const std::string text =
      only_file(MeshFormat::kFebio, {PatientSpace::kRas, kInfos, {test::tet_values("f", {0.25F, 1})}});
  for (const char* part :
       {"<febio_spec version=\"4.0\">\n<!-- voxtet mesh, space RAS, unit mm: ", "<units>mm-kg-s</units>",
        "<material id=\"2\" name=\"scar_dense_5\" type=\"neo-Hookean\">", "<node id=\"3\">0,0.25,0</node>\n",
        "<Elements type=\"tet4\" name=\"label_3rd_wall_2\">\n<elem id=\"1\">1,3,2,5</elem>\n</Elements>\n",
        "<Elements type=\"tet4\" name=\"scar_dense_5\">\n<elem id=\"2\">1,2,3,4</elem>\n</Elements>\n",
        "<Surface name=\"scar_dense_5__label_3rd_wall_2\">\n<tri3 id=\"1\">",
        "<SolidDomain name=\"scar_dense_5\" mat=\"scar_dense_5\"/>\n",
        "<ElementData name=\"f\" elem_set=\"scar_dense_5\">\n<e lid=\"1\">1</e>\n</ElementData>\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(only_file(MeshFormat::kFebio, {}).find("MeshData"), std::string::npos);
}

TEST(WriteXdmf, NamesItsHeavyDataAfterTheFiles) {
  EXPECT_EQ(mesh_name_of("/a.b/heart <1> & co.v2.xdmf"), "heart <1> & co.v2");
  EXPECT_EQ(mesh_name_of("heart.xdmf"), "heart");
  const std::string text = only_file(
      MeshFormat::kXdmf,
      {.space = PatientSpace::kLps, .cell_data = {test::tet_values("f", {0.25F, 1})}, .name = "a <1> & b"});
  for (const char* part :
       {"<!-- voxtet mesh, space LPS, unit mm: x to the left",
        "Precision=\"8\" Dimensions=\"5 3\" Format=\"HDF\">a &lt;1&gt; &amp; b.h5:/points<",
        "DataType=\"Int\" Precision=\"4\" Dimensions=\"2 4\" Format=\"HDF\">"
        "a &lt;1&gt; &amp; b.h5:/tets<",
        "<Attribute Name=\"label\" AttributeType=\"Scalar\" Center=\"Cell\">\n",
        "DataType=\"Float\" Precision=\"4\" Dimensions=\"2\" Format=\"HDF\">"
        "a &lt;1&gt; &amp; b.h5:/f<"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(WriteXdmf, RefusesANameThatCannotBeReferredTo) {
  for (const char* name : {"", " a", "a ", "c:a", "a\nb"}) {
    const auto files = write_tet_mesh(two_tets(), MeshFormat::kXdmf, {.name = name});
    ASSERT_FALSE(files.ok()) << name;
    EXPECT_EQ(files.error().code, ErrorCode::kUsage);
  }
}

}  // namespace
}  // namespace voxtet
