// SPDX-License-Identifier: BSD-3-Clause
#include "projection/projector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>

#include "cad/checked_cad.h"
#include "cad/part_cad.h"
#include "geometry/discrete/discrete_cad.h"
#include "geometry/discrete/refinement.h"
#include "projection/face_boundary.h"
#include "projection/point_search.h"
#include "projection/thresholds.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/pieces.h"
#include "support/stepped_tasks.h"
#include "surface/supports.h"

namespace carreau {

using namespace projection;

namespace {

constexpr unsigned everything = want_position | want_first | want_second;
constexpr double support_angle = 2;  // degrees: edges of supports are leaves of curves

PartCad::Parts curve_parts_of(const Model& model) {
  PartCad::Parts parts;
  for (const Face& face : model.faces)
    for (std::size_t c = 0; c < face.curves.size(); ++c)
      if (const FaceCurve& curve = face.curves[c]; curve.part_of != 0) parts[{face.ref, static_cast<int>(c) + 1}] = {curve.part_of, curve.part_a, curve.part_b};
  return parts;
}

/// Along a curve of a face, as a surface that does not depend on v.
SurfaceJet along(const SurfaceJet& s, const CurveJet& c) {
  const double u = c.ct.x(), v = c.ct.y();
  SurfaceJet jet;
  jet.s = s.s;
  jet.su = u * s.su + v * s.sv;
  jet.suu = (u * u) * s.suu + (2 * u * v) * s.suv + (v * v) * s.svv + c.ctt.x() * s.su + c.ctt.y() * s.sv;
  return jet;
}

std::string kind_of(int dimension) { return dimension == 2 ? "face" : dimension == 1 ? "curve" : "point"; }

/// The ranks of points along Morton's curve through their box: points that follow each other are mostly neighbours.
std::vector<std::int64_t> along_curve(std::span<const Vec3> x) {
  BoxTree::Box box;
  for (const Vec3& p : x) box.add(p);
  constexpr std::uint32_t cells = 1U << 10U;
  const auto spread = [](std::uint32_t bits) {  // two zeros after each bit
    bits = (bits | bits << 16U) & 0x030000ffU, bits = (bits | bits << 8U) & 0x0300f00fU;
    bits = (bits | bits << 4U) & 0x030c30c3U;
    return (bits | bits << 2U) & 0x09249249U;
  };
  const Vec3 size = box.high - box.low;
  std::vector<std::uint32_t> keys;
  keys.reserve(x.size());
  for (const Vec3& p : x) {
    std::uint32_t key = 0;
    for (int k = 0; k < 3; ++k) {
      const double share = size[k] > 0 ? (p[k] - box.low[k]) / size[k] : 0;
      key |= spread(std::min(static_cast<std::uint32_t>(share * cells), cells - 1)) << static_cast<unsigned>(k);
    }
    keys.push_back(key);
  }
  std::vector<std::int64_t> ranks(x.size()), other(x.size());
  std::iota(ranks.begin(), ranks.end(), std::int64_t{0});
  for (const unsigned shift : {0U, 10U, 20U}) {  // by ten bits at a time
    std::array<std::size_t, 1025> first{};
    const auto digit = [&](std::int64_t rank) { return (keys[static_cast<std::size_t>(rank)] >> shift) & 1023U; };
    for (const std::int64_t rank : ranks) ++first[digit(rank) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const std::int64_t rank : ranks) other[first[digit(rank)]++] = rank;
    ranks.swap(other);
  }
  return ranks;
}

[[noreturn]] void report_unknown(int dimension, int ref) {
  throw InvalidArgument("the model has no " + kind_of(dimension) + " with the reference " + std::to_string(ref));
}

}  // namespace

struct Projector::State {
  State(std::shared_ptr<Cad> source, std::shared_ptr<const discrete::DiscreteCad> of_triangles, const Model& of)
      : host(std::move(source)), triangles(std::move(of_triangles)), model(of), checked(*host), cad(checked, curve_parts_of(of)) {
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
      const Face& face = model.faces[f];
      if (!face.left_out.empty()) continue;
      if (!face.is_wire()) faces.emplace(face.ref, f);
      for (std::size_t c = 0; c < face.curves.size(); ++c) curves.emplace(face.curves[c].ref, CurvePlace{f, c});
    }
  }

