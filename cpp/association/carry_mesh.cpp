// SPDX-License-Identifier: BSD-3-Clause
#include "association/carry_mesh.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "association/divide_elements.h"
#include "association/harmonic_map.h"
#include "association/keep_shapes.h"
#include "association/mesh_curves.h"
#include "association/thresholds.h"
#include "cad/batches.h"
#include "model/format_point.h"
#include "periodic/closest.h"
#include "predicates/predicates.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/assembly/whole_mesh.h"
#include "surface/carry/carry_faces.h"
#include "surface/elements/base/curve_middles.h"
#include "surface/elements/base/invalid_report.h"
#include "surface/elements/second_order/quadratic.h"

namespace carreau {

namespace {

using namespace thresholds::association;

class Carrier {
 public:
  Carrier(const MeshOfModel& from, const CurveModel& to, const ModelMatch& match, const SizeRules& rules, const CompositeOptions& options,
          Monitor& monitor, CompositeResult& out)
      : from_(from), to_(to), match_(match), rules_(rules), options_(options), monitor_(monitor), out_(out) {
    curves_from_ = curves_of_mesh(from.model, from.result.mesh, from.result.curve_parameters);
    flipped_.resize(from.result.mesh.faces.size(), 0);
  }

  CarryReport run() {
    const SurfaceMesh& old = from_.result.mesh;
    SurfaceMesh& mesh = out_.mesh;
    mesh.vertices = old.vertices, mesh.vertex_ref.assign(old.vertices.size(), 0);
    out_.vertex_size = from_.result.vertex_size;
    carry_curves();
    const std::size_t faces = to_.model.faces.size();
    mesh.faces.resize(faces), out_.interfaces.resize(faces), out_.spaces.resize(faces);
    CompositeResult known;  // curve_sides() looks at the mesh of a result
    known.mesh = old;
    const ElementWork work{from_.model, curves_from_, rules_, options_, known, monitor_};
    for (std::size_t f = 0; f < faces; ++f) {
      monitor_.checkpoint();
      carry_face(work, f);
      monitor_.progress(Phase::patches, to_.model.faces[match_.face[f]].ref, static_cast<double>(f + 1) / static_cast<double>(faces));
    }
    smooth_faces();
    if (report_.failed > 0) (void)drop_unused(out_);  // vertices inside of faces that have failed
    const std::vector<refining::WorstShape> worst = refining::worst_shapes(old);
    std::vector<refining::WorstShape> before(faces);
    for (std::size_t f = 0; f < faces; ++f) before[match_.face[f]] = worst[f];
    refining::report_losses(mesh, before, "carrying", monitor_);
    if (!old.mid_vertices.empty() && !carry_nodes()) make_nodes();
    return report_;
  }

 private:
  // Shapes that have not fallen much stay: positions are smooth functions of the geometry then.
  void smooth_faces() {
    const SurfaceMesh& old = from_.result.mesh;
    refining::ShapeKeeper keeper(out_.mesh, 0, to_.cad, !rules_.uses_metrics(), !old.mid_vertices.empty(), monitor_);
    for (std::size_t f = 0; f < old.faces.size(); ++f) {
      monitor_.checkpoint();
      std::vector<float> before;
      for (const auto& t : old.faces[f].triangles) before.push_back(static_cast<float>(refining::shape_of(old.faces[f], t, old.vertices)));
      const auto image = static_cast<std::size_t>(match_.face[f]);
      if (before.size() == out_.mesh.faces[image].triangles.size() && keeper.smooth(image, before)) ++report_.smoothed;
    }
  }

