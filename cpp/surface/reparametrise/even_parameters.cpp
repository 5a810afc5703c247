// SPDX-License-Identifier: BSD-3-Clause
#include "surface/reparametrise/even_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mesh/editable_mesh.h"
#include "mesh/local_search.h"
#include "predicates/polygon_locator.h"
#include "predicates/predicates.h"
#include "support/infinity.h"
#include "support/work_bounds.h"
#include "surface/improve/bad_region.h"
#include "surface/reparametrise/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::reparametrise;

/// One parameter: 0 is u, 1 is v.
double of(const Vec2& p, int axis) noexcept { return axis == 0 ? p.x() : p.y(); }
Vec2 point(int axis, double along, double across) noexcept {
  return axis == 0 ? Vec2{along, across} : Vec2{across, along};
}

class Evener {
 public:
  Evener(int ref, Cad& cad, const SampledDomain& domain, const Vec2& at, Monitor& monitor)
      : ref_(ref), cad_(cad), locator_(domain.vertices, domain.edges), at_(at), monitor_(monitor) {
    for (int axis = 0; axis < 2; ++axis) {
      for (const auto& [a, b] : domain.edges) boundary_[axis].push_back(of(domain.vertices[a], axis));
      std::sort(boundary_[axis].begin(), boundary_[axis].end());
    }
  }

  std::optional<Reparametrisation> run() {
    std::array<Found, 2> found{find(0, places(1, nullptr)), {}};
    found[1] = find(1, places(0, found[0].uneven ? &found[0].map : nullptr));
    if (found[1].uneven) found[0] = find(0, places(1, &found[1].map));
    if (!found[0].uneven && !found[1].uneven) return {};
    return Reparametrisation{std::move(found[0].map), std::move(found[1].map)};
  }

 private:
  [[nodiscard]] double low(int axis) const noexcept { return boundary_[axis].front(); }
  [[nodiscard]] double high(int axis) const noexcept { return boundary_[axis].back(); }
  struct Found {
    MonotoneMap map;
    bool uneven = false;  // else it is linear
  };
  [[nodiscard]] Found as_it_is(int axis, double length) const {
    return {{{0, length > 0 ? length : 1}, {low(axis), high(axis)}}, false};
  }

  // Places at equal distances, by the map if given, and at boundary vertices, which mark long curves.
  [[nodiscard]] std::vector<double> places(int axis, const MonotoneMap* map) const {
    const std::vector<double>& sorted = boundary_[axis];
    std::vector<double> p = {low(axis), high(axis), of(at_, axis)};
    for (std::size_t k = 1; k < first_places; ++k) {
      const double share = static_cast<double>(k) / first_places;
      p.push_back(map != nullptr ? (*map)(std::lerp(map->first(), map->last(), share))
                                 : std::lerp(low(axis), high(axis), share));
      if (map == nullptr) p.push_back(sorted[k * (sorted.size() - 1) / first_places]);
    }
    std::sort(p.begin(), p.end());
    p.erase(std::unique(p.begin(), p.end()), p.end());
    return p;
  }

  /// The points of all lines at one place along them; NaN outside of the domain.
  struct Row {
    double at = 0;
    std::vector<Vec3> xyz;
  };
  [[nodiscard]] Row row(int axis, double at, const std::vector<double>& lines) {
    monitor_.checkpoint();
    Row row{at, std::vector<Vec3>(lines.size(), Vec3{std::nan(""), 0, 0})};
    std::vector<Vec2> uv;
    std::vector<std::size_t> line;
    for (std::size_t j = 0; j < lines.size(); ++j)
      if (const Vec2 p = point(axis, at, lines[j]); locator_.contains(p)) uv.push_back(p), line.push_back(j);
    std::vector<SurfaceJet> jets(uv.size());
    if (!uv.empty()) cad_.surface(ref_, want_position, uv, jets);
    for (std::size_t k = 0; k < uv.size(); ++k) row.xyz[line[k]] = jets[k].s;
    return row;
  }
  // The longest one between two rows. Adds them to the lengths of the lines.
  static double chord(const Row& p, const Row& q, std::vector<double>* lengths) {
    double longest = 0;
    for (std::size_t j = 0; j < p.xyz.size(); ++j) {
      const double c = norm(q.xyz[j] - p.xyz[j]);
      if (std::isnan(c)) continue;
      longest = std::max(longest, c);
      if (lengths != nullptr) (*lengths)[j] += c;
    }
    return longest;
  }

