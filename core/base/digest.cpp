#include "base/digest.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace voxtet {
namespace {

static_assert(std::endian::native == std::endian::little, "digests are over little-endian bytes");

constexpr std::array<std::uint32_t, 64> kRoundConstants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

}  // namespace

Sha256::Sha256()
    : state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19} {
}

void Sha256::compress(const std::uint8_t* block) {
  std::array<std::uint32_t, 64> w{};
  for (int i = 0; i < 16; ++i)
    w[i] = std::uint32_t(block[4 * i]) << 24 | std::uint32_t(block[4 * i + 1]) << 16 |
           std::uint32_t(block[4 * i + 2]) << 8 | std::uint32_t(block[4 * i + 3]);
  for (int i = 16; i < 64; ++i) {
    const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
    const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
    w[i] = w[i - 16] + s0 + w[i - 7] + s1;
  }
  auto [a, b, c, d, e, f, g, h] = state_;
  for (int i = 0; i < 64; ++i) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + kRoundConstants[i] + w[i];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const std::array<std::uint32_t, 8> delta{a, b, c, d, e, f, g, h};
  for (int i = 0; i < 8; ++i) state_[i] += delta[i];
}

void Sha256::update(std::span<const std::uint8_t> bytes) {
  std::size_t fill = total_ % 64;
  total_ += bytes.size();
  while (!bytes.empty()) {
    if (fill == 0 && bytes.size() >= 64) {
      compress(bytes.data());
      bytes = bytes.subspan(64);
      continue;
    }
    const std::size_t take = std::min(bytes.size(), 64 - fill);
    std::memcpy(buffer_.data() + fill, bytes.data(), take);
    bytes = bytes.subspan(take);
    fill += take;
    if (fill == 64) {
      compress(buffer_.data());
      fill = 0;
    }
  }
}

void Sha256::update(std::string_view text) {
  update({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::string Sha256::hex() {
  const std::uint64_t bits = total_ * 8;
  const std::array<std::uint8_t, 64> padding{0x80};
  const std::size_t fill = total_ % 64;
  update({padding.data(), (fill < 56 ? 56 : 120) - fill});
  std::array<std::uint8_t, 8> length{};
  for (int i = 0; i < 8; ++i) length[i] = static_cast<std::uint8_t>(bits >> (56 - 8 * i));
  update(length);
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (const std::uint32_t word : state_)
    for (int shift = 28; shift >= 0; shift -= 4) out += kDigits[(word >> shift) & 15];
  return out;
}

std::string digest_of(const TetMesh& mesh) {
  Sha256 sha;
  sha.update_values(reinterpret_cast<const double*>(mesh.points.data()), 3 * mesh.points.size());
  sha.update_values(reinterpret_cast<const std::uint32_t*>(mesh.tets.data()), 4 * mesh.tets.size());
  sha.update_values(mesh.labels.data(), mesh.labels.size());
  return sha.hex();
}

std::string digest_of(const SurfaceMesh& surface) {
  Sha256 sha;
  sha.update_values(reinterpret_cast<const double*>(surface.points.data()), 3 * surface.points.size());
  sha.update_values(reinterpret_cast<const std::uint32_t*>(surface.triangles.data()),
                    3 * surface.triangles.size());
  sha.update_values(reinterpret_cast<const std::uint16_t*>(surface.sides.data()), 2 * surface.sides.size());
  return sha.hex();
}

namespace {

template <class Value>
std::string digest_of_grid(const std::array<int, 3>& size, const Eigen::Matrix4d& index_to_mm,
                           const std::vector<Value>& values) {
  Sha256 sha;
  sha.update_values(size.data(), 3);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      const float value = static_cast<float>(index_to_mm(row, column));
      sha.update_values(&value, 1);
    }
  sha.update_values(values.data(), values.size());
  return sha.hex();
}

}  // namespace

std::string digest_of(const LabelVolume& volume) {
  return digest_of_grid(volume.size, volume.index_to_mm, volume.labels);
}

std::string digest_of(const ScalarVolume& volume) {
  return digest_of_grid(volume.size, volume.index_to_mm, volume.values);
}

}  // namespace voxtet
