// SPDX-License-Identifier: BSD-3-Clause
#include "surface/carry/domain_map.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>

#include "periodic/shared_curves.h"
#include "support/format.h"
#include "support/infinity.h"

namespace carreau {

namespace {

/// An edge of a domain with its ends in the direction of its curve.
struct Directed {
  int first = 0, last = 0;  // vertices of the domain at nodes `segment` and `segment` + 1
  bool along = true;        // the edge runs as its curve does
};

class Mapper {
 public:
  Mapper(const CurveModel& model, const std::vector<DiscreteCurve>& curves, const FacePair& pair, const FaceDomain& master,
         const FaceDomain& slave, double gap)
      : model_(model), curves_(curves), pair_(pair), master_(master), slave_(slave), gap_(gap) {}

  DomainMap run() {
    DomainMap best;
    const std::string names = pair_name(model_, pair_);
    if (master_.origin.size() != slave_.origin.size() || master_.plane.edges.size() != slave_.plane.edges.size()) {
      best.why = names + " have " + std::to_string(master_.origin.size()) + " and " + std::to_string(slave_.origin.size()) +
                 " vertices on their boundaries";
      return best;
    }
    std::optional<DomainMap> plain = attempt(false), turned = attempt(true);
    if (plain && turned) {  // seams and poles alone
      const std::optional<bool> flipped = flipped_by_normals(*plain);
      return flipped && *flipped ? *turned : *plain;
    }
    if (plain) return *plain;
    if (turned) return *turned;
    best.why = names + ": the sides of their domains do not correspond";
    return best;
  }

 private:
  using Key = std::tuple<int, int, bool>;  // curve, segment, along it

  [[nodiscard]] bool is_closed(int curve) const {
    const Curve& shape = model_.curve(curve);
    return shape.end1 == shape.end2 && !shape.degenerate;
  }

  // The use whose places the ends have tells the direction.
  [[nodiscard]] Directed directed(const PlaneEdge& edge, const FaceDomain& domain, int face) const {
    const DiscreteCurve& curve = curves_[edge.curve];
    const std::vector<CurveUse>& uses = model_.curve(edge.curve).uses;
    const Vec2 a = domain.plane.vertices[edge.a], b = domain.plane.vertices[edge.b];
    double nearest = infinity;
    bool along = true;
    for (std::size_t u = 0; u < uses.size(); ++u) {
      if (uses[u].face != face) continue;
      const Vec2 p = curve.uv_of_use[u][edge.segment], q = curve.uv_of_use[u][edge.segment + 1];
      const double forward = norm(p - a) + norm(q - b), backward = norm(p - b) + norm(q - a);
      if (std::min(forward, backward) < nearest) nearest = std::min(forward, backward), along = forward <= backward;
    }
    return {along ? edge.a : edge.b, along ? edge.b : edge.a, along};
  }

  [[nodiscard]] std::map<Key, Directed> edges_of_slave() const {
    std::map<Key, Directed> edges;
    for (const PlaneEdge& edge : slave_.plane.edges) {
      const Directed d = directed(edge, slave_, pair_.slave);
      edges[{edge.curve, edge.segment, d.along}] = d;
      if (edge.kind == PlaneEdgeKind::internal) edges[{edge.curve, edge.segment, !d.along}] = d;
    }
    return edges;
  }

