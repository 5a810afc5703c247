// SPDX-License-Identifier: BSD-3-Clause
// Attractors: sizes that grow linearly with the distance from points, edges and triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "size/attractors.h"
#include "size/thresholds.h"
#include "support/error.h"

namespace {

using namespace carreau;

double size_at(Attractors& attractors, const Vec3& p) {
  const Prescription found = attractors.on_surface(1, {}, p);
  return found.kind == Prescription::Kind::size ? found.size : 0;
}

// Closed forms of the distances: from a point, from the edge (0, 0, 0) - (4, 0, 0), from the square above it in two triangles.
TEST(Attractors, SizesGrowLinearlyWithTheDistance) {
  const std::vector<Vec3> corners{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const Attractor point{.vertices = corners, .elements = {{1, 1, 1}}, .size = 0.1, .surrounding = 1, .reach = 3};
  const Attractor edge{.vertices = corners, .elements = {{0, 1, 1}}, .size = 0.1, .surrounding = 1, .reach = 3};
  const Attractor square{.vertices = corners, .elements = {{0, 1, 2}, {0, 2, 3}}, .size = 0.1, .surrounding = 1, .reach = 3};
  const auto beyond = [](double x, double low, double high) { return std::max({low - x, x - high, 0.0}); };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-4, 8);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p{coordinate(random), coordinate(random), coordinate(random)};
    const std::pair<const Attractor*, double> all[] = {{&point, norm(p - corners[1])},
                                                       {&edge, std::hypot(beyond(p.x(), 0, 4), p.y(), p.z())},
                                                       {&square, std::hypot(beyond(p.x(), 0, 4), beyond(p.y(), 0, 4), p.z())}};
    for (const auto& [attractor, distance] : all) {
      Attractors field;
      field.add(*attractor);
      EXPECT_NEAR(size_at(field, p), distance < 3 ? 0.1 + 0.3 * distance : 0, 1e-12);
      EXPECT_EQ(field.on_curve(1, 1, 0, {}, p).size, field.at_point(1, p).size);
    }
  }
}

TEST(Attractors, TheSmallestSizeCounts) {
  Attractors field;
  field.add({.vertices = {{0, 0, 0}}, .elements = {{0, 0, 0}}, .size = 0.5, .surrounding = 1, .reach = 4});
  field.add({.vertices = {{1, 0, 0}}, .elements = {{0, 0, 0}}, .size = 0.1, .surrounding = 1, .reach = 1});
  EXPECT_NEAR(size_at(field, {0, 0, 0}), 0.5, 1e-15);
  EXPECT_NEAR(size_at(field, {1, 0, 0}), 0.1, 1e-15);
  EXPECT_NEAR(size_at(field, {0.75, 0, 0}), 0.1 + 0.9 * 0.25, 1e-15);
  EXPECT_NEAR(size_at(field, {2.5, 0, 0}), 0.5 + 0.125 * 2.5, 1e-15);
  EXPECT_EQ(size_at(field, {4, 0, 0}), 0);
}

// Each point of an element has a place within half a reach, if the number of places allows it.
TEST(Attractors, PlacesCoverTheElements) {
  const std::vector<Vec3> corners{{0, 0, 0}, {10, 0, 0}, {0, 7, 0}};
  Attractors field;
  field.add({.vertices = corners, .elements = {{0, 1, 2}}, .size = 0.1, .surrounding = 1, .reach = 1});
  EXPECT_LE(field.steep_in_space().size(), thresholds::size::max_attractor_places);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 1000; ++i) {
    double s = share(random), t = share(random);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    const Vec3 p = corners[0] + s * (corners[1] - corners[0]) + t * (corners[2] - corners[0]);
    double nearest = 10;
    for (const SteepPlace& place : field.steep_in_space()) nearest = std::min(nearest, norm(place.at - p));
    EXPECT_LE(nearest, 0.5);
  }
  Attractors gentle;  // no place where sizes hardly change
  gentle.add({.vertices = corners, .elements = {{0, 1, 2}}, .size = 0.8, .surrounding = 1, .reach = 1});
  EXPECT_TRUE(gentle.steep_in_space().empty());
  std::vector<std::array<std::int32_t, 3>> many(5000, {0, 1, 2});
  field.add({.vertices = corners, .elements = many, .size = 0.1, .surrounding = 1, .reach = 1e-3});
  EXPECT_LE(field.steep_in_space().size(), 2 * thresholds::size::max_attractor_places);
}

TEST(Attractors, BadInputIsRejected) {
  const Attractor sound{.vertices = {{0, 0, 0}, {1, 0, 0}}, .elements = {{0, 1, 1}}, .size = 0.1, .surrounding = 1, .reach = 3};
  const auto sentence = [&](auto&& spoil) {
    Attractor spoilt = sound;
    spoil(spoilt);
    try {
      Attractors().add(spoilt);
    } catch (const InvalidArgument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(sentence([](Attractor&) {}), "");
  EXPECT_NE(sentence([](Attractor& a) { a.size = 0; }).find("the size must be positive"), std::string::npos);
  EXPECT_NE(sentence([](Attractor& a) { a.reach = -1; }).find("the reach must be positive"), std::string::npos);
  EXPECT_NE(sentence([](Attractor& a) { a.surrounding = std::nan(""); }).find("the surrounding size"), std::string::npos);
  EXPECT_NE(sentence([](Attractor& a) { a.surrounding = 0.05; }).find("above the surrounding size"), std::string::npos);
  EXPECT_NE(sentence([](Attractor& a) { a.elements.clear(); }).find("no element"), std::string::npos);
  EXPECT_NE(sentence([](Attractor& a) { a.elements[0][2] = 2; }).find("names vertex 2, but there are 2"), std::string::npos);
  EXPECT_NE(sentence([](Attractor& a) { a.vertices[1].x() = HUGE_VAL; }).find("not finite"), std::string::npos);
}

}  // namespace
