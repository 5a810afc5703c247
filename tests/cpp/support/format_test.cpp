// SPDX-License-Identifier: BSD-3-Clause
#include "support/format.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "support/infinity.h"
#include "support/short_number.h"

namespace carreau {
namespace {

TEST(FormatNumber, ReadsBackToTheSameDouble) {
  std::mt19937_64 bits(1);
  for (int i = 0; i < 10000; ++i) {
    const auto word = bits();
    double value;
    static_assert(sizeof value == sizeof word);
    std::memcpy(&value, &word, sizeof value);
    if (!std::isfinite(value)) continue;
    double back = 0;
    ASSERT_TRUE(parse_number(format_number(value), back));
    EXPECT_EQ(back, value);
  }
}

TEST(FormatNumber, IsTheSameInEveryLocale) {
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr && std::setlocale(LC_ALL, "fr_FR.UTF-8") == nullptr)
    GTEST_SKIP() << "no locale with a decimal comma here";
  EXPECT_EQ(format_number(1.5), "1.5");
  double value = 0;
  EXPECT_TRUE(parse_number("2.5", value));
  EXPECT_EQ(value, 2.5);
  std::setlocale(LC_ALL, "C");
}

TEST(ShortNumber, HasNoMoreDigitsThanRequested) {
  EXPECT_EQ(short_number(4.1658e-22), "4.166e-22");  // 4166 / 1e25 is no double of four digits
  EXPECT_EQ(short_number(7.366276317363692e-10), "7.366e-10");
  EXPECT_EQ(short_number(-123456), "-123500");
  EXPECT_EQ(short_number(9.99996), "10");
  EXPECT_EQ(short_number(2), "2");
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(1.0 / 3, 2), "0.33");
  EXPECT_EQ(short_number(5e-324), "5e-324");
  EXPECT_EQ(short_number(std::numeric_limits<double>::max(), 17), format_number(std::numeric_limits<double>::max()));
  EXPECT_EQ(short_number(infinity), "inf");
  std::mt19937_64 bits(2);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::pow(10, exponent(bits));
    const std::string text = short_number(value);
    double back = 0;
    ASSERT_TRUE(parse_number(text, back));
    EXPECT_NEAR(back / value, 1, 0.5001e-3) << text;
    const std::size_t mantissa = text.find('e') == std::string::npos ? text.size() : text.find('e');
    std::string digits;
    for (const char c : text.substr(0, mantissa))
      if (c != '.') digits += c;
    digits.erase(0, digits.find_first_not_of('0'));
    digits.erase(digits.find_last_not_of('0') + 1);
    EXPECT_LE(digits.size(), 4u) << text;
  }
}

TEST(ParseNumber, AcceptsFortranExponentsAndASign) {
  double value = 0;
  EXPECT_TRUE(parse_number("1.5d-3", value));
  EXPECT_EQ(value, 1.5e-3);
  EXPECT_TRUE(parse_number("+.5D+1", value));
  EXPECT_EQ(value, 5);
  EXPECT_TRUE(parse_number("0.", value));
  EXPECT_EQ(value, 0);
}

TEST(ParseNumber, RejectsOtherTextAndLeavesTheValue) {
  double value = 7;
  for (const char* word : {"", "1.5x", "x", "+-1", "1 ", "--1", "1.5dd3", "+"})
    EXPECT_FALSE(parse_number(word, value)) << word;
  EXPECT_EQ(value, 7);
  int whole = 7;
  for (const char* word : {"", "1.0", "99999999999", "a", "+"}) EXPECT_FALSE(parse_number(word, whole)) << word;
  EXPECT_EQ(whole, 7);
  EXPECT_TRUE(parse_number("-12", whole));
  EXPECT_EQ(whole, -12);
}

}  // namespace
}  // namespace carreau
