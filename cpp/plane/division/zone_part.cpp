// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/zone_part.h"

#include <algorithm>
#include <utility>

#include "plane/division/refill.h"
#include "plane/kernel/domain_reader.h"
#include "plane/kernel/thresholds.h"
#include "plane/optimise/local_search.h"
#include "plane/optimise/optimise.h"
#include "support/memory/unfilled.h"

namespace carreau::plane {

namespace {

/// A part of the zone in local numbers: vertices that stay come first.
class PartOfZone {
 public:
  PartOfZone(const Zone& zone, const Refilled& refilled, std::span<const std::uint8_t> free, const ZoneContext& context,
             const Frame& frame)
      : zone_(zone), context_(context) {
    const std::size_t n = zone.vertices.size();
    number(refilled, free);
    mesh.vertices.reserve(of_.size());
    for (const std::int32_t v : of_) {
      const auto k = static_cast<std::size_t>(v);
      const Vec2 p = frame.inward(k < n ? zone.vertices[k] : refilled.added[k - n]);
      mesh.vertices.emplace_back();
      mesh.vertices.back().x = p.x(), mesh.vertices.back().y = p.y();
    }
    add_triangles(refilled);
    impose_edges();
  }

  [[nodiscard]] const std::vector<std::int32_t>& of() const noexcept { return of_; }
  Triangulation mesh;
  int fixed = 0;
  std::size_t of_zone = 0;  ///< vertices from there on are added ones

 private:
  // Fixed ones, others of the zone, added ones.
  void number(const Refilled& refilled, std::span<const std::uint8_t> free) {
    std::vector<std::uint8_t> used(zone_.vertices.size() + refilled.added.size(), 0);
    for (const auto& t : refilled.triangles)
      for (const std::int32_t v : t) used[v] = 1;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v] != 0) of_.push_back(static_cast<std::int32_t>(v));
    const auto stays = [&](std::int32_t v) { return static_cast<std::size_t>(v) < free.size() && free[v] == 0; };
    fixed = static_cast<int>(std::stable_partition(of_.begin(), of_.end(), stays) - of_.begin());
    of_zone = static_cast<std::size_t>(
        std::lower_bound(of_.begin() + fixed, of_.end(), static_cast<std::int32_t>(zone_.vertices.size())) -
        of_.begin());
  }

  void add_triangles(const Refilled& refilled) {
    std::vector<std::int32_t> local(zone_.vertices.size() + refilled.added.size(), -1);
    for (std::size_t k = 0; k < of_.size(); ++k) local[of_[k]] = static_cast<std::int32_t>(k);
    std::vector<std::int32_t> start(of_.size() + 1, 0);
    mesh.triangles.reserve(refilled.triangles.size());
    for (const auto& t : refilled.triangles) {
      Triangle& T = mesh.triangles.emplace_back();
      T.done = Done::yes;
      for (int i = 0; i < 3; ++i) {
        T.v[i] = local[t[i]];
        mesh.vertices[T.v[i]].triangle = static_cast<std::int32_t>(mesh.triangles.size()) - 1;
        ++start[T.v[i]];
      }
    }
    // Half-edges by the vertex that they leave.
    for (std::size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
    std::vector<HalfEdge> leaving(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) leaving[--start[mesh.triangles[t].v[next3[i]]]] = static_cast<HalfEdge>(4 * t + i);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const std::int32_t a = mesh.triangles[t].v[next3[i]], b = mesh.triangles[t].v[prev3[i]];
        for (std::int32_t k = start[b]; k < start[b + 1]; ++k) {
          const HalfEdge he = leaving[k];
          if (mesh.triangles[he >> 2].v[prev3[he & 3]] == a) mesh.triangles[t].n[i] = he;
        }
      }
  }

  // The domain's, and the rim.
  void impose_edges() {
    const auto n = static_cast<std::int32_t>(context_.domain.vertices.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        Triangle& T = mesh.triangles[t];
        const auto whole = [&](int v) {
          return static_cast<std::size_t>(of_[v]) < zone_.whole.size() ? zone_.whole[of_[v]] : n;
        };
        bool imposed = T.n[i] == no_edge, degenerate = false;
        if (const std::int32_t a = whole(T.v[next3[i]]), b = whole(T.v[prev3[i]]); a < n && b < n)
          if (const PlaneEdgeKind kind = context_.inner.kind(a, b); kind != PlaneEdgeKind::boundary)
            imposed = true, degenerate = kind == PlaneEdgeKind::degenerate;
        T.imposed = static_cast<std::uint8_t>(T.imposed | (imposed ? 1U << i : 0U));
        T.degenerate = static_cast<std::uint8_t>(T.degenerate | (degenerate ? 1U << i : 0U));
      }
  }

