#include "io/volume/read_nifti.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include "io/bytes/header_text.h"
#include "io/volume/label_voxels.h"

namespace voxtet {
namespace {

constexpr const char* kNiftiReader = "read_nifti";
constexpr std::size_t kHeader1 = 348, kHeader2 = 540;

Error bad_nifti(const std::string& message) {
  return bad_input(kNiftiReader, message);
}

/// The fields that both versions have, widened. Lengths still in the file's unit.
struct NiftiHeader {
  bool big_endian = false;
  int version = 1;
  std::array<std::uint8_t, 8> magic{};
  std::array<std::int64_t, 8> dim{};
  std::int64_t datatype = 0, bitpix = 0, sform_code = 0, qform_code = 0, units = 0;
  double vox_offset = 0, slope = 0, inter = 0;
  std::array<double, 8> pixdim{};
  std::array<double, 3> quatern{}, qoffset{};
  std::array<double, 12> srow{};
};

/// Where the fields stand. `Dim`, `Code`, `Real` are the types of the extents, the xform codes and the
/// lengths.
template <class Dim, class Code, class Real, class Offset>
NiftiHeader parse_fields(std::span<const std::uint8_t> bytes, bool big_endian, bool second) {
  const auto get = [&]<class T>(T, std::size_t offset) {
    return load_value<T>(bytes.data() + offset, big_endian);
  };
  NiftiHeader h;
  h.big_endian = big_endian;
  h.version = second ? 2 : 1;
  std::memcpy(h.magic.data(), bytes.data() + (second ? 4 : 344), second ? 8 : 4);
  for (std::size_t n = 0; n < 8; ++n) {
    h.dim[n] = get(Dim{}, (second ? 16 : 40) + n * sizeof(Dim));
    h.pixdim[n] = get(Real{}, (second ? 104 : 76) + n * sizeof(Real));
  }
  h.datatype = get(std::int16_t{}, second ? 12 : 70);
  h.bitpix = get(std::int16_t{}, second ? 14 : 72);
  h.vox_offset = static_cast<double>(get(Offset{}, second ? 168 : 108));
  h.slope = get(Real{}, second ? 176 : 112);
  h.inter = get(Real{}, second ? 184 : 116);
  h.units = second ? get(std::int32_t{}, 500) : get(std::uint8_t{}, 123);
  h.qform_code = get(Code{}, second ? 344 : 252);
  h.sform_code = get(Code{}, second ? 348 : 254);
  for (std::size_t n = 0; n < 3; ++n) {
    h.quatern[n] = get(Real{}, (second ? 352 : 256) + n * sizeof(Real));
    h.qoffset[n] = get(Real{}, (second ? 376 : 268) + n * sizeof(Real));
  }
  for (std::size_t n = 0; n < 12; ++n) h.srow[n] = get(Real{}, (second ? 400 : 280) + n * sizeof(Real));
  return h;
}

Result<NiftiHeader> parse_header(std::span<const std::uint8_t> start, ByteSource& source,
                                 std::array<std::uint8_t, kHeader2>& bytes) {
  std::memcpy(bytes.data(), start.data(), start.size());
  const auto little = load_value<std::int32_t>(bytes.data(), false),
             big = load_value<std::int32_t>(bytes.data(), true);
  const bool second = little == kHeader2 || big == kHeader2;
  if (!second && little != kHeader1 && big != kHeader1)
    return bad_nifti("sizeof_hdr is " + std::to_string(little) + "; expected 348 (NIfTI-1) or 540 (NIfTI-2)");
  if (second) {
    Result<std::size_t> got = source.read({bytes.data() + kHeader1, kHeader2 - kHeader1});
    if (!got) return got.error();
    if (*got < kHeader2 - kHeader1)
      return bad_nifti("the header is truncated: " + std::to_string(kHeader1 + *got) +
                       " bytes; expected 540");
    return parse_fields<std::int64_t, std::int32_t, double, std::int64_t>(bytes, big == kHeader2, true);
  }
  return parse_fields<std::int16_t, std::int16_t, float, float>(bytes, big == kHeader1, false);
}

Status check_magic(const NiftiHeader& h) {
  constexpr std::array<std::uint8_t, 8> single1{'n', '+', '1', 0}, pair1{'n', 'i', '1', 0};
  constexpr std::array<std::uint8_t, 8> single2{'n', '+', '2', 0, '\r', '\n', 0x1a, '\n'};
  if (h.magic == (h.version == 1 ? single1 : single2)) return std::monostate{};
  const std::string found(h.magic.begin(), h.magic.begin() + (h.version == 1 ? 4 : 8));
  if (h.magic == pair1 || found.starts_with(std::string("ni2\0", 4)))
    return bad_nifti(
        "magic says that the voxels stand in a separate .img file; expected a single-file NIfTI (.nii)");
  if (h.version == 1 && found == std::string(4, '\0'))
    return bad_nifti(
        "magic is empty, which makes this an ANALYZE 7.5 header without orientation; expected \"n+1\"");
  return bad_nifti("magic is " + in_quotes(found) + "; expected \"" + (h.version == 1 ? "n+1" : "n+2") +
                   "\"");
}

std::optional<VoxelType> voxel_type(std::int64_t datatype) {
  switch (datatype) {
    case 2: return VoxelType::kUint8;
    case 4: return VoxelType::kInt16;
    case 8: return VoxelType::kInt32;
    case 16: return VoxelType::kFloat32;
    case 64: return VoxelType::kFloat64;
    case 256: return VoxelType::kInt8;
    case 512: return VoxelType::kUint16;
    case 768: return VoxelType::kUint32;
    case 1024: return VoxelType::kInt64;
    case 1280: return VoxelType::kUint64;
    default: return std::nullopt;
  }
}

Result<VoxelLayout> layout_of(const NiftiHeader& h) {
  VoxelLayout layout;
  layout.stage = kNiftiReader;
  layout.big_endian = h.big_endian;
  if (h.dim[0] < 3 || h.dim[0] > 7)
    return bad_nifti("dim[0] is " + std::to_string(h.dim[0]) +
                     " dimensions; expected 3, or more of extent 1");
  for (std::size_t d = 4; d <= static_cast<std::size_t>(h.dim[0]); ++d)
    if (h.dim[d] != 1)
      return bad_nifti("dim[" + std::to_string(d) + "] is " + std::to_string(h.dim[d]) +
                       "; expected 1, a single three-dimensional image");
  layout.size = {h.dim[1], h.dim[2], h.dim[3]};
  const std::optional<VoxelType> type = voxel_type(h.datatype);
  if (!type)
    return bad_nifti(
        "datatype is " + std::to_string(h.datatype) +
        "; expected integers of 8 to 64 bits, float32 or float64 (2, 4, 8, 16, 64, 256, 512, 768, "
        "1024, 1280)");
  layout.type = *type;
  const std::size_t bits = 8 * bytes_of(*type);
  if (h.bitpix != static_cast<std::int64_t>(bits))
    return bad_nifti("bitpix is " + std::to_string(h.bitpix) + "; expected " + std::to_string(bits) +
                     " for datatype " + std::to_string(h.datatype));
  if (Status extents = check_extents(layout, "dim"); !extents) return extents.error();
  if (std::isfinite(h.slope) && h.slope != 0) {
    if (!std::isfinite(h.inter))
      return bad_nifti("scl_inter is not finite although scl_slope is; expected a number");
    layout.slope = h.slope;
    layout.inter = h.inter;
  }
  return layout;
}

Result<double> mm_per_unit(std::int64_t xyzt_units) {
  switch (xyzt_units & 7) {
    case 0: return 1.0;
    case 1: return 1000.0;
    case 2: return 1.0;
    case 3: return 0.001;
    default:
      return bad_nifti("xyzt_units is " + std::to_string(xyzt_units) + "; expected a spatial unit of 0 to 3");
  }
}

Status check_pixdim(const NiftiHeader& h) {
  for (std::size_t d = 1; d <= 3; ++d)
    if (!(h.pixdim[d] > 0) || !std::isfinite(h.pixdim[d]))
      return bad_nifti("pixdim[" + std::to_string(d) + "] is " + number_text(h.pixdim[d]) +
                       "; expected a voxel size above 0");
  return std::monostate{};
}

Result<Eigen::Matrix4d> qform(const NiftiHeader& h) {
  const double qfac = h.pixdim[0];
  if (qfac != 1 && qfac != -1 && qfac != 0)
    return bad_nifti("pixdim[0] (qfac) is " + number_text(qfac) + "; expected 1 or -1");
  const double b = h.quatern[0], c = h.quatern[1], d = h.quatern[2];
  const double rest = 1 - (b * b + c * c + d * d);
  // Written so that NaN fails. The components are stored in single precision, in both directions of rounding.
  if (!(rest >= -3 * static_cast<double>(std::numeric_limits<float>::epsilon())))
    return bad_nifti("quatern_b, quatern_c, quatern_d have the squared length " + number_text(1 - rest) +
                     "; expected at most 1");
  const double a = std::sqrt(std::max(rest, 0.0));
  const double s = 2 / (a * a + b * b + c * c + d * d);
  Eigen::Matrix3d rotation;
  rotation << 1 - s * (c * c + d * d), s * (b * c - a * d), s * (b * d + a * c),  //
      s * (b * c + a * d), 1 - s * (b * b + d * d), s * (c * d - a * b),          //
      s * (b * d - a * c), s * (c * d + a * b), 1 - s * (b * b + c * c);
  Eigen::Matrix4d affine = Eigen::Matrix4d::Identity();
  const Eigen::Vector3d spacing(h.pixdim[1], h.pixdim[2], qfac < 0 ? -h.pixdim[3] : h.pixdim[3]);
  affine.topLeftCorner<3, 3>() = rotation * spacing.asDiagonal();
  affine.topRightCorner<3, 1>() << h.qoffset[0], h.qoffset[1], h.qoffset[2];
  return affine;
}

Result<Eigen::Matrix4d> affine_of(const NiftiHeader& h) {
  for (const auto& [name, code] :
       {std::pair("sform_code", h.sform_code), std::pair("qform_code", h.qform_code)})
    if (code < 0 || code > 5)
      return bad_nifti(std::string(name) + " is " + std::to_string(code) + "; expected 0 to 5");
  const Result<double> scale = mm_per_unit(h.units);
  if (!scale) return scale.error();
  Eigen::Matrix4d affine = Eigen::Matrix4d::Identity();
  std::string field = "the sform (srow_x, srow_y, srow_z)";
  if (h.sform_code > 0) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        affine(row, column) = h.srow[static_cast<std::size_t>(4 * row + column)];
  } else {
    if (Status positive = check_pixdim(h); !positive) return positive.error();
    if (h.qform_code > 0) {
      const Result<Eigen::Matrix4d> rigid = qform(h);
      if (!rigid) return rigid.error();
      affine = *rigid;
      field = "the qform (quatern, qoffset, pixdim)";
    } else {
      field = "pixdim";
      for (int d = 0; d < 3; ++d) {
        const auto n = static_cast<std::size_t>(d + 1);
        affine(d, d) = d == 0 ? -h.pixdim[n] : h.pixdim[n];
        affine(d, 3) = -affine(d, d) * static_cast<double>(h.dim[n] - 1) / 2;
      }
    }
  }
  affine.topRows<3>() *= *scale;
  if (Status good = check_affine(kNiftiReader, field, affine); !good) return good.error();
  return affine;
}

/// What a header says of voxels and space.
struct PlacedVoxels {
  VoxelLayout layout;
  Eigen::Matrix4d index_to_mm;
};

/// Reads up to the first voxel.
Result<PlacedVoxels> read_header(ByteSource& source) {
  std::array<std::uint8_t, kHeader2> bytes{};
  std::array<std::uint8_t, kHeader1> start{};
  Result<std::size_t> got = source.read(start);
  if (!got) return got.error();
  if (*got < kHeader1)
    return bad_nifti("the header is truncated: " + std::to_string(*got) + " bytes; expected at least 348");
  const Result<NiftiHeader> header = parse_header(start, source, bytes);
  if (!header) return header.error();
  if (Status magic = check_magic(*header); !magic) return magic.error();
  const Result<VoxelLayout> layout = layout_of(*header);
  if (!layout) return layout.error();
  const Result<Eigen::Matrix4d> affine = affine_of(*header);
  if (!affine) return affine.error();

  const std::size_t header_bytes = header->version == 1 ? kHeader1 : kHeader2;
  const double first = static_cast<double>(header_bytes + 4);
  // 2^53: beyond it a double no longer holds every whole number.
  if (!(header->vox_offset >= first && header->vox_offset <= 9007199254740992.0) ||
      header->vox_offset != std::trunc(header->vox_offset))
    return bad_nifti("vox_offset is " + number_text(header->vox_offset) + "; expected a whole number from " +
                     std::to_string(header_bytes + 4));
  const std::uint64_t to_skip = static_cast<std::uint64_t>(header->vox_offset) - header_bytes;
  if (Status skipped = skip_bytes(source, to_skip, "vox_offset"); !skipped) return skipped.error();
  return PlacedVoxels{*layout, *affine};
}

}  // namespace

