/* SPDX-License-Identifier: BSD-3-Clause */
/* carreau_geometry.h: geometries that the library evaluates itself, without callbacks. C99, and C++ as well.
 *
 *   carreau_session_create(&session);
 *   carreau_molecule_options options = {sizeof options, CARREAU_SAS, 0, 1.4};
 *   carreau_load_molecule(session, &options, "1bna.pdb");       // instead of carreau_set_cad and carreau_model_...
 *   carreau_mesh_generate(session);
 *
 * The rules of carreau.h hold for every function.
 */
#ifndef CARREAU_GEOMETRY_H
#define CARREAU_GEOMETRY_H

#include "carreau.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Several geometries in one session ---- */

/* A session has the host's own geometry (carreau_set_cad or carreau_set_cad_m, with faces by carreau_model_add_face),
 * and any number of others, which the functions below add. Each counts its faces, curves and points from 1. The session
 * moves these numbers behind all its previous numbers: carreau_geometry_info gives the new ones. So the faces of the
 * first geometry of an empty session keep their numbers. Faces that the host adds himself later on must have larger
 * references than these, curves and points too.
 *
 * Geometries do not touch, unless the parameter glue_open is 1: curves that one face only has are then compared in
 * space, in all geometries, and become one within eps_glue (or eps_glue_open). The mesh of a geometry that touches no
 * other geometry is, for equal sizes, identical to its mesh in a separate session. Parameters that are relative to the
 * diagonal use the box of all. Several threads mesh faces at a time when all geometries allow it: geometries that the
 * library evaluates itself allow it.
 *
 * carreau_model_clear drops them all. */
enum {
  CARREAU_GEOMETRY_CALLBACKS = 1, /* carreau_geometry_begin, and libraries on top of it */
  CARREAU_GEOMETRY_BEZIER = 2,
  CARREAU_GEOMETRY_MOLECULE = 3,
  CARREAU_GEOMETRY_PLANE = 4,
  CARREAU_GEOMETRY_GRID = 5,
  CARREAU_GEOMETRY_TRIANGLES = 6,
  CARREAU_GEOMETRY_ATLAS = 7 /* carreau_atlas.h */
};

/* A geometry, and the references that are its own: its face k is face first_face + k - 1 of the session. A geometry
 * without curves (points) has last_curve = first_curve - 1. */
typedef struct carreau_geometry {
  size_t struct_size;
  int32_t kind;  /* CARREAU_GEOMETRY_... */
  int32_t faces; /* their number */
  int32_t first_face, last_face;
  int32_t first_curve, last_curve;
  int32_t first_point, last_point;
} carreau_geometry;

/* Count the geometries that were added, and describe geometry `index`, from 0, in the order of adding.
 * Errors: ARGUMENT. */
CARREAU_API carreau_status carreau_geometry_count(carreau_session* session, int64_t* out_count);
CARREAU_API carreau_status carreau_geometry_info(carreau_session* session, int64_t index,
                                                 carreau_geometry* out_geometry);

/* Begins a geometry of callbacks beside the geometries of the session. Until carreau_geometry_end, the functions
 * carreau_model_... are about its faces alone. They take, and callbacks get, its own references; sentences and results
 * have the references of the session. With carreau_geometry_cancel the session is as it was before; carreau_last_error
 * keeps the sentence of the call before. Calls that need the whole model fail in between (SEQUENCE). Errors of
 * carreau_geometry_begin: ARGUMENT, as carreau_set_cad, SEQUENCE. Errors of carreau_geometry_end: SEQUENCE, MODEL (no face, a
 * reference that is negative, or too large). The session is then as before carreau_geometry_begin. Runs report all
 * other faults of the faces. */
CARREAU_API carreau_status carreau_geometry_begin(carreau_session* session, const carreau_cad* callbacks);
CARREAU_API carreau_status carreau_geometry_end(carreau_session* session);
CARREAU_API carreau_status carreau_geometry_cancel(carreau_session* session);

/* ---- Bezier patches ---- */

/* Largest degree in a direction. */
enum { CARREAU_BEZIER_DEGREE = 15 };

/* Tensor products over the unit square. Patch k, from 0, has a degree m in u and n in v. */
typedef struct carreau_bezier {
  size_t struct_size;
  int64_t patch_count;
  const int32_t* degrees;  /* patch_count x 2: m, n, from 1 to CARREAU_BEZIER_DEGREE */
  const double* controls;  /* for each patch (m + 1)(n + 1) control points x y z, model length; v runs fastest */
  const int32_t* side_refs; /* patch_count x 4, of the sides v = 0, u = 1, v = 1, u = 0: positive, and the same for
                               sides that are one curve; NULL: sides that meet within eps_glue are found when a mesh is made */
} carreau_bezier;

