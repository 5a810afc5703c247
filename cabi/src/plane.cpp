// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "arguments.h"
#include "carreau_geometry.h"
#include "geometry/plane/arrangement.h"
#include "geometry/plane/plane_geometry.h"
#include "guard.h"
#include "io/files.h"
#include "io/plane/plane_files.h"
#include "session/file_adaptation.h"

using carreau::InvalidArgument;
using carreau::Level;
using carreau::PlaneCurve;
using carreau::PlaneDomainInput;
using carreau::PlanePoint;
using carreau::PlaneRest;
using carreau::Vec2;
using namespace carreau::abi;

namespace {

template <typename T>
T entry(const T* array, std::size_t i, T otherwise) {
  return array != nullptr ? array[i] : otherwise;
}

void add_points(const carreau_plane_domain& given, PlaneDomainInput& input) {
  const std::size_t n = count_of(given.point_count, "domain->point_count");
  if (n > 0) required(given.points, "domain->points");
  for (std::size_t i = 0; i < n; ++i) {
    PlanePoint point;
    point.xy = {given.points[2 * i], given.points[2 * i + 1]};
    point.ref = entry(given.point_refs, i, 0);
    point.imposed = entry(given.imposed, i, 0) != 0;
    if (const double size = entry(given.sizes, i, 0.0); size != 0) point.size = size;
    if (const double* m = given.metrics != nullptr ? given.metrics + 3 * i : nullptr;
        m != nullptr && (m[0] != 0 || m[1] != 0 || m[2] != 0))
      point.metric = carreau::Metric2{m[0], m[1], m[2]};
    input.points.push_back(std::move(point));
  }
}

std::optional<Vec2> tangent_at(const double* values) {
  if (std::isnan(values[0]) && std::isnan(values[1])) return std::nullopt;
  return Vec2{values[0], values[1]};
}

void add_curves(const carreau_plane_domain& given, PlaneDomainInput& input) {
  const std::size_t n = count_of(given.curve_count, "domain->curve_count");
  if (n > 0) required(given.curve_starts, "domain->curve_starts"), required(given.curve_points, "domain->curve_points");
  for (std::size_t c = 0; c < n; ++c) {
    const std::int64_t first = given.curve_starts[c], last = given.curve_starts[c + 1];
    if (first < 0 || last < first)
      throw InvalidArgument("domain->curve_starts does not ascend from 0 at curve " + std::to_string(c) + " (from 0)");
    PlaneCurve curve;
    curve.points.assign(given.curve_points + first, given.curve_points + last);
    const std::int32_t kind = entry(given.smooth, c, 0);
    if (kind < 0 || kind > 2)
      throw InvalidArgument("domain->smooth is " + std::to_string(kind) + " at curve " + std::to_string(c) +
                            " (from 0); it must be 0, 1 or 2");
    curve.smooth = kind == CARREAU_SPLINE, curve.arcs = kind == CARREAU_ARCS;
    curve.before = entry(given.controls, 2 * c, -1), curve.after = entry(given.controls, 2 * c + 1, -1);
    if (given.tangents != nullptr)
      curve.tangent_start = tangent_at(given.tangents + 4 * c),
      curve.tangent_end = tangent_at(given.tangents + 4 * c + 2);
    curve.ref = entry(given.curve_refs, c, 0);
    input.curves.push_back(std::move(curve));
  }
}

void add_sides_and_seeds(const carreau_plane_domain& given, PlaneDomainInput& input) {
  const std::size_t sides = count_of(given.side_count, "domain->side_count"), seeds = count_of(given.seed_count, "domain->seed_count");
  if (sides > 0) required(given.sides, "domain->sides");
  if (seeds > 0) required(given.seeds, "domain->seeds"), required(given.seed_refs, "domain->seed_refs");
  for (std::size_t i = 0; i < sides; ++i) {
    const std::int32_t* row = given.sides + 3 * i;
    if (row[1] != 1 && row[1] != -1)
      throw InvalidArgument("side " + std::to_string(i) + " (from 0) of the domain is " + std::to_string(row[1]) +
                            "; it must be 1 (left) or -1 (right)");
    input.sides.push_back({.curve = row[0], .left = row[1] > 0, .ref = row[2]});
  }
  for (std::size_t i = 0; i < seeds; ++i) {
    const bool hole = given.seed_refs[i] == -1;
    input.seeds.push_back(
        {.at = {given.seeds[2 * i], given.seeds[2 * i + 1]}, .hole = hole, .ref = hole ? 0 : given.seed_refs[i]});
  }
}

PlaneDomainInput input_of(const carreau_plane_domain& given) {
  PlaneDomainInput input;
  switch (given.rest) {
    case CARREAU_REST_PARITY:
      input.rest = PlaneRest::parity;
      break;
    case CARREAU_REST_INSIDE:
      input.rest = PlaneRest::inside;
      break;
    case CARREAU_REST_OUTSIDE:
      input.rest = PlaneRest::outside;
      break;
    default:
      throw InvalidArgument("domain->rest is " + std::to_string(given.rest) + "; it must be 0, 1 or 2");
  }
  add_points(given, input);
  add_curves(given, input);
  add_sides_and_seeds(given, input);
  return input;
}

void check_empty(const carreau_session& session) {
  if (!session.model().faces.empty())
    throw InvalidArgument("the session has faces already: call carreau_model_clear first");
}

void add(carreau_session& session, const PlaneDomainInput& input) {
  carreau::PlaneGeometry plane = carreau::build_plane_geometry(input, session.parameters->real("eps_smooth"));
  for (const std::string& warning : plane.warnings) session.monitor.message(Level::warning, warning);
  session.add_geometry(CARREAU_GEOMETRY_PLANE, std::move(plane.built.cad), std::move(plane.built.model));
  session.session.set_prescription_source(plane.sizes);
  session.plane_has_sizes = plane.sizes != nullptr;
}

void arrange(carreau_session& session, PlaneDomainInput& input) {
  const carreau::SegmentArrangement found = carreau::arrange_segments(input);
  std::string text;
  const auto tell = [&](std::size_t n, const char* what) {
    if (n > 0) text += (text.empty() ? "" : ", ") + std::to_string(n) + what;
  };
  tell(found.crossings, " crossings of segments became points");
  tell(found.points_on_segments, " points on segments divide them");
  tell(found.merged_points, " repeated points were merged");
  tell(found.dropped_segments, " repeated segments were dropped");
  if (!text.empty()) session.monitor.message(Level::warning, input.source + ": " + text);
}

bool is_bl2d(const std::string& path) {
  const std::string suffix = carreau::suffix_of(path);
  return suffix == ".h" || suffix == ".hc" || suffix == ".hg";
}

carreau::Solution sizes_of(const std::string& path, std::int32_t field) {
  return is_bl2d(path) ? carreau::read_bl2d_sizes_text(carreau::read_file(path), path)
                       : carreau::read_solution(path, {carreau::SolutionUse::prescription, field});
}

}  // namespace

