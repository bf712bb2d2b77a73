// Real files, cut and damaged at seeded places: an error, or a volume that the file still says, and no more
// memory than its header and its bytes together can mean. The meaning of damaged headers is checked against
// other readers by tests/integration/check_volumes.py.
#include <zlib.h>

#include <functional>
#include <random>

#include "io/bytes/byte_source.h"
#include "unit/io/allocation_peak.h"
#include "unit/io/nifti_file.h"
#include "unit/io/shared_volumes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace voxtet::test {
namespace {

constexpr std::size_t kSlack = std::size_t{1} << 19;

/// Reads under the bound on memory: labels (2 bytes) for at most as many voxels as the bytes can hold.
Result<LabelVolume> read_bounded(const Bytes& bytes, bool compressed) {
  reset_allocation_peak();
  Result<LabelVolume> volume = read(bytes);
  const std::size_t held = bytes.size() * (compressed ? 1032 : 1);
  EXPECT_LE(allocation_peak(), 2 * held + kSlack);
  if (volume) {
    EXPECT_EQ(volume->labels.size(), volume->voxel_count());
    EXPECT_LE(allocation_peak(), 2 * volume->voxel_count() + kSlack);
    EXPECT_TRUE(volume->index_to_mm.allFinite());
  } else {
    EXPECT_FALSE(volume.error().message.empty());
  }
  return volume;
}

Bytes unzipped(const Bytes& bytes) {
  const auto source = make_inflate_source(bytes);
  Bytes all(std::size_t{1} << 24);
  all.resize(*source->read(all));
  return all;
}

/// Where the header of a text format ends.
std::size_t text_header_bytes(const Bytes& bytes) {
  const std::string text(bytes.begin(), bytes.end());
  const std::size_t meta = text.find("ElementDataFile = LOCAL\n");
  return meta != std::string::npos ? meta + 24 : text.find("\n\n") + 2;
}

void for_each_shared_volume(const std::function<void(const std::string& name, const Bytes& bytes)>& visit) {
  if (shared_data(kSharedVolumes[0]).empty()) GTEST_SKIP() << "the shared data folder is absent";
  for (const char* name : kSharedVolumes) {
    SCOPED_TRACE(name);
    const std::string path = shared_data(name);
    ASSERT_FALSE(path.empty());
    visit(name, file_bytes(path));
  }
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

TEST(DamagedVolumes, AnyCutIsAnError) {
  for_each_shared_volume([](const std::string& name, const Bytes& bytes) {
    std::mt19937 random(1);
    const bool raw = name == "mickey.nrrd";
    std::vector<std::size_t> lengths{bytes.size() - 1, bytes.size() - 4, bytes.size() - 8, bytes.size() - 9};
    while (lengths.size() < 64) lengths.push_back(random() % bytes.size());
    for (const std::size_t length : lengths)
      EXPECT_FALSE(
          read_bounded(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)), !raw))
          << "cut to " << length;
    if (!ends_with(name, ".gz")) return;
    const Bytes plain = unzipped(bytes);
    for (int n = 0; n < 64; ++n) {
      const std::size_t length =
          n < 8 ? plain.size() - 1 - static_cast<std::size_t>(n) : random() % plain.size();
      const Bytes cut(plain.begin(), plain.begin() + static_cast<std::ptrdiff_t>(length));
      EXPECT_FALSE(read_bounded(cut, false)) << "inflated and cut to " << length;
    }
  });
}

TEST(DamagedVolumes, ADamagedTextHeaderIsRefusedOrStillDescribesTheData) {
  for_each_shared_volume([](const std::string& name, const Bytes& bytes) {
    if (ends_with(name, ".gz")) return;
    const Result<LabelVolume> whole = read(bytes);
    ASSERT_TRUE(whole) << whole.error().message;
    std::mt19937 random(2);
    const std::size_t header = text_header_bytes(bytes);
    for (int n = 0; n < 200; ++n) {
      Bytes damaged = bytes;
      const std::size_t at = random() % header;
      damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ (1 + random() % 255));
      const Result<LabelVolume> volume = read_bounded(damaged, name != "mickey.nrrd");
      // One character cannot turn a size, type or order into another that fits the data, but for
      // the sign of a type (every value is below 128) and the segments' own words.
      if (volume) {
        EXPECT_EQ(volume->size, whole->size) << at;
        EXPECT_EQ(volume->labels, whole->labels) << at;
      }
    }
  });
}

/// Bytes of a NIfTI-1 header that decide voxels or affine; damage elsewhere must change nothing.
bool decides(std::size_t at) {
  const auto in = [at](std::size_t begin, std::size_t end) { return at >= begin && at < end; };
  return in(0, 4) || in(40, 56) || in(70, 74) || in(76, 92) || in(108, 120) || at == 123 || in(252, 328) ||
         in(344, 348);
}