/* Adds Bezier patches to a session: patch k is face k + 1, and its normal is along Su x Sv. Evaluation, derivatives and
 * the radii of curvature for hgeo_flag = 2 are exact. Errors: ARGUMENT (a degree, a number that is not finite, no
 * patch), SEQUENCE (see carreau_geometry_begin). */
CARREAU_API carreau_status carreau_add_bezier(carreau_session* session, const carreau_bezier* bezier);

/* Adds the Bezier patches of a file .bpt: the number of patches, then for each m n and its control points. Sides that
 * meet are found when a mesh is made. Errors: as above, FILE (with the line). */
CARREAU_API carreau_status carreau_load_bezier(carreau_session* session, const char* path);

/* Gives the degrees m and n of a face that is a Bezier patch. Errors: ARGUMENT. */
CARREAU_API carreau_status carreau_bezier_degrees(carreau_session* session, int32_t face_ref, int32_t out_degrees[2]);

/* ---- Molecules ---- */

/* Which surface of a molecule (HDR sec. 4.6.2). */
enum {
  CARREAU_VWS = 1, /* van der Waals: the boundary of the union of the atoms' balls */
  CARREAU_SAS = 2, /* solvent accessible: the same with the radius of a probe added to all radii */
  CARREAU_SES = 3  /* solvent excluded: the boundary of the space that no probe outside the balls reaches */
};

/* Which surface of a molecule, and by which probe. */
typedef struct carreau_molecule_options {
  size_t struct_size;
  int32_t surface;       /* CARREAU_VWS, CARREAU_SAS or CARREAU_SES */
  int32_t drop_cavities; /* 1: inner shells are left out of the model; areas and volumes have them */
  double probe;          /* radius of the probe; CARREAU_VWS does not use it */
  const char* radii;     /* file of lines "symbol radius", in place of the table's radii; NULL: none */
} carreau_molecule_options;

/* Adds the surface of n balls to a session. A face is a part of one ball that no other ball covers. Its reference is the rank of the ball,
 * from 1; other parts of the same ball are parts of that face (see carreau_model_part_of_face). Torus and concave parts of CARREAU_SES are
 * separate faces, with references behind the references of all balls. A ball that equals another ball, or lies inside it, has no face;
 * spheres that only touch do not meet. If rounding hides how spheres meet (four of them in one point), radii change by some 1e-9 of
 * themselves, and a message reports it. Errors: ARGUMENT (a radius that is not positive, n below 1), SEQUENCE (see
 * carreau_geometry_begin). */
CARREAU_API carreau_status carreau_add_molecule(carreau_session* session, const carreau_molecule_options* options,
                                                int64_t n, const double centers[], const double radii[]);

/* Adds the surface of the atoms of a file .xyzr (x, y, z, radius), .xyz, .pdb, .ent, .cif or .mmcif. Radii are Bondi's,
 * for elements that he lacks the radii of Alvarez and others (cpp/io/molecule/elements.h).
 * Waters and all but the first of alternate locations are left out, and messages report it. References of faces are the
 * serial numbers of .pdb and .cif where these are positive and different, and names of faces are residues.
 * Errors: as above, FILE. */
CARREAU_API carreau_status carreau_load_molecule(carreau_session* session, const carreau_molecule_options* options,
                                                 const char* path);

/* Exact measures of the surface: no mesh is needed. */
typedef struct carreau_molecule_measures {
  size_t struct_size;
  double area;
  double volume; /* inside the surface, without cavities */
  int64_t atoms;
  int64_t exposed_atoms; /* with an area */
  int64_t shells;        /* connected parts of the surface; for CARREAU_SES the parts of CARREAU_SAS */
  int64_t cavities;      /* shells that bound a hole */
  int64_t euler_number;  /* of the surface: of a closed mesh, vertices - triangles / 2 */
  int64_t moved_radii;   /* see carreau_add_molecule */
  double convex_area;    /* of parts of balls; of CARREAU_VWS and CARREAU_SAS, the area */
  double torus_area;     /* swept by a probe that touches two balls; CARREAU_SES */
  double concave_area;   /* of parts of probes that touch three balls; CARREAU_SES */
} carreau_molecule_measures;

/* Measures the molecule that the session was given last. Errors: SEQUENCE (none was). */
CARREAU_API carreau_status carreau_molecule_measure(carreau_session* session, carreau_molecule_measures* out_measures);

/* Gives reference and area of each atom of that molecule (of CARREAU_SES the convex parts); an array may be NULL.
 * Errors: SEQUENCE, ARGUMENT (capacity).
 */
CARREAU_API carreau_status carreau_molecule_atoms(carreau_session* session, int64_t capacity, int32_t out_refs[],
                                                  double out_areas[]);

/* Gives the full area of each atom: of its convex parts, as above; its share of the torus parts beside it; a third of
 * each concave part that touches it. The share lies on its side of the plane in which the probe's centre moves. The sums
 * are in carreau_molecule_measures; except for CARREAU_SES the latter two are 0. An array may be NULL. Errors: SEQUENCE,
 * ARGUMENT (capacity). */
