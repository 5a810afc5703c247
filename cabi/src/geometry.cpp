// SPDX-License-Identifier: BSD-3-Clause
// Several geometries in one session.
#include <algorithm>

#include "arguments.h"
#include "cad/cad_assembly.h"
#include "carreau_geometry.h"
#include "guard.h"
#include "model/geometries.h"

using carreau::CadAssembly;
using carreau::GeometryRange;
using carreau::InvalidArgument;
using carreau::Model;
using carreau::Vec2;
using carreau::Vec3;
using namespace carreau::abi;

namespace {

/// The geometry that has a face, and the reference by which it knows it.
std::pair<carreau::Cad*, int> geometry_of(const carreau_session& session, std::int32_t face) {
  for (const AddedGeometry& geometry : session.added)
    if (face >= geometry.range.first_face && face <= geometry.range.last_face)
      return {geometry.cad.get(), face - geometry.range.first_face + 1};
  const std::string sentence = "no geometry that was added to the session has face " + std::to_string(face);
  if (session.added.empty()) throw StatusError(CARREAU_ERR_SEQUENCE, sentence);
  throw InvalidArgument(carreau::Where{.face = face}, sentence);
}

BegunGeometry& begun_of(carreau_session& session) {
  if (!session.begun)
    throw StatusError(CARREAU_ERR_SEQUENCE, "no geometry has begun: call carreau_geometry_begin first");
  return *session.begun;
}

/// The session gets its own draft back; the model of the geometry is returned.
Model take_part(carreau_session& session) {
  Model part = std::move(session.draft);
  session.draft = std::move(session.begun->outer_draft);
  session.draft_changed = session.begun->outer_changed;
  return part;
}

}  // namespace

void carreau_session::refuse_begun() const {
  if (begun)
    throw StatusError(CARREAU_ERR_SEQUENCE, "a geometry has begun and has no end: call carreau_geometry_end first");
}

void carreau_session::refuse_plane() const {
  if (!added.empty() && added.front().kind == CARREAU_GEOMETRY_PLANE)
    throw InvalidArgument("the session has a plane domain, which is the only geometry of a session");
}

void carreau_session::add_geometry(int kind, std::shared_ptr<carreau::Cad> cad, Model part) {
  refuse_begun();
  refuse_plane();
  const bool only = model().faces.empty(), checked_now = only && kind != CARREAU_GEOMETRY_CALLBACKS;
  Model merged = only ? Model{} : model();
  const GeometryRange range = append_geometry(merged, std::move(part));
  added.reserve(added.size() + 1);
  if (checked_now)
    session.set_model(std::move(merged)), draft = {}, draft_changed = false;
  else
    draft = std::move(merged), draft_changed = true;
  std::vector<int> curves(std::size_t(range.last_face - range.first_face + 1));
  for (const carreau::Face& face : model().faces)
    if (face.ref >= range.first_face && face.ref <= range.last_face)
      curves[std::size_t(face.ref - range.first_face)] = int(face.curves.size());
  added.push_back({kind, std::move(cad), range, std::move(curves)});
  update_cad();
}

void carreau_session::drop_geometries() {
  if (!added.empty() && added.front().kind == CARREAU_GEOMETRY_PLANE) session.set_prescription_source(nullptr);
  added.clear();
  surfaces.clear(), periodic_files.clear(), triangles.reset();
  update_cad();
}

void carreau_session::update_cad() {
  has_cad = host != nullptr || !added.empty();
  session.set_triangles(triangles);
  if (added.empty()) return session.set_cad(host);
  const GeometryRange& first = added.front().range;
  if (!host && added.size() == 1 && first.first_face == 1 && first.first_point == 1)
    return session.set_cad(added.front().cad);
  std::vector<CadAssembly::Part> parts;
  for (const AddedGeometry& geometry : added) {
    const GeometryRange& range = geometry.range;
    parts.push_back({geometry.cad, range.first_face, range.last_face, range.first_point, range.last_point,
                     host ? geometry.curves : std::vector<int>{}});
  }
  session.set_cad(std::make_shared<CadAssembly>(host, std::move(parts)));
}

