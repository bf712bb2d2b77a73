#include <cmath>
#include <limits>

#include "io/bytes/byte_source.h"
#include "unit/io/nifti_file.h"

namespace voxtet::test {
namespace {

const Eigen::Matrix4d kSform = affine({2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30});

TEST(ReadNifti, ReadsEveryTypeInBothByteOrdersAndVersions) {
  struct Case {
    int datatype, bits;
    bool wide;
    Bytes (*pack)(const std::vector<Label>&, bool);
  };
  const std::vector<Case> cases{
      {256, 8, false, packed<std::int8_t>},   {2, 8, false, packed<std::uint8_t>},
      {4, 16, false, packed<std::int16_t>},   {512, 16, true, packed<std::uint16_t>},
      {8, 32, true, packed<std::int32_t>},    {768, 32, true, packed<std::uint32_t>},
      {1024, 64, true, packed<std::int64_t>}, {1280, 64, true, packed<std::uint64_t>},
      {16, 32, true, packed<float>},          {64, 64, true, packed<double>}};
  for (const Case& c : cases)
    for (const int version : {1, 2})
      for (const bool big : {false, true})
        for (const bool gzip : {false, true}) {
          SCOPED_TRACE(std::to_string(c.datatype) + " v" + std::to_string(version) +
                       (big ? " big" : " little"));
          NiftiFile file;
          file.version = version;
          file.big_endian = big;
          file.datatype = c.datatype;
          file.bitpix = c.bits;
          const std::vector<Label> labels = sample_labels(c.wide);
          file.data = c.pack(labels, big);
          expect_volume(read(gzip ? *gzip_bytes(file.bytes()) : file.bytes()), labels, kSform);
        }
}

TEST(ReadNifti, TakesSformThenQformThenPixdim) {
  NiftiFile file;
  file.qform_code = 1;
  file.quatern = {std::sqrt(0.5), 0, 0};  // 90 degrees about x
  file.qoffset = {1, 2, 3};
  const std::vector<Label> labels = sample_labels(false);
  expect_volume(read(file.bytes()), labels, kSform);
  file.sform_code = 0;
  expect_volume(read(file.bytes()), labels, affine({2, 0, 0, 1, 0, 0, -4, 2, 0, 3, 0, 3}));
  file.pixdim[0] = -1;
  expect_volume(read(file.bytes()), labels, affine({2, 0, 0, 1, 0, 0, 4, 2, 0, 3, 0, 3}));
  file.qform_code = 0;
  expect_volume(read(file.bytes()), labels, affine({-2, 0, 0, 2, 0, 3, 0, -1.5, 0, 0, 4, -2}));
}

TEST(ReadNifti, ScalesLengthsToMillimetres) {
  NiftiFile file;
  for (const auto& [units, scale] : {std::pair(0, 1.0), std::pair(1, 1000.0), std::pair(2, 1.0),
                                     std::pair(3, 0.001), std::pair(2 + 8, 1.0)}) {
    file.units = units;
    Eigen::Matrix4d expected = kSform;
    expected.topRows<3>() *= scale;
    expect_volume(read(file.bytes()), sample_labels(false), expected);
  }
}

TEST(ReadNifti, AppliesSlopeAndIntercept) {
  NiftiFile file;
  file.data = packed<std::uint8_t>(std::vector<Label>(12, 30), false);
  file.slope = 0.1;  // not exact in single precision
  file.inter = 2;
  expect_volume(read(file.bytes()), std::vector<Label>(12, 5), kSform);
  for (const double none : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    file.slope = none;
    expect_volume(read(file.bytes()), std::vector<Label>(12, 30), kSform);
  }
  file.slope = 0.01;
  expect_refused(file.bytes(), "voxel (0, 0, 0) has the value 2.29999999");
  file.slope = 1;
  file.inter = std::numeric_limits<double>::infinity();
  expect_refused(file.bytes(), "scl_inter");
}

TEST(ReadNifti, ReadsOneFrameOfFourDimensionsAndSkipsExtensions) {
  NiftiFile file;
  file.dim[0] = 4;
  file.vox_offset = 352 + 64;
  expect_volume(read(file.bytes()), sample_labels(false), kSform);
  file.dim = {4, 3, 2, 1, 2, 1, 1, 1};
  expect_refused(file.bytes(), "dim[4] is 2; expected one label a voxel: choose a frame with --frame 0 to 1");
  file.dim = {5, 3, 1, 1, 2, 2, 1, 1};
  expect_refused(file.bytes(), "dim[4] is 2 and dim[5] is 2");
}

TEST(ReadNifti, NamesTheFirstVoxelThatIsNoLabel) {
  NiftiFile file;
  file.datatype = 16;
  file.bitpix = 32;
  const auto with = [&](float value) {
    file.data = packed<float>(sample_labels(false), false);
    std::memcpy(file.data.data() + 4 * 8, &value, 4);  // voxel (2, 0, 1)
    return file.bytes();
  };
  expect_refused(with(1.5F), "voxel (2, 0, 1) has the value 1.5; expected labels");
  expect_refused(with(-1),
                 "voxel (2, 0, 1) has the value -1; expected labels, whole numbers from 0 to 65535: "
                 "if -1 is the background, say it with --background -1 (source.background)");
  expect_refused(with(std::numeric_limits<float>::quiet_NaN()), "voxel (2, 0, 1) has the value nan");
  file.datatype = 1280;
  file.bitpix = 64;
  file.data = packed<std::uint64_t>(sample_labels(false), false);
  std::fill_n(file.data.begin() + 8, 8, 0xff);
  expect_refused(file.bytes(), "voxel (1, 0, 0) has the value 1.84467441e+19");
}

TEST(ReadNifti, RefusesBadFieldsByName) {
  const auto refused = [](const std::string& words, auto change) {
    for (const int version : {1, 2}) {
      NiftiFile file;
      file.version = version;
      change(file);
      expect_refused(file.bytes(), words);
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused("dim[0] is 2: the file holds one slice", [](NiftiFile& f) { f.dim[0] = 2; });
  refused("dim[0] is 8", [](NiftiFile& f) { f.dim[0] = 8; });
  refused("dim holds the extent 0", [](NiftiFile& f) { f.dim[2] = 0; });
  refused("dim holds the extent -3", [](NiftiFile& f) { f.dim[1] = -3; });
  refused("datatype is 128", [](NiftiFile& f) { f.datatype = 128; });
  refused("bitpix is 16; expected 8", [](NiftiFile& f) { f.bitpix = 16; });
  refused("sform_code is 77", [](NiftiFile& f) { f.sform_code = 77; });
  refused("qform_code is -1", [](NiftiFile& f) { f.qform_code = -1; });
  refused("xyzt_units is 5", [](NiftiFile& f) { f.units = 5; });
  refused("srow_x, srow_y, srow_z) holds a number that is not finite",
          [=](NiftiFile& f) { f.srow[3] = nan; });
  refused("srow_x, srow_y, srow_z) is singular",
          [](NiftiFile& f) { f.srow = {1, 2, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0}; });
  refused("voxel spacing of 0 mm along axis 2", [](NiftiFile& f) { f.srow[10] = 0; });
  refused("pixdim[2] is 0", [](NiftiFile& f) { f.sform_code = 0, f.pixdim[2] = 0; });
  refused("pixdim[0] (qfac) is 3", [](NiftiFile& f) { f.sform_code = 0, f.qform_code = 1, f.pixdim[0] = 3; });
  refused("quatern_b", [](NiftiFile& f) { f.sform_code = 0, f.qform_code = 1, f.quatern = {1, 1, 0}; });
  refused("quatern_b", [=](NiftiFile& f) { f.sform_code = 0, f.qform_code = 1, f.quatern[2] = nan; });
  refused("vox_offset is 300", [](NiftiFile& f) { f.vox_offset = 300; });
  refused("vox_offset skips", [](NiftiFile& f) { f.vox_offset = 4e9; });
  refused("magic is \"x+1",
          [](NiftiFile& f) { f.magic = std::string("x+1\0\0\0\0\0", f.version == 1 ? 4 : 8); });
  refused("truncated: they have 11 bytes; expected 12 bytes", [](NiftiFile& f) { f.data.pop_back(); });
  refused("go on for 1 bytes", [](NiftiFile& f) { f.data.push_back(0); });
  expect_refused(NiftiFile{.magic = std::string("ni1\0", 4)}.bytes(), "separate .img file");
  expect_refused(NiftiFile{.magic = std::string("\0\0\0\0", 4)}.bytes(), "ANALYZE");
  expect_refused(NiftiFile{.vox_offset = 352.5}.bytes(), "vox_offset is 352.5");
}

TEST(ReadNifti, RefusesExtentsWhoseProductOverflows) {
  NiftiFile file;
  file.version = 2;
  file.dim = {3, 2147483647, 2147483647, 2147483647, 1, 1, 1, 1};
  expect_refused(file.bytes(), "dim asks for more voxels than memory can hold");
  file.dim[1] = std::int64_t{1} << 40;
  expect_refused(file.bytes(), "dim holds the extent 1099511627776");
}

TEST(ReadNifti, RefusesDamagedGzip) {
  const Bytes whole = *gzip_bytes(NiftiFile{}.bytes());
  for (std::size_t length = 1; length < whole.size(); ++length)
    EXPECT_FALSE(read(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))).ok())
        << length;
  Bytes crc = whole;
  crc[crc.size() - 6] ^= 1;
  expect_refused(crc, "gzip data are damaged: incorrect data check");
  Bytes length = whole;
  length[length.size() - 2] ^= 1;
  expect_refused(length, "gzip data are damaged: incorrect length check");
  expect_refused(whole + bytes_of_text("x"), "1 bytes follow the end of the gzip data");
  expect_refused(*gzip_bytes(bytes_of_text("something else")), "gzip data that hold no NIfTI or MGH header");
}

TEST(ReadNifti, ReadsSeveralGzipMembers) {
  const Bytes whole = NiftiFile{}.bytes();
  const auto middle = whole.begin() + 200;
  const Bytes both = *gzip_bytes(Bytes(whole.begin(), middle)) + *gzip_bytes(Bytes(middle, whole.end()));
  expect_volume(read(both), sample_labels(false), kSform);
}

TEST(ReadVolume, SaysWhatToConvertDicomWith) {
  Bytes dicom(132, 0);
  std::copy_n("DICM", 4, dicom.begin() + 128);
  expect_refused(dicom + Bytes(200, 1),
                 "is a DICOM file; expected a volume of labels: open the segmentation");
}

TEST(ReadVolume, RefusesWhatItDoesNotKnow) {
  expect_refused({}, "the file is empty");
  expect_refused(bytes_of_text("solid teapot\n"), "starts with \"solid teapot?\"; expected NIfTI");
  EXPECT_NE(read_volume_file("/nonexistent/a.nii").error().message.find("cannot be opened"),
            std::string::npos);
}

}  // namespace
}  // namespace voxtet::test
