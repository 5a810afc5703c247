// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "arguments.h"
#include "carreau_geometry.h"
#include "geometry/discrete/discrete_cad.h"
#include "geometry/discrete/refinement.h"
#include "guard.h"
#include "io/mesh_files.h"
#include "measure/discrete_evaluation.h"
#include "mesh/distance/surface_distance.h"
#include "model/geometries.h"
#include "session/options.h"

using carreau::FlatMesh;
using carreau::InvalidArgument;
using carreau::Level;
using namespace carreau::abi;
namespace discrete = carreau::discrete;

namespace {

struct Options {
  discrete::SharpOptions sharp;
  bool join = true;
};

Options options_of(const carreau_triangles_options* given) {
  Options options;
  if (given == nullptr) return options;
  const carreau_triangles_options known = read_struct(given, "carreau_triangles_options");
  if (known.sharp_angle != 0) options.sharp.sharp_angle = known.sharp_angle;
  if (known.corner_angle != 0) options.sharp.corner_angle = known.corner_angle;
  options.sharp.marked_only = known.given_edges_only != 0;
  options.sharp.references = known.ignore_references == 0;
  options.join = known.keep_double_vertices == 0;
  return options;
}

FlatMesh mesh_of(const carreau_triangles& given) {
  FlatMesh mesh;
  const std::size_t n = count_of(given.vertex_count, "triangles->vertex_count"),
                    m = count_of(given.triangle_count, "triangles->triangle_count"), k = count_of(given.edge_count, "triangles->edge_count");
  if (n > 0) required(given.vertices, "triangles->vertices");
  if (m > 0) required(given.triangles, "triangles->triangles");
  if (k > 0) required(given.edges, "triangles->edges");
  for (std::size_t i = 0; i < n; ++i)
    mesh.vertices.emplace_back(given.vertices[3 * i], given.vertices[3 * i + 1], given.vertices[3 * i + 2]);
  for (std::size_t i = 0; i < m; ++i)
    mesh.triangles.push_back({given.triangles[3 * i], given.triangles[3 * i + 1], given.triangles[3 * i + 2]});
  if (given.triangle_refs != nullptr) mesh.triangle_refs.assign(given.triangle_refs, given.triangle_refs + m);
  for (std::size_t i = 0; i < k; ++i) {
    mesh.edges.push_back({given.edges[2 * i], given.edges[2 * i + 1]});
    for (const std::int32_t v : mesh.edges.back())
      if (v < 0 || static_cast<std::size_t>(v) >= n)
        throw InvalidArgument("edge " + std::to_string(i) + " (from 0) names vertex " + std::to_string(v) + " of " +
                              std::to_string(n));
  }
  return mesh;
}

void add(carreau_session& session, const FlatMesh& mesh, const Options& options) {
  session.refuse_begun();
  session.monitor.begin_run();
  discrete::Triangulation triangulation(mesh, options.join);
  discrete::SharpLines lines = find_sharp_lines(triangulation, options.sharp);
  for (const auto* sentences : {&triangulation.findings.sentences, &lines.sentences})
    for (const std::string& sentence : *sentences) session.monitor.message(Level::warning, sentence);
  auto surface = std::make_shared<const discrete::DiscreteSurface>(std::move(triangulation), std::move(lines));
  carreau::BuiltGeometry built = discrete_geometry(surface);
  // Names and colours of a file belong to its references.
  if (surface->mesh().refs.front() == face_refs(*surface).front())
    for (carreau::Face& face : built.model.faces)
      for (const carreau::FlatFace& known : mesh.faces)
        if (known.ref == face.ref) face.name = known.name, face.rgb = known.rgb;
  session.add_triangles(std::move(surface), std::move(built));
}

const discrete::DiscreteSurface& surface_of(const carreau_session& session) {
  if (!session.triangles)
    throw StatusError(CARREAU_ERR_SEQUENCE, "the session was given no triangles: call carreau_add_triangles first");
  return session.triangles->discrete();
}

/// Pairs of the files by vertices of the surface, which have the same places.
std::vector<carreau::PeriodicLink> periodic_of(const carreau_session& session, const discrete::DiscreteSurface& surface) {
  const auto key = [](const carreau::Vec3& p) { return std::array{p.x(), p.y(), p.z()}; };
  std::map<std::array<double, 3>, std::int32_t> vertex;
  const std::vector<carreau::Vec3>& places = surface.mesh().vertices;
  for (std::size_t v = 0; v < places.size() && !session.periodic_files.empty(); ++v) vertex.emplace(key(places[v]), std::int32_t(v));
  std::vector<carreau::PeriodicLink> links;
  for (const FlatMesh& file : session.periodic_files)
    for (carreau::PeriodicLink link : file.periodic) {
      std::vector<std::array<std::int32_t, 2>> nodes;
      for (const auto& [slave, master] : link.nodes) {
        const auto w = vertex.find(key(file.vertices[std::size_t(slave)])), v = vertex.find(key(file.vertices[std::size_t(master)]));
        if (v != vertex.end() && w != vertex.end()) nodes.push_back({w->second, v->second});
      }
      link.nodes = std::move(nodes);
      if (!link.nodes.empty()) links.push_back(std::move(link));
    }
  return links;
}

/// The mesh of the session, without faces of other geometries.
FlatMesh mesh_of_triangles(const carreau_session& session) {
  if (!session.session.has_mesh()) throw StatusError(CARREAU_ERR_SEQUENCE, "there is no mesh yet");
  FlatMesh flat = carreau::flatten(session.session.mesh(), false);
  std::set<std::int32_t> others;
  for (const carreau::Face& face : session.model().faces)
    if (!face.discrete) others.insert(face.ref);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < flat.triangles.size(); ++t)
    if (!others.contains(flat.triangle_refs[t])) flat.triangles[kept++] = flat.triangles[t];
  flat.triangles.resize(kept);
  return flat;
}

}  // namespace

