// SPDX-License-Identifier: BSD-3-Clause
// Places of the model of a session.
#include <cmath>
#include <limits>
#include <map>

#include "arguments.h"
#include "carreau_geometry.h"
#include "geometry/grid/grid_cad.h"
#include "geometry/grid/ridges/ridges.h"
#include "guard.h"
#include "mesh_content.h"
#include "support/format.h"

using carreau::InvalidArgument;
using carreau::ProjectedPoint;
using carreau::SurfaceJet;
using carreau::Vec2;
using carreau::Vec3;
using namespace carreau::abi;

namespace {

void prepare_places(carreau_session& session, std::int32_t dimension, std::int32_t min_dimension, std::int64_t n) {
  if (dimension < min_dimension || dimension > 2)
    throw InvalidArgument("the dimension is " + std::to_string(dimension) + "; it must be " + (min_dimension == 0 ? "0, " : "") + "1 or 2");
  if (n < 0) throw InvalidArgument("the number of places is " + std::to_string(n));
  session.monitor.begin_run();
  if (!session.has_cad) throw StatusError(CARREAU_ERR_SEQUENCE, "no geometry is registered: call carreau_set_cad or carreau_set_cad_m first");
  const carreau::Model& model = session.model();
  if (model.faces.empty()) throw StatusError(CARREAU_ERR_SEQUENCE, "the model has no face yet");
  const auto lacks = [](const carreau::Face& face) {
    return std::any_of(face.curves.begin(), face.curves.end(), [](const carreau::FaceCurve& curve) { return curve.ref <= 0; });
  };
  if (dimension < 2 && std::any_of(model.faces.begin(), model.faces.end(), lacks))
    throw StatusError(CARREAU_ERR_SEQUENCE, "curves and points of the model have no references yet: carreau_mesh_generate finds them");
  session.commit_model();
}

std::vector<Vec2> parameters_of(const double* values, std::int64_t n, std::int32_t dimension) {
  if (n > 0) required(values, "parameters");
  std::vector<Vec2> places(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = dimension == 2 ? Vec2{values[2 * i], values[2 * i + 1]} : Vec2{values[i], 0};
    if (!carreau::is_finite(places[i])) throw InvalidArgument("a parameter of place " + std::to_string(i) + " is not finite");
  }
  return places;
}

double* put(const Vec3& p, double* out) { return std::copy(p.data(), p.data() + 3, out); }

}  // namespace

carreau_status carreau_evaluate(carreau_session* session, int32_t dimension, int32_t reference, int64_t n, const double parameters[],
                                int32_t order, double out_xyz[], double out_first[], double out_second[]) {
  return guarded(session, [&] {
    if (order < 0 || order > 2) throw InvalidArgument("the order is " + std::to_string(order) + "; it must be 0, 1 or 2");
    if ((order < 1 && out_first != nullptr) || (order < 2 && out_second != nullptr))
      throw InvalidArgument("results above the order " + std::to_string(order) + " must be NULL");
    prepare_places(*session, dimension, 1, n);
    const std::vector<Vec2> places = parameters_of(parameters, n, dimension);
    unsigned want = carreau::want_position;
    if (out_first != nullptr) want |= carreau::want_first;
    if (out_second != nullptr) want |= carreau::want_second;
    std::vector<SurfaceJet> jets(places.size());
    session->session.evaluate_places(dimension, reference, want, places, jets);
    for (const SurfaceJet& jet : jets) {
      if (out_xyz != nullptr) out_xyz = put(jet.s, out_xyz);
      if (out_first != nullptr) out_first = put(jet.su, out_first);
      if (out_second != nullptr) out_second = put(jet.suu, out_second);
      if (dimension == 1) continue;
      if (out_first != nullptr) out_first = put(jet.sv, out_first);
      if (out_second != nullptr) out_second = put(jet.svv, put(jet.suv, out_second));
    }
  });
}

carreau_status carreau_project(carreau_session* session, int32_t dimension, int32_t reference, int64_t n, const double xyz[],
                               int32_t out_references[], double out_parameters[], double out_closest[], double out_distances[]) {
  return guarded(session, [&] {
    prepare_places(*session, dimension, 0, n);
    if (n > 0) required(xyz, "xyz");
    std::vector<Vec3> points(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
      if (!carreau::is_finite(points[i])) throw InvalidArgument("a coordinate of point " + std::to_string(i) + " is not finite");
    }
    std::vector<ProjectedPoint> found(points.size());
    const std::map<int, std::string> failed = session->session.project(dimension, reference, points, found);
    for (const ProjectedPoint& point : found) {
      if (out_references != nullptr) *out_references++ = point.ref;
      if (out_parameters != nullptr) out_parameters = std::copy(point.parameters.data(), point.parameters.data() + dimension, out_parameters);
      if (out_closest != nullptr) out_closest = put(point.xyz, out_closest);
      if (out_distances != nullptr) *out_distances++ = point.distance;
    }
    if (!failed.empty())
      throw StatusError(CARREAU_ERR_PARTIAL, "the closest points leave out a face: " + failed.begin()->second +
                                                 (failed.size() > 1 ? " (and " + std::to_string(failed.size() - 1) + " more faces)" : ""));
  });
}

