// SPDX-License-Identifier: BSD-3-Clause
#include "high_order/raise_order.h"

#include "association/mesh_curves.h"
#include "high_order/raiser.h"
#include "high_order/thresholds.h"
#include "support/error.h"
#include "support/pieces.h"

namespace carreau {

using namespace thresholds::high_order;

namespace {

constexpr std::size_t at_once = 512;

}  // namespace

HighOrderMesh Raiser::run() {
  place_curves();
  list_elements();
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) place_edges(f);
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) place_inside(f);
  repair();
  for (const PeriodicLink& link : mesh_.periodic) link_nodes(link);
  follow_masters();
  fill();
  associate_nodes();
  return std::move(out_);
}

std::int32_t Raiser::add_nodes(std::size_t n) {
  const auto first = static_cast<std::int32_t>(out_.nodes.size());
  out_.nodes.resize(out_.nodes.size() + n), node_uv_.resize(out_.nodes.size(), Vec2{0, 0});
  return first;
}

void Raiser::place_curves() {
  const std::vector<DiscreteCurve> curves = curves_of_mesh(model_, mesh_, result_.curve_parameters);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const DiscreteCurve& d = curves[c];
    const std::vector<std::int32_t>& chain = mesh_.curves[c].vertices;
    if (d.indivisible || chain.size() < 2) continue;
    const auto owner = static_cast<std::size_t>(d.owner);
    const CurveUse& use = model_.curve(d.curve).uses[owner];
    std::vector<double> r, t;
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const double left = d.t_of_use[owner][k - 1], right = d.t_of_use[owner][k];
      const double off_left = left - parameter_at(model_, use, d.r[k - 1]), off_right = right - parameter_at(model_, use, d.r[k]);
      for (std::size_t i = 1; i < p_; ++i) {
        const double s = places_[i], share = d.r[k - 1] + s * (d.r[k] - d.r[k - 1]);
        double at = parameter_at(model_, use, share) + (1 - s) * off_left + s * off_right;
        if (!(std::min(left, right) < at && at < std::max(left, right))) at = (1 - s) * left + s * right;
        r.push_back(share), t.push_back(at);
      }
      if (k + 1 < chain.size()) r.push_back(d.r[k]), t.push_back(right);
    }
    DiscreteCurve fine = d;
    place_vertices_at(fine, r, t, model_);
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const bool forward = chain[k - 1] < chain[k];
      const auto [found, is_new] = edges_.try_emplace(ordered(chain[k - 1], chain[k]), Edge{});
      if (!is_new) continue;
      found->second = {add_nodes(p_ - 1), true};
      for (std::size_t i = 1; i < p_; ++i) {
        const std::int32_t node = found->second.first + static_cast<std::int32_t>(forward ? i : p_ - i) - 1;
        const std::size_t at = (k - 1) * p_ + i;
        out_.nodes[node] = fine.xyz[at];
        on_curves_.push_back({node, mesh_.curves[c].shown_ref(), fine.t_of_use[owner][at]});
        place_of_[node] = {on_curves_.size() - 1, on_sides_.size(), &use};
        const std::vector<CurveUse>& uses = model_.curve(d.curve).uses;
        for (std::size_t u = 0; u < uses.size(); ++u) on_sides_.push_back({node, uses[u].face, fine.uv_of_use[u][at]});
      }
    }
  }
}

void Raiser::list_elements() {
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    const FaceMesh& face = mesh_.faces[f];
    first_element_.push_back(elements_.size());
    for (std::size_t k = 0; k < static_cast<std::size_t>(face.quads); ++k) elements_.push_back({static_cast<std::int32_t>(f), 4, face.quad(k), {}});
    for (std::size_t t = 2 * static_cast<std::size_t>(face.quads); t < face.triangles.size(); ++t) {
      const auto& [a, b, c] = face.triangles[t];
      elements_.push_back({static_cast<std::int32_t>(f), 3, {a, b, c, -1}, {}});
    }
  }
  first_element_.push_back(elements_.size());
}

void Raiser::place(std::size_t f, const Wanted& wanted) {
  const int ref = mesh_.faces[f].ref;
  for_pieces(wanted.node.size(), at_once, [&](std::size_t first, std::size_t n) {
    monitor_.checkpoint();
    std::vector<ClosestPoint> points;
    for (std::size_t i = first; i < first + n; ++i) points.push_back({wanted.guess[i], {}, 0});
    bool failed = false;
    try {
      find_closest(model_.cad, ref, std::span(wanted.target).subspan(first, n), points);
    } catch (const CallbackError&) {
      failed = true;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = first + i;
      if (failed || !(points[i].distance <= wanted.reach[k])) {
        points[i].uv = wanted.guess[k];
        points[i].xyz = surface_at(model_.cad, ref, want_position, wanted.guess[k]).s;
      }
      out_.nodes[wanted.node[k]] = points[i].xyz, node_uv_[wanted.node[k]] = points[i].uv;
    }
  });
}

void Raiser::place_edges(std::size_t f) {
  const FaceMesh& face = mesh_.faces[f];
  const Poles poles(face);
  Wanted wanted;
  for (std::size_t k = first_element_[f]; k < first_element_[f + 1]; ++k) {
    const Element& e = elements_[k];
    for (int i = 0; i < e.corners; ++i) {
      std::int32_t a = e.local[i], b = e.local[(i + 1) % e.corners];
      if (face.vertex[a] > face.vertex[b]) std::swap(a, b);
      const auto [found, is_new] = edges_.try_emplace(Key{face.vertex[a], face.vertex[b]}, Edge{});
      if (!is_new) continue;
      found->second = {add_nodes(p_ - 1), false};
      const Vec3 &from = mesh_.vertices[face.vertex[a]], &to = mesh_.vertices[face.vertex[b]];
      const Vec2 uv_from = poles.arrival(a, face.uv[b]), uv_to = poles.arrival(b, face.uv[a]);
      for (std::size_t m = 1; m < p_; ++m) {
        wanted.node.push_back(found->second.first + static_cast<std::int32_t>(m) - 1);
        wanted.target.push_back(lerp(from, to, places_[m])), wanted.guess.push_back(lerp(uv_from, uv_to, places_[m]));
        wanted.reach.push_back(max_sagitta * norm(to - from));
      }
    }
  }
  place(f, wanted);
}

