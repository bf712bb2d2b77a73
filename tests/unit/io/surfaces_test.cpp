// Named surfaces in the files of every format that has a place for them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "io/mesh/write_mesh.h"
#include "mesh_texts.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

using test::text_of;
using test::two_tets;
using test::written;

/// A roof of two faces of label 5, and a floor of one of label 2 and one of label 5.
std::vector<NamedSet> roof_and_floor(const TetMesh& mesh) {
  std::vector<std::uint32_t> upper, lower;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.face_sides[f] == Sides{5, 0}) upper.push_back(f);
    if (mesh.face_sides[f] == Sides{2, 0}) lower.push_back(f);
  }
  std::vector<NamedSet> sets{{"roof", {upper[0], upper[1]}}, {"floor", {lower[0], upper[2]}}};
  std::sort(sets[1].members.begin(), sets[1].members.end());
  return sets;
}

/// Three pairs of sides, then the two surfaces.
std::vector<std::int32_t> tags_of(const TetMesh& mesh, const std::vector<NamedSet>& sets) {
  std::vector<std::int32_t> tags;
  for (const Sides& sides : mesh.face_sides)
    tags.push_back(sides == Sides{2, 0} ? 1 : sides == Sides{5, 0} ? 2 : 3);
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (const std::uint32_t face : sets[s].members) tags[face] = static_cast<std::int32_t>(4 + s);
  return tags;
}

std::string corners(const Triangle& face) {
  return std::to_string(face[0]) + " " + std::to_string(face[1]) + " " + std::to_string(face[2]);
}

template <class T>
std::vector<T> tail(const std::string& bytes, std::size_t from_end, std::size_t count) {
  std::vector<T> values(count);
  if (from_end <= bytes.size())
    std::memcpy(values.data(), bytes.data() + bytes.size() - from_end, sizeof(T) * count);
  return values;
}

TEST(Surfaces, AreTrianglesAndPointsBesideOpenCarp) {
  const TetMesh mesh = two_tets();
  const std::vector<NamedSet> sets = roof_and_floor(mesh);
  const std::vector<OutputFile> files = written(mesh, MeshFormat::kCarp, {.surfaces = sets});
  ASSERT_EQ(files.size(), 7U);
  EXPECT_EQ(text_of(files, ".roof.surf"), "2\nTr " + corners(mesh.faces[sets[0].members[0]]) + "\nTr " +
                                              corners(mesh.faces[sets[0].members[1]]) + "\n");
  // All of label 5's points are on its two faces of the roof.
  EXPECT_EQ(text_of(files, ".roof.surf.vtx"), "4\nextra\n0\n1\n2\n3\n");
  EXPECT_EQ(files[5].suffix, ".floor.surf");
  EXPECT_EQ(files[6].suffix, ".floor.surf.vtx");
}

TEST(Surfaces, StandBehindTheGroupsByLabelsInAbaqusAndFebio) {
  const TetMesh mesh = two_tets();
  const std::vector<NamedSet> sets = roof_and_floor(mesh);
  for (const MeshFormat format : {MeshFormat::kAbaqus, MeshFormat::kFebio}) {
    const std::string without = text_of(written(mesh, format, {})[0].bytes),
                      with = text_of(written(mesh, format, {.surfaces = sets})[0].bytes);
    // The sets are all that is added.
    const std::string last =
        format == MeshFormat::kAbaqus ? without : without.substr(0, without.find("</Mesh>"));
    EXPECT_EQ(with.substr(0, last.size()), last);
    EXPECT_EQ(with.substr(with.size() - (without.size() - last.size())), without.substr(last.size()));
  }
  const std::string febio = text_of(written(mesh, MeshFormat::kFebio, {.surfaces = sets})[0].bytes);
  const Triangle& face = mesh.faces[sets[0].members[0]];
  EXPECT_NE(febio.find("<Surface name=\"roof\">\n<tri3 id=\"1\">" + std::to_string(face[0] + 1) + "," +
                       std::to_string(face[1] + 1) + "," + std::to_string(face[2] + 1) +
                       "</tri3>\n<tri3 id=\"2\">"),
            std::string::npos);
  const std::string abaqus = text_of(written(mesh, MeshFormat::kAbaqus, {.surfaces = sets})[0].bytes);
  const std::size_t floor = abaqus.find("*SURFACE, NAME=floor, TYPE=ELEMENT\n");
  ASSERT_NE(floor, std::string::npos);
  // One face of each tetrahedron.
  EXPECT_NE(abaqus.find("\n1, S", floor), std::string::npos);
  EXPECT_NE(abaqus.find("\n2, S", floor), std::string::npos);
}