carreau_status carreau_add_plane_domain(carreau_session* session, const carreau_plane_domain* domain) {
  return guarded(session, [&] {
    const carreau_plane_domain known = read_struct(domain, "carreau_plane_domain");
    check_empty(*session);
    add(*session, input_of(known));
  });
}

carreau_status carreau_load_plane_domain(carreau_session* session, const char* path, const char* sizes,
                                         double corner_angle) {
  return guarded(session, [&] {
    required(path, "path");
    if (sizes != nullptr && *sizes == '\0') sizes = nullptr;
    constexpr double half_turn = 180;
    if (!(corner_angle >= 0 && corner_angle <= half_turn))
      throw InvalidArgument("the corner_angle must lie between 0 and 180 degrees");
    check_empty(*session);
    PlaneDomainInput input = carreau::read_plane_domain(path);
    std::shared_ptr<carreau::BackgroundField> background;
    const std::int32_t field = session->session.parameters().integer("sol_field");
    if (sizes != nullptr && input.is_mesh)
      background = carreau::read_background(path, sizes, true, field);
    else if (sizes != nullptr)
      set_point_sizes(input, sizes_of(sizes, field), sizes);
    if (input.arrange) arrange(*session, input);
    if (corner_angle > 0)
      smooth_polygons(input, corner_angle);
    else if (input.is_mesh)
      join_straight_edges(input);
    add(*session, input);
    if (background) session->session.set_background(background), session->plane_has_sizes = true;
  });
}

carreau_status carreau_plane_has_sizes(carreau_session* session, int32_t* out_answer) {
  return guarded(session, [&] { *required(out_answer, "out_answer") = session->plane_has_sizes ? 1 : 0; });
}
