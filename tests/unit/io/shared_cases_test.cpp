// Small files that users of other programs complained about: shared/data/cases with its index.
#include <gtest/gtest.h>

#include "unit/io/remarks.h"
#include "unit/io/shared_volumes.h"

namespace voxtet::test {
namespace {

std::string shared_case(const std::string& name) {
  return shared_data("cases/" + name);
}

/// Voxels of the labels 1 and 2, the outer and the inner body of most cases.
std::array<std::size_t, 2> bodies(const LabelVolume& volume) {
  std::array<std::size_t, 2> count{};
  for (const Label label : volume.labels)
    if (label == 1 || label == 2) ++count[label - 1U];
  return count;
}

#define VOXTET_NEEDS_CASES() \
  if (shared_case("base.nii.gz").empty()) GTEST_SKIP() << "the shared cases are absent"

TEST(SharedCases, AreReadWithTheirRemarks) {
  VOXTET_NEEDS_CASES();
  struct Case {
    const char *name, *warning, *note;
  };
  for (const Case& c : std::vector<Case>{{"base.nii.gz", "", ""},
                                         {"int16_scaled4.nii.gz", "scl_slope", ""},
                                         {"microns.nrrd", "", ""},
                                         {"um_said_mm.nii.gz", "the volume spans 24,000 mm", ""},
                                         {"qs_differ.nii.gz", "sform and qform differ by", ""},
                                         {"sform_zero.nii", "", "the qform is used"},
                                         {"names.seg.nrrd", "", ""},
                                         {"color255.seg.nrrd", "", "no colour of the file is used"},
                                         {"gz_trailing_garbage.nii.gz", "", "zero bytes follow"},
                                         {"list.mhd", "", ""}}) {
    SCOPED_TRACE(c.name);
    ReadRemarks remarks;
    const Result<LabelVolume> volume = read_volume_file(shared_case(c.name), {}, &remarks);
    ASSERT_TRUE(volume) << volume.error().message;
    EXPECT_EQ(volume->size, (std::array<int, 3>{24, 24, 24}));
    const bool scaled = std::string(c.name) == "int16_scaled4.nii.gz";
    if (!scaled) {
      EXPECT_EQ(bodies(*volume), (std::array<std::size_t, 2>{1896, 280}));
    }
    EXPECT_EQ(remarks.warnings.empty(), *c.warning == '\0');
    EXPECT_EQ(remarks.notes.empty(), *c.note == '\0');
    if (*c.warning != '\0') expect_remark(remarks.warnings, c.warning);
    if (*c.note != '\0') expect_remark(remarks.notes, c.note);
  }
}

TEST(SharedCases, ALostSegmentIsSaidAndComesBackByPrecedence) {
  VOXTET_NEEDS_CASES();
  const std::string path = shared_case("layers_rev.seg.nrrd");
  ReadRemarks remarks;
  const Result<LabelVolume> lost = read_volume_file(path, {}, &remarks);
  ASSERT_TRUE(lost) << lost.error().message;
  EXPECT_EQ(bodies(*lost), (std::array<std::size_t, 2>{0, 2176}));
  expect_remark(remarks.warnings,
                "SEGMENT LOST: segment inner (label 1) loses all of its 280 voxels to outer (label 2)");
  expect_remark(remarks.warnings, "overlap in 280 voxels");
  ReadOptions options;
  options.precedence = {"inner"};
  const Result<LabelVolume> kept = read_volume_file(path, options);
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(bodies(*kept), (std::array<std::size_t, 2>{280, 1896}));
}

TEST(SharedCases, OptionsReadWhatIsRefusedWithoutThem) {
  VOXTET_NEEDS_CASES();
  const Result<LabelVolume> refused = read_volume_file(shared_case("neg_bg.nii.gz"));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("--background -1 (source.background)"), std::string::npos);
  ReadOptions options;
  options.background = -1;
  const Result<LabelVolume> volume = read_volume_file(shared_case("neg_bg.nii.gz"), options);
  ASSERT_TRUE(volume) << volume.error().message;
  EXPECT_EQ(bodies(*volume), (std::array<std::size_t, 2>{1896, 280}));

  options = {};
  options.unit = LengthUnit::kMicrometre;
  ReadRemarks remarks;
  const Result<LabelVolume> small = read_volume_file(shared_case("um_said_mm.nii.gz"), options, &remarks);
  ASSERT_TRUE(small) << small.error().message;
  EXPECT_LE((small->spacing_mm() - Eigen::Vector3d::Ones()).norm(), 1e-6);
  EXPECT_TRUE(remarks.warnings.empty());

  const Result<LabelVolume> slice = read_volume_file(shared_case("slice2d.nii.gz"));
  ASSERT_FALSE(slice);
  EXPECT_NE(slice.error().message.find("the file holds one slice"), std::string::npos);
}

TEST(SharedCases, AGreyImageIsTold) {
  VOXTET_NEEDS_CASES();
  ReadRemarks remarks;
  ASSERT_TRUE(read_volume_file(shared_case("intensity.nii.gz"), {}, &remarks));
  expect_remark(remarks.warnings, "170 values: an image, not labels?");
}

}  // namespace
}  // namespace voxtet::test
