// SPDX-License-Identifier: BSD-3-Clause
// Meshes that follow their geometry: carried to a changed one, refined.
#include "arguments.h"
#include "carreau_geometry.h"
#include "guard.h"
#include "mesh_content.h"

using carreau::InvalidArgument;
using carreau::MatchBy;
using carreau::RefineRequest;
using namespace carreau::abi;

static_assert(int(MatchBy::any) == CARREAU_MATCH_ANY && int(MatchBy::reference) == CARREAU_MATCH_REFERENCE);
static_assert(int(MatchBy::name) == CARREAU_MATCH_NAME && int(MatchBy::shape) == CARREAU_MATCH_SHAPE);

namespace {

template <typename Request>
carreau_status refine(carreau_session* session, Request&& request) {
  return guarded(session, [&] {
    session->monitor.begin_run();
    if (!session->session.has_mesh()) throw StatusError(CARREAU_ERR_SEQUENCE, "there is no mesh yet: call carreau_mesh_generate first");
    session->session.refine_mesh(request(surface_of(session->mesh)));
  });
}

}  // namespace

carreau_status carreau_mesh_carry(carreau_session* session, carreau_mesh* old_mesh, int32_t match) {
  return guarded(session, [&] {
    required(old_mesh, "old_mesh");
    if (match < CARREAU_MATCH_ANY || match > CARREAU_MATCH_SHAPE) throw InvalidArgument("there is no match " + std::to_string(match));
    if (old_mesh->session == nullptr) throw InvalidArgument("old_mesh is the mesh of a file: only meshes of sessions know their geometry");
    if (old_mesh->session == session) throw InvalidArgument("old_mesh is the mesh of this session: the changed geometry needs a session of its own");
    const BusyScope busy(old_mesh->busy_flag());
    if (!busy.owned()) throw StatusError(CARREAU_ERR_BUSY, "the session of old_mesh is running");
    if (!old_mesh->session->session.has_mesh()) throw StatusError(CARREAU_ERR_SEQUENCE, "old_mesh is empty: its session has no mesh yet");
    session->monitor.begin_run();
    if (!session->has_cad) throw StatusError(CARREAU_ERR_SEQUENCE, "no geometry is registered: call carreau_set_cad or carreau_set_cad_m first");
    session->commit_model();
    session->session.carry_mesh(old_mesh->session->session, MatchBy(match));
    report_failed_faces(session->session);
  });
}

carreau_status carreau_mesh_halve(carreau_session* session, int32_t times) {
  return refine(session, [&](const carreau::SurfaceMesh&) { return RefineRequest{.halvings = times}; });
}

carreau_status carreau_mesh_refine(carreau_session* session, int32_t kind, int64_t n, const int32_t marks[]) {
  return refine(session, [&](const carreau::SurfaceMesh&) {
    if (kind != CARREAU_MARK_EDGES && kind != CARREAU_MARK_ELEMENTS) throw InvalidArgument("there is no kind of marks " + std::to_string(kind));
    const std::size_t count = count_of(n, "n");
    if (n > 0) required(marks, "marks");
    RefineRequest request;
    for (std::size_t i = 0; i < count; ++i)
      if (kind == CARREAU_MARK_EDGES)
        request.edges.push_back({marks[2 * i], marks[2 * i + 1]});
      else
        request.elements.push_back(marks[i]);
    return request;
  });
}

carreau_status carreau_mesh_refine_sizes(carreau_session* session, int64_t n, const double sizes[]) {
  return refine(session, [&](const carreau::SurfaceMesh& mesh) {
    const std::size_t count = count_of(n, "n");
    required(sizes, "sizes");
    if (count < mesh.vertices.size()) check_capacity(n, mesh.vertices.size(), "vertices");
    return RefineRequest{.sizes = std::vector<double>(sizes, sizes + mesh.vertices.size())};
  });
}