carreau_status carreau_geometry_begin(carreau_session* session, const carreau_cad* callbacks) {
  return guarded(session, [&] {
    session->refuse_begun();
    BegunGeometry begun{.cad = cad_of(callbacks, session->monitor), .outer_draft = {}};
    begun.outer_draft = std::move(session->draft), begun.outer_changed = session->draft_changed;
    session->draft = {}, session->draft_changed = true;
    session->begun = std::move(begun);
  });
}

carreau_status carreau_geometry_end(carreau_session* session) {
  return guarded(session, [&] {
    std::shared_ptr<carreau::Cad> cad = begun_of(*session).cad;
    Model part = take_part(*session);
    session->begun.reset();
    session->add_geometry(CARREAU_GEOMETRY_CALLBACKS, std::move(cad), std::move(part));
  });
}

carreau_status carreau_geometry_cancel(carreau_session* session) {
  if (session == nullptr) return CARREAU_ERR_ARGUMENT;
  const ErrorSlot kept = session->error;
  const carreau_status status = guarded(session, [&] {
    begun_of(*session);
    take_part(*session);
    session->begun.reset();
  });
  if (status == CARREAU_OK) session->error = kept;
  return status;
}

carreau_status carreau_geometry_count(carreau_session* session, int64_t* out_count) {
  return guarded(session, [&] { *required(out_count, "out_count") = std::int64_t(session->added.size()); });
}

carreau_status carreau_geometry_info(carreau_session* session, int64_t index, carreau_geometry* out_geometry) {
  return guarded(session, [&] {
    if (index < 0 || std::uint64_t(index) >= session->added.size())
      throw InvalidArgument("there is no geometry " + std::to_string(index) + "; " +
                            std::to_string(session->added.size()) + " were added");
    const AddedGeometry& geometry = session->added[std::size_t(index)];
    const Model& model = session->begun ? session->begun->outer_draft : session->model();
    carreau_geometry known{};
    known.kind = geometry.kind;
    known.faces = std::int32_t(std::count_if(model.faces.begin(), model.faces.end(), [&](const carreau::Face& face) {
      return face.geometry == int(index) + 1;
    }));
    known.first_face = geometry.range.first_face, known.last_face = geometry.range.last_face;
    known.first_curve = geometry.range.first_curve, known.last_curve = geometry.range.last_curve;
    known.first_point = geometry.range.first_point, known.last_point = geometry.range.last_point;
    write_struct(known, out_geometry, "out_geometry");
  });
}

carreau_status carreau_geometry_points(carreau_session* session, int32_t face_ref, int64_t n, const double uv[],
                                       double out_xyz[]) {
  return guarded(session, [&] {
    const auto [cad, face] = geometry_of(*session, face_ref);
    if (n < 0) throw InvalidArgument("the number of places is " + std::to_string(n));
    if (n > 0) required(uv, "uv"), required(out_xyz, "out_xyz");
    for (std::int64_t i = 0; i < n; ++i) {
      const Vec3 s = surface_at(*cad, face, carreau::want_position, Vec2{uv[2 * i], uv[2 * i + 1]}).s;
      std::copy(s.data(), s.data() + 3, out_xyz + 3 * i);
    }
  });
}

carreau_status carreau_geometry_curve(carreau_session* session, int32_t face_ref, int32_t ic, double share,
                                      double out_uv[2]) {
  return guarded(session, [&] {
    const auto [cad, face] = geometry_of(*session, face_ref);
    required(out_uv, "out_uv");
    const auto [a, b] = cad->curve_interval(face, ic);
    const Vec2 c = cad->curve(face, ic, carreau::want_position, share < 1 ? a + share * (b - a) : b).c;
    out_uv[0] = c.x(), out_uv[1] = c.y();
  });
}