CARREAU_API carreau_status carreau_molecule_atom_areas(carreau_session* session, int64_t capacity, double out_convex[],
                                                       double out_torus[], double out_concave[]);

/* Gives the residue of an atom, from 0; "" when it has none. The text lives until the next call on the session. NULL:
 * no such atom. */
CARREAU_API const char* carreau_molecule_atom_name(carreau_session* session, int64_t atom);

/* ---- Plane domains ---- */

/* The extent of the domain if neither a side nor a seed determines it. */
enum {
  CARREAU_REST_PARITY =
      0, /* the inside of curves; inside of it a loop that nothing joins to it bounds a hole, and so on */
  CARREAU_REST_INSIDE = 1, /* all that curves enclose, but for holes */
  CARREAU_REST_OUTSIDE = 2 /* nothing else */
};

/* The shape of a curve of a plane domain between its points. */
enum {
  CARREAU_SEGMENTS = 0, /* straight; all of its points are vertices */
  CARREAU_SPLINE = 1,   /* a spline of Catmull and Rom */
  CARREAU_ARCS = 2      /* arcs of circles through a start, a point between and an end, with which the next arc starts: an odd
                           number of points, of which those between are no vertices. From a point to itself it is the
                           whole circle, of which the point between is the opposite one, counterclockwise. */
};

/* A domain of the plane. Indices of points and curves count from 0. An array may be NULL where its comment allows it.
 * References are the caller's: 0 means no reference, and several entities may share one. */
typedef struct carreau_plane_domain {
  size_t struct_size;
  int32_t rest;     /* CARREAU_REST_... */
  int32_t reserved; /* 0 */
  int64_t point_count, curve_count, side_count, seed_count;
  const double* points;      /* point_count x 2 */
  const int32_t* point_refs; /* point_count; NULL: none */
  const int32_t* imposed;    /* point_count: 1 makes a point a vertex wherever it lies; NULL: ends of curves only */
  const double* sizes;       /* point_count, prescribed at points and along curves between them; 0: none; NULL: none */
  const double* metrics;     /* point_count x 3 (xx xy yy), in place of sizes; 0 0 0: none; NULL: none */
  const int64_t*
      curve_starts; /* curve_count + 1: curve c passes curve_points[curve_starts[c] .. curve_starts[c + 1] - 1] */
  const int32_t* curve_points; /* a curve whose last point is its first one is closed */
  const int32_t* smooth;     /* curve_count: CARREAU_SEGMENTS, _SPLINE or _ARCS. NULL: segments */
  const int32_t* controls;   /* curve_count x 2, of splines: control points before the first and behind the last point;
                                -1: the end is free. NULL: all are */
  const double* tangents;    /* curve_count x 4, of splines: derivatives at both ends, in place of controls, for pieces
                                of parameter length 1; NaN: not given; NULL: none */
  const int32_t* curve_refs; /* curve_count; NULL: none */
  const int32_t* sides;      /* side_count x 3: a curve, +1 for its left or -1 for its right side, and the reference of
                                the subdomain there */
  const double* seeds;       /* seed_count x 2: a place inside a subdomain or a hole */
  const int32_t* seed_refs;  /* seed_count: the reference of the subdomain, or -1 for a hole */
} carreau_plane_domain;

/* Makes a plane domain the only geometry of a session that has no model: see carreau_model_clear. Its faces are the subdomains, in the
 * plane z = 0 with u = x and v = y; files of its mesh have dimension 2. If a reference is 0, or stands for several entities, the model has
 * a number behind the largest in its place; results show the caller's. Sizes at points hold along curves; inside, hphydef counts (hphy_flag
 * 1) or the sizes of the curves around (hphy_flag 2). Messages report pieces of splines that turn back. Errors: ARGUMENT, MODEL (curves
 * that cross, touch or make a loop; points at one place or beside the domain; an open boundary; a side on which the domain would be
 * unbounded; two references for one subdomain; nothing enclosed). */
CARREAU_API carreau_status carreau_add_plane_domain(carreau_session* session, const carreau_plane_domain* domain);

/* Adds the plane domain of a file: .poly and .node (Triangle; segments that cross are divided), .dat (airfoils), .mesh, .meshb or .bl2d of
 * dimension 2, whose edges and ends of triangles are the curves, .data or .g (BL2D; with the sizes of a .hg beside it). With a corner_angle
 * above 0 (degrees), polygons become splines that end where they turn by more, where other curves end, and where references change. With 0
 * they stay polygons; edges of a mesh with triangles that are parts of one straight side, of one reference and between vertices without
 * one, are one curve. `sizes` names a .sol, .solb, .hg or .h with a size or metric for each vertex of the file; NULL or "": none. When the
 * file has triangles they are a background mesh: see carreau_set_background_mesh. One that is set later replaces the sizes at points; all
 * subdomains lie in its one plane. Errors: as above, FILE (with the line). */
