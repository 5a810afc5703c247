// SPDX-License-Identifier: BSD-3-Clause
#include "session/session.h"

#include <algorithm>
#include <limits>

#include "arguments.h"
#include "guard.h"
#include "mesh_content.h"

using carreau::FaceMesh;
using carreau::FaceStatus;
using namespace carreau::abi;

namespace {

[[noreturn]] void report_failed(std::size_t failed, std::size_t all, int first, const std::string& why) {
  throw StatusError(CARREAU_ERR_PARTIAL, std::to_string(failed) + " of " + std::to_string(all) +
                                             " faces could not be meshed; the first is " + std::to_string(first) + ": " + why);
}

void report_failed_faces(const carreau::PartMesh& part) {
  const auto failed = [](const carreau::WholeFace& each) { return each.face.status == FaceStatus::failed; };
  const auto first = std::find_if(part.faces.begin(), part.faces.end(), failed);
  if (first == part.faces.end()) return;
  report_failed(std::size_t(std::count_if(part.faces.begin(), part.faces.end(), failed)), part.faces.size(), first->face.ref, first->face.why);
}

}  // namespace

void carreau::abi::report_failed_faces(const carreau::Session& session) {
  const FaceMesh* first = nullptr;
  std::size_t failed = 0, all = 0;
  for (const FaceMesh& face : session.mesh().faces) {
    if (face.status != FaceStatus::wire) ++all;
    if (face.status != FaceStatus::failed) continue;
    if (first == nullptr) first = &face;
    ++failed;
  }
  if (first == nullptr) return;
  report_failed(failed, all, first->ref, first->why);
}

namespace {

void require_geometry(const carreau_session& handle) {
  if (!handle.has_cad)
    throw StatusError(CARREAU_ERR_SEQUENCE,
                      "no geometry is registered: call carreau_set_cad or carreau_set_cad_m first");
}

}  // namespace

carreau_status carreau_session_create(carreau_session** out_session) {
  if (out_session == nullptr) return CARREAU_ERR_ARGUMENT;
  return status_of([&] { *out_session = new carreau_session; });
}

void carreau_session_free(carreau_session* session) {
  if (session == nullptr || session->busy.load(std::memory_order_acquire)) return;
  delete session;
}

const char* carreau_last_error(const carreau_session* session) {
  if (session == nullptr || session->busy.load(std::memory_order_acquire)) return "";
  return session->error.sentence.c_str();
}

carreau_status carreau_last_error_place(const carreau_session* session, carreau_error_place* out_place) {
  if (session == nullptr) return CARREAU_ERR_ARGUMENT;
  if (session->busy.load(std::memory_order_acquire)) return CARREAU_ERR_BUSY;
  const carreau::Where& where = session->error.where;
  const auto fill = [&] {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const carreau::Vec2 uv = where.uv.value_or(carreau::Vec2{nan, nan});
    carreau_error_place place{};
    place.face = where.face;
    place.ic = where.curve_index;
    place.curve = where.curve;
    place.point = where.point;
    place.line = where.line;
    place.uv[0] = uv.x();
    place.uv[1] = uv.y();
    place.t = where.t.value_or(nan);
    write_struct(place, out_place, "out_place");
  };
  return status_of(fill);
}

carreau_status carreau_set_error(carreau_session* session, carreau_status error, const char* sentence) {
  const bool known = std::string(carreau_status_name(error)) != "CARREAU_UNKNOWN_STATUS";
  return guarded(session, [&] {
    if (error == CARREAU_OK || !known)
      throw carreau::InvalidArgument("the status " + std::to_string(error) + " is not the status of an error");
    throw StatusError(error, sentence != nullptr ? sentence : "");
  });
}

carreau_status carreau_set_message_callback(carreau_session* session, carreau_message_fn callback, void* user) {
  return guarded(session, [&] { session->monitor.set_message_callback(callback, user); });
}

carreau_status carreau_set_progress_callback(carreau_session* session, carreau_progress_fn callback, void* user) {
  return guarded(session, [&] { session->monitor.set_progress_callback(callback, user); });
}

