/* SPDX-License-Identifier: BSD-3-Clause */
/* carreau_atlas.h: loops and annuli of the plane with smooth parameters, and C1 atlases of triangulated surfaces (G. Atlas, chapter 5).
 * C99, and C++ as well.
 *
 *   carreau_atlas_create(&atlas);
 *   carreau_atlas_build(atlas, NULL, vertices, xyz, triangles, corners, NULL);
 *   carreau_add_atlas(session, atlas);                            // a geometry like any other: carreau_mesh_generate
 *
 * The rules of carreau.h hold for every function. Vertices, triangles, clusters and charts count from 0 in arrays; sentences count
 * vertices from 1. A handle is used by one thread at a time; carreau_..._last_error returns the sentence of its last failed call.
 */
#ifndef CARREAU_ATLAS_H
#define CARREAU_ATLAS_H

#include "carreau_geometry.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Loops: simple polygons with an angle as parameter ---- */

/* Holds a simple polygon with its parameter. */
typedef struct carreau_loop carreau_loop;

/* How fast the angle about a pivot changes. */
enum {
  CARREAU_LOOP_EVEN = 0,  /* the angle about each pivot is linear in phi: a homeomorphism with the circle */
  CARREAU_LOOP_SMOOTH = 1 /* besides, C1 where pivots change; at vertices the polygon itself turns */
};

/* Creates an empty loop. Errors: ARGUMENT, MEMORY. */
CARREAU_API carreau_status carreau_loop_create(carreau_loop** out_loop);
CARREAU_API void carreau_loop_free(carreau_loop* loop); /* Frees it. NULL is allowed */
/* Returns the sentence of the last call on the loop, "" after success. It lives until the next call on it. */
CARREAU_API const char* carreau_loop_last_error(const carreau_loop* loop);

/* Describes a polygon of n vertices (n x 2: x y), counterclockwise, the first one not repeated. On an error the loop is as before.
 * Errors: ARGUMENT, DOMAIN (a loop that crosses or touches itself, runs clockwise, or whose parts are too near to one another). */
CARREAU_API carreau_status carreau_loop_build(carreau_loop* loop, int64_t n, const double xy[], int32_t speed);

/* Points (n x 2) at n values of phi, which has a period of 2 pi and is 0 at vertex 0, and derivatives by phi (n x 2; NULL: none).
 * Errors: ARGUMENT, SEQUENCE (nothing was built). */
CARREAU_API carreau_status carreau_loop_points(carreau_loop* loop, int64_t n, const double phi[], double out_xy[], double out_derivatives[]);

/* phi, from 0 to 2 pi, of n points of the loop. Errors: ARGUMENT (one is further from the loop than `tolerance`), SEQUENCE. */
CARREAU_API carreau_status carreau_loop_invert(carreau_loop* loop, int64_t n, const double xy[], double tolerance, double out_phi[]);

/* The pivots (x y), inside and outside by turns, and their number; capacity 0 requests the number alone. Errors: ARGUMENT (capacity),
 * SEQUENCE. */
CARREAU_API carreau_status carreau_loop_pivots(carreau_loop* loop, int64_t capacity, double out_xy[], int64_t* out_count);

/* ---- Annuli ---- */

/* Holds the annulus between two polygons with its parameters. */
typedef struct carreau_annulus carreau_annulus;

/* The border that follows from the other one, as a multiple of it about each pivot. The inner border is rounded, and the outer one follows,
 * unless the name has OUTER: then the outer border is rounded, more is covered, and the inner border is less like the given one. */
enum {
  CARREAU_BORDER_SPLINE = 0,       /* a cubic between two vertices: C1, and inside the polygons */
  CARREAU_BORDER_CUBIC = 1,        /* one cubic a pivot: C1, simpler, covers less */
  CARREAU_BORDER_POLYGON = 2,      /* the polygons themselves: C0 only */
  CARREAU_BORDER_OUTER_SPLINE = 3, /* as SPLINE, from the outer border */
  CARREAU_BORDER_OUTER_CUBIC = 4   /* as CUBIC, from the outer border */
};

