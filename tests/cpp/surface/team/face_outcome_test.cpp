// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/base/face_outcome.h"

#include <gtest/gtest.h>

#include <cmath>

namespace carreau {
namespace {

ControlSpace space_of_a_square() {
  const SampledDomain square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  Monitor monitor;
  const auto sampler = [](std::span<const Vec2> uv, std::span<Metric2> metric) {
    for (std::size_t i = 0; i < uv.size(); ++i) {
      const double h = 0.01 + 0.1 * std::abs(uv[i].x() - 0.3);
      metric[i] = {1 / (h * h), 0.1 / h, 2 / (h * h)};
    }
  };
  return ControlSpace::build(square, sampler, {}, monitor);
}

FaceOutcome some_outcome() {
  FaceOutcome outcome;
  outcome.patch.emplace();
  outcome.patch->plane = {{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}};
  outcome.patch->xyz = {{0, 0, 0}, {1, 0, 0.1}, {0, 1, -0.0}};
  outcome.patch->size = {0.1, 0.2, 1e-300};
  outcome.patch->excesses = {{2000, {0, 0}, {1, 0}}};
  outcome.patch->normal = {{0, 0, 1}, {0, 0, 1}, {0, 0, 0}};
  outcome.space = space_of_a_square();
  outcome.remark = "face 3: something is to be known";
  outcome.seconds_plane = 0.5;
  outcome.corrections = 2;
  outcome.turned = {{Vec3(0, 0, 0), Vec3(1, 0, 0.1), Vec3(0, 1, 0)}};
  return outcome;
}

std::string bytes_of(const FaceOutcome& outcome) {
  PacketWriter packet;
  outcome.put(packet);
  return packet.take();
}

TEST(FaceOutcome, ComesBackBitForBit) {
  const FaceOutcome outcome = some_outcome();
  const std::string bytes = bytes_of(outcome);
  PacketReader packet(bytes);
  const FaceOutcome back = FaceOutcome::from(packet);
  EXPECT_TRUE(packet.at_end());
  EXPECT_EQ(back.patch->xyz, outcome.patch->xyz);
  EXPECT_EQ(back.patch->plane.triangles, outcome.patch->plane.triangles);
  EXPECT_EQ(back.patch->size, outcome.patch->size);
  EXPECT_EQ(back.remark, outcome.remark);
  EXPECT_EQ(back.corrections, 2);
  EXPECT_EQ(back.turned, outcome.turned);
  EXPECT_EQ(bytes_of(back), bytes);
}

TEST(FaceOutcome, ItsControlSpaceAnswersTheSame) {
  const std::string bytes = bytes_of(some_outcome());
  PacketReader packet(bytes);
  const ControlSpace back = *FaceOutcome::from(packet).space, space = space_of_a_square();
  EXPECT_EQ(back.measure(), space.measure());
  EXPECT_EQ(back.samples(), space.samples());
  for (int i = 0; i < 1000; ++i) {
    const Vec2 uv{std::fmod(i * 0.618034, 1.2) - 0.1, std::fmod(i * 0.754878, 1.2) - 0.1};
    const Metric2 a = space.at(uv), b = back.at(uv);
    EXPECT_TRUE(a.a == b.a && a.b == b.b && a.c == b.c) << uv.x() << " " << uv.y();
  }
}

TEST(FaceOutcome, AFailureHasItsSentence) {
  FaceOutcome failed;
  failed.failure = "face 7: its boundary crosses itself";
  failed.beyond_limit = LimitError(Where{.face = 7}, "too many triangles");
  const std::string bytes = bytes_of(failed);
  PacketReader packet(bytes);
  const FaceOutcome back = FaceOutcome::from(packet);
  EXPECT_FALSE(back.patch || back.space);
  EXPECT_EQ(back.failure, failed.failure);
  EXPECT_STREQ(back.beyond_limit->what(), "face 7: too many triangles");
  EXPECT_EQ(back.beyond_limit->where().face, 7);
}

TEST(FaceOutcome, BytesThatEndEarlyAreRejected) {
  const std::string bytes = bytes_of(some_outcome());
  for (std::size_t n = 0; n < bytes.size(); n += 97) {
    PacketReader packet(std::string_view(bytes).substr(0, n));
    EXPECT_THROW(FaceOutcome::from(packet), Error) << n;
  }
}

}  // namespace
}  // namespace carreau
