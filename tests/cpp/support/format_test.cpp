#include "support/format.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

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

TEST(ParseNumber, AcceptsFortranExponentsAndASign) {
  double value = 0;
  EXPECT_TRUE(parse_number("1.5d-3", value));
  EXPECT_EQ(value, 1.5e-3);
  EXPECT_TRUE(parse_number("+.5D+1", value));
  EXPECT_EQ(value, 5);
  EXPECT_TRUE(parse_number("0.", value));
  EXPECT_EQ(value, 0);
}

TEST(ParseNumber, RefusesWhatIsNotWhollyANumberAndLeavesTheValue) {
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
