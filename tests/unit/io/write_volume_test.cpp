#include <cmath>

#include "io/volume/write_volume.h"
#include "io/volume/write_vti.h"
#include "unit/io/volume_files.h"

namespace voxtet::test {
namespace {

LabelVolume sample_volume(bool wide, bool mirrored, bool sheared) {
  LabelVolume volume;
  volume.size = {3, 2, 2};
  volume.labels = sample_labels(wide);
  Eigen::Matrix3d rotation;
  rotation << 2. / 3, -1. / 3, 2. / 3, 2. / 3, 2. / 3, -1. / 3, -1. / 3, 2. / 3, 2. / 3;
  if (mirrored) rotation.col(0) *= -1;
  if (sheared) rotation.col(1) += 0.3 * rotation.col(0);
  volume.index_to_mm.topLeftCorner<3, 3>() = rotation * Eigen::Vector3d(1.4, 0.7, 8).asDiagonal();
  volume.index_to_mm.topRightCorner<3, 1>() << -44.08, 88.28, 116.84;
  return volume;
}

TEST(WriteNifti, RoundTripsByBothAffines) {
  for (const bool wide : {false, true})
    for (const bool mirrored : {false, true})
      for (const bool gzip : {false, true}) {
        const LabelVolume volume = sample_volume(wide, mirrored, false);
        Bytes bytes = *write_nifti(volume, gzip);
        EXPECT_EQ(bytes, *write_nifti(volume, gzip));
        expect_volume(read(bytes), volume.labels, volume.index_to_mm);
        if (gzip) continue;
        EXPECT_EQ(bytes.size(), 352U + 12U * (wide ? 2 : 1));
        bytes[254] = 0;  // no sform: the qform must say the same
        expect_volume(read(bytes), volume.labels, volume.index_to_mm);
      }
}

TEST(WriteNifti, KeepsEveryHalfTurnInTheQform) {
  for (int axis = -1; axis < 3; ++axis) {
    LabelVolume volume = sample_volume(false, false, false);
    Eigen::Matrix3d turn =
        axis < 0 ? Eigen::Matrix3d::Identity() : Eigen::Matrix3d(-Eigen::Matrix3d::Identity());
    if (axis >= 0) turn(axis, axis) = 1;
    volume.index_to_mm.topLeftCorner<3, 3>() = turn * 2;
    Bytes bytes = *write_nifti(volume, false);
    bytes[254] = 0;
    expect_volume(read(bytes), volume.labels, volume.index_to_mm);
  }
}

TEST(WriteNifti, LeavesAShearToTheSform) {
  const LabelVolume volume = sample_volume(false, false, true);
  const Bytes bytes = *write_nifti(volume, false);
  EXPECT_EQ(bytes[252], 0);
  expect_volume(read(bytes), volume.labels, volume.index_to_mm);
}

TEST(WriteNifti, RefusesWhatNiftiCannotHold) {
  LabelVolume volume = sample_volume(false, false, false);
  volume.size = {32768, 1, 1};
  EXPECT_EQ(write_nifti(volume, false).error().code, ErrorCode::kUsage);
  volume.size = {3, 2, 1};
  EXPECT_EQ(write_nifti(volume, false).error().code, ErrorCode::kInternal);
}

ScalarVolume numbers() {
  ScalarVolume volume;
  volume.size = {3, 2, 2};
  volume.index_to_mm << 0, -1.5, 0, 4, 1.25, 0, 0, 5, 0, 0, 2, 6, 0, 0, 0, 1;
  for (int n = 0; n < 12; ++n) volume.values.push_back(0.125F * static_cast<float>(n * n) - 3);
  return volume;
}

TEST(WriteNifti, NumbersComeBackAsTheyWere) {
  const ScalarVolume volume = numbers();
  for (const bool gzip : {false, true}) {
    const Bytes bytes = write_nifti(volume, gzip).value();
    const Result<ScalarVolume> back = read_scalar_volume({"x.nii", bytes, {}});
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->size, volume.size);
    EXPECT_EQ(back->values, volume.values);
    EXPECT_TRUE(back->index_to_mm.isApprox(volume.index_to_mm, 1e-6));
    const Bytes cut(bytes.begin(), bytes.end() - 5);
    EXPECT_FALSE(read_scalar_volume({"x.nii", cut, {}}).ok());
    const Result<LabelVolume> labels = read_volume({"x.nii", bytes, {}});
    ASSERT_FALSE(labels.ok());
    EXPECT_NE(labels.error().message.find("has the value -2.875"), std::string::npos)
        << labels.error().message;
  }
}

TEST(ReadScalarVolume, RefusesOtherFormatsByName) {
  const std::string text = "NRRD0004\n";
  const Bytes bytes(text.begin(), text.end());
  const Result<ScalarVolume> read = read_scalar_volume({"sizes.nrrd", bytes, {}});
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("sizes.nrrd: starts with"), std::string::npos) << read.error().message;
  EXPECT_NE(read.error().message.find("NIfTI"), std::string::npos);
}

TEST(WriteVti, RefusesAxesThatAreNotAtRightAngles) {
  ScalarVolume volume = numbers();
  volume.index_to_mm(0, 0) = 0.5;
  const Result<Bytes> bytes = write_vti(volume, "thickness");
  ASSERT_FALSE(bytes.ok());
  EXPECT_NE(bytes.error().message.find("right angles"), std::string::npos);
}

}  // namespace
}  // namespace voxtet::test