void Raiser::place_inside(std::size_t f) {
  const FaceMesh& face = mesh_.faces[f];
  Wanted wanted;
  for (std::size_t k = first_element_[f]; k < first_element_[f + 1]; ++k) {
    Element& e = elements_[k];
    const ElementShape& kind = shape(e);
    std::size_t n = 0;
    for (int i = 0; i < e.corners; ++i) e.node[n++] = face.vertex[e.local[i]];
    for (int i = 0; i < e.corners; ++i)
      for (std::size_t m = 1; m < p_; ++m) e.node[n++] = node_of_side(face, e, i, m);
    const std::int32_t first = add_nodes(kind.node_count() - n);
    for (std::size_t i = n; i < kind.node_count(); ++i) e.node[i] = first + static_cast<std::int32_t>(i - n);
    want_inner(e, wanted);
  }
  place(f, wanted);
}

std::array<Vec3, 25> Raiser::positions(const Element& e) const {
  std::array<Vec3, 25> x;
  for (std::size_t i = 0; i < shape(e).node_count(); ++i) x[i] = out_.nodes[e.node[i]];
  return x;
}

std::array<Vec2, 4> Raiser::corners_uv(const Element& e) const {
  const FaceMesh& face = mesh_.faces[e.face];
  if (!poles_ || &poles_->face() != &face) poles_.emplace(face);
  std::array<Vec2, 4> uv;
  for (int i = 0; i < e.corners; ++i) {
    Vec2 mean{0, 0};
    for (int k = 1; k < e.corners; ++k) mean += face.uv[e.local[(i + k) % e.corners]] / (e.corners - 1);
    uv[i] = poles_->arrival(e.local[i], mean);
  }
  return uv;
}

void Raiser::want_inner(const Element& e, Wanted& wanted) const {
  const ElementShape& kind = shape(e);
  std::array<Vec3, 25> x = positions(e);
  kind.place_inner(std::span(x.data(), kind.node_count()));
  const std::array<Vec2, 4> uv = corners_uv(e);
  double longest = 0;
  for (int i = 0; i < e.corners; ++i) longest = std::max(longest, norm(x[(i + 1) % e.corners] - x[i]));
  for (std::size_t i = kind.first_inner(); i < kind.node_count(); ++i) {
    const double s = kind.reference()[i].x(), t = kind.reference()[i].y();
    wanted.node.push_back(e.node[i]), wanted.target.push_back(x[i]);
    wanted.guess.push_back(e.corners == 4 ? Vec2((1 - s) * (1 - t) * uv[0] + s * (1 - t) * uv[1] + s * t * uv[2] + (1 - s) * t * uv[3])
                                          : Vec2((1 - s - t) * uv[0] + s * uv[1] + t * uv[2]));
    wanted.reach.push_back(max_sagitta * longest);
  }
}

double Raiser::score(const Element& e) const {
  const std::array<Vec3, 25> x = positions(e);
  return shape(e).least_jacobian(std::span(x.data(), shape(e).node_count()));
}

HighOrderMesh raise_order(const CurveModel& model, const CompositeResult& result, int order, NodePlaces places, bool lowers, Monitor& monitor) {
  if (order < 2 || order > 4) throw InvalidArgument("the order is " + std::to_string(order) + "; it must be 2, 3 or 4");
  return Raiser(model, result, order, places, lowers, monitor).run();
}

HighOrderMesh with_places(const HighOrderMesh& mesh, NodePlaces places) {
  if (mesh.places == places) return mesh;
  HighOrderMesh out = mesh;
  out.places = places, out.association = {};
  const auto move = [&](bool quad, const std::vector<std::int32_t>& rows) {
    const ElementShape before(quad, mesh.order, mesh.places), after(quad, mesh.order, places);
    const std::vector<double> values = before.values_at(after.reference());
    const std::size_t n = before.node_count();
    for (std::size_t row = 0; row < rows.size(); row += n)
      for (std::size_t i = static_cast<std::size_t>(before.corner_count()); i < n; ++i) {
        Vec3 sum(0, 0, 0);
        for (std::size_t k = 0; k < n; ++k) sum += values[i * n + k] * mesh.nodes[rows[row + k]];
        out.nodes[rows[row + i]] = sum;
      }
  };
  move(false, mesh.triangles), move(true, mesh.quads);
  const std::vector<double> from = places_on_edge(mesh.order, mesh.places), to = places_on_edge(mesh.order, places);
  const auto p = static_cast<std::size_t>(mesh.order);
  for (std::size_t row = 0; row < mesh.edges.size(); row += p + 1)  // edges without an element too
    for (std::size_t i = 1; i < p; ++i) {
      Vec3 sum(0, 0, 0);
      for (std::size_t k = 0; k <= p; ++k) {
        double weight = 1;
        for (std::size_t m = 0; m <= p; ++m)
          if (m != k) weight *= (to[i] - from[m]) / (from[k] - from[m]);
        sum += weight * mesh.nodes[mesh.edges[row + (k == 0 ? 0 : k == p ? 1 : k + 1)]];
      }
      out.nodes[mesh.edges[row + i + 1]] = sum;
    }
  return out;
}

}  // namespace carreau
