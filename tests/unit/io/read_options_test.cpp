// What files say wrongly or leave open: units, two affines, values that are nearly labels or none, padding.
#include <cmath>

#include "io/bytes/byte_source.h"
#include "unit/io/nifti_file.h"
#include "unit/io/remarks.h"

namespace voxtet::test {
namespace {

const Eigen::Matrix4d kPlaced = affine({2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30});

/// int16 voxels that store these labels as well as a slope and an intercept allow.
NiftiFile scaled_file(const std::vector<Label>& labels, double slope, double inter) {
  NiftiFile file;
  file.datatype = 4;
  file.bitpix = 16;
  file.slope = slope;
  file.inter = inter;
  file.data.clear();
  for (const Label label : labels) {
    const auto stored = static_cast<std::int16_t>(std::lround((label - inter) / slope));
    file.data.push_back(static_cast<std::uint8_t>(stored & 0xff));
    file.data.push_back(static_cast<std::uint8_t>(stored >> 8 & 0xff));
  }
  return file;
}

TEST(ReadOptions, LabelsThatASlopeStoresComeBackWhole) {
  // As nibabel saves floats: the range of the values over that of int16.
  for (const Label largest : {4, 9, 40, 254, 1000, 2999}) {
    std::vector<Label> labels;
    for (int n = 0; n < 12; ++n) labels.push_back(static_cast<Label>(largest * n / 11));
    const double slope = largest / 65535.0, inter = largest * 32768.0 / 65535.0;
    ReadRemarks remarks;
    expect_volume(read(scaled_file(labels, slope, inter).bytes(), {}, remarks), labels, kPlaced);
    expect_remark(remarks.warnings, "scl_slope");
    expect_remark(remarks.warnings, "rounded to whole numbers");
  }
  // A slope that stores them as they are is nothing to speak of.
  ReadRemarks remarks;
  expect_volume(read(scaled_file(sample_labels(false), 0.5, 0).bytes(), {}, remarks), sample_labels(false),
                kPlaced);
  EXPECT_TRUE(remarks.warnings.empty());
  // 1 becomes 0.9, and 0.94 is nearer than half a step but too far.
  expect_refused(scaled_file(std::vector<Label>(12, 1), 0.3, 0).bytes(), "has the value 0.9000000");
  expect_refused(scaled_file(std::vector<Label>(12, 1), 0.47, 0).bytes(), "save them without scl_slope");
}

TEST(ReadOptions, AThresholdMakesALabelOfAnImage) {
  NiftiFile file;
  file.datatype = 16;
  file.bitpix = 32;
  const std::vector<float> values{-1000.5F, -2, 0, 0.25F, 0.5F, 0.75F, 1, NAN, INFINITY, 300, 300.5F, 301};
  file.data.resize(48);
  std::memcpy(file.data.data(), values.data(), 48);
  ReadOptions options;
  ReadRemarks remarks;
  options.threshold = Threshold{0.25, 300};
  expect_volume(read(file.bytes(), options, remarks), {0, 0, 0, 1, 1, 1, 1, 0, 0, 1, 0, 0}, kPlaced);
  options.threshold = Threshold{400, 500};
  const Result<LabelVolume> none = read(file.bytes(), options, remarks);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("no voxel has a value from 400 to 500"), std::string::npos)
      << none.error().message;
}

TEST(ReadOptions, RealNumbersNearLabelsAreRounded) {
  NiftiFile file;
  file.datatype = 16;
  file.bitpix = 32;
  const auto with = [&](float value) {
    file.data = packed<float>(std::vector<Label>(12, 3), false);
    std::memcpy(file.data.data(), &value, 4);
    return file.bytes();
  };
  for (const float value : {2.9992F, 3.0009F}) {
    ReadRemarks remarks;
    expect_volume(read(with(value), {}, remarks), std::vector<Label>(12, 3), kPlaced);
    expect_remark(remarks.warnings, "labels are stored as " + std::string(value < 3 ? "2.9992" : "3.0009"));
  }
  ReadRemarks remarks;
  expect_volume(read(with(3), {}, remarks), std::vector<Label>(12, 3), kPlaced);
  EXPECT_TRUE(remarks.warnings.empty());
  expect_refused(with(2.998F), "if they are labels, round them and save them as whole numbers");
}

TEST(ReadOptions, AnyValueMayBeTheBackground) {
  NiftiFile file;
  file.datatype = 8;
  file.bitpix = 32;
  const auto read_values = [&](const std::vector<std::int32_t>& values, std::int64_t background,
                               ReadRemarks& remarks) {
    file.data.resize(48);
    for (std::size_t v = 0; v < 12; ++v) std::memcpy(&file.data[4 * v], &values[v % values.size()], 4);
    ReadOptions options;
    options.background = background;
    Result<LabelVolume> volume = read(file.bytes(), options, remarks);
    EXPECT_TRUE(volume.ok()) << volume.error().message;
    volume->labels.resize(values.size());
    return volume->labels;
  };
  ReadRemarks remarks;
  EXPECT_EQ(read_values({-1, 1, 2}, -1, remarks), (std::vector<Label>{0, 1, 2}));
  EXPECT_EQ(read_values({255, 1, 2}, 255, remarks), (std::vector<Label>{0, 1, 2}));
  EXPECT_TRUE(remarks.warnings.empty());
  // What was 0 is a structure then.
  EXPECT_EQ(read_values({9, 0, 1, 2}, 9, remarks), (std::vector<Label>{0, 3, 1, 2}));
  expect_remark(remarks.warnings, "in ascending order: 0 -> 3");
  remarks = {};
  EXPECT_EQ(read_values({0, 1, 2}, 7, remarks), (std::vector<Label>{3, 1, 2}));
  expect_remark(remarks.warnings, "source.background is 7, a value that no voxel has");
}

TEST(ReadOptions, LabelsBeyondTheRangeTakeFreeNumbersInAscendingOrder) {
  NiftiFile file;
  file.datatype = 1024;
  file.bitpix = 64;
  const auto read_values = [&](const std::vector<std::int64_t>& values, ReadRemarks& remarks) {
    file.data.resize(96);
    for (std::size_t v = 0; v < 12; ++v) std::memcpy(&file.data[8 * v], &values[v % values.size()], 8);
    Result<LabelVolume> volume = read(file.bytes(), {}, remarks);
    EXPECT_TRUE(volume.ok()) << volume.error().message;
    volume->labels.resize(values.size());
    return volume->labels;
  };
  ReadRemarks remarks;
  EXPECT_EQ(read_values({0, 614454277, 65536, 2}, remarks), (std::vector<Label>{0, 4, 3, 2}));
  expect_remark(
      remarks.warnings,
      "values that are no labels from 1 to 65535 take free numbers, in ascending order: 65536 -> 3, "
      "614454277 -> 4");
  EXPECT_EQ(read_values({0, 70000, 65535, 80000, 1}, remarks), (std::vector<Label>{0, 2, 65535, 3, 1}));
  file.data.assign(96, 0xff);
  file.data[8] = 0xfe;
  expect_refused(file.bytes(),
                 "voxel (0, 0, 0) has the value -1; expected labels, whole numbers from 0 to "
                 "65535: there are 2 values below 0: an image, not labels?");
}

TEST(ReadOptions, TheUnitThatIsSaidCountsWhateverTheFileSays) {
  NiftiFile file;
  file.units = 2;
  ReadOptions options;
  ReadRemarks remarks;
  const auto scaled = [](double scale) {
    Eigen::Matrix4d placed = kPlaced;
    placed.topRows<3>() *= scale;
    return placed;
  };
  for (const auto& [unit, scale] :
       {std::pair(LengthUnit::kMetre, 1000.0), std::pair(LengthUnit::kCentimetre, 10.0),
        std::pair(LengthUnit::kMillimetre, 1.0), std::pair(LengthUnit::kMicrometre, 0.001),
        std::pair(LengthUnit::kNanometre, 1e-6)}) {
    options.unit = unit;
    for (const int sform : {1, 0}) {
      file.sform_code = sform;
      file.qform_code = 1 - sform;
      file.qoffset = {10, 20, 30};
      const Result<LabelVolume> volume = read(file.bytes(), options, remarks);
      ASSERT_TRUE(volume) << volume.error().message;
      EXPECT_TRUE(volume->index_to_mm.isApprox(scaled(scale), 1e-6)) << volume->index_to_mm;
    }
  }
  EXPECT_TRUE(remarks.warnings.empty());
  file.units = 5;
  EXPECT_TRUE(read(file.bytes(), options, remarks).ok());
  expect_refused(file.bytes(),
                 "xyzt_units is 5; expected a spatial unit of 0 to 3, or say it with --unit mm");
}

TEST(ReadOptions, UnlikelyLengthsAreWarnedOf) {
  const auto warnings_at = [](double spacing, std::int64_t units, LengthUnit unit) {
    NiftiFile file;
    file.units = units;
    file.srow = {spacing, 0, 0, 0, 0, spacing, 0, 0, 0, 0, spacing, 0};  // spans three of them
    ReadOptions options;
    options.unit = unit;
    ReadRemarks remarks;
    EXPECT_TRUE(read(file.bytes(), options, remarks).ok());
    return remarks.warnings;
  };
  EXPECT_EQ(
      warnings_at(8000, 2, LengthUnit::kOfFile),
      std::vector<std::string>{"sample: the volume spans 24,000 mm (24 mm if its numbers are um): wrong "
                               "unit? --unit um (source.unit) says it"});
  EXPECT_EQ(warnings_at(0.04, 0, LengthUnit::kOfFile),
            std::vector<std::string>{"sample: the volume spans 0.12 mm (120 mm if its numbers are m): wrong "
                                     "unit? --unit m (source.unit) says it"});
  expect_remark(warnings_at(1.5, 1, LengthUnit::kOfFile),
                "spans 4,500 mm (4.5 mm if its numbers are mm): wrong unit? --unit mm");
  for (const double usual : {0.4, 1.0, 50.0, 700.0})
    EXPECT_TRUE(warnings_at(usual, 2, LengthUnit::kOfFile).empty()) << usual;
  // Small numbers of a file that says um, and what somebody says, are meant.
  EXPECT_TRUE(warnings_at(20, 3, LengthUnit::kOfFile).empty());
  EXPECT_TRUE(warnings_at(8000, 2, LengthUnit::kMillimetre).empty());
}

TEST(ReadOptions, TwoAffinesThatDifferAreWarnedOf) {
  NiftiFile file;
  file.qform_code = 1;
  file.qoffset = {10, 20, 30};
  ReadRemarks remarks;
  expect_volume(read(file.bytes(), {}, remarks), sample_labels(false), kPlaced);
  EXPECT_TRUE(remarks.warnings.empty());
  file.qoffset = {10, 20, 30.1F};  // a tenth of the smallest voxel is 0.2 mm
  expect_volume(read(file.bytes(), {}, remarks), sample_labels(false), kPlaced);
  EXPECT_TRUE(remarks.warnings.empty());
  file.qoffset = {10, 25, 30};
  expect_volume(read(file.bytes(), {}, remarks), sample_labels(false), kPlaced);
  EXPECT_EQ(remarks.warnings, std::vector<std::string>{"sample: sform and qform differ by up to 5 mm and 0 "
                                                       "degrees; the sform is used"});
  file.qoffset = {10, 20, 30};
  file.quatern = {0, 0, std::sin(0.25)};  // 28.6 degrees about z
  remarks = {};
  expect_volume(read(file.bytes(), {}, remarks), sample_labels(false), kPlaced);
  expect_remark(remarks.warnings, "and 29 degrees; the sform is used");
  file.quatern = {0, 0, 0};
  file.pixdim[0] = -1;
  remarks = {};
  expect_volume(read(file.bytes(), {}, remarks), sample_labels(false), kPlaced);
  expect_remark(remarks.warnings, "and a reflection; the sform is used");
}

TEST(ReadOptions, AGoodQformTakesThePlaceOfASformOfZeros) {
  NiftiFile file;
  file.qform_code = 1;
  file.qoffset = {10, 20, 30};
  file.srow.fill(0);
  ReadRemarks remarks;
  expect_volume(read(file.bytes(), {}, remarks), sample_labels(false), kPlaced);
  EXPECT_TRUE(remarks.warnings.empty());
  EXPECT_EQ(remarks.notes, std::vector<std::string>{"sample: the sform is all zeros; the qform is used"});
  // One that is damaged is not taken for absent.
  file.srow = {1, 2, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0};
  expect_refused(file.bytes(), "srow_x, srow_y, srow_z) is singular");
  file.srow.fill(0);
  file.pixdim[1] = 0;
  expect_refused(file.bytes(), "srow_x, srow_y, srow_z) gives a voxel spacing of 0 mm");
}

TEST(ReadOptions, ZerosBehindCompressedDataArePassedOver) {
  const Bytes whole = *gzip_bytes(NiftiFile{}.bytes());
  for (const std::size_t zeros : {1, 100, 512}) {
    ReadRemarks remarks;
    expect_volume(read(whole + Bytes(zeros, 0), {}, remarks), sample_labels(false), kPlaced);
    EXPECT_EQ(remarks.notes, std::vector<std::string>{"sample: " + std::to_string(zeros) +
                                                      " zero bytes follow the compressed data; passed over"});
  }
  expect_refused(whole + Bytes{0, 0, 1}, "3 bytes follow the end of the gzip data");
}

TEST(ReadOptions, AVolumeOfOneSliceIsSaidInPlainWords) {
  NiftiFile file;
  file.dim = {3, 3, 4, 1, 1, 1, 1, 1};
  ReadRemarks remarks;
  ASSERT_TRUE(read(file.bytes(), {}, remarks).ok());
  expect_remark(remarks.warnings,
                "the volume is one slice thick (3 x 4 x 1 voxels), so that its mesh is a plate");
}

TEST(ReadOptions, APrecedenceWithoutSegmentsHasNoEffect) {
  ReadOptions options;
  options.precedence = {"1"};
  ReadRemarks remarks;
  expect_volume(read(NiftiFile{}.bytes(), options, remarks), sample_labels(false), kPlaced);
  expect_remark(remarks.warnings, "source.precedence has no effect");
}

}  // namespace
}  // namespace voxtet::test
