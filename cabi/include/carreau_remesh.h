/* SPDX-License-Identifier: BSD-3-Clause */
/* carreau_remesh.h: pieces of the plane that deform, break and touch tools are meshed anew, increment by increment
 * (HDR sec. 3.4). The solver is the caller's. C99, and C++ as well.
 *
 *   carreau_mesh_create(&mesh);
 *   while (increment()) {                               // moves x, fills damage, moves the tools
 *     carreau_remesh_input input = {sizeof input, ...};
 *     carreau_remesh(mesh, &input, &summary);           // then carreau_mesh_vertices, carreau_mesh_triangles, ...
 *   }
 *
 * The rules of carreau.h hold for every function.
 */
#ifndef CARREAU_REMESH_H
#define CARREAU_REMESH_H

#include "carreau.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The reference in the mesh of a vertex or an edge of the boundary. On tool k, from 0, it is CARREAU_NODE_BOUND + k. */
enum {
  CARREAU_NODE_INSIDE = 0,
  CARREAU_NODE_FREE = 1,    /* deformed by stresses */
  CARREAU_NODE_IMPOSED = 2, /* laid bare by the removal of elements */
  CARREAU_NODE_BOUND = 3    /* on a tool */
};

/* How a value in triangles goes to the next mesh: as the mean over the area of a triangle (bounded; preserves
 * constants), or as a density whose integral over the piece stays, except for rounding. */
enum { CARREAU_ELEMENT_MEAN = 0, CARREAU_ELEMENT_CONSERVED = 1 };

/* Curves through free nodes between corners: splines of class C2, with tangents at their ends by four nodes or without
 * curvature there; or straight edges. */
enum { CARREAU_SPLINE_TANGENT = 0, CARREAU_SPLINE_NATURAL = 1, CARREAU_POLYGON = 2 };

/* The error of interpolation that determines sizes. */
enum { CARREAU_ERROR_NONE = 0, CARREAU_ERROR_HESSIAN = 1, CARREAU_ERROR_CURVATURE = 2, CARREAU_ERROR_DEFORMATION = 3 };

/* How close the new boundary came to the request: as requested; runs near places where new edges crossed each other
 * keep their nodes; all runs keep them; bound nodes have not moved to the tools either. */
enum {
  CARREAU_BOUNDARY_SMOOTH = 0,
  CARREAU_BOUNDARY_PARTLY = 1,
  CARREAU_BOUNDARY_KEPT = 2,
  CARREAU_BOUNDARY_AS_GIVEN = 3
};

/* State in. Indices count from 0; an array may be NULL where its comment allows it. Lengths are model lengths. */
typedef struct carreau_remesh_input {
  size_t struct_size;
  int64_t vertex_count, triangle_count;
  const double* vertices;      /* vertex_count x 2: the displacement of the increment is added already */
  const int32_t* triangles;    /* triangle_count x 3, counterclockwise */
  const double* displacements; /* vertex_count x 2, of the increment, to be checked; NULL: not checked */
  const double* damage;        /* triangle_count, in [0, 1]; NULL: none */

  /* Rigid tools where they are now: polylines with the solid on their left. A radius rounds a corner by an arc. */
  int64_t tool_count;
  const int64_t* tool_starts;  /* tool_count + 1: tool k has points tool_starts[k] .. tool_starts[k + 1] - 1 */
  const double* tool_points;   /* x 2 */
  const double* tool_radii;    /* a point; NULL: all corners are sharp */
  const int32_t* tool_closed;  /* tool_count: 1: the last point is followed by the first; NULL: none is */

  int32_t nodal_components;    /* values at each vertex: linear, exact for linear fields */
  int32_t element_components;  /* values in each triangle */
  const double* nodal_values;  /* vertex_count x nodal_components; NULL if these are 0 */
  const double* element_values; /* triangle_count x element_components; NULL if these are 0 */
  const int32_t* element_kinds; /* element_components: CARREAU_ELEMENT_...; NULL: means */

  double h_min, h_max;         /* bounds of sizes */
  double step;                 /* delta of HDR eq. 3.1: vertices as near to a tool are bound; at most h_min */
  double damage_limit;         /* elements of this damage are removed; 0: 1 */
  double gradation;            /* largest ratio of sizes one edge apart, above 1; 0: 1.3 */
  double corner_angle;         /* the boundary has a corner where it turns by more, degrees; 0: 45 */
  double curvature_angle;      /* between edges and tangents of boundary and tools, degrees; 0: 8 */
  int32_t curves;              /* CARREAU_SPLINE_..., CARREAU_POLYGON */
  int32_t imposed_smoothing;   /* rounds of smoothing of nodes that removed elements laid bare */
  int32_t keep_all_parts;      /* 0: the part of the largest area stays; 1: all do */
  int32_t no_damage_sizes;     /* 0: sizes fall linearly from h_max to h_min with damage; 1: they do not */
  int32_t error_source;        /* CARREAU_ERROR_... */
  int32_t error_component;     /* of nodal_values, whose error is estimated */
  double error_tolerance;      /* largest error, or angle in degrees for CARREAU_ERROR_CURVATURE; 0: 0.01 */
  int64_t max_triangles;       /* 0: 500 million */
  int32_t remove_overlaps;     /* 1: elements whose boundary edges cross each other's are removed; 0: DOMAIN */
  int32_t has_reach;           /* 1: `reach` holds; 0: it is the step */
  double reach;                /* nodes outside of a tool are bound within this, at most the step: a surface that leaves a
                                  tool by less in an increment never comes off */
  const int32_t* vertex_kinds; /* vertex_count, CARREAU_NODE_... as carreau_mesh_vertex_refs gives them after the last
                                  increment: edges of the boundary between two imposed vertices stay imposed, and are not
                                  smoothed again. NULL: only faces that this increment lays bare are imposed */
} carreau_remesh_input;