CARREAU_API carreau_status carreau_load_plane_domain(carreau_session* session, const char* path, const char* sizes,
                                                     double corner_angle);

/* Gives 1 if the plane domain that the session got last has sizes or metrics at its points; 0 without such a domain.
 * Errors: ARGUMENT. */
CARREAU_API carreau_status carreau_plane_has_sizes(carreau_session* session, int32_t* out_answer);

/* ---- Structured grids ---- */

/* The measured quantity of the nodes of a grid, which smoothing moves. */
enum {
  CARREAU_MEASURED_POINTS = 0,  /* all coordinates */
  CARREAU_MEASURED_HEIGHTS = 1, /* z, at regular x and y */
  CARREAU_MEASURED_RADII = 2    /* the distance from the axis z, at regular angles and heights */
};

/* Formats of carreau_load_grid. */
enum {
  CARREAU_GRID_BY_SUFFIX = 0, /* .fmt .p3d .x .grd .xyz: PLOT3D; .asc .dem .txt: heights; .cyl: a scan; .ijk: nodes */
  CARREAU_GRID_PLOT3D = 1,
  CARREAU_GRID_HEIGHTS = 2,
  CARREAU_GRID_SCAN = 3,
  CARREAU_GRID_NODES = 4
};

/* Zeros in all members but struct_size are the defaults; NULL in place of the struct is the same. */
typedef struct carreau_grid_options {
  size_t struct_size;
  int32_t measured;         /* CARREAU_MEASURED_...; carreau_load_grid knows it from the format */
  int32_t smoothing_rounds; /* of Taubin's filter, which does not shrink (HDR sec. 4.7.1); 0: none */
  double smoothing_inward, smoothing_outward; /* its weights, both between 0 and 1; both 0: .06 and .061 */
  int32_t lengths;  /* 1: parameters are cumulated lengths of edges, for abrupt steps of a grid; 0: the integers */
  int32_t orient;   /* 1: blocks are turned over, their columns running backwards, so that normals agree across common
                       borders: normals of the first block count, and point outwards where blocks enclose a volume */
  double join_angle; /* degrees: blocks get one tangent plane along borders where their normals differ by less; 0: none */
  double tolerance;  /* nodes of borders are one when they are nearer; 0: a millionth of the diagonal */
  double step; /* of heights and scans whose file does not give it; 0: 1 */
  int32_t fill; /* 1: holes that no side of a block touches are filled, and a message reports it; 0: they stay */
  int32_t continuity; /* between cells: 2: C2, by cubic splines; 0 or 1: C1, by differences */
  int32_t smoothing_by_distance; /* 1: neighbours of heights and radii weigh by the other one's distance in space (HDR
                                    sec. 4.7.1), as neighbours of points do; 0: both weigh as much */
  int32_t reserved; /* 0 */
} carreau_grid_options;

/* Adds a surface through the nodes of n structured grids to a session. Block b has counts[2 b] columns and counts[2 b + 1] rows, and its
 * nodes (x, y, z) lie behind the nodes of block b - 1, columns running fastest. A node with a NaN is missing, and with it the cells around.
 * Each block is a face, whose reference is its rank from 1; it is bicubic on each cell and C1 or C2 between cells (HDR eq. 4.87-4.91). If missing
 * nodes cut a block in two, all its parts have its reference in results, and a message reports it. Common nodes of borders glue blocks, and
 * the sides of one block; a side may be one point. Messages report cells that fold and cells without area, which are left out. Errors:
 * ARGUMENT (counts below 2, infinite coordinates, options), SEQUENCE (see carreau_geometry_begin), MODEL (no cell at all, blocks that
 * overlap), CANCELLED. */
CARREAU_API carreau_status carreau_add_grid(carreau_session* session, const carreau_grid_options* options, int64_t n,
                                            const int32_t counts[], const double nodes[]);

/* Adds a surface through the grids of a file: PLOT3D (text or binary, any byte order and precision, with or without
 * IBLANK), heights (ASCII grids of ESRI, DEM of USGS, plain rows of numbers), a scan r(z, theta), or a list of nodes;
 * docs/how-to/grid.md has the layouts. Errors: as above, FILE (with the line or byte, and the block). */
CARREAU_API carreau_status carreau_load_grid(carreau_session* session, const carreau_grid_options* options,
                                             const char* path, int32_t format);

/* ---- Surfaces given as triangles ---- */

/* The lines of a surface given as triangles. NULL stands for all members 0. */
typedef struct carreau_triangles_options {
  size_t struct_size;
  double sharp_angle;        /* degrees: edges whose two triangles differ by more start a line; 0: found between 20 and 45,
                                where a gap in the angles of the triangles separates tessellated curved surfaces from
                                features */
  double corner_angle;       /* degrees: where a line turns by more it has a corner; 0: 45 */
  int32_t given_edges_only;  /* 1: no other lines are sought than the edges that are given, borders, and edges with
                                three triangles or more */
  int32_t ignore_references; /* 1: borders between triangles of different references are no lines */
  int32_t keep_double_vertices; /* 1: vertices at one place stay as many */
  int32_t reserved;             /* 0 */
} carreau_triangles_options;

