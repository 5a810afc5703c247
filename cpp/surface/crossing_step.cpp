// SPDX-License-Identifier: BSD-3-Clause
// Triangles of faces that are close to each other: chords that cross although the surfaces do not.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "mesh/crossings/shared_search.h"
#include "surface/attempts.h"
#include "surface/crossings/common_points.h"
#include "surface/parts/part_crossings.h"
#include "surface/quads/quadrilaterals.h"
#include "surface/run.h"
#include "surface/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::crossings;

/// A triangle of the whole mesh, by its face.
struct MeshTriangle {
  int face = 0, local = 0;
};

struct WholeMesh {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> first;  // by face, and one more: its first triangle

  [[nodiscard]] MeshTriangle origin(std::int32_t t) const {
    const auto next = std::upper_bound(first.begin(), first.end(), t);  // faces without triangles have none of them
    return {static_cast<int>(next - first.begin()) - 1, t - *(next - 1)};
  }
};

WholeMesh whole(const SurfaceMesh& mesh) {
  WholeMesh all;
  std::size_t n = 0;
  for (const FaceMesh& face : mesh.faces) n += face.triangles.size();
  all.triangles.reserve(n), all.first.reserve(mesh.faces.size() + 1);
  all.first.push_back(0);
  for (const FaceMesh& face : mesh.faces) {
    for (const auto& [a, b, c] : face.triangles)
      all.triangles.push_back({face.vertex[a], face.vertex[b], face.vertex[c]});
    all.first.push_back(static_cast<std::int32_t>(all.triangles.size()));
  }
  return all;
}

/// How far the surfaces are apart where two triangles cross; 0: not at all, seen from there, and smaller triangles do
/// not part them. And by what edges are to be multiplied.
struct Gap {
  double width = 0, share = 1;
};

Gap gap_at(const CompositeRun& run, const PatchTriangle& s, const PatchTriangle& t, const Vec3& place) {
  const OnSurface p(run.cad, s, s.uv_of(place)), q(run.cad, t, t.uv_of(place));
  const double on_s = norm(p.jet.s - place), on_t = norm(q.jet.s - place), width = norm(p.jet.s - q.jet.s);
  const double slope = norm(cross(p.normal, q.normal));
  if (!(std::max(on_s, on_t) > no_sagitta * run.supports.diag && width >= least_gap * std::max(on_s, on_t))) return {};
  if (width < least_width * slope * std::max(s.longest, t.longest)) return {};
  return {width, std::clamp(std::sqrt(sagitta_share * width / (on_s + on_t)), least_share, most_share)};
}

using Edge = std::pair<std::int32_t, std::int32_t>;

/// What is to be finer: edges of triangles that cross, by face, and those of them that lie on curves.
struct FinerPlaces {
  std::vector<std::vector<EdgeSizes::Source>> sources;
  std::set<Edge> edges;
  double gap = 0;  ///< between the surfaces at crossings, the median
};

void add(const SurfaceMesh& mesh, const WholeMesh& all, std::int32_t triangle, double share, FinerPlaces& places) {
  const std::array<std::int32_t, 3>& corners = all.triangles[static_cast<std::size_t>(triangle)];
  const int face = all.origin(triangle).face;
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, norm(mesh.vertices[corners[(k + 1) % 3]] - mesh.vertices[corners[k]]));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t v = corners[k], w = corners[(k + 1) % 3];
    places.sources[static_cast<std::size_t>(face)].push_back({mesh.vertices[v], mesh.vertices[w], share * longest});
    places.edges.insert(std::minmax(v, w));
  }
}

/// The mesh of the run with its crossings.
class Crossings {
 public:
  explicit Crossings(const CompositeRun& run) : mesh_(&run.result.mesh) {
    if (run.result.shares) {
      PartCrossings of_all = find_part_crossings(run, most_pairs);
      crossing_ = std::make_unique<SurfaceMesh>(std::move(of_all.mesh));
      mesh_ = crossing_.get();
      all = whole(mesh()), found = std::move(of_all.found);
      triangles = run.result.shares->triangles;
      return;
    }
    all = whole(mesh());
    found = find_intersections(mesh().vertices, all.triangles, most_pairs, {run.options.team, run.options.threads}, run.monitor);
    triangles = static_cast<std::int64_t>(all.triangles.size());
  }