  struct CurvePlace {
    std::size_t face = 0, curve = 0;  // indices
  };

  [[nodiscard]] bool bound() const { return !cad.reentrant(); }
  [[nodiscard]] std::size_t face_of(int ref) const {
    const auto found = faces.find(ref);
    if (found == faces.end()) report_unknown(2, ref);
    return found->second;
  }

  void evaluate_face(std::size_t f, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
    const Face& face = model.faces[f];
    if (!face.discrete) return cad.surface(face.ref, want, uv, out);
    for (std::size_t k = 0; k < uv.size(); ++k) {
      const std::int32_t triangle = triangles->patch_of(uv[k]);
      if (triangle < 0) throw InvalidArgument(Where{.face = face.ref, .uv = uv[k]}, "no triangle has this place");
      out[k] = triangles->discrete().at(triangle, uv[k] - triangles->corner_of_tile(triangle), want);
    }
  }

  /// Beyond the domain of a face its host may fail.
  void evaluate_about(std::size_t f, const TrimmedDomain* domain, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) {
    if (domain == nullptr) return evaluate_face(f, want, uv, out);
    try {
      return evaluate_face(f, want, uv, out);
    } catch (const CallbackError&) {  // one of them fails
    }
    for (std::size_t k = 0; k < uv.size(); ++k) try {
        evaluate_face(f, want, uv.subspan(k, 1), out.subspan(k, 1));
      } catch (const CallbackError&) {
        if (domain->contains(uv[k], cad)) throw;
        out[k].s = {std::nan(""), std::nan(""), std::nan("")};
      }
  }

  /// Remembers a face on which the host fails; which of its errors does not depend on the threads.
  void keep_failure(std::size_t f, const CallbackError& error, std::map<int, std::string>& to) {
    const std::lock_guard guard(failing);
    const auto [at, first] = to.emplace(model.faces[f].ref, error.what());
    if (!first && error.what() < at->second) at->second = error.what();
  }

  void prepare(int threads, Monitor& monitor);
  void collect_points();
  void search(const PieceTree& tree, std::span<const Vec3> x, std::span<const std::int64_t> ranks, std::span<ProjectedPoint> out, bool of_curves, std::map<int, std::string>& failed, Monitor& monitor);
  void nearest_points(std::optional<int> ref, std::span<const Vec3> x, std::span<ProjectedPoint> out) const;

  std::shared_ptr<Cad> host;
  std::shared_ptr<const discrete::DiscreteCad> triangles;
  Model model;
  CheckedCad checked;
  PartCad cad;
  std::map<int, std::size_t> faces;
  std::map<int, CurvePlace> curves;  // the first use decides

  std::mutex failing;
  std::map<int, std::string> failed_at_first;  // faces without pieces
  bool prepared = false;
  ModelSupports supports;
  double diagonal = 0;
  std::vector<Pieces> of_faces;                 // by index
  std::vector<Pieces> of_curves;                // by rank in curve_refs
  std::vector<int> curve_refs;                  // ascending
  /// Trees by dimension and entity (its index or rank; -1: all), made when they are first needed.
  const PieceTree& tree_of(int dimension, std::int32_t only) {
    return trees.try_emplace({dimension, only}, dimension == 2 ? of_faces : of_curves, only).first->second;
  }
  std::map<std::pair<int, std::int32_t>, PieceTree> trees;
  std::vector<std::pair<int, Vec3>> points;     // ascending references
  BoxTree point_tree;
};

