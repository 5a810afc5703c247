// SPDX-License-Identifier: BSD-3-Clause
// Quality, defects, regions and crossing triangles of a mesh.
#include <algorithm>
#include <span>
#include <thread>

#include "arguments.h"
#include "carreau.h"
#include "guard.h"
#include "high_order/curved_quality.h"
#include "mesh/crossings/intersections.h"
#include "mesh/defects/flat_defects.h"
#include "mesh/quality.h"
#include "mesh/regions.h"
#include "mesh_content.h"

using carreau::FlatMesh;
using carreau::InvalidArgument;
using namespace carreau::abi;

namespace {

int processor_count() { return std::max(1, int(std::thread::hardware_concurrency())); }

void copy_pairs(std::span<const carreau::TriangleIntersection> pairs, std::size_t most, std::int32_t* out_triangles,
                double* out_xyz) {
  for (const carreau::TriangleIntersection& pair : pairs.first(std::min(most, pairs.size()))) {
    if (out_triangles != nullptr) out_triangles = std::copy(pair.triangles.begin(), pair.triangles.end(), out_triangles);
    if (out_xyz != nullptr) *out_xyz++ = pair.place.x(), *out_xyz++ = pair.place.y(), *out_xyz++ = pair.place.z();
  }
}

carreau::MeshRegions regions_of(const carreau_mesh& mesh) {
  require_content(mesh);
  if (mesh.session == nullptr) return carreau::find_regions(mesh.flat);
  FlatMesh flat = carreau::abi::flat_of(mesh);
  flat.names = entity_names_of(mesh);
  return carreau::find_regions(flat);
}

}  // namespace

carreau_quality carreau::abi::quality_of(const carreau::QualitySummary& summary) {
  carreau_quality result{};
  result.vertices = std::int64_t(summary.vertices);
  result.triangles = std::int64_t(summary.triangles);
  result.edges = std::int64_t(summary.edges);
  result.open_edges = std::int64_t(summary.open_edges);
  result.q1_mean = summary.q1.mean, result.q1_min = summary.q1.min;
  result.q1_p1 = summary.q1.p1, result.q1_max = summary.q1.max;
  result.q2_mean = summary.q2.mean, result.q2_min = summary.q2.min;
  result.q2_p1 = summary.q2.p1, result.q2_max = summary.q2.max;
  result.angle_min = summary.angle_min_deg, result.angle_max = summary.angle_max_deg;
  result.area = summary.area;
  result.edge_min = summary.edge_min, result.edge_mean = summary.edge_mean, result.edge_max = summary.edge_max;
  result.degree6 = summary.degree6;
  return result;
}

carreau_status carreau_mesh_quality(carreau_mesh* mesh, carreau_quality* out_quality) {
  return guarded(mesh, [&] {
    require_content(*mesh);
    const carreau::QualitySummary summary =
        mesh->session != nullptr
            ? mesh->session->session.quality()
            : carreau::summarise_quality(mesh->flat, processor_count());
    write_struct(quality_of(summary), out_quality, "out_quality");
  });
}

carreau_status carreau_mesh_defects(carreau_mesh* mesh, int32_t closed, int64_t limit, int64_t* out_count,
                                    const char** out_text) {
  return guarded(mesh, [&] {
    required(out_count, "out_count");
    required(out_text, "out_text");
    if (limit <= 0) throw InvalidArgument("limit is " + std::to_string(limit) + ", not greater than 0");
    require_content(*mesh);
    carreau::DefectOptions options;
    options.closed = closed != 0;
    options.limit = std::size_t(limit);
    std::vector<std::string> of_elements;
    if (mesh->curved) of_elements = carreau::find_curved_defects(*mesh->curved);
    const std::vector<std::string> defects = mesh->session != nullptr
                                                 ? carreau::find_defects(surface_of(*mesh), options)
                                                 : carreau::find_defects(mesh->flat, options, mesh->curved ? &of_elements : nullptr);
    std::string text;
    for (const std::string& defect : defects) text += (text.empty() ? "" : "\n") + defect;
    mesh->text = std::move(text);
    *out_count = std::int64_t(defects.size());
    *out_text = mesh->text.c_str();
  });
}

carreau_status carreau_mesh_regions(carreau_mesh* mesh, int64_t capacity, int64_t* out_count, int32_t* out_solids, double* out_xyz) {
  return guarded(mesh, [&] {
    required(out_count, "out_count");
    if (capacity < 0) throw InvalidArgument("capacity is " + std::to_string(capacity) + ", below 0");
    *out_count = 0;
    carreau::MeshRegions found = regions_of(*mesh);
    std::vector<carreau::MeshRegion>& all = found.solids;
    all.insert(all.end(), found.holes.begin(), found.holes.end());
    *out_count = static_cast<std::int64_t>(all.size());
    for (std::size_t i = 0; i < all.size() && i < static_cast<std::size_t>(capacity); ++i) {
      if (out_solids != nullptr) out_solids[i] = all[i].solid;
      for (int k = 0; k < 3 && out_xyz != nullptr; ++k) out_xyz[3 * i + static_cast<std::size_t>(k)] = all[i].inside[k];
    }
  });
}

carreau_status carreau_mesh_triangle_sides(carreau_mesh* mesh, int64_t capacity, int32_t* out_solids) {
  return guarded(mesh, [&] {
    const carreau::MeshRegions found = regions_of(*mesh);
    if (capacity < static_cast<std::int64_t>(found.sides.size()))
      throw InvalidArgument("capacity is " + std::to_string(capacity) + ", and there are " + std::to_string(found.sides.size()) + " triangles");
    required(out_solids, "out_solids");
    for (std::size_t t = 0; t < found.sides.size(); ++t) std::copy_n(found.sides[t].begin(), 2, out_solids + 2 * t);
  });
}

carreau_status carreau_mesh_intersections(carreau_mesh* mesh, int32_t threads, int64_t capacity, int64_t* out_count,
                                          int32_t* out_triangles, double* out_xyz) {
  return guarded(mesh, [&] {
    required(out_count, "out_count");
    if (threads < 0) throw InvalidArgument("threads is " + std::to_string(threads) + ", below 0");
    if (capacity < 0) throw InvalidArgument("capacity is " + std::to_string(capacity) + ", below 0");
    require_content(*mesh);
    *out_count = 0;
    const carreau::Session* const session = mesh->session != nullptr ? &mesh->session->session : nullptr;
    if (session != nullptr && session->knows_crossings(std::size_t(capacity))) {
      *out_count = session->report().crossings;
      copy_pairs(session->crossings(), std::size_t(capacity), out_triangles, out_xyz);
      return;
    }
    carreau::Monitor silent;
    carreau::IntersectionOptions options;
    options.limit = std::size_t(capacity);
    options.threads = threads > 0 ? threads : processor_count();
    FlatMesh copy;
    if (mesh->session != nullptr) copy = flat_of(*mesh);
    const FlatMesh& flat = mesh->session != nullptr ? copy : mesh->flat;
    const carreau::Intersections found = carreau::find_intersections(flat.vertices, flat.triangles, options, silent);
    *out_count = found.count;
    copy_pairs(found.pairs, found.pairs.size(), out_triangles, out_xyz);
  });
}