/* Triangles in arrays of the caller, copied. */
typedef struct carreau_triangles {
  size_t struct_size;
  int64_t vertex_count, triangle_count, edge_count;
  const double* vertices;       /* vertex_count x 3, model length */
  const int32_t* triangles;     /* triangle_count x 3 vertices, from 0 */
  const int32_t* triangle_refs; /* triangle_count, of faces; NULL: faces are the regions between lines */
  const int32_t* edges;         /* edge_count x 2 vertices, from 0, that are of lines; NULL when edge_count is 0 */
} carreau_triangles;

/* Adds triangles to a session: they are a geometry like others (see carreau_geometry_begin), whose faces have no curves of a parameter
 * plane. A smooth surface goes through their vertices, with tangent planes that agree except on lines. Lines are borders, edges with three
 * triangles or more, edges of triangles that differ by more than the sharp angle, and edges that continue such a line. Its faces are the
 * regions between lines, or the references of the triangles where they have several (moved up when one is not positive). Curves are the
 * lines, corners points where lines end, meet or turn. Carreau joins vertices at one place. It drops repeated triangles and triangles without
 * area (a corner on a longest side divides that side in the neighbours), and turns triangles that run against their neighbours. Messages
 * report it. carreau_mesh_generate makes their mesh in space by all parameters of sizes. Sizes that differ by direction count as their
 * least. Parameter element works as on other surfaces. Errors: ARGUMENT (no triangle, an index out of range, a coordinate that is not
 * finite, an angle, triangles that are all of surfaces before), SEQUENCE, LIMIT.
 *
 * Several surfaces of triangles are one in space: their vertices at one place become one, so that borders with the same vertices are one
 * line, and the mesh conforms there. A triangle of two surfaces belongs to the first. Each surface has its own faces, lines and angles, and
 * nothing is smooth from one to the other. The functions below are about all of them. Curves and corners of the mesh are numbered from 1
 * over all of them, or behind the references of other geometries in the session. They share nothing with other geometries. Such a session
 * has no fields over parameter domains. */
CARREAU_API carreau_status carreau_add_triangles(carreau_session* session, const carreau_triangles_options* options,
                                                 const carreau_triangles* triangles);

/* Adds the triangles of a file that carreau_mesh_read reads. Errors: as above, FILE. */
CARREAU_API carreau_status carreau_load_triangles(carreau_session* session, const carreau_triangles_options* options,
                                                  const char* path);

/* Findings in the triangles of a session. */
typedef struct carreau_triangles_report {
  size_t struct_size;
  int64_t vertices, triangles, edges; /* that are left */
  int64_t shells;                     /* connected over edges */
  int64_t euler_number;               /* vertices - edges + triangles */
  int64_t border_edges;               /* with one triangle */
  int64_t manifold_breaks;            /* edges with three triangles or more */
  int64_t one_sided_edges;            /* on which no orientation agrees */
  int64_t pinched_vertices;           /* whose triangles hang together by the vertex alone */
  int64_t turned_triangles, repeated_triangles, flat_triangles;
  int64_t sharp_edges, lines, corners, regions;
  int64_t dropped_edges;   /* sharper than the angle, but of no line */
  int64_t prolonged_edges; /* flatter, but lines go on over them */
  int64_t faded_ends;      /* ends of lines on no other line */
  int64_t unfolded;        /* tangents that turned back around a vertex, and were turned */
  int64_t folded;          /* tangents that still turn back */
  double diagonal;         /* of the box of the vertices */
  double deviation;        /* no point of the smooth surface is farther from the triangles, nor the other way round */
  double sharp_angle;      /* degrees: the angle given, or found */
} carreau_triangles_report;

/* Gives the report on the triangles of the session. Errors: SEQUENCE (none were), ARGUMENT. */
CARREAU_API carreau_status carreau_triangles_measure(carreau_session* session, carreau_triangles_report* out_report);

/* Cuts triangles into four by the middles of their edges on the smooth surface while their normals differ from it by
 * more than `angle` degrees, at most `depth` times. It puts them into a mesh that carreau_mesh_create made. Depth 0: the
 * repaired triangles. Edges are the edges of lines. Periodic pairs of a file .msh stay pairs. Errors: SEQUENCE (no
 * triangles were given), ARGUMENT, LIMIT (max_triangles). */
CARREAU_API carreau_status carreau_triangles_refine(carreau_session* session, double angle, int32_t depth,
                                                    carreau_mesh* mesh);