  void carry_curves() {
    const SurfaceMesh& old = from_.result.mesh;
    SurfaceMesh& mesh = out_.mesh;
    const std::size_t n = to_.topology.curves.size();
    mesh.curves.resize(n), curves_to_.resize(n), out_.curve_size.resize(n);
    for (std::size_t c = 0; c < n; ++c) {
      const auto d = static_cast<std::size_t>(match_.curve[c]);
      const Curve& curve = to_.topology.curves[d];
      const CurveMesh& before = old.curves[c];
      const bool back = match_.reversed[c] != 0;
      CurveMesh& after = mesh.curves[d];
      after.ref = curve.ref, after.loose = before.loose;
      const FaceCurve& first = to_.model.faces[curve.uses.front().face].curves[curve.uses.front().curve];
      after.part_of = first.shown_as;
      for (const CurveUse& use : curve.uses)
        after.uses.push_back({use.face, to_.model.faces[use.face].curves[use.curve].type == CurveType::internal});
      after.vertices = before.vertices;
      if (back) std::reverse(after.vertices.begin(), after.vertices.end());
      const Vec3 &p = to_.topology.points[curve.end1].position, &q = to_.topology.points[curve.end2].position;
      DiscreteCurve& discrete = curves_to_[d] = undivided_curve(to_, d, p, q);
      if (is_unchanged(c, d)) {
        discrete = curves_from_[c], discrete.curve = static_cast<int>(d);
        out_.curve_size[d] = from_.result.curve_size[c];
      } else if (!discrete.indivisible) {
        const std::vector<double>& r = curves_from_[c].r;
        std::vector<double> inside(r.begin() + 1, r.end() - 1), t;
        if (back) {
          std::reverse(inside.begin(), inside.end());
          for (double& share : inside) share = 1 - share;
        }
        for (const double share : inside) t.push_back(parameter_at(to_, curve.uses.front(), share));
        place_vertices_at(discrete, inside, t, to_);
        out_.curve_size[d] = from_.result.curve_size[c];
        if (back) std::reverse(out_.curve_size[d].begin(), out_.curve_size[d].end());
      }
      if (after.vertices.size() == discrete.xyz.size() || after.vertices.size() == 1)
        for (std::size_t k = 0; k < after.vertices.size(); ++k) mesh.vertices[after.vertices[k]] = discrete.xyz[k];
      mesh.vertex_ref[after.vertices.front()] = to_.topology.points[curve.end1].ref;
      mesh.vertex_ref[after.vertices.back()] = to_.topology.points[curve.end2].ref;
    }
    for (const DiscreteCurve& curve : curves_to_) out_.gaps.push_back({curve.gap, curve.gap_use});
    out_.curve_parameters = parameters_of_curves(to_, curves_to_);
  }

  /// All uses of the curve have the supports that they had: shares of its length would only round its parameters.
  [[nodiscard]] bool is_unchanged(std::size_t c, std::size_t d) const {
    const std::vector<CurveUse>&before = from_.model.topology.curves[c].uses, &after = to_.topology.curves[d].uses;
    if (match_.reversed[c] != 0 || before.size() != after.size()) return false;
    return std::equal(before.begin(), before.end(), after.begin(), [&](const CurveUse& a, const CurveUse& b) {
      const CurveSupport &p = from_.model.support(a), &q = to_.support(b);
      return match_.face[a.face] == b.face && a.curve == b.curve && a.reversed == b.reversed && p.t == q.t && p.uv == q.uv && p.xyz == q.xyz;
    });
  }

  /// Uses of the old curve in a face, and uses of the new curve that may be theirs.
  struct Seam {
    std::size_t curve;
    std::vector<std::int32_t> from, to;
  };

  [[nodiscard]] std::vector<Seam> uses_in_face(std::size_t f) const {
    std::vector<Seam> seams;
    std::vector<int> curves = from_.model.topology.curve_of[f];
    std::sort(curves.begin(), curves.end());
    curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
    const auto list = [](const Curve& curve, int face) {
      std::vector<std::int32_t> uses;
      for (std::size_t u = 0; u < curve.uses.size(); ++u)
        if (curve.uses[u].face == face) uses.push_back(static_cast<std::int32_t>(u));
      return uses;
    };
    for (const int c : curves)
      seams.push_back({static_cast<std::size_t>(c), list(from_.model.topology.curves[c], static_cast<int>(f)),
                       list(to_.topology.curves[match_.curve[c]], match_.face[f])});
    return seams;
  }

