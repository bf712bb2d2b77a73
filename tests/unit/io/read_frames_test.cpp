// Files with several values a voxel, and volumes in several files.
#include <random>

#include "io/bytes/byte_source.h"
#include "unit/io/nifti_file.h"
#include "unit/io/remarks.h"

namespace voxtet::test {
namespace {

/// 3 x 2 x 2 voxels in frames of values, one frame behind the other.
NiftiFile frames_of(const std::vector<std::vector<float>>& frames, int dimension = 4) {
  NiftiFile file;
  file.dim[0] = dimension;
  file.dim[static_cast<std::size_t>(dimension)] = static_cast<std::int64_t>(frames.size());
  file.datatype = 16;
  file.bitpix = 32;
  file.data.clear();
  for (const std::vector<float>& frame : frames)
    for (std::size_t v = 0; v < 12; ++v) {
      Bytes raw(4);
      std::memcpy(raw.data(), &frame[v % frame.size()], 4);
      file.data = std::move(file.data) + raw;
    }
  return file;
}

std::vector<Label> first_labels(const Result<LabelVolume>& volume, std::size_t count) {
  EXPECT_TRUE(volume.ok()) << volume.error().message;
  if (!volume) return {};
  return {volume->labels.begin(), volume->labels.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(ReadFrames, OneOfThemIsChosenByItsNumber) {
  const NiftiFile file = frames_of({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  ReadRemarks remarks;
  for (int frame = 0; frame < 3; ++frame) {
    ReadOptions options;
    options.frame = frame;
    const auto first = static_cast<Label>(3 * frame + 1);
    EXPECT_EQ(
        first_labels(read(file.bytes(), options, remarks), 4),
        (std::vector<Label>{first, static_cast<Label>(first + 1), static_cast<Label>(first + 2), first}));
  }
  expect_refused(
      file.bytes(),
      "dim[4] is 3; expected one label a voxel: choose a frame with --frame 0 to 2 (source.frame)");
  expect_refused(frames_of({{1, 2}, {3, 4}}, 5).bytes(), "dim[5] is 2; expected one label a voxel");
  ReadOptions beyond;
  beyond.frame = 3;
  EXPECT_EQ(read(file.bytes(), beyond, remarks).error().message,
            "sample: source.frame is 3, but the file has 3 frames, counted from 0");
  beyond.frame = 1;
  EXPECT_EQ(read(NiftiFile{}.bytes(), beyond, remarks).error().message,
            "sample: source.frame is 1, but the file has one frame");
}

TEST(ReadFrames, MapsGiveTheFrameWithTheLargestValue) {
  ReadRemarks remarks;
  // With a frame for the background.
  EXPECT_EQ(first_labels(read(frames_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).bytes(), {}, remarks), 3),
            (std::vector<Label>{0, 1, 2}));
  expect_remark(remarks.notes,
                "dim[4] is 3: one-hot or probability maps, of which each voxel takes the largest; frame 0 is "
                "the background, frame n the label n");
  remarks = {};
  // Without one: what is missing to 1 is the background's.
  EXPECT_EQ(first_labels(read(frames_of({{.6F, .3F, .1F}, {.2F, .45F, .2F}}).bytes(), {}, remarks), 3),
            (std::vector<Label>{1, 2, 0}));
  expect_remark(remarks.notes, "frame n is the label n + 1");
  // Masks of bytes.
  EXPECT_EQ(first_labels(read(frames_of({{255, 0, 0}, {0, 255, 0}}).bytes(), {}, remarks), 3),
            (std::vector<Label>{1, 2, 0}));
  // Softmax in half precision.
  EXPECT_EQ(
      first_labels(read(frames_of({{.333F, .25F}, {.333F, .755F}, {.336F, 0}}).bytes(), {}, remarks), 2),
      (std::vector<Label>{2, 1}));
}

TEST(ReadFrames, MapsGiveTheSameLabelsOnEveryPlatform) {
  // Softmax of seeded numbers, in single precision.
  constexpr std::size_t kFrames = 5, kVoxels = 4096;
  std::mt19937 random(11);
  std::vector<std::vector<float>> maps(kFrames, std::vector<float>(kVoxels));
  for (std::size_t v = 0; v < kVoxels; ++v) {
    float sum = 0;
    for (auto& map : maps) sum += map[v] = static_cast<float>(random() % 1000);
    for (auto& map : maps) map[v] /= sum;
  }
  NiftiFile file = frames_of({});
  file.dim = {4, 16, 16, 16, kFrames, 1, 1, 1};
  for (const auto& map : maps) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(map.data());
    file.data.insert(file.data.end(), bytes, bytes + kVoxels * sizeof(float));
  }
  const Result<LabelVolume> volume = read(file.bytes());
  ASSERT_TRUE(volume) << volume.error().message;
  std::uint64_t digest = 1469598103934665603U;  // FNV-1a
  for (const Label label : volume->labels) digest = (digest ^ label) * 1099511628211U;
  EXPECT_EQ(digest, 3377184080303764747U);  // that of numpy.argmax
  EXPECT_GT(std::count(volume->labels.begin(), volume->labels.end(), Label{4}), 500);
}

TEST(ReadFrames, FramesThatAreNoMapsAreLeftToTheUser) {
  const std::string words = "choose a frame with --frame 0 to 1";
  // A beating heart: the masks of two times overlap.
  expect_refused(frames_of({{1, 1, 0}, {1, 0, 0}}).bytes(), words);
  expect_refused(frames_of({{0, 2}, {1, 0}}).bytes(), words);
  expect_refused(frames_of({{-.5F, 1}, {1, 0}}).bytes(), words);
  // One frame with a mask, all others empty.
  expect_refused(frames_of({{0, 0}, {1, 0}}).bytes(), words);
}

TEST(ReadFrames, ChannelsAndTheAxesOfNrrdAreFramesToo) {
  const Bytes values{1, 9, 2, 8, 3, 7, 4, 6, 5, 5, 6, 4, 7, 3, 8, 2, 9, 1, 10, 1, 11, 1, 12, 1};
  const std::string meta =
      "NDims = 3\nDimSize = 3 2 2\nElementNumberOfChannels = 2\nElementType = MET_UCHAR\nElementDataFile = "
      "LOCAL\n";
  const auto nrrd = [](const std::string& rest) {
    return bytes_of_text("NRRD0004\ntype: uchar\ndimension: 4\nencoding: raw\nspace: RAS\n" + rest + "\n");
  };
  const std::string first = "sizes: 2 3 2 2\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n";
  const std::string last = "sizes: 3 2 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1) none\n";
  ReadOptions second;
  second.frame = 1;
  ReadRemarks remarks;
  for (const Bytes& head : {bytes_of_text(meta), nrrd(first)}) {
    EXPECT_EQ(first_labels(read(head + values, second, remarks), 4), (std::vector<Label>{9, 8, 7, 6}));
    expect_refused(head + values, "choose a frame with --frame 0 to 1");
  }
  EXPECT_EQ(first_labels(read(nrrd(last) + values, second, remarks), 3), (std::vector<Label>{7, 3, 8}));
  const std::string frames =
      "NDims = 4\nDimSize = 3 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  EXPECT_EQ(first_labels(read(bytes_of_text(frames) + values, second, remarks), 3),
            (std::vector<Label>{7, 3, 8}));
}

/// The sample's two slices as files of their own.
SiblingReader slices(bool zip) {
  return [zip](const std::string& name) -> Result<Bytes> {
    const Bytes all = sample_bytes();
    const bool first = name == "s001.raw" || name == "a b.raw", second = name == "s002.raw";
    if (!first && !second) return Error{ErrorCode::kBadInput, "test", "no " + name, {}};
    const Bytes part(all.begin() + (first ? 0 : 6), all.begin() + (first ? 6 : 12));
    return zip ? *gzip_bytes(part) : part;
  };
}

TEST(ReadFrames, SlicesInFilesOfAListOrAPatternAreOneVolume) {
  const std::string meta = "NDims = 3\nDimSize = 3 2 2\nElementType = MET_UCHAR\nElementDataFile = ";
  const Eigen::Matrix4d lps = affine({-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0});
  for (const char* files :
       {"LIST\ns001.raw\ns002.raw\n", "LIST 2\na b.raw\r\ns002.raw\n\n", "LIST\ns001.raw\ns002.raw",
        "s%03d.raw 1 2 1\n", "s%03d.raw 1 2\n", "s%03d.raw\n"})
    expect_volume(read(bytes_of_text(meta + files), slices(false)), sample_labels(false), lps);
  const std::string nrrd = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 2 2\nspace: RAS\nencoding: ";
  for (const bool zip : {false, true})
    for (const char* files : {"LIST\ns001.raw\ns002.raw\n", "LIST 2\ns001.raw\ns002.raw\n",
                              "s%03d.raw 1 2 1\n", "s%03i.raw 1 2 1 2\n"})
      expect_volume(read(bytes_of_text(nrrd + (zip ? "gzip" : "raw") + "\ndata file: " + files), slices(zip)),
                    sample_labels(false), Eigen::Matrix4d::Identity());
  expect_refused(bytes_of_text(meta + "LIST\ns001.raw\n"), "go on",
                 [](const std::string&) -> Result<Bytes> { return sample_bytes() + sample_bytes(); });
  expect_refused(bytes_of_text(meta + "LIST\ns001.raw\ns002.raw\ns001.raw\n"),
                 "ElementDataFile names 3 files; expected one for each of the 2 slices", slices(false));
  expect_refused(bytes_of_text(meta + "LIST\n"), "ElementDataFile names 0 files", slices(false));
  expect_refused(bytes_of_text(meta + "LIST\ns001.raw\ns003.raw\n"),
                 "ElementDataFile names a file that cannot be read: no s003.raw", slices(false));
  expect_refused(bytes_of_text(meta + "LIST\n../s001.raw\ns002.raw\n"), "expected a file beside the header",
                 slices(false));
  expect_refused(bytes_of_text(meta + "LIST\ns001.raw\ns002.raw\n"),
                 "\"s001.raw\": the voxel data are truncated",
                 [](const std::string&) -> Result<Bytes> { return Bytes(5); });
  for (const char* pattern : {"s%s.raw 1 2 1", "s%d%d.raw 1 2 1", "s%03d.raw 2 1 1", "s%03d.raw 1 2 0",
                              "s%03d.raw 1 x 1", "s%", "s%03d.raw 1 99999999 1"})
    expect_refused(bytes_of_text(meta + pattern + "\n"), "expected a pattern with one %d", slices(false));
}

TEST(ReadFrames, ASingleFileOfAllSlicesMayStandInAList) {
  const std::string meta =
      "NDims = 3\nDimSize = 3 2 2\nElementType = MET_UCHAR\nElementDataFile = LIST\nall\n";
  const auto all = [](const std::string&) -> Result<Bytes> { return sample_bytes(); };
  expect_volume(read(bytes_of_text(meta), all), sample_labels(false),
                affine({-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0}));
}

TEST(ReadFrames, AWrongLengthOfWholeCompressedDataIsWarnedOf) {
  const Bytes data = zlib_packed(sample_bytes());
  const auto head = [](const std::string& length, const std::string& file) {
    return bytes_of_text("NDims = 3\nDimSize = 3 2 2\nCompressedData = True\nCompressedDataSize = " + length +
                         "\nElementType = MET_UCHAR\nElementDataFile = " + file + "\n");
  };
  const auto sibling = [&](const std::string&) -> Result<Bytes> { return data; };
  const Eigen::Matrix4d lps = affine({-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0});
  for (const char* length : {"5", "0", "1000000"}) {
    ReadRemarks attached, beside;
    expect_volume(read(head(length, "LOCAL") + data, {}, attached), sample_labels(false), lps);
    expect_volume(read(head(length, "a.zraw"), {}, beside, sibling), sample_labels(false), lps);
    for (const ReadRemarks& remarks : {attached, beside})
      expect_remark(remarks.warnings, "CompressedDataSize is " + std::string(length) +
                                          ", but the compressed data have " + std::to_string(data.size()));
  }
  expect_refused(head("5", "LOCAL") + Bytes(data.begin(), data.begin() + 5), "zlib data are truncated");
}

}  // namespace
}  // namespace voxtet::test