carreau_status carreau_model_embed_point(carreau_session* session, const double xyz[], const char* name, int32_t* out_ref) {
  return guarded(session, [&] {
    prepare_places(*session, 2, 2, 1);
    required(xyz, "xyz");
    const int ref = session->session.embed_point({xyz[0], xyz[1], xyz[2]}, name != nullptr ? name : "");
    if (out_ref != nullptr) *out_ref = ref;
  });
}

carreau_status carreau_model_embed_polyline(carreau_session* session, int64_t n, const double xyz[], const char* name, int32_t* out_ref) {
  return guarded(session, [&] {
    prepare_places(*session, 2, 2, n);
    if (n > 0) required(xyz, "xyz");
    std::vector<Vec3> points(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    const int ref = session->session.embed_polyline(points, name != nullptr ? name : "");
    if (out_ref != nullptr) *out_ref = ref;
  });
}

carreau_status carreau_model_embed_wires(carreau_session* session, int64_t* out_count) {
  return guarded(session, [&] {
    prepare_places(*session, 2, 2, 0);
    const int wires = session->session.embed_wires();
    if (out_count != nullptr) *out_count = wires;
  });
}

carreau_status carreau_model_embed_ridges(carreau_session* session, double radius, int64_t* out_count) {
  return guarded(session, [&] {
    prepare_places(*session, 2, 2, 0);
    if (!(radius > 0) || !std::isfinite(radius)) throw InvalidArgument("the radius of ridges must be positive and finite; it is " + carreau::format_number(radius));
    std::vector<std::vector<Vec3>> lines;
    bool grids = false;
    for (const AddedGeometry& geometry : session->added) {
      if (geometry.kind != CARREAU_GEOMETRY_GRID) continue;
      grids = true;
      for (const auto& surface : static_cast<const carreau::grid::GridCad&>(*geometry.cad).surfaces())
        for (std::vector<Vec3>& line : carreau::grid::find_ridges(*surface, radius, session->monitor)) lines.push_back(std::move(line));
    }
    if (!grids) throw StatusError(CARREAU_ERR_SEQUENCE, "ridges are found on structured grids, and the session has none");
    std::int64_t embedded = 0;
    for (const std::vector<Vec3>& line : lines) try {
        session->session.embed_polyline(line, "ridge " + std::to_string(embedded + 1));
        ++embedded;
      } catch (const InvalidArgument& failure) {
        session->monitor.message(carreau::Level::warning, "a ridge is left out: " + std::string(failure.what()));
      }
    if (out_count != nullptr) *out_count = embedded;
  });
}

carreau_status carreau_mesh_vertex_entities(carreau_mesh* mesh, int64_t capacity, int32_t out_dimensions[], int32_t out_references[]) {
  return guarded(mesh, [&] {
    check_capacity(capacity, Counts(*mesh).vertices, "vertices");
    session_only(*mesh, "entities");
    for (const carreau::MeshEntity& entity : mesh->session->session.node_entities()) {
      if (out_dimensions != nullptr) *out_dimensions++ = entity.dimension;
      if (out_references != nullptr) *out_references++ = entity.ref;
    }
  });
}

carreau_status carreau_mesh_edge_parameters(carreau_mesh* mesh, int64_t capacity, double out_t[], int32_t out_faces[], int32_t out_ics[]) {
  return guarded(mesh, [&] {
    check_capacity(capacity, Counts(*mesh).edges, "edges");
    const carreau::SurfaceMesh& surface = session_only(*mesh, "parameters of edges");
    const std::vector<carreau::CurveParameters> parameters = mesh->session->session.curve_parameters();
    for (std::size_t c = 0; c < surface.curves.size(); ++c) {
      const carreau::CurveParameters& on = parameters[c];
      const std::size_t n = surface.curves[c].vertices.size();
      const bool known = on.t.size() == n;
      for (std::size_t i = 1; i < n; ++i) {
        if (out_faces != nullptr) *out_faces++ = known ? on.face : 0;
        if (out_ics != nullptr) *out_ics++ = known ? on.ic : 0;
        for (const std::size_t end : {i - 1, i})
          if (out_t != nullptr) *out_t++ = known ? on.t[end] : std::numeric_limits<double>::quiet_NaN();
      }
    }
  });
}
