#include "io/volume/write_volume.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <optional>

#include "io/bytes/byte_source.h"

namespace voxtet {
namespace {

constexpr const char* kNiftiWriter = "write_nifti";
constexpr std::size_t kVoxOffset = 352;
constexpr std::int16_t kScannerCode = 1, kNoIntent = 0, kLabelIntent = 1002;

template <class T>
void put(Bytes& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

struct Qform {
  std::array<double, 3> quatern;  ///< b, c, d
  double qfac;
};

/// Unit quaternion of a rotation, real part not negative; divides by its largest component.
std::array<double, 3> quaternion_of(const Eigen::Matrix3d& r) {
  const std::array<double, 4> squares{1 + r(0, 0) + r(1, 1) + r(2, 2), 1 + r(0, 0) - r(1, 1) - r(2, 2),
                                      1 - r(0, 0) + r(1, 1) - r(2, 2), 1 - r(0, 0) - r(1, 1) + r(2, 2)};
  const auto largest =
      static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
  const double s = std::sqrt(squares[largest]);  // twice the component
  std::array<double, 4> q{};
  const double ab = r(2, 1) - r(1, 2), ac = r(0, 2) - r(2, 0), ad = r(1, 0) - r(0, 1);
  const double bc = r(1, 0) + r(0, 1), bd = r(0, 2) + r(2, 0), cd = r(2, 1) + r(1, 2);
  switch (largest) {
    case 0: q = {s * s, ab, ac, ad}; break;
    case 1: q = {ab, s * s, bc, bd}; break;
    case 2: q = {ac, bc, s * s, cd}; break;
    default: q = {ad, bd, cd, s * s}; break;
  }
  const double sign = q[0] < 0 ? -1 : 1;
  return {sign * q[1] / (2 * s), sign * q[2] / (2 * s), sign * q[3] / (2 * s)};
}

/// The qform of an affine with orthogonal axes; nothing for a sheared one.
template <class Volume>
std::optional<Qform> qform_of(const Volume& volume) {
  Eigen::Matrix3d rotation = volume.linear() * volume.spacing_mm().cwiseInverse().asDiagonal();
  if (!(rotation.transpose() * rotation).isIdentity(1e-5)) return std::nullopt;
  const double qfac = rotation.determinant() < 0 ? -1 : 1;
  rotation.col(2) *= qfac;
  return Qform{quaternion_of(rotation), qfac};
}

template <class Volume>
Status check(const Volume& volume, std::size_t values) {
  for (int d = 0; d < 3; ++d) {
    const int extent = volume.size[static_cast<std::size_t>(d)];
    if (extent < 1 || extent > 32767)
      return Error{ErrorCode::kUsage,
                   kNiftiWriter,
                   "the volume has " + std::to_string(extent) + " voxels along axis " + std::to_string(d) +
                       "; NIfTI-1 holds 1 to 32767",
                   {}};
  }
  std::size_t expected = 1;
  for (const int extent : volume.size) expected *= static_cast<std::size_t>(extent);
  if (values != expected)
    return Error{ErrorCode::kInternal,
                 kNiftiWriter,
                 "the volume has " + std::to_string(values) + " values; expected " + std::to_string(expected),
                 {}};
  return std::monostate{};
}

/// NIfTI's code of a type, and its bits.
struct DataType {
  std::int16_t code, bits;
};

template <class Volume>
void put_header(Bytes& bytes, const Volume& volume, DataType type, std::int16_t intent) {
  put(bytes, 0, std::int32_t{348});
  bytes[38] = 'r';  // "regular", which ANALYZE readers ask for
  const std::array<int, 8> dim{3, volume.size[0], volume.size[1], volume.size[2], 1, 1, 1, 1};
  const Eigen::Vector3d spacing = volume.spacing_mm();
  const std::optional<Qform> qform = qform_of(volume);
  const std::array<double, 8> pixdim{qform ? qform->qfac : 1, spacing[0], spacing[1], spacing[2], 1, 1, 1, 1};
  for (std::size_t n = 0; n < 8; ++n) {
    put(bytes, 40 + 2 * n, static_cast<std::int16_t>(dim[n]));
    put(bytes, 76 + 4 * n, static_cast<float>(pixdim[n]));
  }
  put(bytes, 68, intent);
  put(bytes, 70, type.code);
  put(bytes, 72, type.bits);
  put(bytes, 108, static_cast<float>(kVoxOffset));
  put(bytes, 112, 1.F);
  bytes[123] = 2;  // mm
  std::memcpy(bytes.data() + 148, "voxtet", 6);
  put(bytes, 254, kScannerCode);
  if (qform) {
    put(bytes, 252, kScannerCode);
    for (std::size_t n = 0; n < 3; ++n) {
      put(bytes, 256 + 4 * n, static_cast<float>(qform->quatern[n]));
      put(bytes, 268 + 4 * n, static_cast<float>(volume.index_to_mm(static_cast<int>(n), 3)));
    }
  }
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      put(bytes, static_cast<std::size_t>(280 + 16 * row + 4 * column),
          static_cast<float>(volume.index_to_mm(row, column)));
  std::memcpy(bytes.data() + 344, "n+1", 4);
}

Error out_of_memory() {
  return {ErrorCode::kOutOfMemory, kNiftiWriter, "there is not enough memory for the file", {}};
}

}  // namespace

Result<Bytes> write_nifti(const ScalarVolume& volume, bool gzip) try {
  if (Status good = check(volume, volume.values.size()); !good) return good.error();
  Bytes bytes(kVoxOffset + volume.values.size() * sizeof(float));
  put_header(bytes, volume, {16, 32}, kNoIntent);
  std::memcpy(bytes.data() + kVoxOffset, volume.values.data(), volume.values.size() * sizeof(float));
  if (!gzip) return bytes;
  return gzip_bytes(bytes);
} catch (const std::bad_alloc&) {
  return out_of_memory();
}

Result<Bytes> write_nifti(const LabelVolume& volume, bool gzip) try {
  if (Status good = check(volume, volume.labels.size()); !good) return good.error();
  const Label most = *std::max_element(volume.labels.begin(), volume.labels.end());
  const bool wide = most > 255;
  Bytes bytes(kVoxOffset + volume.labels.size() * (wide ? 2 : 1));
  put_header(bytes, volume, wide ? DataType{512, 16} : DataType{2, 8}, kLabelIntent);
  if (wide)
    std::memcpy(bytes.data() + kVoxOffset, volume.labels.data(), volume.labels.size() * sizeof(Label));
  else
    std::transform(volume.labels.begin(), volume.labels.end(), bytes.begin() + kVoxOffset,
                   [](Label label) { return static_cast<std::uint8_t>(label); });
  if (!gzip) return bytes;
  return gzip_bytes(bytes);
} catch (const std::bad_alloc&) {
  return out_of_memory();
}

}  // namespace voxtet
