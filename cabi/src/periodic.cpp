// SPDX-License-Identifier: BSD-3-Clause
// Periodic faces: of the model, and of the mesh.
#include <algorithm>
#include <string>

#include "arguments.h"
#include "carreau.h"
#include "guard.h"
#include "mesh_content.h"
#include "support/short_number.h"

using carreau::InvalidArgument;
using carreau::Isometry;
using carreau::Model;
using carreau::PeriodicLink;
using namespace carreau::abi;

namespace {

void require_face(const Model& model, std::int32_t ref) {
  const auto is_it = [ref](const carreau::Face& face) { return face.ref == ref; };
  if (std::none_of(model.faces.begin(), model.faces.end(), is_it))
    throw InvalidArgument("the model has no face of reference " + std::to_string(ref) + ": call carreau_model_add_face first");
}

Isometry isometry_of(const double* transform) {
  Isometry map;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) map.row[i][k] = transform[4 * i + k];
    map.shift[i] = transform[4 * i + 3];
  }
  return map;
}

const std::vector<PeriodicLink>& links_of(const carreau_mesh& mesh) {
  require_content(mesh);
  return mesh.session != nullptr ? surface_of(mesh).periodic : mesh.flat.periodic;
}

std::size_t node_count(const std::vector<PeriodicLink>& links) {
  std::size_t count = 0;
  for (const PeriodicLink& link : links) count += link.nodes.size();
  return count;
}

}  // namespace

carreau_status carreau_model_add_periodicity(carreau_session* session, const int32_t* slave_faces, const int32_t* master_faces,
                                             int64_t n, const double* transform) {
  return guarded(session, [&] {
    if (transform != nullptr && std::all_of(transform, transform + 12, [](double x) { return x == 0; })) transform = nullptr;
    if (n < 0) throw InvalidArgument("a periodicity has " + std::to_string(n) + " pairs of faces");
    if (n > 0) required(slave_faces, "slave_faces"), required(master_faces, "master_faces");
    if (n == 0 && transform == nullptr) throw InvalidArgument("a periodicity has neither faces nor a map");
    carreau::Periodicity given;
    for (int64_t i = 0; i < n; ++i) {
      require_face(session->model(), slave_faces[i]), require_face(session->model(), master_faces[i]);
      if (slave_faces[i] == master_faces[i] && transform == nullptr)
        throw InvalidArgument(carreau::Where{.face = slave_faces[i]}, "the face is periodic with itself: its map must be given");
      given.slaves.push_back(slave_faces[i]), given.masters.push_back(master_faces[i]);
    }
    if (transform != nullptr) given.map = isometry_of(transform);
    if (given.map && !(given.map->distortion() <= carreau::isometry_tolerance))
      throw InvalidArgument("the map of a periodicity changes lengths, or is not finite: R R^T differs from the identity by " +
                            carreau::short_number(given.map->distortion()));
    session->edited_model().periodicities.push_back(std::move(given));
  });
}

carreau_status carreau_model_add_period(carreau_session* session, const double* direction) {
  return guarded(session, [&] {
    required(direction, "direction");
    const carreau::Vec3 along(direction[0], direction[1], direction[2]);
    if (!carreau::is_finite(along) || !(carreau::norm(along) > 0)) throw InvalidArgument("the direction of a period has no length, or is not finite");
    carreau::Periodicity given;
    given.direction = along;
    session->edited_model().periodicities.push_back(std::move(given));
  });
}

carreau_status carreau_mesh_periodic_count(carreau_mesh* mesh, int64_t* out_pairs, int64_t* out_nodes) {
  return guarded(mesh, [&] {
    const std::vector<PeriodicLink>& links = links_of(*mesh);
    if (out_pairs != nullptr) *out_pairs = std::int64_t(links.size());
    if (out_nodes != nullptr) *out_nodes = std::int64_t(node_count(links));
  });
}

carreau_status carreau_mesh_periodic(carreau_mesh* mesh, int64_t capacity, int64_t node_capacity, int32_t* out_dimensions,
                                     int32_t* out_refs, double* out_transforms, int64_t* out_counts, int32_t* out_nodes) {
  return guarded(mesh, [&] {
    const std::vector<PeriodicLink>& links = links_of(*mesh);
    check_capacity(capacity, links.size(), "periodic pairs");
    if (out_nodes != nullptr) check_capacity(node_capacity, node_count(links), "pairs of nodes");
    for (std::size_t i = 0; i < links.size(); ++i) {
      const PeriodicLink& link = links[i];
      if (out_dimensions != nullptr) out_dimensions[i] = link.dimension;
      if (out_refs != nullptr) out_refs[2 * i] = link.slave, out_refs[2 * i + 1] = link.master;
      if (out_counts != nullptr) out_counts[i] = std::int64_t(link.nodes.size());
      for (int k = 0; k < 12 && out_transforms != nullptr; ++k)
        out_transforms[12 * i + std::size_t(k)] = k % 4 == 3 ? link.map.shift[k / 4] : link.map.row[std::size_t(k / 4)][k % 4];
      for (const auto& nodes : link.nodes)
        if (out_nodes != nullptr) out_nodes = std::copy(nodes.begin(), nodes.end(), out_nodes);
    }
  });
}
