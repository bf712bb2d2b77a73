#include "io/volume/formats/nifti_header.h"

#include <cmath>
#include <cstring>
#include <optional>
#include <span>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

constexpr std::size_t kHeader1 = 348, kHeader2 = 540;

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

}  // namespace

Result<NiftiHeader> read_nifti_header(ByteSource& source) {
  std::array<std::uint8_t, kHeader2> bytes{};
  std::array<std::uint8_t, kHeader1> start{};
  const Result<std::size_t> got = source.read(start);
  if (!got) return got.error();
  if (*got < kHeader1)
    return bad_nifti("the header is truncated: " + std::to_string(*got) + " bytes; expected at least 348");
  const Result<NiftiHeader> header = parse_header(start, source, bytes);
  if (!header) return header.error();
  if (Status magic = check_magic(*header); !magic) return magic.error();
  return header;
}

Result<VoxelLayout> nifti_layout(const NiftiHeader& h) {
  VoxelLayout layout;
  layout.stage = kNiftiReader;
  layout.big_endian = h.big_endian;
  if (h.dim[0] == 2) return one_slice(kNiftiReader, "dim[0]", "2");
  if (h.dim[0] < 3 || h.dim[0] > 7)
    return bad_nifti("dim[0] is " + std::to_string(h.dim[0]) +
                     " dimensions; expected 3, or more of extent 1");
  layout.size = {h.dim[1], h.dim[2], h.dim[3]};
  for (std::size_t d = 4; d <= static_cast<std::size_t>(h.dim[0]); ++d) {
    if (h.dim[d] == 1) continue;
    if (layout.frames != 1)
      return bad_nifti(layout.frames_said + " and dim[" + std::to_string(d) + "] is " +
                       std::to_string(h.dim[d]) + "; expected one list of frames at most");
    layout.frames = h.dim[d];
    layout.frames_said = "dim[" + std::to_string(d) + "] is " + std::to_string(h.dim[d]);
  }
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

Status skip_to_voxels(const NiftiHeader& h, ByteSource& source) {
  const std::size_t header_bytes = h.version == 1 ? kHeader1 : kHeader2;
  const double first = static_cast<double>(header_bytes + 4);
  // 2^53: beyond it a double no longer holds every whole number.
  if (!(h.vox_offset >= first && h.vox_offset <= 9007199254740992.0) ||
      h.vox_offset != std::trunc(h.vox_offset))
    return bad_nifti("vox_offset is " + number_text(h.vox_offset) + "; expected a whole number from " +
                     std::to_string(header_bytes + 4));
  return skip_bytes(source, static_cast<std::uint64_t>(h.vox_offset) - header_bytes, "vox_offset");
}

}  // namespace voxtet
