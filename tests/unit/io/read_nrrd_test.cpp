#include "io/bytes/byte_source.h"
#include "unit/io/volume_files.h"

namespace voxtet::test {
namespace {

const std::string kAxes =
    "space: left-posterior-superior\nspace directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (10,20,30)\n";
const Eigen::Matrix4d kFromLps = affine({-2, 0, 0, -10, 0, -3, 0, -20, 0, 0, 4, 30});

/// A whole file; `fields` replaces nothing, it comes after type, dimension, sizes.
Bytes nrrd(const std::string& fields, const Bytes& data, const std::string& type = "uchar",
           const std::string& sizes = "3\nsizes: 3 2 2") {
  return bytes_of_text("NRRD0004\n# made by a test\ntype: " + type + "\ndimension: " + sizes + "\n" + fields +
                       "\n") +
         data;
}

TEST(ReadNrrd, ReadsEveryTypeNameInBothByteOrders) {
  struct Case {
    std::vector<std::string> names;
    bool wide;
    Bytes (*pack)(const std::vector<Label>&, bool);
  };
  const std::vector<Case> cases{
      {{"signed char", "int8", "int8_t"}, false, packed<std::int8_t>},
      {{"uchar", "unsigned char", "uint8", "uint8_t"}, false, packed<std::uint8_t>},
      {{"short", "short int", "signed short", "signed short int", "int16", "int16_t"},
       false,
       packed<std::int16_t>},
      {{"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}, true, packed<std::uint16_t>},
      {{"int", "signed int", "int32", "int32_t"}, true, packed<std::int32_t>},
      {{"uint", "unsigned int", "uint32", "uint32_t"}, true, packed<std::uint32_t>},
      {{"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64",
        "int64_t"},
       true,
       packed<std::int64_t>},
      {{"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"},
       true,
       packed<std::uint64_t>},
      {{"float"}, true, packed<float>},
      {{"double"}, true, packed<double>}};
  for (const Case& c : cases)
    for (const std::string& name : c.names)
      for (const bool big : {false, true})
        for (const bool gzip : {false, true}) {
          SCOPED_TRACE(name);
          const std::vector<Label> labels = sample_labels(c.wide);
          const Bytes data = c.pack(labels, big);
          const std::string fields = kAxes + (big ? "endian: big\n" : "endian: little\n") +
                                     (gzip ? "encoding: gzip\n" : "encoding: raw\n");
          expect_volume(read(nrrd(fields, gzip ? *gzip_bytes(data) : data, name)), labels, kFromLps);
        }
}

TEST(ReadNrrd, TurnsEverySpaceIntoRas) {
  const std::string rest =
      "space directions: (2,0,0) (0, 3, 0) (0,0,4)\nspace origin: (10,20,30)\nencoding: raw\n";
  const Eigen::Matrix4d ras = affine({2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30});
  const Eigen::Matrix4d las = affine({-2, 0, 0, -10, 0, 3, 0, 20, 0, 0, 4, 30});
  for (const char* name : {"right-anterior-superior", "RAS"})
    expect_volume(read(nrrd("space: " + std::string(name) + "\n" + rest, sample_bytes())),
                  sample_labels(false), ras);
  for (const char* name : {"left-anterior-superior", "LAS"})
    expect_volume(read(nrrd("space: " + std::string(name) + "\n" + rest, sample_bytes())),
                  sample_labels(false), las);
  for (const char* name : {"left-posterior-superior", "LPS"})
    expect_volume(read(nrrd("space: " + std::string(name) + "\n" + rest, sample_bytes())),
                  sample_labels(false), kFromLps);
  expect_refused(nrrd("space: scanner-xyz\n" + rest, sample_bytes()), "space is \"scanner-xyz\"");
}

TEST(ReadNrrd, UsesSpacingsAndUnits) {
  const Eigen::Matrix4d placed = affine({-2, 0, 0, 0, 0, -3, 0, 0, 0, 0, 4, 0});
  expect_volume(read(nrrd("spacings: 2 3 4\nencoding: raw\n", sample_bytes())), sample_labels(false), placed);
  expect_volume(
      read(nrrd("spacings: 0.2 3 4000\nunits: \"cm\" \"mm\" \"um\"\nencoding: raw\n", sample_bytes())),
      sample_labels(false), placed);
  Eigen::Matrix4d metres = kFromLps;
  metres.topRows<3>() *= 1000;
  expect_volume(read(nrrd(kAxes + "space units: \"m\" \"m\" \"m\"\nencoding: raw\n", sample_bytes())),
                sample_labels(false), metres);
  expect_refused(nrrd("spacings: 2 -3 4\nencoding: raw\n", sample_bytes()), "spacings holds -3");
  expect_refused(nrrd(kAxes + "spacings: 2 3 4\nencoding: raw\n", sample_bytes()), "spacings is");
  expect_refused(nrrd(kAxes + "space units: \"ly\" \"m\" \"m\"\nencoding: raw\n", sample_bytes()),
                 "the unit \"ly\"");
}

TEST(ReadNrrd, KnowsUnitsInEverySpelling) {
  const std::vector<std::pair<double, std::vector<std::string>>> spellings{
      {1, {"mm", "MM", "millimeter", "millimeters", "millimetre", "Millimetres", "", "???", "none"}},
      {1000, {"m", "meter", "meters", "metres"}},
      {10, {"cm", "centimeter", "centimetres"}},
      {0.001,
       {"um", "\xc2\xb5m", "\xce\xbcm", "micron", "microns", "Microns", "micrometer", "micrometers",
        "micrometre", "micrometres", " um "}},
      {1e-6, {"nm", "nanometers"}},
      {25.4, {"in", "inch", "inches"}}};
  for (const auto& [scale, names] : spellings)
    for (const std::string& name : names) {
      SCOPED_TRACE(name);
      std::string units;
      for (int d = 0; d < 3; ++d) units += " \"" + name + "\"";
      Eigen::Matrix4d scaled = kFromLps;
      scaled.topRows<3>() *= scale;
      for (const bool directions : {true, false}) {
        const std::string fields = directions ? kAxes + "space units:" : "spacings: 2 3 4\nunits:";
        const Result<LabelVolume> volume = read(nrrd(fields + units + "\nencoding: raw\n", sample_bytes()));
        ASSERT_TRUE(volume) << volume.error().message;
        EXPECT_TRUE(volume->linear().isApprox(scaled.topLeftCorner<3, 3>(), 1e-12)) << volume->linear();
      }
    }
  expect_refused(nrrd(kAxes + "space units: \"pixel\" \"pixel\" \"pixel\"\nencoding: raw\n", sample_bytes()),
                 "the unit \"pixel\"; expected mm, m, cm or um, or say it with --unit mm (source.unit");
  ReadOptions options;
  options.unit = LengthUnit::kMillimetre;
  EXPECT_TRUE(read_volume(
      {"a", nrrd(kAxes + "space units: \"pixel\" \"ly\" \"\"\nencoding: raw\n", sample_bytes()), {}},
      options));
}

TEST(ReadNrrd, ColoursThatAreNoneAreLeftOut) {
  ReadRemarks remarks;
  const Bytes file =
      nrrd(kAxes +
               "encoding: raw\nSegment0_LabelValue:=4\nSegment0_Color:=0 1 0\nSegment0_Name:=LV\n"
               "Segment1_LabelValue:=9\nSegment1_Color:=128 174 128\n",
           sample_bytes());
  const Result<LabelVolume> volume = read_volume({"a", file, {}}, {}, &remarks);
  ASSERT_TRUE(volume) << volume.error().message;
  ASSERT_EQ(volume->infos.size(), 2U);
  EXPECT_EQ(volume->infos[0].name, "LV");
  for (const LabelInfo& info : volume->infos) EXPECT_LT(info.colour[0], 0);
  EXPECT_TRUE(remarks.warnings.empty());
  EXPECT_EQ(remarks.notes, std::vector<std::string>{
                               "a: Segment1_Color is \"128 174 128\", expected three numbers from 0 to 1; no "
                               "colour of the file is used"});
}

TEST(ReadNrrd, ReadsTextSkipsAndDetachedData) {
  const std::vector<Label> labels = sample_labels(false);
  std::string text;
  for (const Label label : labels) text += std::to_string(label) + " ";
  for (const char* name : {"ascii", "text", "txt"})
    expect_volume(read(nrrd(kAxes + "encoding: " + name + "\n", bytes_of_text(text))), labels, kFromLps);
  text.pop_back();
  expect_refused(nrrd(kAxes + "encoding: ascii\n", bytes_of_text(text)), "end inside the number \"121\"");

  const Bytes junk = bytes_of_text("line one\nline two\nxyz");
  const std::string skips = "line skip: 2\nbyte skip: 3\n";
  expect_volume(read(nrrd(kAxes + skips + "encoding: raw\n", junk + sample_bytes())), labels, kFromLps);
  expect_volume(read(nrrd(kAxes + "byte skip: -1\nencoding: raw\n", junk + sample_bytes())), labels,
                kFromLps);
  const Bytes packed_data = bytes_of_text("line\n") + *gzip_bytes(bytes_of_text("xyz") + sample_bytes());
  expect_volume(read(nrrd(kAxes + "line skip: 1\nbyte skip: 3\nencoding: gz\n", packed_data)), labels,
                kFromLps);
  expect_refused(nrrd(kAxes + "byte skip: -1\nencoding: gzip\n", packed_data), "byte skip is -1");
  expect_refused(nrrd(kAxes + "line skip: 9\nencoding: raw\n", junk + sample_bytes()), "line skip is 9");

  const auto sibling = [](const std::string& name) -> Result<Bytes> {
    if (name == "voxels.raw") return sample_bytes();
    return Error{ErrorCode::kBadInput, "test", "no " + name, {}};
  };
  const std::string head = kAxes + "encoding: raw\ndata file: ";
  expect_volume(read(nrrd(head + "voxels.raw\n", {}), sibling), labels, kFromLps);
  expect_refused(nrrd(head + "other.raw\n", {}), "data file names the file \"other.raw\"");
  expect_refused(nrrd(head + "other.raw\n", {}, "uchar"), "was not given");
  expect_refused(nrrd(head + "other.raw\n", {}), "data file", sibling);
  expect_refused(nrrd(head + "../voxels.raw\n", {}), "data file is", sibling);
  expect_refused(nrrd(head + "voxels.raw\n", sample_bytes()), "12 bytes follow the header", sibling);
}

TEST(ReadNrrd, ReadsSegmentNamesAndColours) {
  const std::string keys =
      "Segment1_Name:=RV\\nwall\nSegment1_LabelValue:=4\nSegment1_Color:=0.5 1 0\nSegment0_LabelValue:=9\n"
      "Segment0_Name:=LV\n";
  const Result<LabelVolume> volume = read(nrrd(kAxes + "encoding: raw\n" + keys, sample_bytes()));
  expect_volume(volume, sample_labels(false), kFromLps);
  ASSERT_EQ(volume->infos.size(), 2U);
  EXPECT_EQ(volume->infos[0].label, 4);
  EXPECT_EQ(volume->infos[0].name, "RV\nwall");
  EXPECT_EQ(volume->infos[0].colour, (std::array<float, 3>{0.5F, 1, 0}));
  EXPECT_EQ(volume->infos[1].label, 9);
  EXPECT_LT(volume->infos[1].colour[0], 0);
  const std::string head = kAxes + "encoding: raw\n";
  expect_refused(nrrd(head + "Segment0_LabelValue:=70000\n", sample_bytes()),
                 "Segment0_LabelValue is \"70000\"");
  expect_refused(nrrd(head + "Segment0_Layer:=1\n", sample_bytes()), "Segment0_Layer is \"1\"");
  expect_refused(nrrd(head + "Segment0_Layer:=0\nSegment3_Name:=x\n", sample_bytes()),
                 "Segment3_LabelValue is 1");
}

TEST(ReadNrrd, FlattensLayersWithTheLaterSegmentOnTop) {
  const std::string fields =
      "space: RAS\nspace directions: none (2,0,0) (0,3,0) (0,0,4)\nspace origin: (10,20,30)\n"
      "kinds: list domain domain domain\nencoding: raw\n"
      "Segment0_Layer:=0\nSegment0_LabelValue:=1\nSegment0_Name:=pool\n"
      "Segment1_Layer:=1\nSegment1_LabelValue:=1\nSegment1_Name:=scar\n"
      "Segment2_Layer:=0\nSegment2_LabelValue:=2\nSegment2_Name:=wall\n";
  Bytes data(24, 0);
  const auto set = [&](std::size_t voxel, std::uint8_t first, std::uint8_t second) {
    data[2 * voxel] = first;
    data[2 * voxel + 1] = second;
  };
  set(0, 1, 0), set(1, 0, 1), set(2, 1, 1), set(3, 2, 1);
  ReadRemarks remarks;
  const auto read_layers = [&](const std::vector<std::string>& precedence) {
    remarks = {};
    ReadOptions options;
    options.precedence = precedence;
    return read_volume({"a.seg.nrrd", nrrd(fields, data, "uchar", "4\nsizes: 2 3 2 2"), {}}, options,
                       &remarks);
  };
  const std::vector<std::string>& warnings = remarks.warnings;
  const Result<LabelVolume> volume = read_layers({});
  // The scar's value 1 is taken by the pool, so that it becomes 3.
  expect_volume(volume, {1, 3, 3, 2, 0, 0, 0, 0, 0, 0, 0, 0},
                affine({2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30}));
  ASSERT_EQ(volume->infos.size(), 3U);
  EXPECT_EQ(volume->infos[1].name, "wall");
  EXPECT_EQ(volume->infos[2].name, "scar");
  EXPECT_EQ(warnings,
            (std::vector<std::string>{
                "a.seg.nrrd: segments pool (label 1) and scar (label 3) overlap in 1 voxel: of the two "
                "the later one wins, scar (label 3)",
                "a.seg.nrrd: segments scar (label 3) and wall (label 2) overlap in 1 voxel: of the two "
                "the later one wins, wall (label 2)"}));
  // Whatever is named wins over what is not, and the first over the second; by name or by label.
  const auto chosen = [&](const std::vector<std::string>& precedence) {
    const Result<LabelVolume> read = read_layers(precedence);
    return std::vector<Label>(read->labels.begin(), read->labels.begin() + 4);
  };
  EXPECT_EQ(chosen({"pool"}), (std::vector<Label>{1, 3, 1, 2}));
  EXPECT_EQ(warnings[0],
            "a.seg.nrrd: segments pool (label 1) and scar (label 3) overlap in 1 voxel: of the two the "
            "first of source.precedence wins, pool (label 1)");
  EXPECT_EQ(chosen({"scar"}), (std::vector<Label>{1, 3, 3, 3}));
  EXPECT_EQ(chosen({"1", "3"}), (std::vector<Label>{1, 3, 1, 3}));
  EXPECT_EQ(chosen({"wall", "pool", "scar"}), (std::vector<Label>{1, 3, 1, 2}));
  const Result<LabelVolume> unknown = read_layers({"wall", "pol"});
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::kUsage);
  EXPECT_EQ(
      unknown.error().message,
      "a.seg.nrrd: source.precedence[1]: found \"pol\", expected a segment of the file: pool (label 1), "
      "scar (label 3), wall (label 2)");
  // The pool keeps no voxel; the wall never had one.
  set(0, 0, 0), set(3, 0, 1);
  const Result<LabelVolume> lost = read_layers({});
  ASSERT_TRUE(lost.ok());
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_EQ(
      warnings[0],
      "a.seg.nrrd: SEGMENT LOST: segment pool (label 1) loses all of its 1 voxel to scar (label 3), and will "
      "not be in the mesh; to keep it, let it win with --precedence \"pool\" (source.precedence)");
  EXPECT_EQ(warnings[1], "a.seg.nrrd: segment wall (label 2) has no voxels");
  EXPECT_EQ(chosen({"pool"}), (std::vector<Label>{0, 3, 1, 3}));
  set(11, 0, 7);
  expect_refused(nrrd(fields, data, "uchar", "4\nsizes: 2 3 2 2"),
                 "voxel (2, 1, 1) of layer 1 has the value 7");
}

TEST(ReadNrrd, ReadsOneFrameOfFourDimensions) {
  const std::vector<Label> labels = sample_labels(false);
  const std::string ras = "space: RAS\nencoding: raw\n";
  const Eigen::Matrix4d placed = affine({2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0});
  expect_volume(read(nrrd(ras + "space directions: (2,0,0) (0,3,0) (0,0,4) none\n", sample_bytes(), "uchar",
                          "4\nsizes: 3 2 2 1")),
                labels, placed);
  expect_volume(read(nrrd(ras + "spacings: nan 2 3 4\nkinds: list domain domain domain\n", sample_bytes(),
                          "uchar", "4\nsizes: 1 3 2 2")),
                labels, placed);
  expect_refused(nrrd(ras + "space directions: (2,0,0) (0,3,0) (0,0,4) none\n", sample_bytes(), "uchar",
                      "4\nsizes: 3 2 1 2"),
                 "sizes has 2 frames along axis 3; expected one label a voxel: choose a frame with --frame 0 "
                 "to 1 (source.frame)");
  expect_refused(nrrd(ras + "space directions: none (2,0,0) (0,3,0) (0,0,4)\n", sample_bytes(), "uchar",
                      "4\nsizes: 2 3 2 1"),
                 "sizes has 2 values a voxel, but no Segment keys");
}

TEST(ReadNrrd, RefusesBadFieldsByName) {
  const std::string raw = kAxes + "encoding: raw\n";
  const auto text = [](const std::string& t) { return bytes_of_text(t); };
  expect_refused(text("NRRD0009\n\n"), "expected NRRD0001 to NRRD0005");
  expect_refused(text("NRRD0004\ntype: uchar\n"), "no empty line ends it");
  expect_refused(text("NRRD0004\ntype: uch"), "truncated inside the line \"type: uch\"");
  expect_refused(text("NRRD0004\nkynd: 3\n\n"), "unknown field \"kynd\"");
  expect_refused(text("NRRD0004\nnothing\n\n"), "neither \"field: value\" nor");
  expect_refused(nrrd(raw + "encoding: raw\n", sample_bytes()), "\"encoding\" is given twice");
  expect_refused(nrrd(kAxes, sample_bytes()), "has no encoding");
  expect_refused(nrrd(kAxes + "encoding: bzip2\n", sample_bytes()), "encoding is \"bzip2\"");
  expect_refused(nrrd(raw, sample_bytes(), "block"), "type is \"block\"");
  expect_refused(nrrd(raw, sample_bytes(), "short"), "has no endian");
  expect_refused(nrrd(raw + "endian: middle\n", sample_bytes()), "endian is \"middle\"");
  expect_refused(nrrd(raw, sample_bytes(), "uchar", "2\nsizes: 6 2"),
                 "dimension is \"2\": the file holds one slice");
  expect_refused(nrrd(raw, sample_bytes(), "uchar", "3\nsizes: 6 2"), "sizes is \"6 2\"");
  expect_refused(nrrd(raw, sample_bytes(), "uchar", "3\nsizes: 3 0 2"), "sizes holds the extent 0");
  expect_refused(nrrd(raw, sample_bytes(), "uchar", "3\nsizes: 2000000000 2000000000 2000000000"),
                 "sizes asks for more");
  expect_refused(nrrd(raw, sample_bytes(), "uchar", "3\nsizes: 3 2 3"),
                 "truncated: they have 12 bytes; expected 18");
  expect_refused(nrrd(raw, sample_bytes(), "uchar", "3\nsizes: 3 2 1"), "go on for 6 bytes");
  expect_refused(nrrd(raw + "kinds: domain domain list\n", sample_bytes()), "axis 2 is not spatial");
  expect_refused(nrrd(raw + "kinds: domain domain domian\n", sample_bytes()), "unknown kind \"domian\"");
  const std::string head = "encoding: raw\nspace: RAS\n";
  expect_refused(nrrd(head + "space directions: (1,0,0) (0,1,0) (1,1)\n", sample_bytes()),
                 "space directions is");
  expect_refused(nrrd(head + "space directions: (1,0,0) (0,1,0) (1,1,0)\n", sample_bytes()), "singular");
  expect_refused(nrrd(head + "space directions: (1,0,0) (0,1,0) none\n", sample_bytes()),
                 "axis 2 is not spatial");
  expect_refused(nrrd(head + "space origin: 1 2 3\n", sample_bytes()), "space origin is");
  expect_refused(nrrd(head + "space origin: (nan,0,0)\n", sample_bytes()), "not finite");
}

}  // namespace
}  // namespace voxtet::test
