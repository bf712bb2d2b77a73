// Small volume files made in memory, and the sentence-level checks that tests of readers share.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "io/volume/read_volume.h"

namespace voxtet::test {

inline Bytes bytes_of_text(std::string_view text) {
  return Bytes(text.begin(), text.end());
}

inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The bytes of `values` as type T in the given order.
template <class T>
Bytes packed(const std::vector<Label>& values, bool big_endian) {
  Bytes bytes;
  for (const Label value : values) {
    const T stored = static_cast<T>(value);
    std::array<std::uint8_t, sizeof(T)> raw;
    std::memcpy(raw.data(), &stored, sizeof(T));
    if (big_endian) std::reverse(raw.begin(), raw.end());
    bytes.insert(bytes.end(), raw.begin(), raw.end());
  }
  return bytes;
}

inline Bytes zlib_packed(const Bytes& bytes) {
  uLongf size = compressBound(bytes.size());
  Bytes out(size);
  compress2(out.data(), &size, bytes.data(), bytes.size(), 6);
  out.resize(size);
  return out;
}

/// 3 x 2 x 2 voxels, all different, the largest above one byte only when `wide`.
inline std::vector<Label> sample_labels(bool wide) {
  std::vector<Label> labels;
  for (Label n = 0; n < 12; ++n) labels.push_back(static_cast<Label>(n * n));
  if (wide) labels[11] = 65535;
  return labels;
}

/// Those of one byte each.
inline Bytes sample_bytes() {
  return packed<std::uint8_t>(sample_labels(false), false);
}

inline Result<LabelVolume> read(const Bytes& bytes, SiblingReader sibling = {}) {
  return read_volume({"sample", bytes, std::move(sibling)});
}

/// The reader must refuse, blaming `words` (the field's name) in a message that starts with the file's name.
inline void expect_refused(const Bytes& bytes, const std::string& words, SiblingReader sibling = {}) {
  const Result<LabelVolume> volume = read(bytes, std::move(sibling));
  ASSERT_FALSE(volume.ok()) << "accepted, but \"" << words << "\" was expected to be refused";
  EXPECT_EQ(volume.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(volume.error().message.rfind("sample: ", 0), 0U) << volume.error().message;
  EXPECT_NE(volume.error().message.find(words), std::string::npos) << volume.error().message;
}

inline Eigen::Matrix4d affine(std::array<double, 12> rows) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  for (int n = 0; n < 12; ++n) m(n / 4, n % 4) = rows[static_cast<std::size_t>(n)];
  return m;
}

inline void expect_volume(const Result<LabelVolume>& volume, const std::vector<Label>& labels,
                          const Eigen::Matrix4d& index_to_mm) {
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  EXPECT_EQ(volume->size, (std::array<int, 3>{3, 2, 2}));
  EXPECT_EQ(volume->labels, labels);
  EXPECT_LE((volume->index_to_mm - index_to_mm).cwiseAbs().maxCoeff(), 1e-4) << volume->index_to_mm;
}

}  // namespace voxtet::test