  /// Places of the vertices on the boundary.
  struct Boundary {
    std::vector<char> known;
    std::vector<Vec2> uv;
    double mismatch = infinity;  // sum of distances of places of one corner
    double area = 0;             // twice, in (u, v)
  };

  // `turned`: bits of seams whose two uses have changed places.
  [[nodiscard]] Boundary boundary(std::size_t f, const std::vector<CurveSide>& sides, const std::vector<Seam>& seams, unsigned turned) const {
    const FaceMesh& face = from_.result.mesh.faces[f];
    Boundary found{std::vector<char>(face.uv.size(), 0), std::vector<Vec2>(face.uv.size(), Vec2{0, 0}), 0, 0};
    std::map<std::pair<std::size_t, std::int32_t>, std::int32_t> use_of;
    unsigned bit = 1;
    for (const Seam& seam : seams) {
      const bool swap = seam.from.size() == 2 && (turned & bit) != 0;
      if (seam.from.size() == 2) bit <<= 1;
      for (std::size_t i = 0; i < seam.from.size() && i < seam.to.size(); ++i) use_of[{seam.curve, seam.from[i]}] = seam.to[swap ? 1 - i : i];
    }
    std::map<std::int32_t, double> poles;  // lengths of their sides
    for (const Seam& seam : seams)
      for (const std::int32_t use : seam.from)
        if (const DiscreteCurve& d = curves_from_[seam.curve]; d.indivisible)
          poles[from_.result.mesh.curves[seam.curve].vertices.front()] = norm(d.uv_of_use[use].back() - d.uv_of_use[use].front());
    for (const CurveSide& side : sides) {
      const auto use = use_of.find({static_cast<std::size_t>(side.curve), side.use});
      if (use == use_of.end()) continue;
      const CurveMesh& before = from_.result.mesh.curves[side.curve];
      const DiscreteCurve& after = curves_to_[match_.curve[side.curve]];
      const std::vector<Vec2>& places = after.uv_of_use[use->second];
      const auto place = [&](std::int32_t k) { return places[match_.reversed[side.curve] != 0 ? after.segments() - k : k]; };
      const bool forward = before.vertices[side.segment] == face.vertex[side.a];
      const Vec2 at_a = place(side.segment + (forward ? 0 : 1)), at_b = place(side.segment + (forward ? 1 : 0));
      const std::vector<Vec2>& old = curves_from_[side.curve].uv_of_use[side.use];
      for (const auto& [v, at, k] : {std::tuple(side.a, at_a, forward ? 0 : 1), std::tuple(side.b, at_b, forward ? 1 : 0)}) {
        // At a pole a side of a flattened triangle is one with the curve in space, but not in (u, v).
        if (const auto pole = poles.find(face.vertex[v]); pole != poles.end() && norm(face.uv[v] - old[side.segment + k]) > 1e-3 * pole->second) continue;
        if (found.known[v] != 0) found.mismatch += norm(found.uv[v] - at);
        found.known[v] = 1, found.uv[v] = at;
      }
    }
    for (const Seam& seam : seams)
      for (const std::int32_t use : seam.from)
        if (const auto image = use_of.find({seam.curve, use}); image != use_of.end()) place_on_pole(face, seam.curve, use, image->second, found);
    for (const auto* list : {&face.triangles, &face.flattened})
      for (const auto& t : *list)
        for (std::size_t i = 0; i < 3; ++i) {
          const std::int32_t a = t[i], b = t[(i + 1) % 3];
          // Sides inside, known at both ends, come twice and cancel.
          if (found.known[a] != 0 && found.known[b] != 0) found.area += found.uv[a].x() * found.uv[b].y() - found.uv[a].y() * found.uv[b].x();
        }
    return found;
  }