TEST(Surfaces, AreFurtherPhysicalGroupsOfGmsh) {
  const TetMesh mesh = two_tets();
  const std::vector<OutputFile> files = written(mesh, MeshFormat::kMsh, {.surfaces = roof_and_floor(mesh)});
  const std::string msh = text_of(files[0].bytes);
  EXPECT_NE(
      msh.find("$PhysicalNames\n7\n2 1 \"label 2|background\"\n2 2 \"label 5|background\"\n"
               "2 3 \"label 5|label 2\"\n2 4 \"roof\"\n2 5 \"floor\"\n3 2 \"label 2\"\n3 5 \"label 5\"\n"),
      std::string::npos);
  // Patches: 2|0 alone and as floor, 5|0 as roof and as floor, 5|2.
  const std::size_t entities = msh.find("$Entities\n") + 10;
  std::array<std::uint64_t, 4> counts{};
  std::memcpy(counts.data(), msh.data() + entities, 32);
  EXPECT_EQ(counts, (std::array<std::uint64_t, 4>{0, 0, 5, 2}));
  const Result<TetMesh> back = test::read_export(files);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->tets, mesh.tets);
  EXPECT_EQ(back->labels, mesh.labels);
}

TEST(Surfaces, AreNumbersOfTheTrianglesBesideVtu) {
  const TetMesh mesh = two_tets();
  const std::vector<NamedSet> sets = roof_and_floor(mesh);
  const std::vector<OutputFile> files = written(mesh, MeshFormat::kVtu, {.surfaces = sets});
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].bytes, written(mesh, MeshFormat::kVtu, {})[0].bytes);
  const std::string vtu = text_of(files, ".surfaces.vtu");
  EXPECT_NE(vtu.find("z superior; surface 1 roof, 2 floor -->"), std::string::npos);
  EXPECT_NE(vtu.find("<DataArray type=\"Int32\" Name=\"surface\""), std::string::npos);
  std::vector<std::int32_t> wanted(mesh.faces.size(), 0);
  for (std::size_t s = 0; s < 2; ++s)
    for (const std::uint32_t face : sets[s].members) wanted[face] = static_cast<std::int32_t>(s + 1);
  const std::size_t footer = std::string("\n</AppendedData>\n</VTKFile>\n").size();
  EXPECT_EQ(tail<std::int32_t>(vtu, footer + 4 * wanted.size(), wanted.size()), wanted);
}

TEST(Surfaces, AndInterfacesAreTagsOfFacetsOnThePointsOfTheMeshBesideXdmf) {
  const TetMesh mesh = two_tets();
  const std::vector<NamedSet> sets = roof_and_floor(mesh);
  const std::vector<OutputFile> files = written(mesh, MeshFormat::kXdmf, {.surfaces = sets, .name = "a"});
  ASSERT_EQ(files.size(), 4U);
  const std::vector<OutputFile> without = written(mesh, MeshFormat::kXdmf, {.name = "a"});
  EXPECT_NE(text_of(without, ".facets.xdmf").find("; facet 1 label 2|background, 2 label 5|background, 3 "),
            std::string::npos);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(files[i].bytes, without[i].bytes);
  const std::string xml = text_of(files, ".facets.xdmf");
  for (const char* part :
       {"; facet 1 label 2|background, 3 label 5|label 2, 4 roof, 5 floor -->",
        "<Grid Name=\"facets\" GridType=\"Uniform\">",
        "Dimensions=\"5 3\" Format=\"HDF\">a.facets.h5:/points<",
        "<Topology TopologyType=\"Triangle\" NodesPerElement=\"3\" NumberOfElements=\"7\">\n"
        "<DataItem DataType=\"Int\" Precision=\"4\" Dimensions=\"7 3\" "
        "Format=\"HDF\">a.facets.h5:/triangles<",
        "<Attribute Name=\"facet\" AttributeType=\"Scalar\" Center=\"Cell\">\n"
        "<DataItem DataType=\"Int\" Precision=\"4\" Dimensions=\"7\" Format=\"HDF\">a.facets.h5:/facet<"})
    EXPECT_NE(xml.find(part), std::string::npos) << part;
  const std::string numbers = text_of(files, ".facets.h5");
  EXPECT_EQ(tail<std::int32_t>(numbers, 28, 7), tags_of(mesh, sets));
  const Triangle& first = mesh.faces[0];
  EXPECT_EQ(tail<std::uint32_t>(numbers, 28 + 84, 3),
            (std::vector<std::uint32_t>(first.begin(), first.end())));
}