void Projector::State::prepare(int threads, Monitor& monitor) {
  if (prepared) return;
  Model with_curves = model;
  for (Face& face : with_curves.faces)
    if (!face.left_out.empty() || face.discrete) face.curves.clear();
  supports = build_supports(with_curves, cad, support_angle, threads, monitor);
  for (const auto& [ref, f] : faces) {
    if (model.faces[f].discrete) continue;
    const auto [low, high] = box_of_boundary(model.faces[f], supports.of_face[f]);
    if (low.x() < high.x() && low.y() < high.y()) cad.set_parameter_box(ref, low, high);
  }
  std::vector<std::vector<Region>> regions(model.faces.size());
  if (triangles) {
    const std::vector<std::int32_t> refs = discrete::face_refs(triangles->discrete());
    for (std::size_t t = 0; t < refs.size(); ++t) {
      const auto face = faces.find(refs[t]);
      if (face == faces.end() || !model.faces[face->second].discrete) continue;
      const Vec2 corner = triangles->corner_of_tile(static_cast<std::int32_t>(t));
      regions[face->second].push_back({corner, corner + Vec2(1, 1), true});
    }
  }
  of_faces.assign(model.faces.size(), {});
  const auto make = [&](std::size_t f, Monitor& here) {
    const Face& face = model.faces[f];
    if (!face.left_out.empty() || face.is_wire()) return;
    if (face.discrete) {
      of_faces[f] = pieces_of_triangles(regions[f], [&](std::span<const Vec2> uv, std::span<SurfaceJet> jets) { evaluate_face(f, want_position, uv, jets); }, here);
      return;
    }
    const auto [low, high] = box_of_boundary(face, supports.of_face[f]);
    std::optional<TrimmedDomain> domain;  // answers where the host fails
    if (low.x() < high.x() && low.y() < high.y() && !is_box(face, supports.of_face[f], low, high)) domain.emplace(face.ref, boundary_of(face, supports.of_face[f]));
    of_faces[f] = pieces_of_face(model, f, supports.of_face[f],
                                 [&](std::span<const Vec2> uv, std::span<SurfaceJet> jets) {
                                   evaluate_about(f, domain ? &*domain : nullptr, want_position, uv, jets);
                                 },
                                 here);
  };
  failed_at_first.clear();
  const auto make_or_fail = [&](std::size_t f, Monitor& here) {
    try {
      make(f, here);
    } catch (const CallbackError& error) {
      of_faces[f] = {};
      keep_failure(f, error, failed_at_first);
    }
  };
  run_each(model.faces.size(), bound(), threads, make_or_fail, monitor);
  if (!faces.empty() && failed_at_first.size() == faces.size()) throw CallbackError(failed_at_first.begin()->second);
  for (const auto& [ref, place] : curves) {
    curve_refs.push_back(ref);
    of_curves.push_back(pieces_of_curve(static_cast<int>(place.face), static_cast<int>(place.curve), supports.of_face[place.face][place.curve]));
  }
  collect_points();
  BoxTree::Box box;
  for (const auto* list : {&of_faces, &of_curves})
    for (const Pieces& each : *list)
      if (!each.boxes.empty()) box.add(each.box);
  diagonal = box.low.x() <= box.high.x() ? norm(box.high - box.low) : 0;
  prepared = true;
}

void Projector::State::collect_points() {
  std::map<int, Vec3> known;
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const Face& face = model.faces[f];
    for (std::size_t c = 0; c < supports.of_face[f].size(); ++c) {
      known.emplace(face.curves[c].end1, supports.of_face[f][c].xyz.front());
      known.emplace(face.curves[c].end2, supports.of_face[f][c].xyz.back());
    }
    if (face.left_out.empty() && !face.discrete)
      for (const FacePoint& point : face.points) known.emplace(point.ref, surface_at(cad, face.ref, want_position, point.uv).s);
  }
  points.assign(known.begin(), known.end());
  std::vector<BoxTree::Box> boxes;
  std::vector<Vec3> centres;
  for (const auto& [ref, at] : points) {
    boxes.emplace_back().add(at);
    centres.push_back(at);
  }
  point_tree = BoxTree(boxes, centres);
}

void Projector::State::nearest_points(std::optional<int> ref, std::span<const Vec3> x, std::span<ProjectedPoint> out) const {
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::int32_t best = -1;
    double least = infinity;
    const auto look = [&](std::int32_t p) {
      const Vec3 r = points[static_cast<std::size_t>(p)].second - x[i];
      if (const double d = dot(r, r); d < least || (d == least && p < best)) least = d, best = p;
    };
    if (ref) {
      const auto found = std::lower_bound(points.begin(), points.end(), *ref, [](const auto& point, int r) { return point.first < r; });
      if (found == points.end() || found->first != *ref) report_unknown(0, *ref);
      look(static_cast<std::int32_t>(found - points.begin()));
    } else {
      if (points.empty()) throw InvalidArgument("the model has no point");
      point_tree.nearest_first([&](std::int32_t n) { return point_tree.node(static_cast<std::size_t>(n)).box.squared_distance(x[i]); },
                               [&](double bound) { return bound <= least; },
                               [&](const BoxTree::Node& leaf) {
                                 for (const std::int32_t p : point_tree.things(leaf)) look(p);
                               });
    }
    out[i] = {points[static_cast<std::size_t>(best)].first, {}, points[static_cast<std::size_t>(best)].second, std::sqrt(least)};
  }
}