// New faces have references behind the previous references of the session.
void carreau_session::add_triangles(std::shared_ptr<const discrete::DiscreteSurface> surface,
                                    carreau::BuiltGeometry built) {
  refuse_plane();
  surfaces.reserve(surfaces.size() + 1);
  std::vector<discrete::PlacedSurface> all = surfaces;
  all.push_back({std::move(surface), largest_references(model()).face + 1});
  std::vector<std::string> sentences;
  const auto together = std::make_shared<discrete::DiscreteCad>(side_by_side(all, sentences));
  const std::vector<std::int32_t> refs = face_refs(together->discrete());
  const std::set<std::int32_t> left(refs.begin(), refs.end());
  std::erase_if(built.model.faces,
                [&](const carreau::Face& face) { return !left.contains(face.ref + all.back().first_face - 1); });
  if (built.model.faces.empty()) throw InvalidArgument("all triangles belong to surfaces of the session already");
  for (const std::string& sentence : sentences) monitor.message(Level::warning, sentence);
  add_geometry(CARREAU_GEOMETRY_TRIANGLES, together, std::move(built.model));
  surfaces.push_back(std::move(all.back()));
  triangles = together;
  for (AddedGeometry& geometry : added)
    if (geometry.kind == CARREAU_GEOMETRY_TRIANGLES) geometry.cad = together;
  update_cad();
}

carreau_status carreau_add_triangles(carreau_session* session, const carreau_triangles_options* options,
                                     const carreau_triangles* triangles) {
  return guarded(session, [&] {
    const Options known = options_of(options);
    add(*session, mesh_of(read_struct(triangles, "carreau_triangles")), known);
  });
}

carreau_status carreau_load_triangles(carreau_session* session, const carreau_triangles_options* options,
                                      const char* path) {
  return guarded(session, [&] {
    const Options known = options_of(options);
    const FlatMesh mesh = carreau::read_mesh(required(path, "path"));
    add(*session, mesh, known);
    if (mesh.periodic.empty()) return;
    FlatMesh& pairs = session->periodic_files.emplace_back();
    pairs.vertices = mesh.vertices, pairs.periodic = mesh.periodic;
    for (carreau::PeriodicLink& link : pairs.periodic)
      if (link.dimension == 2) link.master += session->surfaces.back().first_face - 1, link.slave += session->surfaces.back().first_face - 1;
  });
}