  [[nodiscard]] std::optional<DomainMap> attempt(bool flipped) const {
    const std::map<Key, Directed> edges = edges_of_slave();
    DomainMap map;
    map.flipped = flipped;
    map.vertex.assign(master_.origin.size(), -1);
    std::vector<int> back(slave_.origin.size(), -1);
    const auto join = [&](int from, int to) {
      if ((map.vertex[from] >= 0 && map.vertex[from] != to) || (back[to] >= 0 && back[to] != from)) return false;
      map.vertex[from] = to, back[to] = from;
      return true;
    };
    for (const PlaneEdge& edge : master_.plane.edges) {
      const auto found = pair_.curves.find(edge.curve);
      if (found == pair_.curves.end()) return {};
      const CurveImage& image = found->second;
      const DiscreteCurve &from = curves_[edge.curve], &to = curves_[image.curve];
      const bool closed = is_closed(edge.curve);
      const Directed d = directed(edge, master_, pair_.master);
      // A degenerate curve has no direction in space: its places in (u, v) decide.
      const bool degenerate = model_.curve(edge.curve).degenerate;
      int segment = edge.segment;
      bool along = d.along;
      bool reversed = image.reversed;
      if (!degenerate) {
        const int i = vertex_image(from, to, image, closed, edge.segment);
        if (i < 0) return {};
        segment = reversed ? (i + to.segments() - 1) % to.segments() : i % to.segments();
        along = d.along != (reversed != flipped);
      } else {
        const auto there = std::find_if(edges.begin(), edges.end(), [&](const auto& e) { return std::get<0>(e.first) == image.curve; });
        if (there == edges.end()) return {};
        along = there->second.along;
        reversed = (d.along != along) != flipped;
      }
      const auto other = edges.find({image.curve, segment, along});
      if (other == edges.end()) return {};
      const Directed& e = other->second;
      if (!join(d.first, reversed ? e.last : e.first) || !join(d.last, reversed ? e.first : e.last)) return {};
    }
    if (!join_points(map, back, join)) return {};
    return map;
  }

  template <typename Join>
  [[nodiscard]] bool join_points(const DomainMap& map, const std::vector<int>& back, const Join& join) const {
    for (std::size_t v = 0; v < master_.origin.size(); ++v) {
      if (map.vertex[v] >= 0) continue;
      if (master_.origin[v].point < 0) return false;
      const auto position = [&](int face, const Vec2& uv) { return surface_at(model_.cad, model_.model.faces[face].ref, want_position, uv).s; };
      const Vec3 image = pair_.map(position(pair_.master, master_.plane.vertices[v]));
      bool found = false;
      for (std::size_t w = 0; w < slave_.origin.size() && !found; ++w)
        found = back[w] < 0 && slave_.origin[w].point >= 0 && norm(position(pair_.slave, slave_.plane.vertices[w]) - image) <= gap_ &&
                join(static_cast<int>(v), static_cast<int>(w));
      if (!found) return false;
    }
    return true;
  }

  // Compares the normals of both surfaces at vertices where both have one.
  [[nodiscard]] std::optional<bool> flipped_by_normals(const DomainMap& map) const {
    const auto normal = [&](int face, const Vec2& uv) {
      const SurfaceJet jet = surface_at(model_.cad, model_.model.faces[face].ref, want_first, uv);
      const Vec3 n = cross(jet.su, jet.sv);
      const double scale = norm(jet.su) * norm(jet.sv);
      return scale > 0 && norm(n) > 1e-6 * scale ? Vec3(n / norm(n)) : Vec3(0, 0, 0);
    };
    for (std::size_t v = 0; v < map.vertex.size(); ++v) {
      const Vec3 n = pair_.map.turn(normal(pair_.master, master_.plane.vertices[v]));
      const double agree = dot(n, normal(pair_.slave, slave_.plane.vertices[map.vertex[v]]));
      if (std::abs(agree) > 0.5) return (agree < 0) != pair_.map.reflects();
    }
    return {};
  }

  const CurveModel& model_;
  const std::vector<DiscreteCurve>& curves_;
  const FacePair& pair_;
  const FaceDomain &master_, &slave_;
  double gap_;
};

}  // namespace

DomainMap map_domain(const CurveModel& model, const std::vector<DiscreteCurve>& curves, const FacePair& pair,
                     const FaceDomain& master, const FaceDomain& slave, double gap) {
  return Mapper(model, curves, pair, master, slave, gap).run();
}

}  // namespace carreau
