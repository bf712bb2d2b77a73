// Label volumes as the bytes of a link.
#include "io/volume/coded/coded_volume.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "io/volume/read_volume.h"
#include "support/data.h"
#include "support/test_random.h"

namespace voxtet {
namespace {

LabelVolume blobs(const std::array<int, 3>& size, int labels, std::uint64_t seed) {
  test::TestRandom random(seed);
  LabelVolume volume;
  volume.size = size;
  volume.labels.assign(volume.voxel_count(), kBackground);
  volume.index_to_mm.diagonal() = Eigen::Vector4d(0.7, 1.1, 2.5, 1);
  volume.index_to_mm(0, 1) = -0.0;
  volume.index_to_mm.topRightCorner<3, 1>() = Eigen::Vector3d(-10, 1.0 / 3, 12.3456789012);
  for (int n = 0; n < labels; ++n) {
    Eigen::Vector3d centre;  // one after the other: the order of arguments is the compiler's
    for (int d = 0; d < 3; ++d) centre[d] = random.below(size[static_cast<std::size_t>(d)]);
    const double radius = 1 + random.below(6);
    const auto label = static_cast<Label>(1 + random.below(60000));
    volume.visit([&](int i, int j, int k, std::size_t at) {
      if ((Eigen::Vector3d(i, j, k) - centre).norm() < radius) volume.labels[at] = label;
    });
  }
  return volume;
}

void expect_same_after_coding(const LabelVolume& volume) {
  const Result<Bytes> bytes = code_volume(volume);
  ASSERT_TRUE(bytes.ok()) << bytes.error().message;
  const Result<LabelVolume> back = decode_volume(*bytes);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->size, volume.size);
  EXPECT_EQ(back->index_to_mm, volume.index_to_mm);
  EXPECT_EQ(back->labels, volume.labels);
}

TEST(CodedVolume, ComesBackExactly) {
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    test::TestRandom random(static_cast<std::uint64_t>(seed));
    const std::array<int, 3> size{1 + random.below(30), 1 + random.below(20), 1 + random.below(12)};
    expect_same_after_coding(blobs(size, random.below(12), static_cast<std::uint64_t>(100 + seed)));
  }
  LabelVolume noise = blobs({17, 13, 11}, 0, 1);
  test::TestRandom random(5);
  for (Label& label : noise.labels) label = static_cast<Label>(random.below(250));
  expect_same_after_coding(noise);
  LabelVolume full = blobs({4, 4, 4}, 0, 1);
  full.labels.assign(64, 9);
  expect_same_after_coding(full);
}

TEST(CodedVolume, HasTheSameBytesOnEveryPlatform) {
  const Bytes bytes = *code_volume(blobs({30, 26, 18}, 9, 11));
  EXPECT_EQ(crc32(0, bytes.data(), static_cast<uInt>(bytes.size())), 2726192563U);
}

TEST(CodedVolume, RefusesWhatALinkCannotHold) {
  LabelVolume many = blobs({20, 20, 1}, 0, 1);
  for (std::size_t v = 0; v < many.labels.size(); ++v) many.labels[v] = static_cast<Label>(v);
  EXPECT_NE(code_volume(many).error().message.find("399 labels, a link holds at most 254"), std::string::npos)
      << code_volume(many).error().message;
}

TEST(CodedVolume, SaysWhatIsDamaged) {
  const LabelVolume volume = blobs({20, 18, 9}, 5, 3);
  const Bytes whole = *code_volume(volume);
  const auto message = [](const Bytes& bytes) {
    const Result<LabelVolume> read = decode_volume(bytes);
    return read.ok() ? std::string("read") : read.error().message;
  };
  EXPECT_NE(message({}).find("damaged"), std::string::npos);
  Bytes other = whole;
  other[0] = 7;
  EXPECT_NE(message(other).find("found version 7"), std::string::npos);
  for (std::size_t cut = 0; cut + 1 < whole.size(); ++cut)
    EXPECT_NE(message(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut))), "read") << cut;
  // A changed bit is seen, or changes nothing: 0 has several forms.
  for (std::size_t bit = 0; bit < 8 * whole.size(); bit += 3) {
    other = whole;
    other[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    const Result<LabelVolume> read = decode_volume(other);
    if (!read.ok()) continue;
    EXPECT_EQ(read->labels, volume.labels) << bit;
    EXPECT_EQ(read->index_to_mm, volume.index_to_mm) << bit;
  }
}

TEST(CodedVolume, HoldsRealHeartsInAFewThousandCharacters) {
  const std::array<std::pair<const char*, std::size_t>, 3> files{{{"biv_es_oblique_sax.nii.gz", 1600},
                                                                  {"biv_ed_oblique_sax.nii.gz", 2100},
                                                                  {"biv_ed_scar_1mm.nii.gz", 11500}}};
  for (const auto& [name, most] : files) {
    const std::string path = test::shared_data(name);
    if (path.empty()) GTEST_SKIP() << "the volumes are not there: set VOXTET_DATA";
    const Result<LabelVolume> volume = read_volume_file(path);
    ASSERT_TRUE(volume.ok());
    const std::size_t characters = (code_volume(*volume)->size() * 4 + 2) / 3;
    RecordProperty(name, static_cast<int>(characters));
    EXPECT_LE(characters, most) << name;
    expect_same_after_coding(*volume);
  }
}

}  // namespace
}  // namespace voxtet
