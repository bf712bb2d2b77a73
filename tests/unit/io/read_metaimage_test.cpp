#include "io/bytes/byte_source.h"
#include "unit/io/volume_files.h"

namespace voxtet::test {
namespace {

const std::string kHead = "ObjectType = Image\nNDims = 3\nDimSize = 3 2 2\n";
const std::string kPlace = "TransformMatrix = 0 1 0 1 0 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 2 3 4\n";
const Eigen::Matrix4d kRas = affine({0, -3, 0, -10, -2, 0, 0, -20, 0, 0, 4, 30});

Bytes meta(const std::string& fields, const Bytes& data, const std::string& type = "MET_UCHAR") {
  return bytes_of_text(kHead + fields + "ElementType = " + type + "\nElementDataFile = LOCAL\n") + data;
}

TEST(ReadMetaImage, ReadsEveryTypeInBothByteOrders) {
  struct Case {
    std::string name;
    bool wide;
    Bytes (*pack)(const std::vector<Label>&, bool);
  };
  const std::vector<Case> cases{{"MET_CHAR", false, packed<std::int8_t>},
                                {"MET_UCHAR", false, packed<std::uint8_t>},
                                {"MET_SHORT", false, packed<std::int16_t>},
                                {"MET_USHORT", true, packed<std::uint16_t>},
                                {"MET_INT", true, packed<std::int32_t>},
                                {"MET_UINT", true, packed<std::uint32_t>},
                                {"MET_LONG", true, packed<std::int32_t>},
                                {"MET_ULONG", true, packed<std::uint32_t>},
                                {"MET_LONG_LONG", true, packed<std::int64_t>},
                                {"MET_ULONG_LONG", true, packed<std::uint64_t>},
                                {"MET_FLOAT", true, packed<float>},
                                {"MET_DOUBLE", true, packed<double>}};
  for (const Case& c : cases)
    for (const bool big : {false, true})
      for (const bool zip : {false, true}) {
        SCOPED_TRACE(c.name);
        const std::vector<Label> labels = sample_labels(c.wide);
        const Bytes raw = c.pack(labels, big), data = zip ? zlib_packed(raw) : raw;
        const std::string fields =
            kPlace + "BinaryDataByteOrderMSB = " + (big ? "True\n" : "False\n") +
            (zip ? "CompressedData = True\nCompressedDataSize = " + std::to_string(data.size()) + "\n" : "");
        expect_volume(read(meta(fields, data, c.name)), labels, kRas);
      }
}

TEST(ReadMetaImage, TakesSynonymsUnitsAndOneFrame) {
  const std::vector<Label> labels = sample_labels(false);
  for (const char* matrix : {"Rotation", "Orientation"})
    for (const char* offset : {"Position", "Origin"})
      expect_volume(read(meta(std::string(matrix) + " = 0 1 0 1 0 0 0 0 1\n" + offset +
                                  " = 1 2 3\nElementSize = .2 .3 .4\nDistanceUnits = cm\n",
                              sample_bytes())),
                    labels, affine({0, -3, 0, -10, -2, 0, 0, -20, 0, 0, 4, 30}));
  expect_volume(read(meta("", sample_bytes())), labels, affine({-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0}));
  const std::string four =
      "NDims = 4\nDimSize = 3 2 2 1\nElementSpacing = 2 3 4 1\nElementType = MET_UCHAR\n"
      "TransformMatrix = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\nOffset = 1 2 3 0\nElementDataFile = ";
  expect_volume(read(bytes_of_text(four + "LOCAL\n") + sample_bytes()), labels,
                affine({-2, 0, 0, -1, 0, -3, 0, -2, 0, 0, 4, 3}));
}

TEST(ReadMetaImage, ReadsTextAndDetachedData) {
  std::string text;
  for (const Label label : sample_labels(false)) text += std::to_string(label) + "\n";
  expect_volume(read(meta(kPlace + "BinaryData = False\n", bytes_of_text(text))), sample_labels(false), kRas);
  const auto sibling = [](const std::string&) -> Result<Bytes> {
    return bytes_of_text("head") + sample_bytes();
  };
  const std::string head = kHead + kPlace + "ElementType = MET_UCHAR\n";
  expect_volume(read(bytes_of_text(head + "HeaderSize = 4\nElementDataFile = a b.raw\n"), sibling),
                sample_labels(false), kRas);
  expect_volume(read(bytes_of_text(head + "HeaderSize = -1\nElementDataFile = a.raw\n"), sibling),
                sample_labels(false), kRas);
  expect_refused(bytes_of_text(head + "ElementDataFile = a.raw\n"), "go on for 4 bytes", sibling);
  expect_refused(bytes_of_text(head + "ElementDataFile = /etc/passwd\n"), "ElementDataFile is", sibling);
}

TEST(ReadMetaImage, RefusesBadFieldsByName) {
  const auto refused = [](const std::string& fields, const std::string& words) {
    expect_refused(meta(fields, sample_bytes()), words);
  };
  refused("ObjectSubTipe = x\n", "unknown field \"ObjectSubTipe\"; expected ObjectSubType?");
  refused("Ofset = 1 2 3\n", "expected Offset?");
  refused("DimSize = 3 2 2\n", "DimSize (or a synonym) is given twice");
  refused("Offset = 1 2 3\nOrigin = 1 2 3\n", "Origin (or a synonym) is given twice");
  refused("no equals sign\n", "not of the form Key = Value");
  refused("Offset = 1 2\n", "Offset is \"1 2\"; expected 3 numbers");
  refused("TransformMatrix = 1 0 0 0 1 0 0 0\n", "TransformMatrix is");
  refused("TransformMatrix = 1 0 0 1 0 0 0 0 1\n", "singular");
  refused("ElementSpacing = 1 0 1\n", "ElementSpacing holds 0");
  refused("ElementNumberOfChannels = 3\n", "truncated: they have 12 bytes; expected 36");
  refused("ElementToIntensityFunctionSlope = 2\n", "ElementToIntensityFunctionSlope is 2");
  refused("CompressedData = maybe\n", "CompressedData is \"maybe\"");
  refused("CompressedData = True\nCompressedDataSize = five\n", "CompressedDataSize is \"five\"");
  refused("CompressedData = True\n", "zlib data are damaged");
  refused("DistanceUnits = ly\n", "DistanceUnits is \"ly\"");
  refused("HeaderSize = 3\n", "HeaderSize is 3");
  expect_refused(meta("", sample_bytes(), "MET_FLOAT_ARRAY"), "ElementType is");
  expect_refused(meta("", sample_bytes() + sample_bytes()), "go on for 12 bytes");
  expect_refused(bytes_of_text(kHead), "no ElementDataFile");
  expect_refused(bytes_of_text("ObjectType = Tube\nElementDataFile = LOCAL\n"), "ObjectType is \"Tube\"");
  const auto without = [](const std::string& head) {
    return bytes_of_text(head + "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n") + sample_bytes();
  };
  expect_refused(without("NDims = 3\n"), "no DimSize");
  expect_refused(without("NDims = 2\nDimSize = 6 2\n"), "NDims is 2: the file holds one slice");
  expect_refused(without("NDims = 3\nDimSize = 3 2\n"), "DimSize is \"3 2\"");
  expect_refused(without("NDims = 4\nDimSize = 3 2 1 2\n"), "DimSize has 2 frames");
  expect_refused(without("NDims = 3\nDimSize = 3 -2 2\n"), "DimSize holds the extent -2");
  expect_refused(without("NDims = 3\nDimSize = 2000000000 2000000000 2000000000\n"), "DimSize asks for more");
}

}  // namespace
}  // namespace voxtet::test
