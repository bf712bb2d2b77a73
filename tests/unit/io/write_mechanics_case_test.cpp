// Cases of mechanics for FEBio and svMultiPhysics.
#include "io/mesh/write_mechanics_case.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/mesh/write_mesh.h"
#include "mesh_texts.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

const MechanicsCase kWanted{1, 0.3, 1.5, 8, 1000, 2, 4, {"inside"}, "base", {}};

Field directions(std::string_view name, std::vector<float> values) {
  return {std::string(name), "Direction", "1", On::kTets, Scale::kSequential, 3, std::move(values)};
}

/// The first two outer faces are `inside`, the last one is `base`.
WriteMeshOptions options_of(const TetMesh& mesh) {
  WriteMeshOptions options;
  std::vector<std::uint32_t> outer;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.face_sides[f][1] == 0) outer.push_back(f);
  options.surfaces = {{"inside", {outer[0], outer[1]}}, {"base", {outer.back()}}};
  options.cell_data = {directions(kFibreField, {0.6F, 0.8F, 0, 1, 0, 0}),
                       directions(kSheetField, {0, 0, 1, 0, 1, 0})};
  options.name = "a & b";
  return options;
}

std::vector<OutputFile> case_of(MechanicsProgram program, const WriteMeshOptions& options) {
  Result<std::vector<OutputFile>> files = write_mechanics_case(test::two_tets(), kWanted, program, options);
  EXPECT_TRUE(files.ok()) << files.error().message;
  return files ? std::move(files).value() : std::vector<OutputFile>{};
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

TEST(MechanicsCase, IsReadBackFromFebioAsTheSameMesh) {
  const TetMesh mesh = test::two_tets();
  const std::vector<OutputFile> files = case_of(MechanicsProgram::kFebio, options_of(mesh));
  ASSERT_FALSE(files.empty());
  EXPECT_EQ(files[0].suffix, ".feb");
  const Result<TetMesh> read = read_tet_mesh({"mesh.feb", files[0].bytes, {}});
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->points, mesh.points);
  EXPECT_EQ(read->tets.size(), mesh.tets.size());
}

TEST(MechanicsCase, HasAMaterialWithFibresForFebio) {
  const std::string text =
      test::text_of(case_of(MechanicsProgram::kFebio, options_of(test::two_tets())), ".feb");
  expect_parts(
      text, {"name=\"label_5\" type=\"uncoupled solid mixture\">\n<density>1.06e-06</density>\n<k>1000</k>\n"
             "<pressure_model>NIKE3D</pressure_model>\n"
             "<solid type=\"Mooney-Rivlin\">\n<c1>1</c1>\n<c2>0.3</c2>\n</solid>\n"
             "<solid type=\"fiber-exp-pow-uncoupled\">\n<ksi>1.5</ksi>\n<alpha>8</alpha>\n<beta>2</beta>\n"
             "<fiber type=\"vector\">1,0,0</fiber>\n</solid>\n</material>\n",
             "<time_steps>4</time_steps>\n<step_size>0.25</step_size>\n", "<pressure lc=\"1\">2</pressure>\n",
             "node_set=\"@surface:base\"", "surface=\"inside\"", "<pt>0,0</pt>\n<pt>1,1</pt>\n",
             "<SolidDomain name=\"label_2\" mat=\"label_2\" type=\"elastic-solid\" elem_type=\"TET4G1\"/>\n",
             "file=\"a &amp; b.displacement.txt\"",
             "elem_set=\"label_5\">\n<elem lid=\"1\"><a>1,0,0</a><d>0,1,0</d></elem>\n</ElementData>\n"});
}

TEST(MechanicsCase, TurnsDirectionsWithTheMesh) {
  WriteMeshOptions options = options_of(test::two_tets());
  options.space = PatientSpace::kLps;
  const std::string text = test::text_of(case_of(MechanicsProgram::kFebio, options), ".feb");
  expect_parts(text, {"<elem lid=\"1\"><a>-1,0,0</a><d>0,-1,0</d></elem>\n"});
}

TEST(MechanicsCase, IsIsotropicInFebioWhereALabelHasNoFibres) {
  WriteMeshOptions options = options_of(test::two_tets());
  options.cell_data = {directions(kFibreField, {1, 0, 0, 0, 0, 0}),
                       directions(kSheetField, {0, 1, 0, 0, 0, 0})};
  const std::string text = test::text_of(case_of(MechanicsProgram::kFebio, options), ".feb");
  expect_parts(text, {"name=\"label_5\" type=\"Mooney-Rivlin\">\n<density>1.06e-06</density>\n<c1>1</c1>\n"
                      "<c2>0.3</c2>\n<k>1000</k>\n<pressure_model>NIKE3D</pressure_model>\n</material>\n"});
  EXPECT_EQ(text.find("elem_set=\"label_5\""), std::string::npos);
  const auto refused =
      write_mechanics_case(test::two_tets(), kWanted, MechanicsProgram::kSvMultiPhysics, options);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
  EXPECT_EQ(
      refused.error().message,
      "label 5: found no fibres, which a case for svMultiPhysics has everywhere; expected a mesh of the "
      "wall alone, or .feb");
}