/* Zones of a point. */
enum {
  CARREAU_ZONE_OUTSIDE = 0,
  CARREAU_ZONE_ANNULUS = 1, /* of an atlas: shared with other charts */
  CARREAU_ZONE_INSIDE = 2   /* of an atlas: the chart's alone */
};

/* Creates an empty annulus. Errors: ARGUMENT, MEMORY. */
CARREAU_API carreau_status carreau_annulus_create(carreau_annulus** out_annulus);
CARREAU_API void carreau_annulus_free(carreau_annulus* annulus); /* Frees it. NULL is allowed */
/* Returns the sentence of the last call on the annulus, "" after success. It lives until the next call on it. */
CARREAU_API const char* carreau_annulus_last_error(const carreau_annulus* annulus);

/* Describes the annulus between two polygons, both counterclockwise (n x 2, m x 2). If no pivots see all of it, its outer border comes
 * nearer. `star`: 1 allows a single pivot if it sees the whole inner border. Errors: ARGUMENT, DOMAIN (as carreau_loop_build; an annulus
 * without width). */
CARREAU_API carreau_status carreau_annulus_build(carreau_annulus* annulus, int64_t n, const double inner_xy[], int64_t m,
                                                 const double outer_xy[], int32_t border, int32_t star);

/* Points (n x 2) at n places tau, phi (n x 2), tau from 0 at the inner to 1 at the outer border, phi with a period of 2 pi;
 * derivatives (n x 4: x, y by tau, then by phi; NULL: none). Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_annulus_points(carreau_annulus* annulus, int64_t n, const double tau_phi[], double out_xy[],
                                                  double out_derivatives[]);

/* Zones of n points, and tau, phi (n x 2, phi from 0 to 2 pi) of points in the annulus, 0 for others. An array may be NULL. Errors: ARGUMENT,
 * SEQUENCE. */
CARREAU_API carreau_status carreau_annulus_invert(carreau_annulus* annulus, int64_t n, const double xy[], double out_tau_phi[],
                                                  int32_t out_zones[]);

/* The pivots (x y) of an annulus, and their number; as carreau_loop_pivots. Errors: ARGUMENT (capacity), SEQUENCE. */
CARREAU_API carreau_status carreau_annulus_pivots(carreau_annulus* annulus, int64_t capacity, double out_xy[], int64_t* out_count);

/* The polygon (x y) that was described as outer border, and the number of its vertices; as carreau_loop_pivots. Errors: ARGUMENT
 * (capacity), SEQUENCE. */
CARREAU_API carreau_status carreau_annulus_outer_border(carreau_annulus* annulus, int64_t capacity, double out_xy[], int64_t* out_count);

/* The edges (x y x y) of the pseudo-skeleton of the inner border, and their number; as carreau_loop_pivots. Errors: ARGUMENT (capacity),
 * SEQUENCE. */
CARREAU_API carreau_status carreau_annulus_skeleton(carreau_annulus* annulus, int64_t capacity, double out_edges[], int64_t* out_count);

/* Writes an OpenEXR file of `width` pixels a row: channels tau and phi (NaN outside of the annulus), and zone (CARREAU_ZONE_...),
 * over the box of the outer border, y upwards. Errors: ARGUMENT (a width below 2 or above 65536), SEQUENCE, FILE (a library without
 * OpenEXR, too). */
CARREAU_API carreau_status carreau_annulus_write_exr(carreau_annulus* annulus, const char* path, int32_t width);

/* ---- Atlases of closed triangulated surfaces ---- */

/* Holds charts of a closed triangulated surface. */
typedef struct carreau_atlas carreau_atlas;

/* Zeros in all members but struct_size are the defaults; NULL in place of the struct is the same. */
typedef struct carreau_atlas_options {
  size_t struct_size;
  int32_t border; /* CARREAU_BORDER_..., not POLYGON */
  int32_t reach;  /* of clusters that the library makes, in edges: 1 (0 is the same) for the smallest, 2, 3 for larger ones */
} carreau_atlas_options;