  /// That of the run, or of one in parts the triangles that cross.
  [[nodiscard]] const SurfaceMesh& mesh() const noexcept { return *mesh_; }
  [[nodiscard]] PatchTriangle triangle(std::int32_t number) const {
    const MeshTriangle which = all.origin(number);
    return {mesh(), which.face, which.local};
  }

  WholeMesh all;
  Intersections found;
  std::int64_t triangles = 0;  ///< of the whole mesh

 private:
  std::unique_ptr<SurfaceMesh> crossing_;  // null: that of the run
  const SurfaceMesh* mesh_;
};

/// By vertex of the mesh.
std::vector<bool> vertices_of_curves(const SurfaceMesh& mesh) {
  std::vector<bool> on_curve(mesh.vertices.size());
  for (const auto& curve : mesh.curves)
    for (const std::int32_t v : curve.vertices) on_curve[static_cast<std::size_t>(v)] = true;
  return on_curve;
}

/// No gaps near places where both faces cross in the geometry itself. `of`: pairs of triangles of two faces.
void drop_vain_gaps(const CompositeRun& run, const Crossings& crossings, std::pair<int, int> faces,
                    const std::vector<std::size_t>& of, const std::vector<bool>& on_curve, std::vector<Gap>& gaps) {
  CommonPoints common(crossings.mesh(), faces.first, faces.second);
  const auto corners = [&](std::size_t k) {
    const auto [s, t] = crossings.found.pairs[k].triangles;
    return std::pair{crossings.triangle(s), crossings.triangle(t)};
  };
  // Over edges of curves triangles may leave the face.
  const auto at_curve = [&](std::int32_t t) {
    const auto& v = crossings.all.triangles[static_cast<std::size_t>(t)];
    return std::count_if(v.begin(), v.end(), [&](std::int32_t i) { return on_curve[static_cast<std::size_t>(i)]; }) > 1;
  };
  for (const std::size_t k : of) {
    const auto& triangles = crossings.found.pairs[k].triangles;
    if (std::any_of(triangles.begin(), triangles.end(), at_curve)) continue;
    const auto [s, t] = corners(k);
    common.look(run.cad, s, t, crossings.found.pairs[k].place);
  }
  for (const std::size_t k : of) {
    if (gaps[k].width == 0) continue;
    const auto [s, t] = corners(k);
    if (common.any_near(crossings.found.pairs[k].place, std::max(s.longest, t.longest))) gaps[k] = {};
  }
}

/// By pair of triangles that cross.
std::vector<Gap> gaps_of(const CompositeRun& run, const Crossings& crossings) {
  const std::vector<TriangleIntersection>& pairs = crossings.found.pairs;
  const auto faces_of = [&](std::size_t k) -> std::pair<int, int> {
    const auto [s, t] = pairs[k].triangles;
    const int a = crossings.all.origin(s).face;
    const int b = crossings.all.origin(t).face;
    return {std::min(a, b), std::max(a, b)};
  };
  std::vector<Gap> gaps(pairs.size());
  std::map<std::pair<int, int>, std::vector<std::size_t>> of_faces;  // those of which some have gaps
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [s, t] = pairs[k].triangles;
    gaps[k] = gap_at(run, crossings.triangle(s), crossings.triangle(t), pairs[k].place);
    if (const std::pair<int, int> faces = faces_of(k); gaps[k].width > 0 && faces.first != faces.second)
      of_faces.try_emplace(faces);
  }
  if (of_faces.empty()) return gaps;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (const auto of = of_faces.find(faces_of(k)); of != of_faces.end()) of->second.push_back(k);
  const std::vector<bool> on_curve = vertices_of_curves(crossings.mesh());
  for (const auto& [faces, of] : of_faces) drop_vain_gaps(run, crossings, faces, of, on_curve, gaps);
  return gaps;
}