/* The events of a remeshing. */
typedef struct carreau_remesh_summary {
  size_t struct_size;
  int64_t vertices, triangles, boundary_edges;
  int64_t bound_vertices, free_vertices, imposed_vertices;
  /* Triangles removed: totally damaged; at vertices where more than two boundary edges met; left at one side only by
   * the removal; with smaller parts; where the piece overlapped itself. */
  int64_t removed_damaged, removed_multiple, removed_dangling, removed_parts;
  int64_t removed_overlapping;     /* with remove_overlaps */
  int32_t parts_found, parts_kept; /* more than one: the piece has broken */
  int32_t boundary;                /* CARREAU_BOUNDARY_... */
  int32_t reserved;
  double area_given, area_removed;
  double area_bound;    /* gained by boundary nodes that moved to tools, were smoothed or removed */
  double area_geometry; /* inside the curves of the new boundary */
  double area;          /* of the new mesh */
} carreau_remesh_summary;

/* Meshes a piece anew after an increment, and puts the result into a mesh that carreau_mesh_create has made: dimension
 * 2; references of vertices and edges are CARREAU_NODE_...; edges are the boundary, with the piece on their left;
 * references of triangles are parts, from 1. `out_summary` may be NULL. Equal input gives an identical mesh. On an
 * error the mesh and the summary stay as they were. Errors: ARGUMENT (counts, indices, numbers that are not finite; a
 * triangle that the displacement has turned over; a displacement or a step larger than h_min; damage outside [0, 1]; a
 * negative kind; a
 * tool deeper than the step in the piece, or the piece in a tool; radii that do not fit; nothing is left of the piece;
 * mesh of a session), DOMAIN (the piece overlaps itself), LIMIT, MEMORY. */
CARREAU_API carreau_status carreau_remesh(carreau_mesh* mesh, const carreau_remesh_input* input,
                                          carreau_remesh_summary* out_summary);

/* Copy the fields on the new mesh: vertices x nodal_components, triangles x element_components, triangles.
 * Errors: ARGUMENT (capacity, in rows), SEQUENCE (the mesh is not by carreau_remesh; there was no damage). */
CARREAU_API carreau_status carreau_remesh_nodal_values(carreau_mesh* mesh, int64_t capacity, double out_values[]);
CARREAU_API carreau_status carreau_remesh_element_values(carreau_mesh* mesh, int64_t capacity, double out_values[]);
CARREAU_API carreau_status carreau_remesh_damage(carreau_mesh* mesh, int64_t capacity, double out_damage[]);

/* Adds a field to a mesh outside of sessions, for carreau_mesh_write to .vtu: `components` numbers for each vertex, or
 * each triangle. A field of the same name is replaced. Errors: ARGUMENT, SEQUENCE (the mesh is empty). */
CARREAU_API carreau_status carreau_mesh_add_field(carreau_mesh* mesh, const char* name, int32_t on_vertices,
                                                  int32_t components, const double values[]);

#ifdef __cplusplus
}
#endif

#endif
