// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/lines/line_places.h"

#include <algorithm>
#include <cmath>

#include "support/infinity.h"

namespace carreau {

LinePlaces::LinePlaces(const SharpLine& line, const SurfaceMesh& mesh, const CurveModel& model,
                       std::span<const DiscreteCurve> known, const Charts& charts, Cad& cad)
    : line_(line), mesh_(mesh), model_(model), known_(known), charts_(charts), cad_(cad) {
  arc_.push_back(0);
  for (std::size_t first = 0, last = 0; first < line.curve.size(); first = last) {
    for (last = first + 1; last < line.curve.size() && line.curve[last] == line.curve[first];) ++last;
    add_part(first, last);
    if (arc_.size() != last + 1) return;
  }
}

// The rank at which the curve has v before or after the other vertex.
std::optional<std::size_t> LinePlaces::rank_on(std::int32_t curve, std::int32_t v, std::int32_t other) const {
  const std::vector<std::int32_t>& chain = mesh_.curves[curve].vertices;
  const auto c = static_cast<std::size_t>(curve);
  if (c >= known_.size() || known_[c].curve != curve || known_[c].r.size() != chain.size()) return {};
  for (std::size_t k = 0; k < chain.size(); ++k) {
    if (chain[k] != v || known_[c].xyz[k] != mesh_.vertices[v]) continue;
    if ((k > 0 && chain[k - 1] == other) || (k + 1 < chain.size() && chain[k + 1] == other)) return k;
  }
  return {};
}

void LinePlaces::add_part(std::size_t first, std::size_t last) {
  const std::int32_t c = line_.curve[first];
  const double length = static_cast<std::size_t>(c) < known_.size() ? model_.length(c) : 0;
  const double start = arc_.back();
  std::optional<std::size_t> begin, last_rank;
  for (std::size_t k = first; k <= last; ++k) {
    const std::int32_t other = line_.vertices[k == last ? k - 1 : k + 1];
    const auto rank = rank_on(c, line_.vertices[k], other);
    if (!rank || !(length > 0)) return;
    if (k > first && *rank != *last_rank + 1 && *rank + 1 != *last_rank) return;
    last_rank = rank;
    if (!begin) begin = rank;
    if (k > first) arc_.push_back(start + length * std::abs(known_[c].r[*rank] - known_[c].r[*begin]));
    if (k == last)
      parts_.push_back({c, start, arc_.back(), length * known_[c].r[*begin], length * known_[c].r[*rank], first});
  }
}

const LinePlaces::Part& LinePlaces::part_at(double arc) const {
  const auto next = std::ranges::upper_bound(parts_, arc, {}, &Part::from);
  return next == parts_.begin() ? parts_.front() : *(next - 1);
}

double LinePlaces::curve_arc(const Part& part, double arc) const {
  const double share = std::clamp((arc - part.from) / (part.to - part.from), 0.0, 1.0);
  return part.curve_from + share * (part.curve_to - part.curve_from);
}

std::vector<OnCurve> LinePlaces::on_curves(double arc) const {
  std::vector<OnCurve> found;
  for (const Part& part : parts_) {
    if (!(part.from <= arc && arc <= part.to)) continue;
    const CurveUse& use = model_.curve(part.curve).uses.front();
    const double r = curve_arc(part, arc) / model_.length(part.curve);
    found.push_back({part.curve, model_.face_ref(use), use.curve + 1, parameter_at(model_, use, r)});
  }
  return found;
}

Vec3 LinePlaces::near(double arc) const {
  const Part& part = part_at(arc);
  return model_.support(model_.curve(part.curve).uses.front()).point_at_arc(curve_arc(part, arc));
}

// Returns the triangle of the face on the line's edge there. At a seam it is the triangle on the side that has the
// place.
std::int32_t LinePlaces::triangle_beside(double arc, std::int32_t face, const Vec2& uv) const {
  const auto next = std::ranges::upper_bound(arc_, arc);
  const std::size_t edge = std::min<std::size_t>(
      line_.curve.size() - 1, next == arc_.begin() ? 0 : static_cast<std::size_t>(next - arc_.begin()) - 1);
  std::int32_t best = -1;
  double nearest = infinity;
  for (const auto& [t, side] : charts_.triangles_on(mesh_edge(line_.vertices[edge], line_.vertices[edge + 1]))) {
    if (charts_.triangles()[t].face != face) continue;
    const Vec2 middle = 0.5 * (charts_.uv(t, side) + charts_.uv(t, (side + 1) % 3));
    if (const double d = norm(uv - middle); d < nearest) nearest = d, best = t;
  }
  return best;
}

KeptPlaces LinePlaces::at(double arc) {
  const Part& part = part_at(arc);
  const double r = curve_arc(part, arc) / model_.length(part.curve);
  const Curve& curve = model_.curve(part.curve);
  KeptPlaces places;
  Vec3 position;
  for (std::size_t u = 0; u < curve.uses.size(); ++u) {
    const CurveUse& use = curve.uses[u];
    const int ref = model_.face_ref(use);
    double t = parameter_at(model_, use, r);
    Vec2 uv = cad_.curve(ref, use.curve + 1, want_position, t).c;
    if (u > 0) {
      const CurveSupport& support = model_.support(use);
      uv = refine_t(cad_, ref, use.curve + 1, support, t, support.t.front(), support.t.back(), position).uv;
    }
    const SurfaceJet jet = surface_at(cad_, ref, want_position | want_first, uv);
    if (u == 0) position = jet.s;
    const std::int32_t triangle = triangle_beside(arc, use.face, uv);
    if (triangle < 0) continue;  // of a face without a mesh
    SurfacePlace place = charts_.place({triangle, uv}, jet);
    place.xyz = position;
    places.push_back(place);
  }
  return places;
}

}  // namespace carreau