  Found find(int axis, const std::vector<double>& lines) {
    std::vector<Row> rows;
    for (const double p : places(axis, nullptr)) rows.push_back(row(axis, p, lines));
    std::vector<double> chords, lengths;
    double total = 0;
    for (;;) {
      chords.clear();
      lengths.assign(lines.size(), 0);
      total = 0;
      for (std::size_t k = 0; k + 1 < rows.size(); ++k)
        total += chords.emplace_back(chord(rows[k], rows[k + 1], &lengths));
      std::vector<Row> finer;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        finer.push_back(std::move(rows[k]));
        if (k + 1 == rows.size() || chords[k] <= finest * total) continue;
        const double a = finer.back().at, b = rows[k + 1].at, middle = 0.5 * (a + b);
        if (b - a > narrowest * std::max(std::abs(a), std::abs(b)) && middle > a && middle < b)
          finer.push_back(row(axis, middle, lines));
        else if (chords[k] > finest * total)
          refuse_jump(axis, 0.5 * (a + b), finer.back(), rows[k + 1], lines);
      }
      const bool done = finer.size() == rows.size() || finer.size() > 3000;
      rows.swap(finer);
      if (done) break;
    }
    const double length = *std::max_element(lengths.begin(), lengths.end());
    if (chords.size() + 1 != rows.size() || total > max_detours * length || !(total > 0))
      return as_it_is(axis, length);
    return map_of(axis, rows, chords, total);
  }

  [[nodiscard]] Found map_of(int axis, const std::vector<Row>& rows, const std::vector<double>& chords,
                             double total) const {
    const double width = high(axis) - low(axis);
    std::vector<double> x = {0}, u = {rows.front().at};
    double reached = 0, fastest = 0, slowest = infinity;
    for (std::size_t k = 0; k < chords.size(); ++k) {
      const double step = (rows[k + 1].at - rows[k].at) / width,
                   length = std::max(chords[k], min_speed * total * step);
      fastest = std::max(fastest, length / step), slowest = std::min(slowest, length / step);
      reached += length;
      const bool last = k + 1 == chords.size();
      if (!last && reached - x.back() < shortest * total) continue;  // it counts with the next one
      if (last && x.size() > 1 && reached - x.back() < shortest * total) x.pop_back(), u.pop_back();
      x.push_back(reached);
      u.push_back(rows[k + 1].at);
    }
    if (fastest < even * slowest) return as_it_is(axis, total);
    return {MonotoneMap(std::move(x), std::move(u)), true};
  }

  [[noreturn]] void refuse_jump(int axis, double at, const Row& p, const Row& q,
                                const std::vector<double>& lines) const {
    std::size_t worst = 0;
    double longest = 0;
    for (std::size_t j = 0; j < lines.size(); ++j)
      if (const double c = norm(q.xyz[j] - p.xyz[j]); c > longest) longest = c, worst = j;
    throw DomainError(Where{.face = ref_, .uv = point(axis, at, lines[worst])},
                      "the surface jumps: it is not continuous there");
  }

  int ref_;
  Cad& cad_;
  PolygonLocator locator_;
  Vec2 at_;
  Monitor& monitor_;
  std::array<std::vector<double>, 2> boundary_;  // sorted coordinates of its vertices
};

/// Swaps edges of triangles that are turned over.
class TurnedTriangles {
 public:
  TurnedTriangles(const PlaneDomain& host, PatchMesh& mesh) : mesh_(mesh), editable_(host, mesh.plane, mesh.xyz) {}

  void run(Monitor& monitor) {
    improve_in_passes(
        work_bounds::passes, monitor, [this] { return turned_over(mesh_.plane); },
        [this](std::int32_t t) { return mend(t); });
  }

  [[nodiscard]] static std::vector<std::int32_t> turned_over(const PlaneMesh& mesh) {
    std::vector<std::int32_t> turned;
    const std::vector<Vec2>& p = mesh.vertices;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (const auto& [a, b, c] = mesh.triangles[t]; orientation(p[a], p[b], p[c]) <= 0)
        turned.push_back(static_cast<std::int32_t>(t));
    return turned;
  }

 private:
  bool mend(std::int32_t t) {
    const auto quality = [this](const EditableMesh::Triangle& of) { return quality_in_space(of, mesh_.xyz); };
    if (editable_.is_positive(0, editable_.at({0, t}))) return false;
    const double own = quality(editable_.at({0, t}));
    double best = 0;
    std::optional<EditableMesh::Quad> found;
    for (int i = 0; i < 3; ++i) {
      const auto q = editable_.quad({0, t}, i);
      if (!q || !editable_.can_swap(*q)) continue;
      const auto [first, second] = EditableMesh::swapped(*q);
      const double worse = std::min(quality(first), quality(second));
      if (worse < min_kept * std::min(own, quality(editable_.at({0, q->u})))) continue;
      if (worse > best) best = worse, found = q;
    }
    return found && editable_.swap(*found);
  }

  PatchMesh& mesh_;
  EditableMesh editable_;
};

Metric2 scaled(Metric2 m, double x, double y) noexcept { return {m.a * x * x, m.b * x * y, m.c * y * y}; }

}  // namespace

std::optional<Reparametrisation> even_parameters(int ref, Cad& cad, const SampledDomain& domain, const Vec2& at,
                                                 Monitor& monitor) {
  return Evener(ref, cad, domain, at, monitor).run();
}

FaceDomain reparametrised(const FaceDomain& domain, const Reparametrisation& map) {
  FaceDomain result = domain;
  for (Vec2& p : result.plane.vertices) p = map.from_host(p);
  return result;
}

std::size_t return_to_host(const PlaneDomain& host, const Reparametrisation& map, PatchMesh& mesh, Monitor& monitor) {
  std::vector<Vec2>& uv = mesh.plane.vertices;
  std::copy(host.vertices.begin(), host.vertices.end(), uv.begin());
  for (std::size_t v = host.vertices.size(); v < uv.size(); ++v) uv[v] = map.to_host(uv[v]);
  const auto turned = [&mesh] { return TurnedTriangles::turned_over(mesh.plane).size(); };
  if (turned() > 0) TurnedTriangles(host, mesh).run(monitor);
  return turned();
}

ControlSpace returned_to_host(const PlaneDomain& host, const Reparametrisation& map, const ControlSpace& space,
                              Monitor& monitor) {
  const auto sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    for (std::size_t k = 0; k < uv.size(); ++k) {
      const Vec2 p = map.from_host(uv[k]);
      metric[k] = scaled(space.at(p), 1 / map.u.jet(p.x()).first, 1 / map.v.jet(p.y()).first);
    }
  };
  return ControlSpace::build(sampled_domain(host), sampler, {.max_samples = 20'000}, monitor);
}

}  // namespace carreau