TEST(Surfaces, AreTheTagOfEachFaceInMsh22TetgenAndNastran) {
  const TetMesh mesh = two_tets();
  const std::vector<NamedSet> sets = roof_and_floor(mesh);
  const std::vector<std::int32_t> tags = tags_of(mesh, sets);
  const std::string msh = text_of(written(mesh, MeshFormat::kMsh22, {.surfaces = sets}), ".msh");
  EXPECT_NE(msh.find("2 3 \"label 5|label 2\"\n2 4 \"roof\"\n2 5 \"floor\"\n3 2 \"label 2\"\n"),
            std::string::npos);
  const std::string face = text_of(written(mesh, MeshFormat::kTetgen, {.surfaces = sets}), ".face");
  EXPECT_TRUE(
      face.starts_with("# marker 1 label 2|background\n# marker 3 label 5|label 2\n# marker 4 roof\n"
                       "# marker 5 floor\n7 1\n"));
  const std::string bdf = text_of(written(mesh, MeshFormat::kNastran, {.surfaces = sets}), ".bdf");
  EXPECT_NE(bdf.find("$ load 4 roof\n$ load 5 floor\n"), std::string::npos);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    std::string corners;
    for (const std::uint32_t corner : mesh.faces[f]) corners += " " + std::to_string(corner + 1);
    const std::string tag = std::to_string(tags[f]);
    // In MSH the elementary tag follows: faces of two labels and one surface are two entities.
    const std::size_t element = msh.find("\n" + std::to_string(3 + f) + " 2 2 " + tag + " ");
    ASSERT_NE(element, std::string::npos) << msh;
    EXPECT_EQ(msh.substr(msh.find('\n', element + 1) - corners.size(), corners.size()), corners);
    EXPECT_NE(face.find("\n" + std::to_string(f + 1) + corners + " " + tag + "\n"), std::string::npos)
        << face;
    // On the element behind the face: a corner of the face, then the corner that is not on it.
    const std::size_t behind = mesh.face_sides[f][0] == 2 ? 0 : 1;
    std::size_t apex = 0;
    for (const std::uint32_t corner : mesh.tets[behind])
      if (std::find(mesh.faces[f].begin(), mesh.faces[f].end(), corner) == mesh.faces[f].end())
        apex = corner + 1;
    const std::string load = "PLOAD4  " + tag + "       " + std::to_string(behind + 1) +
                             "       1.0                             " +
                             std::to_string(mesh.faces[f][0] + 1) + "       " + std::to_string(apex) + "\n";
    EXPECT_NE(bdf.find(load), std::string::npos) << load << bdf;
  }
}

TEST(Surfaces, AreNumbersOfTheTrianglesBesideVtk) {
  const TetMesh mesh = two_tets();
  const std::vector<NamedSet> sets = roof_and_floor(mesh);
  const std::vector<OutputFile> files = written(mesh, MeshFormat::kVtk, {.surfaces = sets});
  ASSERT_EQ(files.size(), 2U);
  const std::string vtk = text_of(files, ".surfaces.vtk");
  EXPECT_NE(vtk.find("surface_names 1 11 unsigned_char\n114 111 111 102 0 102 108 111 111 114 0\n"),
            std::string::npos);
  std::string numbers = "SCALARS surface int 1\nLOOKUP_TABLE default\n";
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    std::size_t number = 0;
    for (std::size_t s = 0; s < 2; ++s)
      if (std::count(sets[s].members.begin(), sets[s].members.end(), f) > 0) number = s + 1;
    numbers += std::to_string(number) + "\n";
  }
  EXPECT_TRUE(vtk.ends_with(numbers)) << vtk;
}

TEST(Surfaces, AreLeftOutByTheOtherFormats) {
  const TetMesh mesh = two_tets();
  for (const MeshFormat format : {MeshFormat::kMedit, MeshFormat::kStl, MeshFormat::kPly}) {
    EXPECT_FALSE(has_place_for_surfaces(format));
    const std::vector<OutputFile> files = written(mesh, format, {.surfaces = roof_and_floor(mesh)});
    ASSERT_EQ(files.size(), 1U);
    EXPECT_EQ(files[0].bytes, written(mesh, format, {})[0].bytes);
  }
}

TEST(Surfaces, AreRefusedWithABadNameAFaceThatIsNotThereOrOneThatIsTaken) {
  const TetMesh mesh = two_tets();
  const auto error_of = [&](std::vector<NamedSet> sets) {
    const auto files = write_tet_mesh(mesh, MeshFormat::kVtu, {.surfaces = std::move(sets)});
    if (files.ok()) return std::string("none");
    EXPECT_EQ(files.error().code, ErrorCode::kInternal);
    return files.error().message;
  };
  EXPECT_EQ(error_of({{"a b", {0}}}), "surface \"a b\": expected a name of letters, digits and _");
  EXPECT_EQ(error_of({{"a", {0, 7}}}), "surface a: face 7 of 7");
  EXPECT_EQ(error_of({{"a", {0, 1}}, {"b", {1}}}),
            "surface b: face 1 is in a surface already, expected it once");
}

}  // namespace
}  // namespace voxtet
