// Values of openCARP beside a mesh: .lon, .dat and .igb.
#include "io/mesh/read_values.h"

#include <cmath>
#include <cstring>

#include "io/mesh/read_mesh.h"
#include "io/mesh/write_igb.h"
#include "support/labelled_mesh.h"
#include "unit/io/mesh_texts.h"

namespace voxtet::test {
namespace {

/// A mesh of two tetrahedra with a triangle between them, and a .lon.
std::vector<OutputFile> mesh_with_directions(const std::string& lon) {
  return {{".elem", bytes_of("3\nTt 0 1 2 3 7\nTr 0 1 2 9\nTt 0 2 1 4 8\n")},
          {".pts", bytes_of("5\n0 0 0\n1000 0 0\n0 1000 0\n0 0 1000\n0 0 -1000\n")},
          {".lon", bytes_of(lon)}};
}

Result<MeshArrays> read_arrays(const std::vector<OutputFile>& files) {
  const SiblingReader sibling = [&](const std::string& name) -> Result<Bytes> {
    for (const OutputFile& file : files)
      if (name == "mesh" + file.suffix) return file.bytes;
    return Error{ErrorCode::kBadInput, "test", name + " is missing", {}};
  };
  MeshArrays arrays;
  const auto mesh = read_tet_mesh({"mesh" + files[0].suffix, files[0].bytes, sibling}, &arrays);
  if (!mesh.ok()) return mesh.error();
  return arrays;
}

TEST(ReadCarpDirections, KeepsThoseOfTheTetrahedra) {
  const auto arrays = read_arrays(mesh_with_directions("2\n1 0 0 0 1 0\n9 9 9 9 9 9\n0 0 0 0 0 -1\n"));
  ASSERT_TRUE(arrays.ok()) << arrays.error().message;
  ASSERT_EQ(arrays->cell_data.size(), 2U);
  EXPECT_EQ(arrays->cell_data[0].name, kFibreField);
  EXPECT_EQ(arrays->cell_data[0].values, (std::vector<float>{1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(arrays->cell_data[1].name, kSheetField);
  EXPECT_EQ(arrays->cell_data[1].values, (std::vector<float>{0, 1, 0, 0, 0, -1}));
}

TEST(ReadCarpDirections, AreOneOrTwoOrNone) {
  const auto one = read_arrays(mesh_with_directions("1\n1 0 0\n9 9 9\n0 0 1\n"));
  ASSERT_TRUE(one.ok()) << one.error().message;
  ASSERT_EQ(one->cell_data.size(), 1U);
  auto files = mesh_with_directions("");
  files.pop_back();
  const auto none = read_arrays(files);
  ASSERT_TRUE(none.ok()) << none.error().message;
  EXPECT_TRUE(none->cell_data.empty());
}

TEST(ReadCarpDirections, ComeBackAsTheyWereWritten) {
  const TetMesh mesh = kuhn_cube(2);
  Field fibre{"fibre", "Fibre", "1", On::kTets, Scale::kSequential, 3, {}};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto angle = static_cast<float>(t);
    fibre.values.insert(fibre.values.end(), {std::cos(angle), std::sin(angle), 0});
  }
  auto files = written(mesh, MeshFormat::kCarp, {.cell_data = {fibre}});
  std::swap(files[0], files[1]);
  const auto arrays = read_arrays(files);
  ASSERT_TRUE(arrays.ok()) << arrays.error().message;
  ASSERT_EQ(arrays->cell_data.size(), 1U);
  EXPECT_EQ(arrays->cell_data[0].values, fibre.values);
}

TEST(ReadCarpDirections, NameWhatIsWrong) {
  for (const auto& [lon, part] :
       {std::pair{"3\n1 0 0\n", "line 1: the number of directions of an element is \"3\""},
        std::pair{"1\n1 0 0\n0 1 0\n", "found 2 rows, expected 3"},
        std::pair{"2\n1 0 0\n0 1 0\n0 0 1\n", "found 1 rows, expected 3"},
        std::pair{"1\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n", "line 5: found \"1\" behind the last"},
        std::pair{"1\n1 0 0\n0 nan 0\n0 0 1\n", "line 3: a direction is \"nan\""}}) {
    const auto arrays = read_arrays(mesh_with_directions(lon));
    ASSERT_FALSE(arrays.ok()) << lon;
    EXPECT_NE(arrays.error().message.find("mesh.lon"), std::string::npos) << arrays.error().message;
    EXPECT_NE(arrays.error().message.find(part), std::string::npos) << arrays.error().message;
  }
}

Result<PointValues> open_text(const std::string& name, const std::string& text) {
  return PointValues::open(name, bytes_of(text));
}

void expect_values_refused(const std::string& name, const std::string& text, const std::string& part) {
  const auto values = open_text(name, text);
  ASSERT_FALSE(values.ok()) << name;
  EXPECT_EQ(values.error().code, ErrorCode::kBadInput);
  EXPECT_NE(values.error().message.find(name), std::string::npos) << values.error().message;
  EXPECT_NE(values.error().message.find(part), std::string::npos) << values.error().message;
}

TEST(PointValuesOfDat, AreNumbersOneForEachPoint) {
  const auto values = open_text("a/heart.activation_ms.dat", "0.5\n-1\n12\n");
  ASSERT_TRUE(values.ok()) << values.error().message;
  EXPECT_EQ(values->count(), 3U);
  EXPECT_TRUE(values->times_ms().empty());
  EXPECT_EQ(values->frames(), 1U);
  const auto field = values->frame(0);
  ASSERT_TRUE(field.ok());
  EXPECT_EQ(field->name, "activation_ms");
  EXPECT_EQ(field->unit, "ms");
  EXPECT_EQ(field->on, On::kPoints);
  EXPECT_FLOAT_EQ(field->values[0], 0.5F);
  EXPECT_TRUE(std::isnan(field->values[1]));  // never activated
  EXPECT_FLOAT_EQ(field->values[2], 12);
  EXPECT_TRUE(values->check_count(3).ok());
  EXPECT_EQ(values->check_count(4).error().message,
            "a/heart.activation_ms.dat: found 3 values, expected 4, one for each point of the mesh");
}

TEST(PointValuesOfDat, KeepMinusOneAmongOthersBelowZero) {
  const auto values = open_text("init_acts_vm-thresh.dat", "-80\n-1\n");
  ASSERT_TRUE(values.ok()) << values.error().message;
  const auto field = values->frame(0);
  EXPECT_EQ(field->name, "init_acts_vm_thresh");
  EXPECT_EQ(field->values, (std::vector<float>{-80, -1}));
}

TEST(PointValuesOfDat, NameWhatIsWrong) {
  expect_values_refused("a.dat", "1\nx\n", "line 2: a value is \"x\", expected a finite number");
  expect_values_refused("a.dat", "1\ninf\n", "line 2");
  expect_values_refused("a.dat", "1\n2", "the file ends inside the line of the last value");
  expect_values_refused("a.dat", "\n", "found no value");
  expect_values_refused("a.txt", "1\n", "\".txt\", expected .dat or .igb");
}

/// An .igb of these words.
std::string igb(std::string words, const std::string& data) {
  words.resize(IgbHeader::kBytes - 1, ' ');
  return words + '\f' + data;
}

template <class T>
std::string raw(const std::vector<T>& values, bool big_endian = false) {
  std::string out;
  for (const T value : values) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    out += bytes;
  }
  return out;
}

template <class T>
void expect_type(const std::string& type, const std::vector<T>& stored) {
  for (const bool big : {false, true}) {
    const auto values = open_text(
        "vm.igb", igb("x:3 y:1 z:1 t:2 type:" + type + " systeme:" + (big ? "big" : "little") +
                          "_endian\r\nfacteur:0.5 zero:-80 inc_t:5 unites:mV unites_x:um # a:comment\r\n",
                      raw(stored, big)));
    ASSERT_TRUE(values.ok()) << type << ": " << values.error().message;
    EXPECT_EQ(values->times_ms(), (std::vector<double>{0, 5}));
    for (std::size_t frame = 0; frame < 2; ++frame) {
      const auto field = values->frame(frame);
      ASSERT_TRUE(field.ok());
      EXPECT_EQ(field->name, "vm");
      EXPECT_EQ(field->unit, "mV");
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_FLOAT_EQ(field->values[i],
                        static_cast<float>(0.5 * static_cast<double>(stored[3 * frame + i]) - 80))
            << type << big;
    }
  }
}

TEST(PointValuesOfIgb, AreOfAnyTypeAndByteOrder) {
  expect_type<std::uint8_t>("byte", {0, 1, 255, 3, 4, 5});
  expect_type<std::int8_t>("char", {0, -1, -128, 127, 4, 5});
  expect_type<std::int16_t>("short", {0, -1, -32768, 32767, 4, 5});
  expect_type<std::int32_t>("int", {0, -1, -2147483647, 70000, 4, 5});
  expect_type<std::uint32_t>("uint", {0, 1, 4000000000, 70000, 4, 5});
  expect_type<float>("float", {0, -1.5F, 1e20F, 3, 4, 5});
  expect_type<double>("double", {0, -1.5, 1e20, 3, 4, 5});
}

TEST(PointValuesOfIgb, HaveTheTimesOfTheirHeader) {
  const std::string start = "x:1 y:1 t:3 type:byte systeme:little_endian ";
  const auto times = [&](const std::string& words) {
    const auto values = open_text("a.igb", igb(start + words, "abc"));
    EXPECT_TRUE(values.ok()) << values.error().message;
    return values.ok() ? values->times_ms() : std::vector<double>{};
  };
  EXPECT_EQ(times(""), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(times("org_t:10 inc_t:2"), (std::vector<double>{10, 12, 14}));
  EXPECT_EQ(times("dim_t:100 unites_t:ms"), (std::vector<double>{0, 50, 100}));
  EXPECT_EQ(times("inc_t:0.5 dim_t:1 org_t:1 unites_t:s"), (std::vector<double>{1000, 1500, 2000}));
}

TEST(PointValuesOfIgb, NameWhatIsWrong) {
  const std::string good = "x:2 y:1 z:1 t:2 type:float systeme:little_endian ";
  const std::string data = raw<float>({1, 2, 3, 4});
  ASSERT_TRUE(open_text("a.igb", igb(good, data)).ok());
  ASSERT_TRUE(open_text("a.igb", igb(good, data + "\f")).ok());  // as the manual says
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string words = good;
    words.replace(words.find(from), from.size(), to);
    return igb(words, data);
  };
  expect_values_refused("a.igb", "x:2", "found 3 bytes, expected a header of 1024");
  expect_values_refused("a.igb", changed("x:2", ""), "x: found none, expected a whole number of at least 1");
  expect_values_refused("a.igb", changed("x:2", "x:0"), "x: found \"0\"");
  expect_values_refused("a.igb", changed("t:2", "t:2.5"), "t: found \"2.5\"");
  expect_values_refused("a.igb", changed("float", "vec3f"), "type: found \"vec3f\", expected byte, char");
  expect_values_refused("a.igb", changed("systeme:little_endian", ""),
                        "systeme: found none, expected little_endian or big_endian");
  expect_values_refused("a.igb", changed("z:1", "hello"), "found \"hello\", expected keyword:value");
  expect_values_refused("a.igb", igb(good + "facteur:nan", data), "facteur: found \"nan\"");
  expect_values_refused("a.igb", igb(good + "inc_t:-1", data), "inc_t: found \"-1\", expected more than 0");
  expect_values_refused("a.igb", igb(good + "unites_t:h", data), "unites_t: found \"h\", expected ms or s");
  expect_values_refused("a.igb", igb(good, data.substr(1)),
                        "found 15 bytes behind the header, expected 2 frames of 2 x 1 x 1 values of 4 bytes");
  expect_values_refused("a.igb", igb(good, data + "too"), "found 19 bytes behind");
  expect_values_refused("a.igb", changed("x:2 y:1 z:1", "x:4294967295 y:4294967295 z:4294967295"),
                        "4294967295 x 4294967295 x 4294967295 values");
  const auto values = open_text("a.igb", igb(good, raw<float>({1, 2, 3, HUGE_VALF})));
  ASSERT_TRUE(values.ok());
  EXPECT_TRUE(values->frame(0).ok());
  EXPECT_EQ(values->frame(1).error().message, "a.igb: frame 1, value 1: found inf, expected a finite number");
  EXPECT_EQ(values->check_count(3).error().message,
            "a.igb: found 2 values in a frame, expected 3, one for each point of the mesh");
}

TEST(PointValuesOfIgb, ComeBackAsTheyWereWrittenOnEveryPlatform) {
  IgbWriter writer(3, "mV", 10, 2.5, -80);
  EXPECT_EQ(writer.next_ms(), 10);
  writer.add({-80, 20, NAN});
  writer.add({1, 2, 3});
  EXPECT_EQ(writer.next_ms(), 15);
  EXPECT_EQ(writer.frames(), 2U);
  const Bytes file = writer.take();
  EXPECT_EQ(file.size(), IgbHeader::kBytes + 24);
  EXPECT_EQ(file[IgbHeader::kBytes - 1], '\f');
  std::size_t line = 0;  // meshalyzer refuses lines of more than 80 characters
  for (std::size_t i = 0; i < IgbHeader::kBytes; ++i) {
    line = file[i] == '\n' ? 0 : line + 1;
    ASSERT_LE(line, 80U);
  }
  const auto values = PointValues::open("vm.igb", file);
  ASSERT_TRUE(values.ok()) << values.error().message;
  EXPECT_EQ(values->times_ms(), (std::vector<double>{10, 12.5}));
  EXPECT_EQ(values->frame(0)->values, (std::vector<float>{-80, 20, -80}));
  EXPECT_EQ(values->frame(1)->values, (std::vector<float>{1, 2, 3}));
  const std::string words =
      "x:3 y:1 z:1 t:2 type:float systeme:little_endian\r\n"
      "org_t:10 inc_t:2.5 dim_t:2.5 unites_t:ms\r\n"
      "unites:mV facteur:1 zero:0\r\n ";
  EXPECT_EQ(text_of(file).substr(0, words.size()), words);
  EXPECT_EQ(text_of(file).substr(IgbHeader::kBytes), raw<float>({-80, 20, -80, 1, 2, 3}));
}

TEST(PointValues, SurviveDamagedFiles) {
  const std::string whole[] = {
      igb("x:3 y:2 z:1 t:4 type:float systeme:little_endian\r\nfacteur:1 zero:0 inc_t:5\r\n",
          raw<float>(std::vector<float>(24, 1.5F))),
      "1.5\n-1\n2e3\n4\n5\n"};
  std::uint64_t state = 7;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>((state >> 33) % below);
  };
  const std::string spice = "0123456789-+.e:;# \n\f\xff\x80";
  for (const std::string& good : whole) {
    const std::string name = good[0] == 'x' ? "a.igb" : "a.dat";
    int refused = 0;
    for (int round = 0; round < 3000; ++round) {
      std::string damaged = good;
      // Half of the places are among the words.
      for (std::size_t hits = 1 + random(4); hits > 0; --hits)
        damaged[random(random(2) == 0 ? damaged.size() : std::min<std::size_t>(damaged.size(), 90))] =
            spice[random(spice.size())];
      if (random(4) == 0) damaged.resize(random(damaged.size()));
      const auto values = open_text(name, damaged);
      if (!values.ok()) {
        EXPECT_EQ(values.error().code, ErrorCode::kBadInput);
        ++refused;
        continue;
      }
      for (std::size_t k = 0; k < values->frames(); ++k) {
        const auto field = values->frame(k);
        if (field.ok()) ASSERT_EQ(field->values.size(), values->count());
      }
    }
    EXPECT_GT(refused, 1000) << name;
  }
}

}  // namespace
}  // namespace voxtet::test