void carreau_stop(carreau_session* session) {
  if (session != nullptr) session->monitor.request_stop();
}

carreau_status carreau_mesh_generate(carreau_session* session) {
  return guarded(session, [&] {
    session->monitor.begin_run();
    require_geometry(*session);
    if (session->model().faces.empty()) throw StatusError(CARREAU_ERR_SEQUENCE, "the model has no face yet");
    session->commit_model();
    session->session.make_mesh();
    report_failed_faces(session->session);
  });
}

carreau_status carreau_mesh_generate_part(carreau_session* session, carreau_mesh* part) {
  return guarded(session, [&] {
    required(part, "part");
    if (part->session != nullptr) throw carreau::InvalidArgument("the mesh of a session cannot be a part: use carreau_mesh_create");
    session->monitor.begin_run();
    require_geometry(*session);
    if (session->model().faces.empty()) throw StatusError(CARREAU_ERR_SEQUENCE, "the model has no face yet");
    session->commit_model();
    keep_part(session->session.make_part(), *part);
    report_failed_faces(*part->part);
  });
}

carreau_status carreau_run_env(carreau_session* session, const char* path) {
  return guarded(session, [&] {
    required(path, "path");
    session->monitor.begin_run();
    require_geometry(*session);
    session->commit_model();
    session->session.run_env(path);
    if (session->session.has_mesh()) report_failed_faces(session->session);
  });
}

carreau_status carreau_session_interface_count(carreau_session* session, int64_t* out_count) {
  return guarded(session, [&] {
    required(out_count, "out_count");
    if (!session->session.has_mesh()) throw StatusError(CARREAU_ERR_SEQUENCE, "there is no mesh yet");
    *out_count = static_cast<int64_t>(session->session.interfaces().size());
  });
}

carreau_status carreau_session_interface(carreau_session* session, int64_t index, carreau_interface* out_interface) {
  return guarded(session, [&] {
    if (!session->session.has_mesh()) throw StatusError(CARREAU_ERR_SEQUENCE, "there is no mesh yet");
    const std::vector<carreau::Interface>& all = session->session.interfaces();
    if (index < 0 || index >= static_cast<int64_t>(all.size()))
      throw StatusError(CARREAU_ERR_ARGUMENT, "interface " + std::to_string(index) + " is out of range; there are " +
                                                  std::to_string(all.size()));
    const carreau::Interface& entry = all[static_cast<std::size_t>(index)];
    carreau_interface result{};
    result.curve = entry.ref;
    result.uses = entry.uses;
    result.face = entry.first.face;
    result.ic = entry.first.curve_index;
    result.other_face = entry.farthest.face;
    result.other_ic = entry.farthest.curve_index;
    result.boundary = entry.boundary ? 1 : 0;
    result.glued = entry.glued ? 1 : 0;
    result.degenerate = entry.degenerate ? 1 : 0;
    result.loose = entry.loose ? 1 : 0;
    result.gap = entry.gap;
    write_struct(result, out_interface, "out_interface");
  });
}

carreau_status carreau_session_report(carreau_session* session, carreau_report* out_report) {
  return guarded(session, [&] {
    if (!session->session.has_mesh()) throw StatusError(CARREAU_ERR_SEQUENCE, "there is no mesh yet");
    const carreau::CompositeReport& report = session->session.report();
    carreau_report result{};
    result.diag = report.diag;
    result.surf0_calls = report.calls.surf0;
    result.surf1_calls = report.calls.surf1;
    result.surf2_calls = report.calls.surf2;
    result.curv0_calls = report.calls.curv0;
    result.curv1_calls = report.calls.curv1;
    result.curv2_calls = report.calls.curv2;
    result.size_calls = report.calls.sizes;
    result.seconds_curves = report.seconds_curves;
    result.seconds_sampling = report.seconds_sampling;
    result.seconds_plane = report.seconds_plane;
    result.seconds_lift = report.seconds_lift;
    result.seconds_total = report.seconds_total;
    write_struct(result, out_report, "out_report");
  });
}
