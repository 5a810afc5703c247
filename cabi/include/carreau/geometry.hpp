// SPDX-License-Identifier: BSD-3-Clause
/// Geometries that the library evaluates itself: carreau_geometry.h, see carreau.hpp.
#ifndef CARREAU_GEOMETRY_HPP
#define CARREAU_GEOMETRY_HPP

#include "../carreau_geometry.h"
#include "session.hpp"

namespace carreau {

// ---- Several geometries in one session ----

/// All geometries that were added, in that order.
inline std::vector<carreau_geometry> geometries(Session& session) {
  std::int64_t n = 0;
  session.done(carreau_geometry_count(session.get(), &n));
  std::vector<carreau_geometry> out(static_cast<std::size_t>(n), detail::sized<carreau_geometry>());
  for (std::int64_t i = 0; i < n; ++i) session.done(carreau_geometry_info(session.get(), i, &out[static_cast<std::size_t>(i)]));
  return out;
}

/// Adds a geometry of callbacks beside the geometries of the session. `describe` adds its faces and curves, under references of this
/// geometry. When it throws, the session is as it was before, and the exception goes on.
template <typename Describe>
void add_geometry(Session& session, Geometry geometry, Describe&& describe) {
  session.give(std::move(geometry), carreau_geometry_begin);
  try {
    describe();
  } catch (...) {
    carreau_geometry_cancel(session.get());
    throw;
  }
  session.done(carreau_geometry_end(session.get()));
}

// ---- Places of the model ----

/// Positions and derivatives at places; derivatives above the order are empty.
struct Evaluated {
  std::vector<Point3> xyz{};
  std::vector<Point3> first{};   ///< of a face S_u, S_v in turn; of a curve dx/dt
  std::vector<Point3> second{};  ///< of a face S_uu, S_uv, S_vv in turn; of a curve the second derivative
};

/// Evaluates a face at places (u, v), by derivatives up to `order`.
inline Evaluated evaluate_face(Session& session, int face, std::span<const Point2> uv, int order = 0) {
  Evaluated out{std::vector<Point3>(uv.size()), std::vector<Point3>(order > 0 ? 2 * uv.size() : 0), std::vector<Point3>(order > 1 ? 3 * uv.size() : 0)};
  session.done(carreau_evaluate(session.get(), 2, face, detail::count_of(uv.size()), detail::flat(uv), order, detail::flat(out.xyz),
                                order > 0 ? detail::flat(out.first) : nullptr, order > 1 ? detail::flat(out.second) : nullptr));
  return out;
}
/// Evaluates a curve, by its reference, at parameters t.
inline Evaluated evaluate_curve(Session& session, int curve, std::span<const double> t, int order = 0) {
  Evaluated out{std::vector<Point3>(t.size()), std::vector<Point3>(order > 0 ? t.size() : 0), std::vector<Point3>(order > 1 ? t.size() : 0)};
  session.done(carreau_evaluate(session.get(), 1, curve, detail::count_of(t.size()), t.data(), order, detail::flat(out.xyz),
                                order > 0 ? detail::flat(out.first) : nullptr, order > 1 ? detail::flat(out.second) : nullptr));
  return out;
}

/// Closest points of entities of one dimension.
struct Projected {
  std::vector<std::int32_t> references{};
  std::vector<double> parameters{};  ///< n x dimension
  std::vector<Point3> closest{};
  std::vector<double> distances{};
};
/// Projects points to faces (dimension 2), curves (1) or points (0); reference 0: to the closest of all.
inline Projected project(Session& session, std::span<const Point3> xyz, int dimension = 2, int reference = 0) {
  const std::size_t columns = dimension > 0 ? static_cast<std::size_t>(dimension) : 0;
  Projected out{std::vector<std::int32_t>(xyz.size()), std::vector<double>(columns * xyz.size()), std::vector<Point3>(xyz.size()),
                std::vector<double>(xyz.size())};
  session.done(carreau_project(session.get(), dimension, reference, detail::count_of(xyz.size()), detail::flat(xyz), out.references.data(),
                               out.parameters.data(), detail::flat(out.closest), out.distances.data()));
  return out;
}

/// Embeds a point of space in the nearest face, or in a curve or point within embed_tolerance; returns its reference.
inline int embed_point(Session& session, const Point3& xyz, const std::string& name = "") {
  std::int32_t ref = 0;
  session.done(carreau_model_embed_point(session.get(), xyz.data(), name.c_str(), &ref));
  return ref;
}
/// Embeds a polyline in the faces that it lies on; returns the reference that names its edges.
inline int embed_polyline(Session& session, std::span<const Point3> xyz, const std::string& name = "") {
  std::int32_t ref = 0;
  session.done(carreau_model_embed_polyline(session.get(), detail::count_of(xyz.size()), detail::flat(xyz), name.c_str(), &ref));
  return ref;
}
/// Embeds the wires that lie on faces; returns their number.
inline std::int64_t embed_wires(Session& session) {
  std::int64_t count = 0;
  session.done(carreau_model_embed_wires(session.get(), &count));
  return count;
}
/// Embeds the ridges of grids whose radius of curvature is below `radius`; returns their number.
inline std::int64_t embed_ridges(Session& session, double radius) {
  std::int64_t count = 0;
  session.done(carreau_model_embed_ridges(session.get(), radius, &count));
  return count;
}

/// The entities that vertices of a mesh lie on: points (dimension 0), curves (1) and faces (2).
struct VertexEntities {
  std::vector<std::int32_t> dimensions{}, references{};
};
inline VertexEntities vertex_entities(const Mesh& mesh) {
  const auto n = static_cast<std::size_t>(mesh.vertex_count());
  VertexEntities out{std::vector<std::int32_t>(n), std::vector<std::int32_t>(n)};
  mesh.done(carreau_mesh_vertex_entities(mesh.get(), detail::count_of(n), out.dimensions.data(), out.references.data()));
  return out;
}
/// Parameters of the ends of edges on curve ic of a face.
struct EdgeParameters {
  std::vector<std::array<double, 2>> t{};
  std::vector<std::int32_t> faces{}, ics{};
};
inline EdgeParameters edge_parameters(const Mesh& mesh) {
  const auto n = static_cast<std::size_t>(mesh.edge_count());
  EdgeParameters out{std::vector<std::array<double, 2>>(n), std::vector<std::int32_t>(n), std::vector<std::int32_t>(n)};
  mesh.done(carreau_mesh_edge_parameters(mesh.get(), detail::count_of(n), detail::flat(out.t), out.faces.data(), out.ics.data()));
  return out;
}

/// Carries the mesh of another session to the geometry of this one; `match` is CARREAU_MATCH_....
inline Outcome carry_mesh(Session& session, const Mesh& old_mesh, int match = CARREAU_MATCH_ANY) {
  return session.outcome(carreau_mesh_carry(session.get(), old_mesh.get(), match));
}
/// Halves all edges of the mesh.
inline void halve_mesh(Session& session, int times = 1) { session.done(carreau_mesh_halve(session.get(), times)); }
/// Halves these edges, by vertices, or all edges of these elements.
inline void refine_edges(Session& session, std::span<const std::array<std::int32_t, 2>> edges) {
  session.done(carreau_mesh_refine(session.get(), CARREAU_MARK_EDGES, detail::count_of(edges.size()), detail::flat(edges)));
}
inline void refine_elements(Session& session, std::span<const std::int32_t> elements) {
  session.done(carreau_mesh_refine(session.get(), CARREAU_MARK_ELEMENTS, detail::count_of(elements.size()), elements.data()));
}
/// Halves edges until they fit the sizes at vertices.
inline void refine_to_sizes(Session& session, std::span<const double> sizes) {
  session.done(carreau_mesh_refine_sizes(session.get(), detail::count_of(sizes.size()), sizes.data()));
}

/// Elements of order 2 to 4 over the mesh; `places` is CARREAU_EQUIDISTANT or CARREAU_GAUSS_LOBATTO. Returns the number of invalid ones.
inline std::int64_t raise_order(Session& session, int order, int places = CARREAU_EQUIDISTANT) {
  std::int64_t invalid = 0;
  session.done(carreau_raise_order(session.get(), order, places, &invalid));
  return invalid;
}
/// Nodes, and rows of nodes of elements by kind with the references of faces or curves.
struct RaisedElements {
  std::vector<Point3> nodes{};
  std::vector<std::int32_t> triangles{}, triangle_refs{}, quads{}, quad_refs{}, edges{}, edge_refs{};
};
inline RaisedElements raised_elements(Session& session, int order) {
  std::int64_t n = 0, triangles = 0, quads = 0, edges = 0;
  session.done(carreau_raised_count(session.get(), &n, &triangles, &quads, &edges));
  RaisedElements out;
  const auto size = [](std::int64_t count, int width) { return static_cast<std::size_t>(count) * static_cast<std::size_t>(width); };
  out.nodes.resize(size(n, 1));
  out.triangles.resize(size(triangles, (order + 1) * (order + 2) / 2)), out.triangle_refs.resize(size(triangles, 1));
  out.quads.resize(size(quads, (order + 1) * (order + 1))), out.quad_refs.resize(size(quads, 1));
  out.edges.resize(size(edges, order + 1)), out.edge_refs.resize(size(edges, 1));
  session.done(carreau_raised_nodes(session.get(), n, detail::flat(out.nodes)));
  if (triangles > 0) session.done(carreau_raised_elements(session.get(), 3, triangles, out.triangles.data(), out.triangle_refs.data()));
  if (quads > 0) session.done(carreau_raised_elements(session.get(), 4, quads, out.quads.data(), out.quad_refs.data()));
  if (edges > 0) session.done(carreau_raised_elements(session.get(), 2, edges, out.edges.data(), out.edge_refs.data()));
  return out;
}
inline void write_raised(Session& session, const std::string& path) { session.done(carreau_raised_write(session.get(), path.c_str())); }

/// Points of a face at places (u, v).
inline std::vector<Point3> geometry_points(Session& session, int face, std::span<const Point2> uv) {
  std::vector<Point3> out(uv.size());
  session.done(carreau_geometry_points(session.get(), face, detail::count_of(uv.size()), detail::flat(uv), detail::flat(out)));
  return out;
}
/// (u, v) at a share, 0 to 1, of curve ic of a face.
inline Point2 geometry_curve(Session& session, int face, int ic, double share) {
  Point2 out{};
  session.done(carreau_geometry_curve(session.get(), face, ic, share, out.data()));
  return out;
}

// ---- Bezier patches ----

/// One patch: degrees m in u and n in v, and (m + 1)(n + 1) control points, v running fastest.
struct BezierPatch {
  int m = 3, n = 3;
  std::vector<Point3> controls{};
  std::array<std::int32_t, 4> side_refs{}; ///< of v = 0, u = 1, v = 1, u = 0; all 0 in all patches: found by comparing positions
};

inline void add_bezier(Session& session, std::span<const BezierPatch> patches) {
  std::vector<std::int32_t> degrees, sides;
  std::vector<Point3> controls;
  bool given = false;
  for (const BezierPatch& patch : patches) {
    if (patch.m < 0 || patch.n < 0 || patch.controls.size() != (static_cast<std::size_t>(patch.m) + 1) * (static_cast<std::size_t>(patch.n) + 1))
      detail::fail(CARREAU_ERR_ARGUMENT, "A Bezier patch does not have (m + 1)(n + 1) control points.");
    degrees.insert(degrees.end(), {patch.m, patch.n});
    controls.insert(controls.end(), patch.controls.begin(), patch.controls.end());
    sides.insert(sides.end(), patch.side_refs.begin(), patch.side_refs.end());
    given = given || patch.side_refs != std::array<std::int32_t, 4>{};
  }
  auto in = detail::sized<carreau_bezier>();
  in.patch_count = detail::count_of(patches.size());
  in.degrees = degrees.data();
  in.controls = detail::flat(controls);
  in.side_refs = given ? sides.data() : nullptr;
  session.done(carreau_add_bezier(session.get(), &in));
}
inline void load_bezier(Session& session, const std::string& path) { session.done(carreau_load_bezier(session.get(), path.c_str())); }
inline std::array<std::int32_t, 2> bezier_degrees(Session& session, int face) {
  std::array<std::int32_t, 2> out{};
  session.done(carreau_bezier_degrees(session.get(), face, out.data()));
  return out;
}

// ---- Molecules ----

/// surface: CARREAU_VWS, CARREAU_SAS or CARREAU_SES.
struct MoleculeOptions {
  int surface = CARREAU_VWS;
  double probe = 0;
  bool drop_cavities = false;
  std::string radii = {}; ///< file of lines "symbol radius"; empty: none
};
/// Values of each atom.
struct MoleculeAtoms {
  std::vector<std::int32_t> refs;
  std::vector<double> areas, convex, torus, concave; ///< areas: of convex parts alone for CARREAU_SES
};

namespace detail {

inline carreau_molecule_options c_of(const MoleculeOptions& options) {
  auto out = sized<carreau_molecule_options>();
  out.surface = options.surface;
  out.drop_cavities = options.drop_cavities ? 1 : 0;
  out.probe = options.probe;
  out.radii = options.radii.empty() ? nullptr : options.radii.c_str(); // lives as long as `options`
  return out;
}

} // namespace detail

inline void add_molecule(Session& session, const MoleculeOptions& options, std::span<const Point3> centers, std::span<const double> radii) {
  const carreau_molecule_options in = detail::c_of(options);
  if (centers.size() != radii.size()) detail::fail(CARREAU_ERR_ARGUMENT, "A molecule does not have as many centers as radii.");
  session.done(carreau_add_molecule(session.get(), &in, detail::count_of(radii.size()), detail::flat(centers), detail::data_or_null(radii)));
}
inline void load_molecule(Session& session, const MoleculeOptions& options, const std::string& path) {
  const carreau_molecule_options in = detail::c_of(options);
  session.done(carreau_load_molecule(session.get(), &in, path.c_str()));
}
inline carreau_molecule_measures molecule_measure(Session& session) { return session.filled(carreau_molecule_measure); }
inline MoleculeAtoms molecule_atoms(Session& session) {
  const std::int64_t n = molecule_measure(session).atoms;
  const auto size = static_cast<std::size_t>(n);
  MoleculeAtoms out{std::vector<std::int32_t>(size), std::vector<double>(size), std::vector<double>(size), std::vector<double>(size),
                    std::vector<double>(size)};
  session.done(carreau_molecule_atoms(session.get(), n, out.refs.data(), out.areas.data()));
  session.done(carreau_molecule_atom_areas(session.get(), n, out.convex.data(), out.torus.data(), out.concave.data()));
  return out;
}
/// Residue of an atom, from 0; "" when it has none, std::nullopt: no such atom.
inline std::optional<std::string> molecule_atom_name(Session& session, std::int64_t atom) {
  const char* name = carreau_molecule_atom_name(session.get(), atom);
  return name == nullptr ? std::nullopt : std::optional<std::string>(name);
}

// ---- Plane domains ----

/// The struct of the C interface, whose struct_size need not be set: it holds pointers to arrays of the caller.
inline void add_plane_domain(Session& session, const carreau_plane_domain& domain) {
  const carreau_plane_domain in = detail::sized(domain);
  session.done(carreau_add_plane_domain(session.get(), &in));
}
inline void load_plane_domain(Session& session, const std::string& path, const std::string& sizes = "", double corner_angle = 0) {
  session.done(carreau_load_plane_domain(session.get(), path.c_str(), sizes.c_str(), corner_angle));
}
inline bool plane_has_sizes(Session& session) {
  std::int32_t out = 0;
  session.done(carreau_plane_has_sizes(session.get(), &out));
  return out != 0;
}

// ---- Structured grids ----

/// A block of nodes, columns running fastest; NaN: missing.
struct GridBlock {
  int columns = 0, rows = 0;
  std::span<const Point3> nodes{};
};

inline void add_grid(Session& session, std::span<const GridBlock> blocks, const carreau_grid_options& options = {}) {
  const carreau_grid_options in = detail::sized(options);
  std::vector<std::int32_t> counts;
  std::vector<Point3> nodes;
  for (const GridBlock& block : blocks) {
    if (block.columns < 0 || block.rows < 0 || block.nodes.size() != static_cast<std::size_t>(block.columns) * static_cast<std::size_t>(block.rows))
      detail::fail(CARREAU_ERR_ARGUMENT, "A block of a grid does not have columns x rows nodes.");
    counts.insert(counts.end(), {block.columns, block.rows});
    nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
  }
  session.done(carreau_add_grid(session.get(), &in, detail::count_of(blocks.size()), counts.data(), detail::flat(nodes)));
}
/// format: CARREAU_GRID_...
inline void load_grid(Session& session, const std::string& path, const carreau_grid_options& options = {},
                      int format = CARREAU_GRID_BY_SUFFIX) {
  const carreau_grid_options in = detail::sized(options);
  session.done(carreau_load_grid(session.get(), &in, path.c_str(), format));
}

// ---- Surfaces given as triangles ----

inline void add_triangles(Session& session, const MeshArrays& arrays, const carreau_triangles_options& options = {}) {
  const carreau_triangles_options with = detail::sized(options);
  auto in = detail::sized<carreau_triangles>();
  if (!arrays.triangle_refs.empty() && arrays.triangle_refs.size() != arrays.triangles.size())
    detail::fail(CARREAU_ERR_ARGUMENT, "There are not as many references as triangles.");
  in.vertex_count = detail::count_of(arrays.vertices.size());
  in.triangle_count = detail::count_of(arrays.triangles.size());
  in.edge_count = detail::count_of(arrays.edges.size());
  in.vertices = detail::flat(arrays.vertices);
  in.triangles = detail::flat(arrays.triangles);
  in.triangle_refs = detail::data_or_null(arrays.triangle_refs);
  in.edges = detail::flat(arrays.edges);
  session.done(carreau_add_triangles(session.get(), &with, &in));
}
inline void load_triangles(Session& session, const std::string& path, const carreau_triangles_options& options = {}) {
  const carreau_triangles_options with = detail::sized(options);
  session.done(carreau_load_triangles(session.get(), &with, path.c_str()));
}
inline carreau_triangles_report triangles_measure(Session& session) { return session.filled(carreau_triangles_measure); }
/// The triangles cut into four by the smooth surface, at most `depth` times, while normals differ by more than `angle` degrees.
inline Mesh triangles_refine(Session& session, double angle, int depth) {
  Mesh out;
  session.done(carreau_triangles_refine(session.get(), angle, depth, out.get()));
  return out;
}
/// The largest distance from the mesh to the triangles, and back.
inline std::array<double, 2> triangles_distances(Session& session) {
  std::array<double, 2> out{};
  session.done(carreau_triangles_distances(session.get(), out.data()));
  return out;
}
/// The distance from the mesh to the triangles lies between the first two, that back between the others.
inline std::array<double, 4> triangles_bounds(Session& session, double share = 0) {
  std::array<double, 4> out{};
  session.done(carreau_triangles_bounds(session.get(), share, out.data()));
  return out;
}

} // namespace carreau

#endif
