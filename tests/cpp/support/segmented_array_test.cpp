// SPDX-License-Identifier: BSD-3-Clause
#include "support/memory/segmented_array.h"

#include <gtest/gtest.h>

#include <vector>

namespace carreau {
namespace {

TEST(SegmentedArray, HoldsAppendedValues) {
  SegmentedArray<int, 8> array;
  EXPECT_EQ(array.size(), 0U);
  for (int k = 0; k < 100; ++k) array.push_back(k * k);
  ASSERT_EQ(array.size(), 100U);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(array[static_cast<std::size_t>(k)], k * k);
}

TEST(SegmentedArray, AppendsDefaultValues) {
  struct Value {
    int number = 7;
  };
  SegmentedArray<Value, 8> array;
  for (int k = 0; k < 5; ++k) array.append(4);
  ASSERT_EQ(array.size(), 20U);
  for (std::size_t k = 0; k < array.size(); ++k) EXPECT_EQ(array[k].number, 7);
}

// A holder of a reference may append.
TEST(SegmentedArray, NeverMovesItsValues) {
  SegmentedArray<double, 4> array;
  std::vector<const double*> places;
  for (int k = 0; k < 1000; ++k) {
    array.push_back(k);
    places.push_back(&array[array.size() - 1]);
  }
  for (std::size_t k = 0; k < array.size(); ++k) {
    EXPECT_EQ(places[k], &array[k]);
    EXPECT_EQ(*places[k], static_cast<double>(k));
  }
}

}  // namespace
}  // namespace carreau