  // Vertices on a side of (u, v) that is a point of space, at their shares of the side.
  void place_on_pole(const FaceMesh& face, std::size_t c, std::int32_t use, std::int32_t image, Boundary& found) const {
    const DiscreteCurve &before = curves_from_[c], &after = curves_to_[match_.curve[c]];
    if (!before.indivisible) return;
    const std::int32_t pole = from_.result.mesh.curves[c].vertices.front();
    const Vec2 a = before.uv_of_use[use].front(), side = before.uv_of_use[use].back() - a;
    const Vec2 &p = after.uv_of_use[image].front(), &q = after.uv_of_use[image].back();
    const double square = dot(side, side);
    if (!(square > 0)) return;
    const auto share = [&](std::size_t v) { return dot(face.uv[v] - a, side) / square; };
    const auto lies_on = [&](std::size_t v) {
      const double s = share(v);
      const Vec2 off = face.uv[v] - a - s * side;
      return face.vertex[v] == pole && s > -rounding_of::sizes && s < 1 + rounding_of::sizes && dot(off, off) <= rounding_of::sizes * square;
    };
    double turned = 0;  // known ends give the direction
    for (std::size_t v = 0; v < face.uv.size(); ++v)
      if (found.known[v] != 0 && lies_on(v)) turned += (share(v) < 0.5 ? 1 : -1) * (norm(found.uv[v] - p) - norm(found.uv[v] - q));
    for (std::size_t v = 0; v < face.uv.size(); ++v)
      if (found.known[v] == 0 && lies_on(v)) found.known[v] = 1, found.uv[v] = turned > 0 ? lerp(q, p, share(v)) : lerp(p, q, share(v));
  }

  [[nodiscard]] Boundary best_boundary(std::size_t f, const ElementWork& work) const {
    const std::vector<CurveSide> sides = curve_sides(work, f);
    const std::vector<Seam> seams = uses_in_face(f);
    // All choices of sides of so many seams are tried, 64 at most.
    const auto doubled = std::min<std::ptrdiff_t>(
        6, std::count_if(seams.begin(), seams.end(), [](const Seam& seam) { return seam.from.size() == 2; }));
    Boundary best;
    for (unsigned turned = 0; turned < 1U << doubled; ++turned) {
      Boundary now = boundary(f, sides, seams, turned);
      const double least = best.mismatch - 1e-9 * (1 + best.mismatch);
      if (now.mismatch < least || (now.mismatch <= best.mismatch + 1e-9 && now.area > 0 && best.area <= 0)) best = std::move(now);
    }
    return best;
  }

  void place_points(const Face& before, const Face& after, const FaceMesh& mesh, Boundary& places) const {
    for (std::size_t i = 0; i < before.points.size() && i < after.points.size(); ++i)
      for (std::size_t v = 0; v < mesh.uv.size(); ++v)
        if (places.known[v] == 0 && mesh.uv[v] == before.points[i].uv) {
          places.known[v] = 1, places.uv[v] = after.points[i].uv;
          out_.mesh.vertex_ref[mesh.vertex[v]] = after.points[i].ref;
        }
  }

  [[nodiscard]] static bool agree(const FaceMesh& before, const Boundary& places) {
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};
    for (const Vec2& p : before.uv) low = low.cwiseMin(p), high = high.cwiseMax(p);
    for (std::size_t v = 0; v < before.uv.size(); ++v)
      if (places.known[v] != 0)
        for (int i = 0; i < 2; ++i)
          if (std::abs(places.uv[v][i] - before.uv[v][i]) > rounding_of::sizes * (high[i] - low[i])) return false;
    return true;
  }