/* Distances between the mesh of a session and the triangles that it was given, model length, over their vertices,
 * middles of edges and of triangles: the largest from the mesh to the triangles, and back. Errors: SEQUENCE (no
 * triangles, no mesh), ARGUMENT. */
CARREAU_API carreau_status carreau_triangles_distances(carreau_session* session, double out_distances[2]);

/* Bounds the distances over all points of both. The largest distance from the mesh to the triangles lies between out_bounds[0] and
 * out_bounds[1], rounding included. The largest distance from the triangles to the mesh lies between out_bounds[2] and out_bounds[3]. The
 * upper ones are larger than the lower ones by no more than the share and a millionth of the diagonal, unless that takes too long. `share`:
 * 0 stands for .01. The mesh has straight triangles. carreau_session_delivered reports these bounds with the bounds of each triangle. A
 * message warns, with the place, when the mesh is farther from the triangles than a tenth of its edges there. Errors: SEQUENCE (no
 * triangles, no mesh), ARGUMENT (a share
 * that is negative or not finite, other elements), CANCELLED. */
CARREAU_API carreau_status carreau_triangles_bounds(carreau_session* session, double share, double out_bounds[4]);

/* ---- Places of the model ---- */

/* Evaluate the geometry of a session, of whatever kind, and project points to it. An entity has a dimension, 2 (faces), 1 (curves) or 0
 * (points), and a reference of the model. A place of a face is (u, v), a place of a curve is t in the first face that has the curve, and a
 * point has no parameters: rows have as many numbers as the dimension. Faces are known by the references that callbacks get, also where
 * results name the whole of which a face is a part. Curves and points without references get theirs by a mesh; before, they are an error
 * (SEQUENCE).
 *
 * Both evaluate the geometry as a run does, on several threads if it allows that (parameter threads). Finite differences replace
 * derivatives that a host does not give.
 * Errors: SEQUENCE (no geometry, no model, no references), ARGUMENT (no such entity, dimension, order, numbers that are not finite), MODEL,
 * CALLBACK, CANCELLED, MEMORY; BUSY inside a callback. */

/* Evaluates an entity of dimension 2 or 1 at n places, n x dimension. `order` is the highest derivative, 0 to 2. out_xyz is n x 3. out_first
 * is n x dimension x 3: S_u and S_v, or dx/dt. out_second is n x 3 x 3: S_uu, S_uv, S_vv, or n x 3 for a curve. Each may be NULL, as must be
 * results above the order. */
CARREAU_API carreau_status carreau_evaluate(carreau_session* session, int32_t dimension, int32_t reference, int64_t n,
                                            const double parameters[], int32_t order, double out_xyz[], double out_first[],
                                            double out_second[]);

/* Finds the closest point of an entity to each of n points of space, n x 3; a reference of 0 means all entities of that dimension. The
 * result is the closest point of all, not only of a neighbourhood, and lies within a domain or on its boundary. Among several closest
 * points the choice is always the same. References (n) name the entities found, parameters are n x dimension, and distances are lengths of the model.
 * Each result may be NULL. If the geometry fails on some faces, the results are closest points of the others (PARTIAL).
 *
 * The first call cuts each face into pieces that are nearly quadratic, by 25 evaluations a piece. They serve further calls until the
 * geometry, the model or the mesh of the session changes. Details smaller than the distances between these places stay unseen. A point then
 * takes two to four evaluations of second order. */
CARREAU_API carreau_status carreau_project(carreau_session* session, int32_t dimension, int32_t reference, int64_t n, const double xyz[],
                                           int32_t out_references[], double out_parameters[], double out_closest[],
                                           double out_distances[]);

/* Embeds a point of space, 3 numbers, in the face nearest to it: the mesh has a vertex there. Within the parameter embed_tolerance a point of
 * the model replaces it, or a curve gets it as an end of two parts. `name` names the point in files with groups; NULL or "": none. The
 * reference of the point, of the model and of the vertex, is stored in *out_ref, which may be NULL. References of a model
 * without any are found first.
 * Errors: SEQUENCE (no geometry, no model), ARGUMENT (farther from the faces than embed_tolerance: the sentence has the
 * distance; a face given by triangles), MODEL, CALLBACK, CANCELLED, MEMORY; BUSY inside a callback. The model does not change then. */
CARREAU_API carreau_status carreau_model_embed_point(carreau_session* session, const double xyz[], const char* name, int32_t* out_ref);

/* Embeds a polyline of n points of space, n x 3, in the faces that it lies on. The projection of its segments to the model becomes internal
 * curves, whose edges the mesh has. It crosses borders of faces, seams and internal curves, which are cut there; vertices where it turns by
 * more than 15 degrees on the surface are points. It is closed when the last point equals the first. Points must be within embed_tolerance of
 * the faces; ends within embed_tolerance of a point or curve of the model join it. If the projection jumps from one face to another, the
 * shortest way over their common curve joins both. One reference names all edges in results; *out_ref, which may be NULL, receives it.
 * Errors as carreau_model_embed_point(), and ARGUMENT for segments that leave the surface, run along a curve of the model, or pass a
 * singular point of a face. */