carreau_status carreau_triangles_measure(carreau_session* session, carreau_triangles_report* out_report) {
  return guarded(session, [&] {
    const discrete::DiscreteSurface& surface = surface_of(*session);
    const discrete::Triangulation& mesh = surface.mesh();
    const discrete::Findings& found = mesh.findings;
    const discrete::SharpLines& lines = surface.lines();
    carreau_triangles_report report{};
    report.vertices = std::int64_t(mesh.vertices.size()), report.triangles = std::int64_t(mesh.triangles.size());
    report.edges = std::int64_t(mesh.edges.size());
    report.shells = found.shells, report.euler_number = found.euler_number;
    report.border_edges = found.border_edges, report.manifold_breaks = found.manifold_breaks;
    report.one_sided_edges = found.one_sided_edges, report.pinched_vertices = found.pinched_vertices;
    report.turned_triangles = found.turned_triangles, report.repeated_triangles = found.repeated_triangles;
    report.flat_triangles = found.flat_triangles;
    report.sharp_edges = lines.edges, report.lines = std::int64_t(lines.lines.size());
    report.corners = std::int64_t(lines.corners.size()), report.regions = lines.regions;
    report.dropped_edges = lines.dropped, report.prolonged_edges = lines.prolonged, report.faded_ends = lines.faded;
    report.unfolded = surface.unfolded(), report.folded = surface.folded();
    report.diagonal = mesh.diagonal(), report.deviation = surface.deviation();
    report.sharp_angle = lines.sharp_angle;
    write_struct(report, out_report, "out_report");
  });
}

carreau_status carreau_triangles_refine(carreau_session* session, double angle, int32_t depth, carreau_mesh* mesh) {
  return guarded(session, [&] {
    const discrete::DiscreteSurface& surface = surface_of(*session);
    if (required(mesh, "mesh")->session != nullptr)
      throw InvalidArgument("the mesh of a session cannot be replaced: use carreau_mesh_create");
    if (depth < 0) throw InvalidArgument("the depth of refinement is " + std::to_string(depth));
    session->monitor.begin_run();
    discrete::RefinementLimits limits{.depth = depth};
    if (const int most = session->parameters->integer("max_triangles"); most > 0) limits.triangles = most;
    std::vector<carreau::PeriodicLink> pairs = periodic_of(*session, surface);
    discrete::RefinedMesh refined;
    if (depth == 0)
      refined = unrefined(surface), refined.periodic = std::move(pairs);
    else
      refined = refine(surface, wish_of_angle(surface, angle), limits, session->monitor, std::move(pairs));
    if (!refined.complete)
      session->monitor.message(Level::warning,
                               "triangles differ from the surface by more than the angle: the depth of " +
                                   std::to_string(depth) + " is reached");
    mesh->flat = flat_mesh(surface, refined);
    mesh->flat_faces = faces_of(mesh->flat);
    mesh->filled = true;
    mesh->part.reset();
    mesh->corner_uv.clear();
  });
}

carreau_status carreau_triangles_distances(carreau_session* session, double out_distances[2]) {
  return guarded(session, [&] {
    required(out_distances, "out_distances");
    const discrete::Triangulation& input = surface_of(*session).mesh();
    const FlatMesh flat = mesh_of_triangles(*session);
    session->monitor.begin_run();
    session->session.together([&](const carreau::Executor& executor) {
      out_distances[0] =
          largest_distance(flat.vertices, flat.triangles, input.vertices, input.triangles, session->monitor, executor);
      out_distances[1] =
          largest_distance(input.vertices, input.triangles, flat.vertices, flat.triangles, session->monitor, executor);
    });
  });
}

carreau_status carreau_triangles_bounds(carreau_session* session, double share, double out_bounds[4]) {
  return guarded(session, [&] {
    required(out_bounds, "out_bounds");
    const discrete::Triangulation& input = surface_of(*session).mesh();
    if (!(share >= 0) || !std::isfinite(share))
      throw InvalidArgument("the share of the distance must be finite and not negative");
    const FlatMesh flat = mesh_of_triangles(*session);
    if (session->session.mesh().cells_are_not_triangles())
      throw InvalidArgument("distances are bounded of meshes of straight triangles alone");
    session->monitor.begin_run();
    carreau::DistanceTolerance tolerance;
    if (share > 0) tolerance.share = share;
    const carreau::TrianglesOfSpace made{flat.vertices, flat.triangles}, given{input.vertices, input.triangles};
    session->session.together([&](const carreau::Executor& executor) {
      std::vector<carreau::FarPoint> of_made, of_given;
      const carreau::DistanceBounds there =
                                        bound_distance(made, given, tolerance, executor, session->monitor, nullptr, &of_made),
                                    back = bound_distance(given, made, tolerance, executor, session->monitor, nullptr, &of_given);
      warn_of_distance(farthest_by_size(made, of_made, of_given), session->monitor);
      out_bounds[0] = there.lower, out_bounds[1] = there.upper, out_bounds[2] = back.lower, out_bounds[3] = back.upper;
    });
  });
}
