// Builds NIfTI headers field by field, in either version and byte order.
#pragma once

#include "unit/io/volume_files.h"

namespace voxtet::test {

struct NiftiFile {
  int version = 1;
  bool big_endian = false;
  std::array<std::int64_t, 8> dim{3, 3, 2, 2, 1, 1, 1, 1};
  std::array<double, 8> pixdim{1, 2, 3, 4, 1, 1, 1, 1};
  std::int64_t datatype = 2, bitpix = 8, sform_code = 1, qform_code = 0, units = 2;
  double vox_offset = 0;  ///< 0: the smallest that is allowed
  double slope = 1, inter = 0;
  std::array<double, 3> quatern{0, 0, 0}, qoffset{0, 0, 0};
  std::array<double, 12> srow{2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30};
  std::string magic = {};  ///< empty: the right one
  Bytes data = packed<std::uint8_t>(sample_labels(false), false);

  std::size_t header_bytes() const { return version == 1 ? 348 : 540; }

  template <class T>
  void put(Bytes& bytes, std::size_t at, double value) const {
    const T stored = static_cast<T>(value);
    std::array<std::uint8_t, sizeof(T)> raw;
    std::memcpy(raw.data(), &stored, sizeof(T));
    if (big_endian) std::reverse(raw.begin(), raw.end());
    std::copy(raw.begin(), raw.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  }

  Bytes bytes() const {
    const double offset = vox_offset != 0 ? vox_offset : static_cast<double>(header_bytes() + 4);
    Bytes out(std::max(header_bytes() + 4, offset < 1e6 && offset > 0 ? static_cast<std::size_t>(offset) : 0),
              0);
    put<std::int32_t>(out, 0, static_cast<double>(header_bytes()));
    version == 1 ? put_fields<std::int16_t, std::int16_t, float, float>(out, offset)
                 : put_fields<std::int64_t, std::int32_t, double, std::int64_t>(out, offset);
    const std::string right = version == 1 ? std::string("n+1\0", 4) : std::string("n+2\0\r\n\032\n", 8);
    const std::string& used = magic.empty() ? right : magic;
    std::copy(used.begin(), used.end(), out.begin() + (version == 1 ? 344 : 4));
    return std::move(out) + data;
  }

 private:
  template <class Dim, class Code, class Real, class Offset>
  void put_fields(Bytes& out, double offset) const {
    const bool v2 = version == 2;
    for (std::size_t n = 0; n < 8; ++n) {
      put<Dim>(out, (v2 ? 16 : 40) + n * sizeof(Dim), static_cast<double>(dim[n]));
      put<Real>(out, (v2 ? 104 : 76) + n * sizeof(Real), pixdim[n]);
    }
    put<std::int16_t>(out, v2 ? 12 : 70, static_cast<double>(datatype));
    put<std::int16_t>(out, v2 ? 14 : 72, static_cast<double>(bitpix));
    put<Offset>(out, v2 ? 168 : 108, offset);
    put<Real>(out, v2 ? 176 : 112, slope);
    put<Real>(out, v2 ? 184 : 116, inter);
    if (v2)
      put<std::int32_t>(out, 500, static_cast<double>(units));
    else
      out[123] = static_cast<std::uint8_t>(units);
    put<Code>(out, v2 ? 344 : 252, static_cast<double>(qform_code));
    put<Code>(out, v2 ? 348 : 254, static_cast<double>(sform_code));
    for (std::size_t n = 0; n < 3; ++n) {
      put<Real>(out, (v2 ? 352 : 256) + n * sizeof(Real), quatern[n]);
      put<Real>(out, (v2 ? 376 : 268) + n * sizeof(Real), qoffset[n]);
    }
    for (std::size_t n = 0; n < 12; ++n) put<Real>(out, (v2 ? 400 : 280) + n * sizeof(Real), srow[n]);
  }
};

}  // namespace voxtet::test