  void carry_face(const ElementWork& work, std::size_t f) {
    const FaceMesh& before = from_.result.mesh.faces[f];
    const Face& model = to_.model.faces[match_.face[f]];
    FaceMesh& after = out_.mesh.faces[match_.face[f]];
    after.ref = model.ref, after.name = model.name, after.rgb = model.rgb, after.part_of = model.part_of;
    after.status = before.status, after.why = before.why;
    if (before.triangles.empty()) return;
    after.status = FaceStatus::meshed, after.why.clear();
    Boundary places = best_boundary(f, work);
    const std::vector<int>& around = from_.model.topology.curve_of[f];
    // A boundary that has not changed keeps its places, whatever gaps its curves have in space.
    if (std::all_of(around.begin(), around.end(), [&](int c) { return is_unchanged(static_cast<std::size_t>(c), static_cast<std::size_t>(match_.curve[c])); }))
      for (std::size_t v = 0; v < before.uv.size(); ++v)
        if (places.known[v] != 0) places.uv[v] = before.uv[v];
    place_points(from_.model.model.faces[f], model, before, places);
    after.vertex = before.vertex;
    const bool same = agree(before, places);
    std::vector<std::array<std::int32_t, 3>> all = before.triangles;
    all.insert(all.end(), before.flattened.begin(), before.flattened.end());
    after.uv = places.uv;
    if (same)
      for (std::size_t v = 0; v < after.uv.size(); ++v) {
        if (places.known[v] == 0) after.uv[v] = before.uv[v];
      }
    else
      map_harmonically(before.uv, all, places.known, after.uv);
    ++(same ? report_.kept : report_.relaxed);
    const bool flipped = places.area < 0;
    flipped_[f] = flipped ? 1 : 0;
    std::vector<std::int32_t> identity(before.uv.size());
    std::iota(identity.begin(), identity.end(), 0);
    carry_elements(before, identity, flipped, after);
    after.flattened = before.flattened;
    if (flipped)
      for (auto& [a, b, c] : after.flattened) std::swap(b, c);
    settle(after, places);
  }

  // Corners of quadrilaterals are triangles too: elements stay convex.
  static std::vector<std::array<std::int32_t, 3>> judged(const FaceMesh& face) {
    std::vector<std::array<std::int32_t, 3>> all = face.triangles;
    for (std::size_t k = 0; k < static_cast<std::size_t>(face.quads); ++k) {
      const auto [a, b, c, d] = face.quad(k);
      all.push_back({a, b, d}), all.push_back({b, c, d});
    }
    all.insert(all.end(), face.flattened.begin(), face.flattened.end());
    return all;
  }

  void settle(FaceMesh& face, const Boundary& places) {
    const std::vector<std::array<std::int32_t, 3>> all = judged(face);
    const std::vector<std::int32_t> turned = untangle(all, places.known, face.uv);
    std::vector<std::size_t> asked;
    std::vector<Vec2> uv;
    for (std::size_t v = 0; v < face.uv.size(); ++v)
      if (places.known[v] == 0 || is_point(face, v)) asked.push_back(v), uv.push_back(face.uv[v]);
    for_batches(to_.cad, face.ref, want_position, uv, monitor_,
                [&](std::size_t first, std::span<const Vec2> here, std::span<const SurfaceJet> jets) {
                  for (std::size_t k = 0; k < here.size(); ++k) out_.mesh.vertices[face.vertex[asked[first + k]]] = jets[k].s;
                });
    if (turned.empty()) return;
    ++report_.failed;
    const auto t = static_cast<std::size_t>(turned.front());
    const std::int32_t at = all[t][0];
    face.status = FaceStatus::failed;
    face.why = Where{.face = face.shown_ref(), .uv = face.uv[at]}.prefix() + std::to_string(turned.size()) +
               (turned.size() == 1 ? " triangle of the carried mesh stays" : " triangles of the carried mesh stay") + " turned, the first one triangle " +
               std::to_string(std::min(t, face.triangles.size() - 1)) + " of the face at " + format_point(out_.mesh.vertices[face.vertex[at]]);
    monitor_.message(Level::error, face.why);
    face.triangles.clear(), face.flattened.clear(), face.quads = 0;
    face.uv.clear(), face.vertex.clear();
  }

  // A vertex inside of the face that the model imposes.
  [[nodiscard]] bool is_point(const FaceMesh& face, std::size_t v) const {
    const auto& points = to_.model.faces[static_cast<std::size_t>(&face - out_.mesh.faces.data())].points;
    return std::any_of(points.begin(), points.end(), [&](const FacePoint& point) { return point.uv == face.uv[v]; });
  }

  /// The edge of a curve of the mesh before that has a node.
  struct NodeOfCurve {
    std::size_t curve = 0, segment = 0;
    bool is_known = false;  ///< false: the node lies inside a face
  };