TEST(DamagedVolumes, ADamagedNiftiHeaderChangesOnlyWhatItSays) {
  for_each_shared_volume([](const std::string& name, const Bytes& bytes) {
    if (!ends_with(name, ".gz")) return;
    const Bytes plain = unzipped(bytes);
    const Result<LabelVolume> whole = read(plain);
    ASSERT_TRUE(whole) << whole.error().message;
    // The rest is compressed once: a gzip file may have several members.
    const Bytes rest = *gzip_bytes(Bytes(plain.begin() + 352, plain.end()));
    std::mt19937 random(3);
    for (int n = 0; n < 200; ++n) {
      Bytes header(plain.begin(), plain.begin() + 352);
      const std::size_t at = random() % 348;
      header[at] = static_cast<std::uint8_t>(header[at] ^ (1 + random() % 255));
      const bool packed_again = n % 2 == 0;
      const Bytes damaged =
          packed_again ? *gzip_bytes(header) + rest : header + Bytes(plain.begin() + 352, plain.end());
      const Result<LabelVolume> volume = read_bounded(damaged, packed_again);
      if (decides(at)) continue;
      ASSERT_TRUE(volume) << at << " " << volume.error().message;
      EXPECT_EQ(volume->labels, whole->labels) << at;
      EXPECT_EQ(volume->index_to_mm, whole->index_to_mm) << at;
    }
  });
}

TEST(DamagedVolumes, DamagedCompressedBytesAreRefusedOrMeanTheSame) {
  for_each_shared_volume([](const std::string& name, const Bytes& bytes) {
    if (name == "mickey.nrrd") return;
    const Result<LabelVolume> whole = read(bytes);
    ASSERT_TRUE(whole) << whole.error().message;
    std::mt19937 random(4);
    const std::size_t begin = ends_with(name, ".gz") ? 0 : text_header_bytes(bytes);
    for (int n = 0; n < 200; ++n) {
      Bytes damaged = bytes;
      // Every second place is in the header of the compressed data, where each byte means something.
      const std::size_t at = begin + random() % (n % 2 == 0 ? 20 : bytes.size() - begin);
      damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ (1 + random() % 255));
      const Result<LabelVolume> volume = read_bounded(damaged, true);
      if (volume) {
        EXPECT_EQ(volume->labels, whole->labels) << at;
      }
    }
  });
}

TEST(DamagedVolumes, ClaimsOfHugeSizesAllocateNothing) {
  NiftiFile file;
  file.dim = {3, 32767, 32767, 32767, 1, 1, 1, 1};
  for (const Bytes& bytes : {file.bytes(), *gzip_bytes(file.bytes())}) {
    reset_allocation_peak();
    EXPECT_FALSE(read(bytes));
    EXPECT_LE(allocation_peak(), kSlack);
  }
  for (const char* encoding : {"raw", "gzip", "ascii"}) {
    const Bytes bytes = bytes_of_text("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 900 900 900\nencoding: " +
                                      std::string(encoding) + "\n\n1 2 3\n");
    reset_allocation_peak();
    EXPECT_FALSE(read(bytes));
    EXPECT_LE(allocation_peak(), kSlack);
  }
}

TEST(DamagedVolumes, SurvivesSeededMutationsOfSmallFiles) {
  const Bytes labels = packed<std::uint8_t>(sample_labels(false), false);
  NiftiFile second;
  second.version = 2;
  NiftiFile maps;
  maps.dim = {4, 3, 2, 1, 2, 1, 1, 1};
  maps.data = Bytes{1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1};
  Bytes mgh(284, 0);
  for (const auto& [at, value] :
       {std::pair(3, 1), std::pair(7, 3), std::pair(11, 2), std::pair(15, 2), std::pair(19, 1)})
    mgh[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(value);
  const std::vector<Bytes> seeds{
      NiftiFile{}.bytes(),
      second.bytes(),
      *gzip_bytes(NiftiFile{}.bytes()),
      bytes_of_text("NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 3 2 1\nspace: RAS\nencoding: raw\n"
                    "space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\n"
                    "Segment0_Layer:=0\nSegment0_LabelValue:=1\n\n") +
          labels,
      bytes_of_text(
          "NRRD0001\ntype: float\ndimension: 3\nsizes: 2 2 1\nspacings: 1 1 2\nencoding: ascii\n\n1 2 3 4\n"),
      bytes_of_text("NDims = 3\nDimSize = 3 2 2\nElementType = MET_UCHAR\nElementSpacing = 1 1 2\n"
                    "CompressedData = True\nElementDataFile = LOCAL\n") +
          zlib_packed(labels),
      maps.bytes(),
      bytes_of_text("NDims = 3\nDimSize = 3 2 2\nElementType = MET_UCHAR\nElementDataFile = LIST\na\nb\n"),
      bytes_of_text("NDims = 3\nDimSize = 3 2 2\nElementType = MET_UCHAR\nElementDataFile = s%02d 1 2 1\n"),
      mgh + labels};
  const std::vector<std::string> words{
      "0",    "-1", "4294967296", "nan", "1e308", "none", ")",      "\n",
      "\n\n", "=",  ":=",         "\"",  "LOCAL", "gzip", "double", "99999999999999999999"};
  std::mt19937 random(5);
  std::size_t runs = 0;
  for (const Bytes& seed : seeds)
    for (int n = 0; n < 3000; ++n, ++runs) {
      Bytes bytes = seed;
      for (std::uint32_t edits = 1 + random() % 3; edits > 0; --edits) {
        const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size());
        const std::string& word = words[random() % words.size()];
        switch (random() % 4) {
          case 0: *at = static_cast<std::uint8_t>(random()); break;
          case 1: bytes.insert(at, word.begin(), word.end()); break;
          case 2: bytes.erase(at); break;
          default: *at = random() % 2 == 0 ? 0xff : 0; break;
        }
      }
      reset_allocation_peak();
      ASSERT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
      ASSERT_LE(allocation_peak(), 3 * 1032 * bytes.size() + kSlack);
    }
  EXPECT_EQ(runs, 3000 * seeds.size());
}

}  // namespace
}  // namespace voxtet::test