TEST(MechanicsCase, RefusesALabelThatHasFibresInPlaces) {
  TetMesh mesh = test::two_tets();
  mesh.labels = {2, 2};
  WriteMeshOptions options = options_of(test::two_tets());
  options.cell_data = {directions(kFibreField, {1, 0, 0, 0, 0, 0}),
                       directions(kSheetField, {0, 1, 0, 0, 0, 0})};
  const auto refused = write_mechanics_case(mesh, kWanted, MechanicsProgram::kFebio, options);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
  EXPECT_EQ(refused.error().message,
            "label 2: found tetrahedra with fibres and others without, expected one material for a label");
}

TEST(MechanicsCase, SaysWhatIsMissing) {
  const TetMesh mesh = test::two_tets();
  WriteMeshOptions options = options_of(mesh);
  options.surfaces.pop_back();
  const auto no_base = write_mechanics_case(mesh, kWanted, MechanicsProgram::kFebio, options);
  ASSERT_FALSE(no_base.ok());
  EXPECT_EQ(no_base.error().message, "found no surface base");
  options.cell_data.pop_back();
  const auto no_sheet = write_mechanics_case(mesh, kWanted, MechanicsProgram::kFebio, options);
  ASSERT_FALSE(no_sheet.ok());
  EXPECT_EQ(no_sheet.error().message, "found no field sheet");
}

TEST(MechanicsCase, HasSecondOrderElementsForFebioAlone) {
  const TetMesh mesh = test::two_tets();
  WriteMeshOptions options = options_of(mesh);
  options.midside = test::nodes_of_two_tets();
  const std::string text = test::text_of(case_of(MechanicsProgram::kFebio, options), ".feb");
  expect_parts(text, {"<Elements type=\"tet10\" name=\"label_5\">\n<elem id=\"2\">1,2,3,4,",
                      "<tri6 id=\"1\">", "elem_type=\"TET10G4\"", "<node id=\"14\">"});
  const auto refused = write_mechanics_case(mesh, kWanted, MechanicsProgram::kSvMultiPhysics, options);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
}

TEST(MechanicsCase, HasAFileForEachPartOfSvMultiPhysics) {
  const TetMesh mesh = test::two_tets();
  const std::vector<OutputFile> files = case_of(MechanicsProgram::kSvMultiPhysics, options_of(mesh));
  std::vector<std::string> suffixes;
  for (const OutputFile& file : files) suffixes.push_back(file.suffix);
  EXPECT_EQ(suffixes, (std::vector<std::string>{".xml", ".mesh.vtu", ".fibersLong.vtu", ".fibersSheet.vtu",
                                                ".pressure.dat", ".README.txt", ".inside.vtp", ".base.vtp"}));
  EXPECT_EQ(test::text_of(files, ".pressure.dat"), "2 1\n0 0\n1 2\n");
  expect_parts(
      test::text_of(files, ".xml"),
      {"<Mesh_file_path>a &amp; b.mesh.vtu</Mesh_file_path>\n",
       "<Add_face name=\"base\">\n<Face_file_path>a &amp; b.base.vtp</Face_file_path>\n</Add_face>\n",
       "<a>2.6</a>\n<b>0</b>\n<a4f>1.5</a4f>\n<b4f>8</b4f>\n",
       "<Dilational_penalty_model>ST91</Dilational_penalty_model>\n<Penalty_parameter>1000<",
       "<Add_BC name=\"base\">\n<Type>Dirichlet</Type>\n<Value>0</Value>\n</Add_BC>\n",
       "<Add_BC name=\"inside\">\n<Type>Neu</Type>\n<Time_dependence>Unsteady</Time_dependence>\n"});
  const Result<TetMesh> read = read_tet_mesh({"m.vtu", files[1].bytes, {}});
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->points, mesh.points);
  EXPECT_EQ(read->tets, mesh.tets);
  expect_parts(test::text_of(files, ".inside.vtp"), {"NumberOfPoints=\"4\" NumberOfPolys=\"2\"",
                                                     "Name=\"GlobalNodeID\"", "Name=\"GlobalElementID\""});
}

TEST(MechanicsCase, IsForTheProgramOfItsEnding) {
  EXPECT_EQ(*mechanics_program_of("a/heart.feb"), MechanicsProgram::kFebio);
  EXPECT_EQ(*mechanics_program_of("heart.XML"), MechanicsProgram::kSvMultiPhysics);
  const auto other = mechanics_program_of("heart.vtu");
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().message,
            "heart.vtu: found the ending \".vtu\", expected .feb for FEBio or .xml for svMultiPhysics");
}

}  // namespace
}  // namespace voxtet