  // Nodes of curves keep their shares of the length, nodes inside their places beside the ends of their edges, so that they too are smooth
  // functions of the geometry. Returns false, with no node, if an element is invalid then: nodes are to be made anew.
  bool carry_nodes() {
    const SurfaceMesh& old = from_.result.mesh;
    SurfaceMesh& mesh = out_.mesh;
    if (report_.failed > 0) return false;
    mesh.mid_vertices = old.mid_vertices;
    std::vector<NodeOfCurve> on_curve(old.mid_vertices.size());
    std::vector<DiscreteCurve> fine(old.curves.size());
    for (std::size_t c = 0; c < old.curves.size(); ++c)
      if (!old.curves[c].mid.empty() && !carry_curve_nodes(c, fine[c], on_curve)) return discard_nodes();
    for (std::size_t f = 0; f < old.faces.size(); ++f)
      if (!old.faces[f].mid.empty()) carry_face_nodes(f, fine, on_curve);
    const ElementWork work{to_, curves_to_, rules_, options_, out_, monitor_};
    QuadraticReport report;
    report.quads.resize(mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      if (!mesh.faces[f].mid.empty()) find_invalid(work, f, report);
    return report.invalid.empty() || discard_nodes();
  }

  bool discard_nodes() {
    out_.mesh.mid_vertices.clear();
    for (CurveMesh& curve : out_.mesh.curves) curve.mid.clear();
    for (FaceMesh& face : out_.mesh.faces) face.mid.clear(), face.mid_uv.clear(), face.mid_vertex.clear();
    return false;
  }

  // `fine`: the curve with its nodes between its vertices.
  bool carry_curve_nodes(std::size_t c, DiscreteCurve& fine, std::vector<NodeOfCurve>& on_curve) {
    const SurfaceMesh& old = from_.result.mesh;
    const CurveMesh& before = old.curves[c];
    const auto d = static_cast<std::size_t>(match_.curve[c]);
    const DiscreteCurve &known = curves_from_[c], &to = curves_to_[d];
    const bool back = match_.reversed[c] != 0;
    const auto n = static_cast<std::size_t>(known.segments());
    if (to.indivisible || known.indivisible || before.mid.size() != n || to.segments() != known.segments()) return false;
    const auto owner = static_cast<std::size_t>(known.owner);
    const CurveUse &use = from_.model.curve(known.curve).uses[owner], &first = to_.curve(to.curve).uses.front();
    const CurveSupport& support = from_.model.support(use);
    std::vector<double> r;
    for (std::size_t k = 0; k < n; ++k) {
      const auto [low, high] = std::minmax(known.t_of_use[owner][k], known.t_of_use[owner][k + 1]);
      const double t = find_closest(from_.model, use, (low + high) / 2, low, high, old.mid_vertices[before.mid[k]]).t;
      const double share = support.arc_at_t(t) / support.length();
      r.push_back(use.reversed ? 1 - share : share);
      if (k + 1 < n) r.push_back(known.r[k + 1]);
      on_curve[before.mid[k]] = {c, k, true};
    }
    if (back) {
      std::reverse(r.begin(), r.end());
      for (double& share : r) share = 1 - share;
    }
    std::vector<double> t;
    for (const double share : r) t.push_back(parameter_at(to_, first, share));
    fine = to;
    place_vertices_at(fine, r, t, to_);
    CurveMesh& after = out_.mesh.curves[d];
    after.mid = before.mid;
    if (back) std::reverse(after.mid.begin(), after.mid.end());
    for (std::size_t k = 0; k < n; ++k) out_.mesh.mid_vertices[after.mid[k]] = fine.xyz[2 * k + 1];
    return true;
  }

  void carry_face_nodes(std::size_t f, const std::vector<DiscreteCurve>& fine, const std::vector<NodeOfCurve>& on_curve) {
    const FaceMesh& before = from_.result.mesh.faces[f];
    FaceMesh& after = out_.mesh.faces[match_.face[f]];
    const bool flipped = flipped_[f] != 0;
    carry_mids(before, flipped, after);
    after.mid_vertex = before.mid_vertex, after.mid_uv.assign(before.mid_uv.size(), Vec2{0, 0});
    std::vector<char> done(before.mid_uv.size(), 0);
    std::vector<std::int32_t> inside;
    std::vector<Vec2> uv;
    for (std::size_t t = 0; t < before.mid.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t mid = before.mid[t][i];
        if (mid < 0 || std::exchange(done[mid], 1) != 0) continue;
        const std::int32_t a = before.triangles[t][i], b = before.triangles[t][(i + 1) % 3];
        const Vec2 &p = before.uv[a], &q = after.uv[a];
        const Vec2 edge = before.uv[b] - p, there = after.uv[b] - q, off = before.mid_uv[mid] - p;
        if (const NodeOfCurve& on = on_curve[before.mid_vertex[mid]]; on.is_known) {
          after.mid_uv[mid] = nearest_side(f, fine[on.curve], on, q + 0.5 * there);
          continue;
        }
        // The quotient of complex numbers off / edge, turned if the face is.
        const double square = dot(edge, edge), along = dot(off, edge) / square, beside = (flipped ? -1 : 1) * (edge.x() * off.y() - edge.y() * off.x()) / square;
        after.mid_uv[mid] = agrees(before, after, a, b) ? before.mid_uv[mid] : Vec2(q + along * there + beside * Vec2(-there.y(), there.x()));
        inside.push_back(mid), uv.push_back(after.mid_uv[mid]);
      }
    for_batches(to_.cad, after.ref, want_position, uv, monitor_, [&](std::size_t first, std::span<const Vec2> here, std::span<const SurfaceJet> jets) {
      for (std::size_t k = 0; k < here.size(); ++k) out_.mesh.mid_vertices[after.mid_vertex[inside[first + k]]] = jets[k].s;
    });
  }

  static bool agrees(const FaceMesh& before, const FaceMesh& after, std::int32_t a, std::int32_t b) {
    return before.uv[a] == after.uv[a] && before.uv[b] == after.uv[b];
  }

  // (u, v) of a node of a curve in the face, near a place: a seam has two.
  [[nodiscard]] Vec2 nearest_side(std::size_t f, const DiscreteCurve& fine, const NodeOfCurve& on, const Vec2& near) const {
    const std::vector<CurveUse>& uses = to_.curve(fine.curve).uses;
    const std::size_t k = match_.reversed[on.curve] != 0 ? static_cast<std::size_t>(curves_from_[on.curve].segments()) - 1 - on.segment : on.segment;
    Vec2 best = near;
    double least = infinity;
    for (std::size_t u = 0; u < uses.size(); ++u)
      if (uses[u].face == match_.face[f])
        if (const double apart = norm(fine.uv_of_use[u][2 * k + 1] - near); apart < least) best = fine.uv_of_use[u][2 * k + 1], least = apart;
    return best;
  }

  void make_nodes() {
    const ElementWork work{to_, curves_to_, rules_, options_, out_, monitor_};
    QuadraticReport made = make_quadratic(work);
    if (const std::vector<CuspEnd> cusps = made.cusps; !cusps.empty()) made = make_quadratic(work, cusps);
    for (const InvalidElements& invalid : made.invalid)
      monitor_.message(Level::warning, mark_invalid(out_.mesh.faces[invalid.face], invalid.uv, invalid.count));
  }

  const MeshOfModel& from_;
  const CurveModel& to_;
  const ModelMatch& match_;
  const SizeRules& rules_;
  const CompositeOptions& options_;
  Monitor& monitor_;
  CompositeResult& out_;
  std::vector<char> flipped_;  // by face of the mesh before: its elements turn the other way
  std::vector<DiscreteCurve> curves_from_, curves_to_;  // by curve of either topology
  CarryReport report_;
};

}  // namespace

CarryReport carry_mesh(const MeshOfModel& from, const CurveModel& to, const ModelMatch& match, const SizeRules& rules,
                       const CompositeOptions& options, Monitor& monitor, CompositeResult& out) {
  return Carrier(from, to, match, rules, options, monitor, out).run();
}

}  // namespace carreau
