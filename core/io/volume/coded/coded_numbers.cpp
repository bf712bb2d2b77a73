#include "io/volume/coded/coded_numbers.h"

#include <array>
#include <cmath>
#include <cstring>

namespace voxtet {
namespace {

enum Form : std::uint8_t { kSingle, kDouble, kDecimal };  // kDecimal + d: a whole number over 10^d

constexpr std::array<double, 7> kPowers{1, 10, 100, 1e3, 1e4, 1e5, 1e6};
constexpr double kMostDecimal = 1e7;

template <class T>
void put_raw(Bytes& bytes, T value) {
  std::array<std::uint8_t, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

}  // namespace

void put_number(Bytes& bytes, std::uint64_t number) {
  for (; number > 127; number >>= 7U) bytes.push_back(static_cast<std::uint8_t>(number | 128U));
  bytes.push_back(static_cast<std::uint8_t>(number));
}

void put_real(Bytes& bytes, double value) {
  for (std::size_t digits = 0; digits < kPowers.size(); ++digits) {
    const double whole = std::round(value * kPowers[digits]);
    if (std::abs(whole) > kMostDecimal || whole / kPowers[digits] != value) continue;
    const auto count = static_cast<std::int64_t>(std::abs(whole));
    bytes.push_back(static_cast<std::uint8_t>(kDecimal + digits));
    put_number(bytes, static_cast<std::uint64_t>(2 * count + (std::signbit(whole) ? 1 : 0)));
    return;
  }
  const auto single = static_cast<float>(value);
  const bool fits = static_cast<double>(single) == value;
  bytes.push_back(fits ? kSingle : kDouble);
  fits ? put_raw(bytes, single) : put_raw(bytes, value);
}

std::uint8_t NumberReader::byte() {
  if (at_ < bytes_.size()) return bytes_[at_++];
  failed_ = true;
  return 0;
}

std::uint64_t NumberReader::number() {
  std::uint64_t number = 0;
  for (unsigned shift = 0; shift < 63; shift += 7) {
    const std::uint8_t next = byte();
    number |= static_cast<std::uint64_t>(next & 127U) << shift;
    if (next < 128) return number;
  }
  failed_ = true;
  return 0;
}

double NumberReader::real() {
  const std::uint8_t form = byte();
  if (form >= kDecimal && form < kDecimal + kPowers.size()) {
    const std::uint64_t coded = number();
    const double value = static_cast<double>(coded / 2) / kPowers[form - kDecimal];
    return coded % 2 == 1 ? -value : value;
  }
  if (form > kDouble) failed_ = true;
  std::array<std::uint8_t, 8> raw{};
  for (std::size_t i = 0; i < (form == kSingle ? 4U : 8U); ++i) raw[i] = byte();
  if (form == kSingle) {
    float single = 0;
    std::memcpy(&single, raw.data(), 4);
    return single;
  }
  double value = 0;
  std::memcpy(&value, raw.data(), 8);
  return value;
}

}  // namespace voxtet