  const Zone& zone_;
  const ZoneContext& context_;
  std::vector<std::int32_t> of_;
};

/// Some triangles of a zone with their vertices, in local numbers of equal order. There may be many parts, and work on
/// one should not depend on the size of the whole.
class Excerpt {
 public:
  Excerpt(const Zone& of, std::span<const std::int32_t> triangles, std::span<const std::uint8_t> free_of) : whole_(of) {
    UnfilledVector<std::int32_t> local(of.vertices.size());  // vertices of these triangles only
    for (const std::int32_t t : triangles)
      for (const std::int32_t v : of.triangles[t]) local[v] = -1;
    for (const std::int32_t t : triangles)
      for (const std::int32_t v : of.triangles[t])
        if (local[v] < 0) local[v] = 0, of_.push_back(v);
    std::sort(of_.begin(), of_.end());
    for (std::size_t k = 0; k < of_.size(); ++k) {
      const std::int32_t v = of_[k];
      local[v] = static_cast<std::int32_t>(k);
      zone.vertices.push_back(of.vertices[v]);
      zone.level.push_back(of.level[v]);
      free.push_back(free_of[v]);
      if (static_cast<std::size_t>(v) < of.whole.size()) zone.whole.push_back(of.whole[v]);
    }
    zone.triangles.reserve(triangles.size());
    for (const std::int32_t k : triangles) {
      const auto& t = of.triangles[k];
      zone.triangles.push_back({local[t[0]], local[t[1]], local[t[2]]});
    }
  }

  /// In numbers of the whole zone.
  [[nodiscard]] ZonePart back(ZonePart part) const {
    const auto n = static_cast<std::int32_t>(of_.size());
    const auto shift = static_cast<std::int32_t>(whole_.vertices.size()) - n;
    for (std::int32_t& v : part.moved) v = of_[v];
    for (auto& t : part.triangles)
      for (std::int32_t& v : t) v = v < n ? of_[v] : v + shift;
    return part;
  }

  Zone zone;  ///< vertices, whole, level, triangles
  std::vector<std::uint8_t> free;

 private:
  const Zone& whole_;
  std::vector<std::int32_t> of_;
};

}  // namespace

ZonePart optimise_part(const Zone& whole, std::span<const std::int32_t> triangles,
                       std::span<const std::uint8_t> free_of_whole, const ZoneContext& context, Monitor& monitor) {
  const Excerpt excerpt(whole, triangles, free_of_whole);
  const Zone& zone = excerpt.zone;
  const std::vector<std::uint8_t>& free = excerpt.free;
  const Frame frame = frame_of(context.domain);
  const Refilled refilled = refill(zone, free, context, monitor);
  PartOfZone part(zone, refilled, free, context, frame);
  const Field field(context.metric, frame, context.known);
  PlaneWork work{part.mesh, field, monitor};
  work.fixed = part.fixed;
  if (field.bends()) part.mesh.bends.resize(part.mesh.vertices.size());
  for (std::size_t v = 0; v < part.mesh.vertices.size(); ++v) work.shapes.set_metric(static_cast<int>(v));
  const Settled settled = optimise(work, static_cast<std::size_t>(context.known.triangles));
  if (context.options.shape_trials) search_around_bad_triangles(work, settled, context.options.normals);

  ZonePart result;
  const std::size_t n = part.of_zone;
  result.moved.reserve(n - static_cast<std::size_t>(part.fixed)), result.to.reserve(result.moved.capacity());
  result.added.reserve(part.mesh.vertices.size() - n);
  result.triangles.reserve(part.mesh.triangles.size());
  for (std::size_t v = static_cast<std::size_t>(part.fixed); v < n; ++v) {
    result.moved.push_back(part.of()[v]);
    result.to.push_back(frame.outward(part.mesh.at(static_cast<int>(v))));
  }
  const auto base = static_cast<std::int32_t>(zone.vertices.size() - n);
  for (std::size_t v = n; v < part.mesh.vertices.size(); ++v)
    result.added.push_back(frame.outward(part.mesh.at(static_cast<int>(v))));
  const auto number = [&](std::int32_t v) { return static_cast<std::size_t>(v) < n ? part.of()[v] : base + v; };
  for (const Triangle& T : part.mesh.triangles)
    if (T.v[0] >= 0) result.triangles.push_back({number(T.v[0]), number(T.v[1]), number(T.v[2])});
  return excerpt.back(std::move(result));
}

}  // namespace carreau::plane