CARREAU_API carreau_status carreau_model_embed_polyline(carreau_session* session, int64_t n, const double xyz[], const char* name,
                                                        int32_t* out_ref);

/* Embeds the curves of wires (faces of orientation 0) that lie on other faces, as carreau_model_embed_polyline() does, under the names of their
 * wires. These wires leave the model; *out_count, which may be NULL, receives their number. A warning names each other wire, which stays.
 * Errors: SEQUENCE (no geometry, no model), MODEL, CALLBACK, CANCELLED, MEMORY; BUSY inside a callback. */
CARREAU_API carreau_status carreau_model_embed_wires(carreau_session* session, int64_t* out_count);

/* Embeds the ridges of the session's structured grids as carreau_model_embed_polyline() does: lines where the principal curvature of larger
 * absolute value is maximal along its direction and its radius is below `radius` (model length), sharp convex and concave lines alike.
 * Curvatures are curvatures of the cubic spline through the nodes, so that noise has to be smoothed first. Lines that are shorter than
 * `radius` and borders of grids are none, and surfaces of constant curvature such as circular fillets have none. *out_count, which may be
 * NULL, receives the number of lines; files with groups call them "ridge 1", "ridge 2"... A warning names each line that cannot be embedded.
 * Errors: SEQUENCE (no grid), ARGUMENT (radius), MODEL, CANCELLED, MEMORY; BUSY inside a callback. */
CARREAU_API carreau_status carreau_model_embed_ridges(carreau_session* session, double radius, int64_t* out_count);

/* Gives the entity of lowest dimension that each vertex lies on, in the order of carreau_mesh_vertices, nodes on edges included: a point (0,
 * corners and imposed points), a curve (1, free edges too) or a face (2), by the references that carreau_project takes. Vertices on several
 * curves have the first one. (u, v) of each corner are in carreau_mesh_corner_uv. Mesh of a session only. Either array may be NULL. Errors:
 * ARGUMENT (capacity below the number of vertices), SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_vertex_entities(carreau_mesh* mesh, int64_t capacity, int32_t out_dimensions[],
                                                        int32_t out_references[]);
/* Gives the parameters of both ends of each edge of carreau_mesh_edges, k x 2, on curve number ic (k) of a face (k), as callbacks get them.
 * A closed curve has one parameter at its first edge and another at its last. t is NaN where vertices have left the curve (narrow faces
 * that became one curve), and on surfaces given as triangles; face and ic are 0 on a curve without any. Mesh of a session only. Each
 * array may be NULL. Errors: ARGUMENT (capacity below the number of edges), SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_edge_parameters(carreau_mesh* mesh, int64_t capacity, double out_t[], int32_t out_faces[],
                                                        int32_t out_ics[]);

/* ---- Meshes that follow their geometry ---- */

/* How carreau_mesh_carry matches faces and curves of both models. ANY: by references; by names or shapes where references have no
 * counterparts of equal neighbours, or where they are twice as far apart as like shapes. NAME: faces by unique names, curves by their faces.
 * SHAPE: by neighbours, boundary length and place in the box of the model. */
enum { CARREAU_MATCH_ANY = 0, CARREAU_MATCH_REFERENCE = 1, CARREAU_MATCH_NAME = 2, CARREAU_MATCH_SHAPE = 3 };

/* Carries the mesh of another session to the geometry of `session`, whose topology is equal. The mesh of `session` gets the vertices,
 * triangles and elements of the old mesh, with the new references. Vertices of curves keep their share of the arc length. Vertices of faces keep
 * (u, v) if the domain stays within 1e-6 of its box, else they relax by mean-value weights while the boundary is fixed, which changes
 * smoothly with the geometry. Triangles that turn over in (u, v) are smoothed, and a face where one stays turned fails with that triangle as its reason.
 * A warning names faces whose worst shape falls by half.
 * Elements of second order get new nodes. Faces of the new mesh are in the order of the new model. Both sessions evaluate their callbacks.
 *
 * Two meshes of geometries whose parameter differs by 2 d give the derivatives of vertices, (x(p + d) - x(p - d)) / (2 d).
 * Errors: as carreau_mesh_generate; MODEL (the topologies differ: the face or curve without a counterpart), ARGUMENT (a mesh of a file, of this
 * session or across patches, faces given as triangles, cracks, no such match), PARTIAL. */
CARREAU_API carreau_status carreau_mesh_carry(carreau_session* session, carreau_mesh* old_mesh, int32_t match);

/* Kinds of marks: rows of two vertices, or numbers of elements in the order of the mesh, faces in order, quadrilaterals before triangles. */
enum { CARREAU_MARK_EDGES = 1, CARREAU_MARK_ELEMENTS = 2 };