FinerPlaces places_to_refine(const CompositeRun& run, const Crossings& crossings) {
  const WholeMesh& all = crossings.all;
  FinerPlaces places;
  places.sources.resize(run.model.faces.size());
  const std::vector<Gap> gap_of = gaps_of(run, crossings);
  std::vector<double> gaps;
  // Edges that are cut in two later need no more where that is enough.
  const double kept = 1 / enlargement_for(run.options.element);
  for (std::size_t k = 0; k < gap_of.size(); ++k) {
    if (gap_of[k].width == 0 || gap_of[k].share >= kept) continue;
    gaps.push_back(gap_of[k].width);
    for (const std::int32_t t : crossings.found.pairs[k].triangles)
      add(crossings.mesh(), all, t, gap_of[k].share, places);
  }
  if (gaps.empty()) return places;
  const auto middle = gaps.begin() + std::ssize(gaps) / 2;
  std::nth_element(gaps.begin(), middle, gaps.end());
  places.gap = *middle;
  return places;
}

// Segments of curves that are edges of such triangles.
void split_curves(const CompositeRun& run, const std::set<Edge>& edges, std::vector<DiscreteCurve>& curves) {
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::vector<std::int32_t>& v = run.result.mesh.curves[c].vertices;
    if (static_cast<int>(v.size()) != curves[c].segments() + 1) continue;  // it has vanished
    for (int k = curves[c].segments() - 1; k >= 0; --k) {
      const auto i = static_cast<std::size_t>(k);
      if (edges.contains(std::minmax(v[i], v[i + 1]))) split_segment(curves[c], k, run.curve_model);
    }
  }
  if (!run.narrow.strips.empty()) complete_sides(run.curve_model, run.narrow.strips, curves);
}

void make_finer(CompositeRun& run, const FinerPlaces& places) {
  run.curves = run.cut_curves;
  split_curves(run, places.edges, run.curves);
  run.finer.resize(places.sources.size());
  for (std::size_t f = 0; f < places.sources.size(); ++f)
    run.finer[f].insert(run.finer[f].end(), places.sources[f].begin(), places.sources[f].end());
}

// Of surfaces that cross, gaps between points over crossings are sagittas, which fall by four when edges are halved.
bool surfaces_cross(const FinerPlaces& before, const FinerPlaces& now) {
  return now.gap < most_fall_of_gap * before.gap;
}

// The faces of a plane domain lie beside one another, and the triangles of each are turned the same way.
bool covers_a_plane_once(const CompositeRun& run) {
  const std::vector<FaceMesh>& faces = run.result.mesh.faces;
  return run.model.plane && std::all_of(faces.begin(), faces.end(),
                                        [](const FaceMesh& face) { return face.status == FaceStatus::meshed; });
}

}  // namespace

void part_crossing_triangles(CompositeRun& run, const std::function<void()>& mesh_again) {
  if (run.options.crossing_rounds == 0) return;
  if (covers_a_plane_once(run)) {
    run.result.report.crossings = 0;
    return;
  }
  Crossings now(run);
  Intersections fewest = now.found;
  const std::int64_t first = now.triangles;
  Attempts attempts(run, mesh_again);
  FinerPlaces places = places_to_refine(run, now);
  for (int round = 0; round < run.options.crossing_rounds && !places.edges.empty(); ++round) {
    if (!attempts.again([&] { make_finer(run, places); })) break;
    now = Crossings(run);
    const bool best = attempts.keep_if(now.found.count < fewest.count);
    if (best) fewest = now.found;
    if (now.triangles > most_growth * first) break;
    FinerPlaces next = places_to_refine(run, now);
    if (!best && surfaces_cross(places, next)) break;
    places = std::move(next);
  }
  attempts.finish();
  run.result.report.crossings = fewest.count;
  // Of a mesh in parts they are of triangles that no process can number.
  if (!run.options.parts) run.result.crossings = std::move(fewest.pairs);
}

}  // namespace carreau