/* The numbers of the charts and other entities of an atlas. */
typedef struct carreau_atlas_counts {
  size_t struct_size;
  int64_t vertices, triangles; /* of the triangulation covered: the one given, or its division */
  int64_t charts;
  int64_t triples;    /* places where three charts meet */
  int64_t mended;     /* charts whose annulus has pivots beside its vertices, since the pivots of the skeleton fail */
} carreau_atlas_counts;

/* The plane of a chart: its place (x, y) lies at origin + x u + y v. */
typedef struct carreau_atlas_chart {
  size_t struct_size;
  double origin[3], u[3], v[3], normal[3];
  double period;    /* of phi in its annulus: pi / 3 for each place where three charts meet */
  int64_t vertices; /* of its cluster */
} carreau_atlas_chart;

/* Creates an empty atlas. Errors: ARGUMENT, MEMORY. */
CARREAU_API carreau_status carreau_atlas_create(carreau_atlas** out_atlas);
CARREAU_API void carreau_atlas_free(carreau_atlas* atlas); /* Frees it. NULL is allowed */
/* Returns the sentence of the last call on the atlas, "" after success. It lives until the next call on it. */
CARREAU_API const char* carreau_atlas_last_error(const carreau_atlas* atlas);

/* Covers a closed surface of n vertices (n x 3) and m triangles (m x 3, indices from 0, counterclockwise from outside). clusters: the
 * cluster of each vertex, from 0 without gaps, each a disc; NULL, or -1 at vertex 0: the library makes them, and divides triangles in four
 * where they are too coarse. On an error the atlas is as before. Errors: ARGUMENT (the triangulation has a border, or is turned differently
 * in places), DOMAIN (a cluster that is no disc, or far from a plane). */
CARREAU_API carreau_status carreau_atlas_build(carreau_atlas* atlas, const carreau_atlas_options* options, int64_t n, const double xyz[], int64_t m,
                                               const int32_t triangles[], const int32_t clusters[]);

/* Count the entities of the atlas, and describe chart `chart`. Errors: ARGUMENT, SEQUENCE (nothing was built). */
CARREAU_API carreau_status carreau_atlas_count(carreau_atlas* atlas, carreau_atlas_counts* out_counts);
CARREAU_API carreau_status carreau_atlas_chart_info(carreau_atlas* atlas, int64_t chart, carreau_atlas_chart* out_chart);

/* Places (n x 2) of a chart at n places tau, phi of its annulus, which it shares with others. Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_atlas_annulus_points(carreau_atlas* atlas, int64_t chart, int64_t n, const double tau_phi[], double out_xy[]);

/* Zones (CARREAU_ZONE_...) and weights of the chart at n of its places; an array may be NULL. The weights of all charts at one place of the
 * surface have the sum 1. Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_atlas_zones(carreau_atlas* atlas, int64_t chart, int64_t n, const double xy[], int32_t out_zones[],
                                               double out_weights[]);

/* Transition from chart i to chart j: places (n x 2) in j of n places of i. out_found: 1 where both charts have the place, else 0, and the
 * place is left alone. Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_atlas_transition(carreau_atlas* atlas, int64_t i, int64_t j, int64_t n, const double xy[], double out_xy[],
                                                    int32_t out_found[]);

/* Points (n x 3) of the blended C1 surface at n places of a chart, and derivatives (n x 6: by x, then by y; NULL: none).
 * Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_atlas_points(carreau_atlas* atlas, int64_t chart, int64_t n, const double xy[], double out_xyz[],
                                                double out_derivatives[]);

/* Adds the blended surface to a session: chart k is face k + 1. The session copies the data that it needs: the atlas may be freed or
 * built anew. The sentence of an error is the session's. Errors: ARGUMENT, SEQUENCE (nothing was built; see
 * carreau_geometry_begin). */
CARREAU_API carreau_status carreau_add_atlas(carreau_session* session, const carreau_atlas* atlas);

#ifdef __cplusplus
}
#endif

#endif
