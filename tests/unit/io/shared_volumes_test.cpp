#include "unit/io/shared_volumes.h"

#include <gtest/gtest.h>

#include <map>

namespace voxtet::test {
namespace {

TEST(SharedVolumes, TheSameHeartInThreeFormatsIsTheSameVolume) {
  if (shared_data(kSharedVolumes[0]).empty()) GTEST_SKIP() << "the shared data folder is absent";
  const Result<LabelVolume> nifti = read_volume_file(shared_data("biv_ed_oblique_sax.nii.gz"));
  ASSERT_TRUE(nifti) << nifti.error().message;
  EXPECT_EQ(nifti->size, (std::array<int, 3>{93, 80, 18}));
  for (const char* name : {"biv_ed_oblique_sax.mha", "biv_ed_oblique_sax.seg.nrrd"}) {
    const Result<LabelVolume> other = read_volume_file(shared_data(name));
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_EQ(other->size, nifti->size);
    EXPECT_EQ(other->labels, nifti->labels);
    EXPECT_LE((other->index_to_mm - nifti->index_to_mm).cwiseAbs().maxCoeff(), 1e-4) << name;
    if (other->infos.empty()) continue;
    ASSERT_EQ(other->infos.size(), 4U);
    EXPECT_EQ(other->infos[0].name, "LV_myocardium");
    EXPECT_EQ(other->infos[0].colour, (std::array<float, 3>{0.9F, 0.5F, 0.1F}));
  }
}

TEST(SharedVolumes, HoldTheLabelCountsOfTheirIndex) {
  const std::map<std::string, std::map<Label, std::size_t>> expected{
      {"biv_ed_oblique_sax.mha", {{1, 8227}, {2, 2876}, {3, 11059}, {4, 10741}}},
      {"biv_ed_scar_1mm.nii.gz", {{1, 116352}, {2, 45941}, {3, 174538}, {4, 169372}, {5, 8880}, {6, 6621}}},
      {"biv_mean_2mm_float32.nii.gz", {{1, 13596}, {2, 4499}, {3, 18700}, {4, 21181}}},
      {"prostate_phantom.nrrd", {{1, 168}, {7, 170}, {8, 2997}, {9, 9088}}},
      {"skull.nrrd", {{1, 532633}}},
      // Label 1 is what surrounds the bodies, which the index does not count.
      {"mickey.nrrd", {{1, 232028}, {2, 16348}, {3, 822}, {4, 822}, {5, 27}}}};
  for (const auto& [name, counts] : expected) {
    if (shared_data(name).empty()) GTEST_SKIP() << "the shared data folder is absent";
    const Result<LabelVolume> volume = read_volume_file(shared_data(name));
    ASSERT_TRUE(volume) << volume.error().message;
    std::map<Label, std::size_t> found;
    for (const Label label : volume->labels)
      if (label != kBackground) ++found[label];
    EXPECT_EQ(found, counts) << name;
  }
}

}  // namespace
}  // namespace voxtet::test