// All searches go on together: their places go to the host face by face. `ranks`: of the points in x and out; neighbours follow each other.
void Projector::State::search(const PieceTree& tree, std::span<const Vec3> x, std::span<const std::int64_t> ranks, std::span<ProjectedPoint> out, bool of_curve,
                              std::map<int, std::string>& failed, Monitor& monitor) {
  std::vector<PointSearch> searches;
  searches.reserve(ranks.size());
  SearchGroup group;
  std::vector<Vec3> places;
  places.reserve(ranks.size());
  for (const std::int64_t rank : ranks) places.push_back(x[static_cast<std::size_t>(rank)]);
  for (std::size_t i = 0; i < places.size(); ++i) searches.emplace_back(tree, std::span<const Vec3>(places).subspan(i), diagonal, group);
  struct Asked {
    PlaceRequest place;
    std::size_t search = 0;
    CurveJet curve;
  };
  std::vector<Asked> asked;
  std::vector<std::uint64_t> order;  // by face and search
  std::vector<std::size_t> going(ranks.size());
  std::iota(going.begin(), going.end(), std::size_t{0});
  std::vector<Vec2> uv;
  std::vector<SurfaceJet> jets;
  while (true) {
    monitor.checkpoint();
    going.erase(std::remove_if(going.begin(), going.end(), [&](std::size_t i) { return !searches[i].goes_on(); }), going.end());
    if (going.empty()) break;
    asked.clear();
    order.clear();
    for (std::size_t k = 0; k < going.size(); ++k) order.push_back(static_cast<std::uint64_t>(searches[going[k]].request().face) << 32U | k);
    std::sort(order.begin(), order.end());
    for (const std::uint64_t each : order) {
      const std::size_t search = going[each & 0xffffffffU];
      asked.push_back({searches[search].request(), search, {}});
    }
    for (std::size_t first = 0, end = 0; first < asked.size(); first = end) {
      const auto face = static_cast<std::size_t>(asked[first].place.face);
      uv.clear();
      for (end = first; end < asked.size() && asked[end].place.face == asked[first].place.face; ++end) {
        Asked& each = asked[end];
        if (each.place.curve >= 0) each.curve = cad.curve(model.faces[face].ref, each.place.curve + 1, everything, each.place.parameters.x());
        uv.push_back(each.place.curve >= 0 ? each.curve.c : each.place.parameters);
      }
      jets.resize(uv.size());
      const auto& domain = of_faces[face].domain;
      try {
        evaluate_about(face, domain ? &*domain : nullptr, everything, uv, jets);
      } catch (const CallbackError& error) {
        keep_failure(face, error, failed);
        SurfaceJet none;
        none.s = {std::nan(""), std::nan(""), std::nan("")};
        std::fill(jets.begin(), jets.end(), none);
      }
      for (std::size_t k = first; k < end; ++k) {
        const Asked& each = asked[k];
        const SurfaceJet& jet = jets[k - first];
        searches[each.search].take(each.place.curve >= 0 ? along(jet, each.curve) : jet, cad);
      }
    }
  }
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const PointSearch::Found& best = searches[i].best();
    if (best.entity < 0) {
      const std::lock_guard guard(failing);
      if (!failed.empty()) throw CallbackError(failed.begin()->second);
      throw InvalidArgument("no point of the model was found for point " + std::to_string(ranks[i]));
    }
    const auto entity = static_cast<std::size_t>(best.entity);
    ProjectedPoint& to = out[static_cast<std::size_t>(ranks[i])];
    to = {of_curve ? curve_refs[entity] : model.faces[entity].ref, best.place.parameters, best.xyz, std::sqrt(best.square)};
    if (!of_curve && best.place.curve >= 0)  // on the boundary of a face
      to.parameters = cad.curve(model.faces[entity].ref, best.place.curve + 1, want_position, best.place.parameters.x()).c;
  }
}

