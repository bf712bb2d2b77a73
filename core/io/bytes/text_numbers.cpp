#include "io/bytes/text_numbers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace voxtet {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr std::uint64_t kTen16 = 10'000'000'000'000'000;
constexpr std::uint64_t kTen17 = 10 * kTen16;
constexpr int kDigits = 17;

constexpr Wide ten_to(int power) {
  Wide result = 1;
  for (int i = 0; i < power; ++i) result *= 10;
  return result;
}

constexpr auto kTens = [] {
  std::array<Wide, 22> powers{};
  for (int i = 0; i < 22; ++i) powers[static_cast<std::size_t>(i)] = ten_to(i);
  return powers;
}();

/// value = digits * 10^(exponent - 16), digits having 17 places.
struct Decimal {
  std::uint64_t digits = 0;
  int exponent = 0;
};

/// For 1e-4 <= value < 1e15. With scale = 10^(16 - exponent) the product mantissa * scale is exact in 128
/// bits, so that rounding and the question whether fewer digits read back are decided exactly.
Decimal to_decimal(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  const std::uint64_t mantissa = (bits & ((1ULL << 52) - 1)) | 1ULL << 52;
  const int shift = 1075 - static_cast<int>(bits >> 52);
  Decimal result;
  for (double power = 10; result.exponent < 15 && value >= power; power *= 10) ++result.exponent;
  for (double power = 1; result.exponent > -5 && value < power; power /= 10) --result.exponent;
  Wide product = 0;
  for (;;) {
    product = mantissa * kTens[static_cast<std::size_t>(16 - result.exponent)];
    const Wide rest = product & ((Wide{1} << shift) - 1);
    const Wide half = Wide{1} << (shift - 1);
    result.digits = static_cast<std::uint64_t>(product >> shift);
    if (rest > half || (rest == half && (result.digits & 1))) ++result.digits;
    if (result.digits >= kTen17) {
      ++result.exponent;
    } else if (result.digits < kTen16) {
      --result.exponent;
    } else {
      break;
    }
  }
  // Neighbouring doubles are one scale apart (half of that below a power of two).
  const Wide scale = kTens[static_cast<std::size_t>(16 - result.exponent)];
  const Wide reach = mantissa == 1ULL << 52 ? scale / 4 : scale / 2;
  for (const std::uint64_t unit : {std::uint64_t{100}, std::uint64_t{10}}) {
    const std::uint64_t shorter = (result.digits + unit / 2) / unit * unit;
    const Wide there = Wide{shorter} << shift;
    if ((there > product ? there - product : product - there) >= reach) continue;
    result.digits = shorter;
    break;
  }
  if (result.digits >= kTen17) {
    result.digits /= 10;
    ++result.exponent;
  }
  return result;
}

}  // namespace

char* format_real(char* out, double value) {
  const double size = std::abs(value);
  if (!(size >= 1e-4 && size < 1e15)) {
    if (size == 0) {
      *out = '0';
      return out + 1;
    }
    return out + std::snprintf(out, kRealChars, "%.17g", value);
  }
  if (value < 0) *out++ = '-';
  const Decimal decimal = to_decimal(size);
  std::array<char, kDigits> digits;
  std::uint64_t left = decimal.digits;
  for (int i = kDigits; i-- > 0; left /= 10)
    digits[static_cast<std::size_t>(i)] = static_cast<char>('0' + left % 10);
  int last = kDigits - 1;
  while (last > 0 && last > decimal.exponent && digits[static_cast<std::size_t>(last)] == '0') --last;
  if (decimal.exponent < 0) {
    *out++ = '0';
    *out++ = '.';
    for (int i = -1; i > decimal.exponent; --i) *out++ = '0';
  }
  for (int i = 0; i <= last; ++i) {
    if (i > 0 && i == decimal.exponent + 1) *out++ = '.';
    *out++ = digits[static_cast<std::size_t>(i)];
  }
  return out;
}

bool parse_real(std::string_view word, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  std::array<char, 400> copy;
  if (word.empty() || word[0] == '+' || word.size() >= copy.size()) return false;
  for (const char c : word)
    if (!(c >= '0' && c <= '9') && c != '.' && c != '-' && c != '+' && c != 'e' && c != 'E') return false;
#ifdef __cpp_lib_to_chars
  const std::from_chars_result read = std::from_chars(word.data(), word.data() + word.size(), value);
  if (read.ec == std::errc{}) return read.ptr == word.data() + word.size() && std::isfinite(value);
  if (read.ec != std::errc::result_out_of_range) return false;
#endif
  std::memcpy(copy.data(), word.data(), word.size());
  copy[word.size()] = '\0';
  char* end = nullptr;
  value = std::strtod(copy.data(), &end);
  return end == copy.data() + word.size() && std::isfinite(value);
}

}  // namespace voxtet
