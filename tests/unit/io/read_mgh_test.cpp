#include "io/bytes/byte_source.h"
#include "unit/io/remarks.h"

namespace voxtet::test {
namespace {

/// A file of 3 x 2 x 2 voxels, big-endian.
struct MghFile {
  std::array<std::int32_t, 7> head{1, 3, 2, 2, 1, 0, 0};  ///< version, extents, frames, type, dof
  std::int16_t good = 1;
  std::array<float, 15> place{2, 3, 4, 1, 0, 0, 0, 1, 0, 0, 0, 1, 10, 20, 30};
  Bytes data = sample_bytes(), tail{};

  template <class T>
  static void put(Bytes& bytes, std::size_t at, T value) {
    std::memcpy(&bytes[at], &value, sizeof(T));
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + sizeof(T)));
  }
  Bytes bytes() const {
    Bytes out(284, 0);
    for (std::size_t n = 0; n < head.size(); ++n) put(out, 4 * n, head[n]);
    put(out, 28, good);
    for (std::size_t n = 0; n < place.size(); ++n) put(out, 30 + 4 * n, place[n]);
    return std::move(out) + data + tail;
  }
};

// The centre is at half the extents: (1.5, 1, 1).
const Eigen::Matrix4d kCentred = affine({2, 0, 0, 7, 0, 3, 0, 17, 0, 0, 4, 26});

TEST(ReadMgh, ReadsEveryTypeWithAndWithoutCompression) {
  struct Case {
    std::int32_t type;
    bool wide;
    Bytes (*pack)(const std::vector<Label>&, bool);
  };
  for (const Case& c : std::vector<Case>{{0, false, packed<std::uint8_t>},
                                         {1, true, packed<std::int32_t>},
                                         {3, true, packed<float>},
                                         {4, false, packed<std::int16_t>},
                                         {10, true, packed<std::uint16_t>}})
    for (const bool gzip : {false, true}) {
      MghFile file;
      file.head[5] = c.type;
      file.data = c.pack(sample_labels(c.wide), true);
      file.tail = Bytes(20, 7);  // acquisition and tags
      expect_volume(read(gzip ? *gzip_bytes(file.bytes()) : file.bytes()), sample_labels(c.wide), kCentred);
    }
}

TEST(ReadMgh, WithoutAGeometryItIsCoronal) {
  MghFile file;
  file.good = 0;
  expect_volume(read(file.bytes()), sample_labels(false), affine({-1, 0, 0, 1.5, 0, 0, 1, -1, 0, -1, 0, 1}));
}

TEST(ReadMgh, ChoosesAFrame) {
  MghFile file;
  file.head[4] = 2;
  file.data = Bytes(12, 3) + sample_bytes();
  expect_refused(file.bytes(),
                 "nframes is 2; expected one label a voxel: choose a frame with --frame 0 to 1");
  ReadOptions options;
  options.frame = 1;
  ReadRemarks remarks;
  expect_volume(read(file.bytes(), options, remarks), sample_labels(false), kCentred);
}

TEST(ReadMgh, RefusesDamage) {
  const Bytes whole = MghFile{}.bytes();
  expect_refused(Bytes(whole.begin(), whole.end() - 1), "truncated: they have 11 bytes; expected 12");
  expect_refused(Bytes(whole.begin(), whole.begin() + 200), "the header is truncated: 200 bytes");
  Bytes packed_file = *gzip_bytes(MghFile{.tail = Bytes(20, 7)}.bytes());
  packed_file[packed_file.size() - 6] ^= 1;
  expect_refused(packed_file, "incorrect data check");
  MghFile flat;
  flat.place[3] = 0;
  expect_refused(flat.bytes(), "spacing, direction cosines and centre");
  MghFile huge;
  huge.head[1] = huge.head[2] = 4095;  // as many as 32 bits can address
  expect_refused(huge.bytes(), "truncated: they have 12 bytes");
}

}  // namespace
}  // namespace voxtet::test
