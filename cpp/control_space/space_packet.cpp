// SPDX-License-Identifier: BSD-3-Clause
// A control space as bytes for another process, and back.
#include "control_space/control_space.h"
#include "support/error.h"

namespace carreau {

namespace {

constexpr std::size_t reals_of_leaf = 3 + 9 * 3;

void put(PacketWriter& packet, const Metric2& m) { packet.put(m.a), packet.put(m.b), packet.put(m.c); }

Metric2 metric_of(PacketReader& packet) {
  const double a = packet.real(), b = packet.real(), c = packet.real();
  return {a, b, c};
}

}  // namespace

void ControlSpace::put(PacketWriter& packet) const {
  packet.put(low_), packet.put(scale_), packet.put(last_);
  packet.put(static_cast<std::int64_t>(columns_));
  carreau::put(packet, unit_);
  packet.put(table_);
  packet.put(static_cast<std::int64_t>(children_.size()));
  for (const auto& four : children_)
    for (const std::int32_t child : four) packet.put(std::int64_t{child});
  packet.put(static_cast<std::int64_t>(leaves_.size()));
  for (const Leaf& leaf : leaves_) {
    packet.put(leaf.x), packet.put(leaf.y), packet.put(leaf.scale);
    for (const auto& root : leaf.c)
      for (const double value : root) packet.put(value);
  }
  packet.put(measures_);
  packet.put(measure_);
  packet.put(static_cast<std::int64_t>(samples_));
}

ControlSpace ControlSpace::from(PacketReader& packet) {
  ControlSpace space;
  space.low_ = packet.plane_point(), space.scale_ = packet.plane_point(), space.last_ = packet.plane_point();
  space.columns_ = static_cast<std::size_t>(packet.integer());
  space.unit_ = metric_of(packet);
  space.table_ = packet.integers();
  space.children_.resize(packet.count(4 * sizeof(std::int64_t)));
  for (auto& four : space.children_)
    for (std::int32_t& child : four) child = static_cast<std::int32_t>(packet.integer());
  space.leaves_.resize(packet.count(reals_of_leaf * sizeof(double)));
  for (Leaf& leaf : space.leaves_) {
    leaf.x = packet.real(), leaf.y = packet.real(), leaf.scale = packet.real();
    for (auto& root : leaf.c)
      for (double& value : root) value = packet.real();
  }
  space.measures_ = packet.reals();
  space.measure_ = packet.real();
  space.samples_ = static_cast<std::size_t>(packet.integer());
  return space;
}

}  // namespace carreau
