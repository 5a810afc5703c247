// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/certify/edit_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/shares.h"
#include "surface/remesh/bounds/chart_map.h"
#include "surface/remesh/bounds/spread_places.h"
#include "surface/remesh/bounds/thresholds.h"
#include "surface/remesh/certify/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::bounds;
using thresholds::certify::within;

constexpr double degree = std::numbers::pi / 180;

void arrive(const std::array<SurfacePlace, 3>& corner, ChartMap& map) {
  const SurfacePlace& pole = corner[map.pole];
  std::array<Vec2, 2> box{pole.foot.uv, pole.foot.uv};
  for (const SurfacePlace& p : corner) box = {box[0].cwiseMin(p.foot.uv), box[1].cwiseMax(p.foot.uv)};
  for (int k = 0; k < 2; ++k) {
    const SurfacePlace& from = corner[(map.pole + 1 + k) % 3];
    map.arrival[k] = arrival_at_pole(pole.foot.uv, {pole.su, pole.sv}, from.foot.uv, {from.su, from.sv}, pole.xyz - from.xyz, box);
  }
}

ChartMap map_of(const std::array<SurfacePlace, 3>& corner, const std::array<bool, 3>& on_line) {
  ChartMap map{{corner[0].foot.uv, corner[1].foot.uv, corner[2].foot.uv}, {}, -1, {}};
  int regular = 0;
  for (int i = 0; i < 3; ++i) corner[i].regular ? ++regular : map.pole = i;
  if (regular < 2) map.pole = -1;
  if (map.pole >= 0) arrive(corner, map);
  const Vec2 ab = map.corner[1] - map.corner[0], ac = map.corner[2] - map.corner[0];
  for (std::size_t i = 0; i < 3 && regular == 3; ++i) {
    if (on_line[i]) continue;
    const SurfacePlace &p = corner[i], &q = corner[(i + 1) % 3];
    const Vec2 bulge = bulge_over_chord(q.foot.uv - p.foot.uv, {p.su, p.sv}, {q.su, q.sv}), inside = part_inside(bulge, ab, ac) * bulge;
    if (is_finite(inside)) map.bulge[i] = inside;
  }
  return map;
}

}  // namespace

double EditBounds::deviation_tolerance(const Corners& corners) const {
  const SurfaceTolerances& asked = mesh_.tolerances();
  if (asked.deviation > 0) return within * asked.deviation;
  double sum = 0;
  for (const std::int32_t v : corners.vertex) sum += mesh_.size(v);
  return within * asked.share_of_size * sum / 3;
}

// The slope of the mesh around it is at most twice the slope at its own corners.
BoundedTriangle EditBounds::flat(const Corners& corners) const {
  BoundedTriangle made({corners.place[0].xyz, corners.place[1].xyz, corners.place[2].xyz});
  if (made.is_flat()) return made;
  double least = 1, area = norm(cross(made.p[1] - made.p[0], made.p[2] - made.p[0]));
  for (int i = 0; i < 3; ++i) {
    const std::int32_t v = corners.vertex[i], w = corners.vertex[(i + 1) % 3];
    made.open_side[i] = !mesh_.is_free(v) && !mesh_.is_free(w);
    made.open_corner[i] = !mesh_.is_free(v);
    if (corners.place[i].regular) least = std::min(least, std::abs(dot(corners.place[i].normal, made.normal)));
  }
  const double leaning = 2 * std::acos(std::min(least, 1.0));
  made.slope = leaning < std::numbers::pi / 3 ? std::tan(leaning) : infinity;
  made.reach = area / made.longest / 2;
  const SurfaceTolerances& asked = mesh_.tolerances();
  made.deviation_tolerance = deviation_tolerance(corners);
  made.deviation_floor = shares::negligible * made.deviation_tolerance;
  made.angle_tolerance = within * asked.angle_deg * degree;
  made.decides = true;
  made.angle_floor = shares::small * made.angle_tolerance;
  return made;
}

TriangleBound EditBounds::bound_in_chart(const Corners& corners, std::int32_t face, const BoundedTriangle& flat) {
  const ChartMap map = map_of(corners.place, flat.open_side);
  std::vector<Vec2> uv;
  std::vector<SurfaceJet> jets;
  std::vector<BoundPlace> seen;
  const auto see = [&](std::span<const PlaceInTriangle> places) {
    uv.clear();
    for (const PlaceInTriangle& p : places) uv.push_back(map.at(p));
    jets.resize(uv.size());
    cad_.surface(mesh_.charts().reference(face), want_position | want_first, uv, jets);
    seen.clear();
    for (const SurfaceJet& jet : jets) seen.push_back({jet.s, cross(jet.su, jet.sv)});
  };
  see(TriangleBound::lattice());
  constexpr std::array<std::size_t, 3> corner_ranks{0, 4, 14};
  for (std::size_t i = 0; i < 3; ++i)
    seen[corner_ranks[i]] = {corners.place[i].xyz, cross(corners.place[i].su, corners.place[i].sv)};
  TriangleBound bound(flat, std::span<const BoundPlace, TriangleBound::lattice_size>(seen.data(), TriangleBound::lattice_size));
  while (!bound.wanted().empty()) {
    see(bound.wanted());
    bound.take(seen);
  }
  return bound;
}

TriangleBound EditBounds::bound_over_several(const Corners& corners, const BoundedTriangle& flat) {
  SpreadTriangle triangle(mesh_.charts(), cad_, flat.p, corners.place, false);
  for (int i = 0; i < 3; ++i)
    if (!corners.place[i].regular) {
      const auto ends = mesh_.places(corners.vertex[i]);
      triangle.set_pole({ends.begin(), ends.end()});
    }
  const SpreadPlaces places(triangle, flat);
  TriangleBound bound(flat, places.lattice());
  std::vector<BoundPlace> seen;
  while (!bound.wanted().empty()) {
    seen.clear();
    for (const PlaceInTriangle& p : bound.wanted()) seen.push_back(places.at(p));
    bound.take(seen);
  }
  return bound;
}

double EditBounds::share(const EditableMesh::Triangle& t, bool roughly, double most) {
  const PlacedCell cell = placer_({t[0], t[1], t[2], -1});
  Corners corners;
  for (int i = 0; i < 3; ++i) {
    corners.vertex[i] = cell.corners[i].vertex;
    corners.place[i] = mesh_.places(cell.corners[i].vertex)[cell.corners[i].place];
    corners.place[i].xyz = mesh_.position(cell.corners[i].vertex);
  }
  // Spread ones run as the atlas does.
  if (cell.spread && cell.corners[1].vertex != t[1] && cell.corners[0].vertex == t[0]) {
    std::swap(corners.vertex[1], corners.vertex[2]);
    std::swap(corners.place[1], corners.place[2]);
  }
  BoundedTriangle flat = this->flat(corners);
  flat.roughly = roughly;
  const double turned = 180 / mesh_.tolerances().angle_deg;
  if (flat.is_flat()) return turned;
  double least = 1;
  for (const SurfacePlace& p : corners.place)
    if (p.regular) least = std::min(least, std::abs(dot(p.normal, flat.normal)));
  if (const double shown = std::acos(least) / flat.angle_tolerance; shown > most) return shown;
  const TriangleBound bound = cell.spread ? bound_over_several(corners, flat) : bound_in_chart(corners, cell.face, flat);
  return std::max(bound.deviation() / flat.deviation_tolerance, bound.angle() / flat.angle_tolerance);
}

}  // namespace carreau
