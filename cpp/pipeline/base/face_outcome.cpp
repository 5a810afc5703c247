// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/base/face_outcome.h"

#include "support/ranks/triangle_packet.h"
#include "surface/lift/excess_packet.h"

namespace carreau {

namespace {

void put_layers(PacketWriter& packet, const std::vector<LayerCell>& layers) {
  packet.put(static_cast<std::int64_t>(layers.size()));
  for (const LayerCell& cell : layers) {
    for (const std::int32_t v : cell.corners) packet.put(std::int64_t{v});
    packet.put(std::int64_t{cell.layers}), packet.put(std::int64_t{cell.row});
  }
}

std::vector<LayerCell> layers_of(PacketReader& packet) {
  std::vector<LayerCell> layers;
  for (std::int64_t n = packet.integer(); n > 0; --n) {
    LayerCell& cell = layers.emplace_back();
    for (std::int32_t& v : cell.corners) v = static_cast<std::int32_t>(packet.integer());
    cell.layers = static_cast<std::int32_t>(packet.integer()), cell.row = static_cast<std::int32_t>(packet.integer());
  }
  return layers;
}

void put(PacketWriter& packet, const PatchMesh& patch) {
  packet.put(patch.plane.vertices);
  put_triangles(packet, patch.plane.triangles);
  packet.put(patch.xyz);
  packet.put(patch.size);
  put_excesses(packet, patch.excesses);
  packet.put(patch.normal);
}

PatchMesh patch_of(PacketReader& packet) {
  PatchMesh patch;
  patch.plane.vertices = packet.plane_points();
  patch.plane.triangles = triangles_of(packet);
  patch.xyz = packet.points();
  patch.size = packet.reals();
  patch.excesses = excesses_of(packet);
  patch.normal = packet.points();
  return patch;
}

LimitError limit_of(PacketReader& packet) {
  const Where where = packet.where();
  const std::string sentence = packet.text(), prefix = where.prefix();
  return {where, sentence.starts_with(prefix) ? sentence.substr(prefix.size()) : sentence};
}

}  // namespace

void FaceOutcome::put(PacketWriter& packet) const {
  packet.put(patch.has_value());
  if (patch) carreau::put(packet, *patch);
  put_layers(packet, layers);
  std::vector<Vec3> corners;
  for (const std::array<Vec3, 3>& triangle : turned) corners.insert(corners.end(), triangle.begin(), triangle.end());
  packet.put(corners);
  packet.put(elsewhere.has_value());
  if (elsewhere) packet.put(std::int64_t{elsewhere->rank}), packet.put(elsewhere->triangles);
  packet.put(space.has_value());
  if (space) space->put(packet);
  packet.put(std::string_view(failure));
  packet.put(std::string_view(remark));
  packet.put(beyond_limit.has_value());
  if (beyond_limit) packet.put(beyond_limit->where()), packet.put(std::string_view(beyond_limit->what()));
  packet.put(seconds_sampling), packet.put(seconds_plane), packet.put(seconds_lift);
  packet.put(std::int64_t{corrections});
}

FaceOutcome FaceOutcome::from(PacketReader& packet) {
  FaceOutcome outcome;
  if (packet.flag()) outcome.patch = patch_of(packet);
  outcome.layers = layers_of(packet);
  const std::vector<Vec3> corners = packet.points();
  for (std::size_t k = 0; k + 2 < corners.size(); k += 3) outcome.turned.push_back({corners[k], corners[k + 1], corners[k + 2]});
  if (packet.flag()) {
    const auto rank = static_cast<int>(packet.integer());
    outcome.elsewhere = PatchElsewhere{rank, packet.integer()};
  }
  if (packet.flag()) outcome.space = ControlSpace::from(packet);
  outcome.failure = packet.text();
  outcome.remark = packet.text();
  if (packet.flag()) outcome.beyond_limit = limit_of(packet);
  outcome.seconds_sampling = packet.real(), outcome.seconds_plane = packet.real(), outcome.seconds_lift = packet.real();
  outcome.corrections = static_cast<int>(packet.integer());
  return outcome;
}

FaceOutcome FaceOutcome::without_patch(int rank) const {
  FaceOutcome seen_by_others;
  if (patch) seen_by_others.elsewhere = PatchElsewhere{rank, static_cast<std::int64_t>(patch->plane.triangles.size())};
  seen_by_others.failure = failure, seen_by_others.remark = remark, seen_by_others.beyond_limit = beyond_limit;
  seen_by_others.seconds_sampling = seconds_sampling, seen_by_others.seconds_plane = seconds_plane, seen_by_others.seconds_lift = seconds_lift;
  seen_by_others.corrections = corrections;
  return seen_by_others;
}

}  // namespace carreau
