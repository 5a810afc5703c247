// SPDX-License-Identifier: BSD-3-Clause
// Elements of order 3 and 4 over the mesh of a session.
#include "arguments.h"
#include "carreau_geometry.h"
#include "guard.h"
#include "handles.h"

using carreau::HighOrderMesh;
using carreau::InvalidArgument;
using carreau::NodePlaces;
using namespace carreau::abi;

static_assert(int(NodePlaces::equidistant) == CARREAU_EQUIDISTANT && int(NodePlaces::gauss_lobatto) == CARREAU_GAUSS_LOBATTO);

namespace {

const HighOrderMesh& raised_of(const carreau_session& session) {
  if (!session.session.has_raised()) throw StatusError(CARREAU_ERR_SEQUENCE, "there are no elements of a higher order: call carreau_raise_order first");
  return session.session.raised();
}

}  // namespace

carreau_status carreau_raise_order(carreau_session* session, int32_t order, int32_t places, int64_t* out_invalid) {
  return guarded(session, [&] {
    if (places != CARREAU_EQUIDISTANT && places != CARREAU_GAUSS_LOBATTO) throw InvalidArgument("there are no places of nodes " + std::to_string(places));
    if (!session->session.has_mesh()) throw StatusError(CARREAU_ERR_SEQUENCE, "there is no mesh yet: call carreau_mesh_generate first");
    session->monitor.begin_run();
    const HighOrderMesh& made = session->session.raise_order(order, NodePlaces(places));
    if (out_invalid != nullptr) *out_invalid = std::int64_t(made.invalid.size());
  });
}

carreau_status carreau_raised_count(carreau_session* session, int64_t* out_nodes, int64_t* out_triangles, int64_t* out_quads, int64_t* out_edges) {
  return guarded(session, [&] {
    const HighOrderMesh& mesh = raised_of(*session);
    const auto give = [](std::int64_t* out, std::size_t n) {
      if (out != nullptr) *out = std::int64_t(n);
    };
    give(out_nodes, mesh.nodes.size()), give(out_triangles, mesh.triangle_refs.size());
    give(out_quads, mesh.quad_refs.size()), give(out_edges, mesh.edge_refs.size());
  });
}

carreau_status carreau_raised_nodes(carreau_session* session, int64_t capacity, double out_xyz[]) {
  return guarded(session, [&] {
    const HighOrderMesh& mesh = raised_of(*session);
    required(out_xyz, "out_xyz");
    check_capacity(capacity, mesh.nodes.size(), "nodes");
    for (const carreau::Vec3& p : mesh.nodes) out_xyz = std::copy(p.data(), p.data() + 3, out_xyz);
  });
}

carreau_status carreau_raised_elements(carreau_session* session, int32_t corners, int64_t capacity, int32_t out_nodes[], int32_t out_references[]) {
  return guarded(session, [&] {
    const HighOrderMesh& mesh = raised_of(*session);
    if (corners < 2 || corners > 4) throw InvalidArgument("there are no elements of " + std::to_string(corners) + " corners");
    required(out_nodes, "out_nodes");
    const std::vector<std::int32_t>& nodes = corners == 2 ? mesh.edges : corners == 3 ? mesh.triangles : mesh.quads;
    const std::vector<std::int32_t>& refs = corners == 2 ? mesh.edge_refs : corners == 3 ? mesh.triangle_refs : mesh.quad_refs;
    check_capacity(capacity, refs.size(), "elements");
    std::copy(nodes.begin(), nodes.end(), out_nodes);
    if (out_references != nullptr) std::copy(refs.begin(), refs.end(), out_references);
  });
}

carreau_status carreau_raised_write(carreau_session* session, const char* path) {
  return guarded(session, [&] {
    (void)raised_of(*session);
    session->session.write_raised(required(path, "path"));
  });
}
