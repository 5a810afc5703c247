// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/zone.h"

#include <algorithm>

#include "plane/division/zone_part.h"
#include "plane/kernel/thresholds.h"
#include "support/memory/unfilled.h"
#include "support/ranks/triangle_packet.h"

namespace carreau::plane {

namespace {

constexpr std::uint8_t outside = zone_layers;

using Triangles = std::span<const std::array<std::int32_t, 3>>;

/// The triangles of each vertex, ascending.
class TrianglesAround {
 public:
  TrianglesAround(Triangles triangles, std::size_t vertices) : end_(vertices + 1, 0), triangles_(3 * triangles.size()) {
    for (const auto& t : triangles)
      for (const std::int32_t v : t) ++end_[v];
    std::int32_t sum = 0;
    for (std::int32_t& end : end_) sum += end, end = sum - end;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (const std::int32_t v : triangles[t]) triangles_[end_[v]++] = static_cast<std::int32_t>(t);
  }
  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t v) const noexcept {
    const std::int32_t from = v == 0 ? 0 : end_[v - 1];
    return {triangles_.data() + from, triangles_.data() + end_[v]};
  }

 private:
  std::vector<std::int32_t> end_;
  UnfilledVector<std::int32_t> triangles_;
};

// Marks layers of vertices from the vertices of level 0, up to `most`.
void spread(Triangles triangles, std::vector<std::uint8_t>& level, int most, Monitor& monitor) {
  monitor.checkpoint();
  const TrianglesAround around(triangles, level.size());
  std::vector<std::int32_t> front, next;
  for (std::size_t v = 0; v < level.size(); ++v)
    if (level[v] == 0) front.push_back(static_cast<std::int32_t>(v));
  for (int now = 0; now + 1 < most; ++now, front.swap(next)) {
    monitor.checkpoint();
    next.clear();
    for (const std::int32_t v : front)
      for (const std::int32_t t : around.of(v))
        for (const std::int32_t w : triangles[t])
          if (level[w] > now + 1) level[w] = static_cast<std::uint8_t>(now + 1), next.push_back(w);
  }
}

/// Makes a zone of the triangles of pieces that are near separators.
class ZoneMaker {
 public:
  explicit ZoneMaker(const JoinedPieces& joined) : joined_(joined), shared_(joined.pieces.separator.size(), -1) {}

  Zone run(Monitor& monitor) {
    for (std::size_t p = 0; p < joined_.meshes.size(); ++p) {
      monitor.checkpoint();
      add_piece(p);
    }
    return std::move(zone_);
  }

 private:
  void add_piece(std::size_t p) {
    const PlaneMesh& mesh = joined_.mesh(p);
    const NearSeparators& near = joined_.meshes[p].near;
    const std::vector<std::int32_t>& whole = joined_.pieces.pieces[p].whole;
    number_.assign(mesh.vertices.size(), -1);
    near_.assign(mesh.vertices.size(), -1);
    for (std::size_t v = 0; v < whole.size(); ++v) number_[v] = shared_[whole[v]];
    for (std::size_t k = 0; k < near.vertices.size(); ++k) near_[near.vertices[k]] = static_cast<std::int32_t>(k);
    for (const std::int32_t k : near.triangles) {
      const std::array<std::int32_t, 3>& t = mesh.triangles[k];
      for (const std::int32_t v : t)
        if (number_[v] < 0) add_vertex(p, v);
      zone_.triangles.push_back({number_[t[0]], number_[t[1]], number_[t[2]]});
      zone_.band.push_back(band_of(near, t));
    }
    for (std::size_t v = 0; v < whole.size(); ++v) shared_[whole[v]] = number_[v];
  }
  void add_vertex(std::size_t p, std::int32_t v) {
    const auto n = static_cast<std::int32_t>(joined_.pieces.pieces[p].whole.size());
    const auto domain = static_cast<std::int32_t>(joined_.pieces.separator.size() - joined_.pieces.separators.size());
    number_[v] = static_cast<std::int32_t>(zone_.vertices.size());
    const std::int32_t whole = joined_.whole(p, v);
    const bool imposed = v < n ? whole < domain : v < joined_.meshes[p].work.fixed;
    zone_.vertices.push_back(joined_.mesh(p).vertices[v]);
    zone_.whole.push_back(whole);
    zone_.level.push_back(near_[v] < 0 ? outside : static_cast<std::uint8_t>(joined_.meshes[p].near.level[near_[v]]));
    zone_.fixed.push_back(imposed || near_[v] < 0 ? 1 : 0);
  }
  [[nodiscard]] std::int32_t band_of(const NearSeparators& near, const std::array<std::int32_t, 3>& t) const {
    std::int32_t band = Pieces::none;
    for (const std::int32_t v : t) {
      if (near_[v] < 0) continue;
      const std::int32_t here = near.band[near_[v]];
      band = band == Pieces::none || band == here ? here : Pieces::several;
    }
    return band;
  }