/* Refine the mesh of a session on its surfaces, and replace it. New vertices halve edges: on curves by arc length, on faces on the way in
 * (u, v), as far from both ends in space, on elements of second order at their nodes. Old vertices keep their numbers and places, except
 * inside faces where elements of second order are repaired or shapes fall, mostly beside curves. Swaps and moves restore them, and a warning
 * names a face whose worst shape falls by half. A triangle with marked edges loses its longest edge too, and edges around new vertices are swapped where
 * shapes gain. A quadrilateral becomes four, or triangles if not all of its edges are halved. Periodic faces are divided alike.
 * Errors: ARGUMENT (no such edge or element, sizes not positive, a mesh across patches or of triangles), SEQUENCE
 * (no mesh yet), LIMIT, CALLBACK, CANCELLED, MEMORY. The mesh stays then. */

/* Halves all edges, `times` times: each element becomes four. */
CARREAU_API carreau_status carreau_mesh_halve(carreau_session* session, int32_t times);
/* Halves n marked edges (n x 2 vertices) or all edges of n marked elements (n numbers from 0). */
CARREAU_API carreau_status carreau_mesh_refine(carreau_session* session, int32_t kind, int64_t n, const int32_t marks[]);
/* Halves edges until none is longer than sqrt(2) of the size at its ends. `sizes` are model lengths at the n vertices of the mesh; of elements
 * of second order at the corners, which come first. */
CARREAU_API carreau_status carreau_mesh_refine_sizes(carreau_session* session, int64_t n, const double sizes[]);

/* ---- Elements of order 3 and 4 ---- */

/* Places of nodes on the edges of elements: k / p, or the points of Gauss-Lobatto's quadrature. */
enum { CARREAU_EQUIDISTANT = 0, CARREAU_GAUSS_LOBATTO = 1 };

/* Makes elements of order 2 to 4 over the elements of the session's mesh: best over a mesh of order 2 (parameter element), whose
 * sizes were chosen for curved elements. They last until the mesh changes. Nodes of curves divide the arc length, other nodes are
 * closest points of chords and of the polynomials that the edges imply. Bernstein coefficients of the Jacobian prove the elements valid. In
 * elements that are not, inner nodes move, then nodes of inner edges. At last carreau_mesh_refine halves the edges of elements that stay
 * invalid, up to four times. *out_invalid (may be NULL) counts the elements that are invalid then; a warning names the first. Errors: ARGUMENT (order, places, a mesh across patches or of triangles), SEQUENCE (no mesh yet),
 * CALLBACK, CANCELLED, MEMORY. */
CARREAU_API carreau_status carreau_raise_order(carreau_session* session, int32_t order, int32_t places, int64_t* out_invalid);

/* Give the numbers of these elements: all nodes, vertices of the mesh first, triangles, quadrilaterals, edges of curves. Each may be NULL. The
 * nodes, n x 3. The elements with `corners` corners, 3, 4, or 2 (edges of curves): rows of (p + 1)(p + 2) / 2, (p + 1)^2 or p + 1 nodes from 0, in
 * the order of Gmsh's types 21, 23, 36, 37, 26, 27, and unless NULL the references of faces or curves. Order 2 has type 10
 * for quadrilaterals. Write a file: .msh, .msh2 (Gmsh 4.1 and 2.2), .vtu (Lagrange cells), .mesh (MFEM v1.0, discontinuous nodes, positive
 * references). Files have the nodes that their formats require, on the same polynomials; with the parameter association = 1 the places of
 * equidistant nodes on the geometry, too (not .mesh).
 * Errors: SEQUENCE (carreau_raise_order did not succeed since the last mesh), ARGUMENT (capacity in rows, corners, suffix, references), FILE. */
CARREAU_API carreau_status carreau_raised_count(carreau_session* session, int64_t* out_nodes, int64_t* out_triangles, int64_t* out_quads,
                                                int64_t* out_edges);
CARREAU_API carreau_status carreau_raised_nodes(carreau_session* session, int64_t capacity, double out_xyz[]);
CARREAU_API carreau_status carreau_raised_elements(carreau_session* session, int32_t corners, int64_t capacity, int32_t out_nodes[],
                                                   int32_t out_references[]);
CARREAU_API carreau_status carreau_raised_write(carreau_session* session, const char* path);

/* ---- Points of added geometries ---- */

/* Evaluates a face at n places (u, v). Errors: SEQUENCE (no geometry was added), ARGUMENT. */
CARREAU_API carreau_status carreau_geometry_points(carreau_session* session, int32_t face_ref, int64_t n,
                                                   const double uv[], double out_xyz[]);

/* Evaluates curve `ic` of a face at a share of its interval, from 0 to 1: (u, v). Errors: as above. */
CARREAU_API carreau_status carreau_geometry_curve(carreau_session* session, int32_t face_ref, int32_t ic, double share,
                                                  double out_uv[2]);

#ifdef __cplusplus
}
#endif

#endif