Projector::Projector(std::shared_ptr<Cad> cad, std::shared_ptr<const discrete::DiscreteCad> triangles, const Model& model)
    : state_(std::make_unique<State>(std::move(cad), std::move(triangles), model)) {}
Projector::~Projector() = default;

void Projector::evaluate(int dimension, int ref, unsigned want, std::span<const Vec2> parameters, std::span<SurfaceJet> out, int threads,
                         Monitor& monitor) {
  State& s = *state_;
  constexpr std::size_t at_once = 4096;
  const std::size_t tasks = (parameters.size() + at_once - 1) / at_once;
  const auto part = [&](auto span, std::size_t k) { return span.subspan(k * at_once, std::min(at_once, span.size() - k * at_once)); };
  if (dimension == 2) {
    const std::size_t f = s.face_of(ref);
    return run_each(tasks, s.bound(), threads,
                    [&](std::size_t k, Monitor& here) {
                      here.checkpoint();
                      s.evaluate_face(f, want, part(parameters, k), part(out, k));
                    },
                    monitor);
  }
  const auto found = s.curves.find(ref);
  if (found == s.curves.end()) report_unknown(1, ref);
  const auto [f, c] = found->second;
  const int face = s.model.faces[f].ref, ic = static_cast<int>(c) + 1;
  const unsigned of_surface = (want & want_second) != 0 ? everything : want;
  run_each(tasks, s.bound(), threads,
           [&](std::size_t k, Monitor& here) {
             here.checkpoint();
             const std::span<const Vec2> t = part(parameters, k);
             const std::span<SurfaceJet> jets = part(out, k);
             std::vector<CurveJet> curve;
             std::vector<Vec2> uv;
             for (const Vec2& each : t) curve.push_back(s.cad.curve(face, ic, want | want_position, each.x())), uv.push_back(curve.back().c);
             s.cad.surface(face, of_surface, uv, jets);
             for (std::size_t i = 0; i < jets.size(); ++i) jets[i] = along(jets[i], curve[i]);
           },
           monitor);
}

std::map<int, std::string> Projector::project(int dimension, int ref, std::span<const Vec3> x, std::span<ProjectedPoint> out, int threads, Monitor& monitor) {
  State& s = *state_;
  std::int32_t only = -1;
  if (dimension == 2 && ref != 0) only = static_cast<std::int32_t>(s.face_of(ref));
  if (dimension == 2 && s.faces.empty()) throw InvalidArgument("the model has no face with an area");
  if (dimension == 1 && ref != 0 && !s.curves.contains(ref)) report_unknown(1, ref);
  if (dimension == 1 && s.curves.empty()) throw InvalidArgument("the model has no curve");
  s.prepare(threads, monitor);
  std::map<int, std::string> failed;
  if (dimension == 0) return s.nearest_points(ref != 0 ? std::optional<int>(ref) : std::nullopt, x, out), failed;
  if (dimension == 2 && ref == 0) failed = s.failed_at_first;
  if (const auto found = s.failed_at_first.find(ref); dimension == 2 && found != s.failed_at_first.end()) throw CallbackError(found->second);
  if (dimension == 1 && ref != 0)
    only = static_cast<std::int32_t>(std::lower_bound(s.curve_refs.begin(), s.curve_refs.end(), ref) - s.curve_refs.begin());
  const PieceTree& tree = s.tree_of(dimension, only);
  // The memory of so many searches, whose places go to the host together, stays in the cache of a processor. [time only]
  constexpr std::size_t each = 1024;
  const std::vector<std::int64_t> order = along_curve(x);
  run_each((x.size() + each - 1) / each, s.bound(), threads,
           [&](std::size_t k, Monitor& here) {
             const std::size_t first = k * each, n = std::min(each, x.size() - first);
             s.search(tree, x, std::span(order).subspan(first, n), out, dimension == 1, failed, here);
           },
           monitor);
  return failed;
}

double Projector::diagonal(int threads, Monitor& monitor) {
  state_->prepare(threads, monitor);
  return state_->diagonal;
}

}  // namespace carreau