  const JoinedPieces& joined_;
  std::vector<std::int32_t> shared_;  // numbers in the zone, by vertex of the whole mesh
  std::vector<std::int32_t> number_;  // the same by vertex of the piece
  std::vector<std::int32_t> near_;    // by vertex of the piece: its place among the vertices near separators
  Zone zone_;
};

void apply(Zone& zone, const std::vector<ZonePart>& parts, const std::vector<std::uint8_t>& replaced,
           Monitor& monitor) {
  monitor.checkpoint();
  std::vector<std::array<std::int32_t, 3>> triangles;
  triangles.reserve(zone.triangles.size());
  for (std::size_t t = 0; t < zone.triangles.size(); ++t)
    if (replaced[t] == 0) triangles.push_back(zone.triangles[t]);
  const auto n = static_cast<std::int32_t>(zone.vertices.size());
  for (const ZonePart& part : parts) {
    monitor.checkpoint();
    for (std::size_t k = 0; k < part.moved.size(); ++k) zone.vertices[part.moved[k]] = part.to[k];
    const auto shift = static_cast<std::int32_t>(zone.vertices.size()) - n;
    zone.vertices.insert(zone.vertices.end(), part.added.begin(), part.added.end());
    for (std::array<std::int32_t, 3> t : part.triangles) {
      for (std::int32_t& v : t)
        if (v >= n) v += shift;
      triangles.push_back(t);
    }
  }
  zone.triangles.swap(triangles);
  zone.fixed.resize(zone.vertices.size(), 0);
  zone.level.resize(zone.vertices.size(), outside);
}

/// The triangles of each separator.
class Bands {
 public:
  explicit Bands(const Zone& zone) {
    for (const std::int32_t band : zone.band)
      if (band >= 0) {
        if (start_.size() < static_cast<std::size_t>(band) + 2) start_.resize(static_cast<std::size_t>(band) + 2, 0);
        ++start_[band + 1];
      }
    if (start_.empty()) start_.push_back(0);
    for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
    triangles_.resize(start_.back());
    std::vector<std::size_t> next = start_;
    for (std::size_t t = 0; t < zone.band.size(); ++t)
      if (zone.band[t] >= 0) triangles_[next[zone.band[t]]++] = static_cast<std::int32_t>(t);
  }
  [[nodiscard]] std::size_t count() const noexcept { return start_.size() - 1; }
  [[nodiscard]] std::span<const std::int32_t> triangles(std::size_t band) const noexcept {
    return std::span(triangles_).subspan(start_[band], start_[band + 1] - start_[band]);
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<std::int32_t> triangles_;
};

void put_part(PacketWriter& packet, const ZonePart& part) {
  packet.put(part.moved);
  packet.put(part.to);
  packet.put(part.added);
  put_triangles(packet, part.triangles);
}
ZonePart get_part(PacketReader& packet) {
  ZonePart part;
  part.moved = packet.integers();
  part.to = packet.plane_points();
  part.added = packet.plane_points();
  part.triangles = triangles_of(packet);
  return part;
}

// Vertices of triangles that belong to several bands wait for the second round; the others' bands know all around them.
std::vector<std::uint8_t> improve_bands(Zone& zone, const ZoneContext& context) {
  context.monitor.checkpoint();
  std::vector<std::uint8_t> free(zone.vertices.size()), waiting(zone.vertices.size(), 0);
  for (std::size_t t = 0; t < zone.triangles.size(); ++t)
    if (zone.band[t] < 0)
      for (const std::int32_t v : zone.triangles[t]) waiting[v] = zone.fixed[v] != 0 ? 0 : 1;
  for (std::size_t v = 0; v < free.size(); ++v) free[v] = zone.fixed[v] == 0 && waiting[v] == 0 ? 1 : 0;
  context.monitor.checkpoint();
  const Bands bands(zone);
  std::vector<std::uint8_t> replaced(zone.triangles.size(), 0);
  for (std::size_t t = 0; t < zone.triangles.size(); ++t) replaced[t] = zone.band[t] < 0 ? 0 : 1;
  const auto improve = [&](std::size_t b, Monitor& monitor) {
    return optimise_part(zone, bands.triangles(b), free, context, monitor);
  };
  const std::vector<ZonePart> parts =
      shared_work<ZonePart>(context.options.executor, "bands", bands.count(), false, improve, put_part, get_part, context.monitor);
  apply(zone, parts, replaced, context.monitor);
  waiting.resize(zone.vertices.size(), 0);
  return waiting;
}

void improve_meeting_places(Zone& zone, const std::vector<std::uint8_t>& waiting, const ZoneContext& context) {
  context.monitor.checkpoint();
  std::vector<std::uint8_t> level(zone.vertices.size(), meeting_layers), free(zone.vertices.size(), 0);
  for (std::size_t v = 0; v < level.size(); ++v)
    if (waiting[v] != 0) level[v] = 0;
  spread(zone.triangles, level, meeting_layers, context.monitor);
  context.monitor.checkpoint();
  for (std::size_t v = 0; v < level.size(); ++v) free[v] = level[v] < meeting_layers && zone.fixed[v] == 0 ? 1 : 0;
  std::vector<std::int32_t> near;
  std::vector<std::uint8_t> replaced(zone.triangles.size(), 0);
  for (std::size_t t = 0; t < zone.triangles.size(); ++t) {
    const auto& [a, b, c] = zone.triangles[t];
    if (free[a] + free[b] + free[c] == 0) continue;
    near.push_back(static_cast<std::int32_t>(t));
    replaced[t] = 1;
  }
  if (near.empty()) return;
  apply(zone, {optimise_part(zone, near, free, context, context.monitor)}, replaced, context.monitor);
}

}  // namespace

JoinedPieces join(const Pieces& pieces, std::span<const MeshedPiece> meshes) {
  JoinedPieces joined{.pieces = pieces, .meshes = meshes, .inside = {}};
  auto next = static_cast<std::int32_t>(pieces.separator.size());
  for (std::size_t p = 0; p < meshes.size(); ++p) {
    joined.inside.push_back(next);
    next += static_cast<std::int32_t>(joined.mesh(p).vertices.size() - pieces.pieces[p].whole.size());
  }
  return joined;
}

Zone improved_zone(const JoinedPieces& joined, const ZoneContext& context) {
  Zone zone = ZoneMaker(joined).run(context.monitor);
  const std::vector<std::uint8_t> waiting = improve_bands(zone, context);
  improve_meeting_places(zone, waiting, context);
  return zone;
}

}  // namespace carreau::plane
