#include "io/bytes/text_numbers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace voxtet {
namespace {

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

double double_of(std::uint64_t bits) {
  double value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

std::string text_of(double value) {
  std::array<char, kRealChars> buffer;
  return {buffer.data(), format_real(buffer.data(), value)};
}

void expect_round_trip(double value) {
  const std::string text = text_of(value);
  ASSERT_LT(text.size(), static_cast<std::size_t>(kRealChars));
  double read = 0;
  ASSERT_TRUE(parse_real(text, read)) << text;
  ASSERT_EQ(bits_of(read), bits_of(value)) << text;
  ASSERT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
}

TEST(FormatReal, WritesShortDecimalsShort) {
  EXPECT_EQ(text_of(0), "0");
  EXPECT_EQ(text_of(-0.0), "0");
  EXPECT_EQ(text_of(1), "1");
  EXPECT_EQ(text_of(-12.3), "-12.3");
  EXPECT_EQ(text_of(0.1), "0.1");
  EXPECT_EQ(text_of(100), "100");
  EXPECT_EQ(text_of(123456789012345), "123456789012345");
  EXPECT_EQ(text_of(0.0001), "0.0001");
  EXPECT_EQ(text_of(9.5), "9.5");
  EXPECT_EQ(text_of(999999.999999), "999999.999999");
  EXPECT_EQ(text_of(0.1 + 0.2), "0.30000000000000004");
}

TEST(FormatReal, ReadsBackToTheSameBits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200000; ++i) {
    const std::uint64_t bits = random();
    const double any = double_of(bits);
    if (std::isfinite(any) && any != 0) expect_round_trip(any);
    const std::uint64_t exponent = 1009 + bits % 64;
    expect_round_trip(double_of((random() & ~(0x7ffULL << 52)) | exponent << 52));
    if (HasFatalFailure()) return;
  }
  for (int power = -14; power < 50; ++power)
    for (const double value : {std::ldexp(1.0, power), std::nextafter(std::ldexp(1.0, power), 0.0),
                               std::nextafter(std::ldexp(1.0, power), 1e300)})
      expect_round_trip(value);
  double ten = 1e-4;
  for (int i = 0; i < 20; ++i, ten *= 10)
    for (const double value : {ten, std::nextafter(ten, 0.0), std::nextafter(ten, 1e300)})
      expect_round_trip(value);
  expect_round_trip(std::numeric_limits<double>::denorm_min());
  expect_round_trip(std::numeric_limits<double>::max());
}

TEST(FormatReal, GivesTheDigitsOfPrintfWhereAllSeventeenAreNeeded) {
  std::mt19937_64 random(2);
  int compared = 0;
  for (int i = 0; i < 100000; ++i) {
    const double value = double_of((random() & ~(0xfffULL << 52)) | (1010 + random() % 62) << 52);
    std::array<char, 64> expected;
    std::snprintf(expected.data(), expected.size(), "%.16g", value);
    if (std::strtod(expected.data(), nullptr) == value) continue;
    std::snprintf(expected.data(), expected.size(), "%.17g", value);
    ASSERT_EQ(text_of(value), expected.data());
    ++compared;
  }
  EXPECT_GT(compared, 10000);
}

TEST(ParseReal, RefusesWhatIsNotAFiniteDecimal) {
  double value = 0;
  for (const char* text :
       {"", "nan", "inf", "-inf", "0x10", "1.0x", "1e999", "--1", "+-1", "++1", "1e", ".", "1 "})
    EXPECT_FALSE(parse_real(text, value)) << text;
  for (const char* text : {"+1.5", "1.5", "15e-1", ".15E1", "1.50000"}) {
    EXPECT_TRUE(parse_real(text, value)) << text;
    EXPECT_EQ(value, 1.5);
  }
  EXPECT_TRUE(parse_real("1e-999", value));
  EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace voxtet