bool looks_like_nifti(std::span<const std::uint8_t> start) {
  if (start.size() < 4) return false;
  for (const bool big : {false, true}) {
    const auto size = load_value<std::int32_t>(start.data(), big);
    if (size == kHeader1 || size == kHeader2) return true;
  }
  const auto magic_at = [&](std::size_t offset, std::uint8_t version) {
    return start.size() >= offset + 4 && start[offset] == 'n' &&
           (start[offset + 1] == '+' || start[offset + 1] == 'i') && start[offset + 2] == version &&
           start[offset + 3] == 0;
  };
  return magic_at(344, '1') || magic_at(4, '2');
}

Result<LabelVolume> read_nifti(ByteSource& source) {
  const Result<PlacedVoxels> header = read_header(source);
  if (!header) return header.error();
  Result<std::vector<Label>> labels = read_labels(source, header->layout);
  if (!labels) return labels.error();
  return make_volume(header->layout, header->index_to_mm, std::move(*labels));
}

Result<ScalarVolume> read_nifti_scalars(ByteSource& source) {
  const Result<PlacedVoxels> header = read_header(source);
  if (!header) return header.error();
  Result<std::vector<float>> values = read_scalars(source, header->layout);
  if (!values) return values.error();
  ScalarVolume volume;
  for (std::size_t d = 0; d < 3; ++d) volume.size[d] = static_cast<int>(header->layout.size[d]);
  volume.index_to_mm = header->index_to_mm;
  volume.values = std::move(*values);
  return volume;
}

}  // namespace voxtet
