/* SPDX-License-Identifier: BSD-3-Clause */
/* clang-format off */
/* carreau.h: meshes of surfaces made of parametric patches, driven by callbacks. C89 with <stdint.h>, C99, and C++.
 *
 * In ten lines:
 *   carreau_session* session = NULL;
 *   carreau_session_create(&session);
 *   carreau_set_cad(session, &my_geometry);                    // or carreau_set_cad_m
 *   carreau_model_add_face(session, 1, 1);                      // or carreau_model_read_pardom
 *   carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, 0, 0, 0); ...
 *   carreau_set_real(session, "hphydef", 0.1);
 *   if (carreau_mesh_generate(session) != CARREAU_OK) puts(carreau_last_error(session));
 *   carreau_session_mesh(session, &mesh);                       // then carreau_mesh_vertices, carreau_mesh_write, ...
 *   carreau_session_free(session);
 *
 * Rules that hold for every function
 *
 *   Status     A function that can fail returns a carreau_status. Results come through out_ arguments; an error leaves
 *              them as they were.
 *   Errors     carreau_last_error(session) and carreau_mesh_last_error(mesh) hold the sentence of the last call on
 *              that handle ("" after success). A NULL handle is CARREAU_ERR_ARGUMENT and has no sentence.
 *   Threads    Handles are independent of one another. Use a handle from one thread at a time; only carreau_stop may be
 *              called from anywhere at any time. There is no global state.
 *   Callbacks  come one at a time from the thread that called carreau_mesh_generate, carreau_run_env, carreau_write_exr
 *              or, to measure the delivered mesh, carreau_session_delivered and its like. Only carreau_cad.reentrant
 *              allows more. A callback must return: no longjmp, Fortran stop or C++ exception may leave it (an
 *              exception that does is CARREAU_ERR_CALLBACK, where compilers agree). Inside a callback, carreau_stop is
 *              the only call allowed on its session and mesh; any other returns CARREAU_ERR_BUSY.
 *   Silence    The library prints nothing, raises and catches no signal, and never ends the process. It gives back the
 *              caller's floating-point environment (rounding, traps, flags) as it was; callbacks run in the default.
 *   Ownership  The library copies arguments before a call returns. The library owns the strings that it returns; the
 *              comment of each states its lifetime. Arrays of results belong to the caller.
 *   Text       is UTF-8 and ends with a zero byte. Numbers in it do not depend on the locale.
 *   Structs    start with struct_size, so that they can grow: set it to sizeof the struct. Set every other member of an
 *              input struct to zero (`= {0}`) before you fill it.
 *   Arrays     are declared as `T name[]`, pointers to one value as `T* name`.
 *   Indices    of vertices, triangles, edges and faces count from 0. Two numbers of the manual count from 1 here too:
 *              `ic`, the rank of a curve in its face, and the rank in `orientation`.
 *   Units      Lengths are in the model units of S(u, v), angles in degrees, times in seconds.
 *
 * "RT-0232" is the manual of the program BLSURF: P. Laug, H. Borouchaki, INRIA RT-0232 (1999). "RR-2818" is P. Laug,
 * H. Borouchaki, P. L. George, INRIA RR-2818 (1996), and "HDR" is P. Laug's habilitation (2006).
 */
/* clang-format on */
#ifndef CARREAU_H
#define CARREAU_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#if defined(CARREAU_BUILDING)
#define CARREAU_API __declspec(dllexport)
#else
#define CARREAU_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define CARREAU_API __attribute__((visibility("default")))
#else
#define CARREAU_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Versions and status ---- */

/* The version of this header. */
#define CARREAU_VERSION_MAJOR 0
#define CARREAU_VERSION_MINOR 1
#define CARREAU_VERSION_PATCH 0

/* One row for each status: X(symbol, value, meaning). A value never changes, and is never used again. */
#define CARREAU_STATUS_TABLE(X)                                                                               \
  X(CARREAU_OK, 0, "success")                                                                                 \
  X(CARREAU_ERR_ARGUMENT, 1, "an argument or the value of a parameter violates its precondition")             \
  X(CARREAU_ERR_MODEL, 2, "faces, curves, points or references contradict one another")                       \
  X(CARREAU_ERR_FILE, 3, "a file cannot be opened, read, understood or written")                              \
  X(CARREAU_ERR_CALLBACK, 4, "a callback reported a failure or returned a value that is not usable")          \
  X(CARREAU_ERR_DOMAIN, 5, "a parameter domain does not close, crosses itself or is turned the wrong way")    \
  X(CARREAU_ERR_LIMIT, 6, "the mesh would exceed the limit set by max_triangles or by memory")                \
  X(CARREAU_ERR_CANCELLED, 7, "the host stopped the run")                                                       \
  X(CARREAU_ERR_MEMORY, 8, "an allocation failed")                                                            \
  X(CARREAU_ERR_SEQUENCE, 9, "the call needs the result of an earlier call that was not made or did not succeed") \
  X(CARREAU_ERR_PARTIAL, 10, "some faces could not be meshed; the mesh holds the others")                     \
  X(CARREAU_ERR_BUSY, 11, "the session is running: only carreau_stop may be called from a callback")          \
  X(CARREAU_ERR_INTERNAL, 99, "a defect of the library; please report it")

/* The result of a function that can fail: CARREAU_OK, or one of the errors above. */
typedef int32_t carreau_status;
enum {
#define CARREAU_STATUS_ROW(symbol, value, meaning) symbol = value,
  CARREAU_STATUS_TABLE(CARREAU_STATUS_ROW)
#undef CARREAU_STATUS_ROW
  CARREAU_STATUS_END = 100 /* above every status; C89 allows no comma at the end of a list */
};

/* Return "CARREAU_ERR_FILE" and the meaning above, or "CARREAU_UNKNOWN_STATUS" and "unknown status". Both are static.
 */
CARREAU_API const char* carreau_status_name(carreau_status status);
CARREAU_API const char* carreau_status_meaning(carreau_status status);

/* Return the version of the library that runs: "0.1.0" (static), and major * 10000 + minor * 100 + patch. */
CARREAU_API const char* carreau_version(void);
CARREAU_API int32_t carreau_version_number(void);

/* ---- Sessions ---- */

/* Holds geometry, model, parameters and the mesh made of them. */
typedef struct carreau_session carreau_session;
/* Holds a mesh: the mesh of a session, or a mesh read from a file. */
typedef struct carreau_mesh carreau_mesh;

/* Creates a session with default parameters, and without geometry or model. Free it with carreau_session_free.
 * Errors: ARGUMENT (out_session is NULL), MEMORY. */
CARREAU_API carreau_status carreau_session_create(carreau_session** out_session);

/* Frees a session and its mesh. NULL is allowed. Inside a callback of the session the call is ignored. */
CARREAU_API void carreau_session_free(carreau_session* session);

/* Returns the sentence of the last call on the session: which routine, which face, curve, (u, v) or t, which file and
 * line. It is "" after success, for a NULL session, and inside a callback. It lives until the next call on the session.
 */
CARREAU_API const char* carreau_last_error(const carreau_session* session);

/* The place of the last error. A member that does not matter is 0, or NaN. References are the host's own. */
typedef struct carreau_error_place {
  size_t struct_size;
  int32_t face;  /* reference of the face */
  int32_t ic;    /* rank of a curve in that face, from 1 */
  int32_t curve; /* reference of the curve */
  int32_t point; /* reference of the point */
  int32_t line;  /* line of the file named in the sentence, from 1 */
  int32_t reserved;
  double uv[2];
  double t;
} carreau_error_place;

/* Fills *out_place. Unlike other calls, it keeps the sentence and the place. Errors: ARGUMENT. */
CARREAU_API carreau_status carreau_last_error_place(const carreau_session* session, carreau_error_place* out_place);

/* For libraries that work on a session of their caller: marks the last call as failed with this status and sentence.
 * Returns the status. NULL or "": no sentence. Errors: ARGUMENT (the status is CARREAU_OK or none).
 */
CARREAU_API carreau_status carreau_set_error(carreau_session* session, carreau_status error, const char* sentence);

/* ---- Geometry: the routines of the module cad_m ---- */

/* The value of h and the radii before the call of a routine. A routine that does not answer leaves it (RT-0232 sec.
 * 3.1.3).
 */
#define CARREAU_HVIDE (-1e38)

/* The routines of RT-0232 sec. 3.1, under their names and with their arguments, each by reference. A bind(C) procedure
 * or an external Fortran 77 subroutine fits as it is.
 *   refs   reference of the face          ic   rank of the curve in the face, from 1 (order of the model)
 *   uv     u, v                           t    parameter on the curve, a <= t <= b
 * surf0, curv_int and curv0 are needed. Finite differences replace derivatives that are NULL. Derivatives that are
 * given are compared with finite differences on a sample before a mesh is made. Sizes and radii that are NULL do not
 * answer. A routine has no status: it reports a failure by a value that is not finite, or by carreau_stop. */
typedef struct carreau_cad_m {
  size_t struct_size;
  void (*cad_init)(void);                                          /* called once, by carreau_set_cad_m; may be NULL */
  void (*surf0)(const int32_t* refs, const double* uv, double* S); /* S[3] */
  void (*surf1)(const int32_t* refs, const double* uv, double* Su, double* Sv);                /* [3] each */
  void (*surf2)(const int32_t* refs, const double* uv, double* Suu, double* Suv, double* Svv); /* [3] each */
  void (*curv_int)(const int32_t* refs, const int32_t* ic, double* a, double* b);
  void (*curv0)(const int32_t* refs, const int32_t* ic, const double* t, double* C);     /* C[2] */
  void (*curv1)(const int32_t* refs, const int32_t* ic, const double* t, double* Ct);    /* [2] */
  void (*curv2)(const int32_t* refs, const int32_t* ic, const double* t, double* Ctt);   /* [2] */
  void (*cad_hphys)(const int32_t* refs, const double* uv, double* h);                   /* called if hphy_flag = 2 */
  void (*cad_hphyc)(const int32_t* refs, const int32_t* ic, const double* t, double* h); /* called if hphy_flag = 2 */
  void (*cad_hphyp)(const int32_t* refp, double* h);                                     /* called if hphy_flag = 2 */
  void (*cad_rads)(const int32_t* refs, const double* uv, double* rhos);                 /* called if hgeo_flag = 2 */
  void (*cad_radc)(const int32_t* refs, const int32_t* ic, const double* t, double* rhoc); /* when hgeo_flag = 2 */
} carreau_cad_m;

/* Registers the routines in place of earlier ones of this call or of carreau_set_cad, and calls cad_init. Copies the
 * struct.
 * Errors: ARGUMENT (a needed routine is missing, struct_size). */
CARREAU_API carreau_status carreau_set_cad_m(carreau_session* session, const carreau_cad_m* routines);

/* ---- Geometry: callbacks for C hosts ---- */

/* A callback returns 0, or any other value to report a failure. The run then ends with CARREAU_ERR_CALLBACK and a
 * sentence that holds the value. A size or radius that does not answer returns CARREAU_NO_ANSWER, or returns 0 and
 * leaves CARREAU_HVIDE in *value. A callback may leave entries above `order` untouched.
 *   face    reference of the face
 *   ic      rank of the curve in the face, from 1
 *   order   highest derivative requested: 0, 1 or 2, never above surface_order (curve_order)
 *   user    the member `user` of the struct */
#define CARREAU_NO_ANSWER (-1)

/* Gives S(u, v) and its derivatives, [3] each. No pointer is NULL. */
typedef int32_t (*carreau_surface_fn)(int32_t face, double u, double v, int32_t order, double* S, double* Su,
                                      double* Sv, double* Suu, double* Suv, double* Svv, void* user);
/* Does the same at n > 0 points: uv is n x 2 and every result n x 3, row by row. Results above `order` are NULL. */
typedef int32_t (*carreau_surface_batch_fn)(int32_t face, int64_t n, const double* uv, int32_t order, double* S,
                                            double* Su, double* Sv, double* Suu, double* Suv, double* Svv, void* user);
/* Gives the interval [a, b] of a curve, a < b. */
typedef int32_t (*carreau_interval_fn)(int32_t face, int32_t ic, double* a, double* b, void* user);
/* Gives C(t) in the parameter plane and its derivatives, [2] each. No pointer is NULL. */
typedef int32_t (*carreau_curve_fn)(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct,
                                    double* Ctt, void* user);
/* Give the desired size (hphy_flag = 2) or the radius of curvature (hgeo_flag = 2), a model length > 0. A size that is
 * not positive and finite is an error of the callback. */
typedef int32_t (*carreau_surface_value_fn)(int32_t face, double u, double v, double* value, void* user);
typedef int32_t (*carreau_curve_value_fn)(int32_t face, int32_t ic, double t, double* value, void* user);
typedef int32_t (*carreau_point_value_fn)(int32_t point, double* value, void* user);
/* Explains to a reader why a callback has failed on a face, as part of the sentence of the error. It is called right
 * after the callback, from the same thread. The text is copied; NULL or "" adds nothing. */
typedef const char* (*carreau_failure_fn)(int32_t face, void* user);

/* The callbacks of a geometry. */
typedef struct carreau_cad {
  size_t struct_size;
  void* user;            /* handed to every callback; never looked at */
  int32_t surface_order; /* order that `surface` can give: 0, 1 or 2; the rest is found by finite differences */
  int32_t curve_order;   /* order that `curve` can give: 0, 1 or 2 */
  int32_t reentrant;     /* 1: callbacks may come from several threads at a time; 0: from the caller's thread only */
  int32_t reserved;      /* 0 */
  carreau_surface_fn surface;             /* needed, unless surface_batch is given */
  carreau_surface_batch_fn surface_batch; /* used in place of `surface` when given */
  carreau_interval_fn curve_interval;     /* needed */
  carreau_curve_fn curve;                 /* needed */
  carreau_surface_value_fn surface_size;  /* the rest may be NULL: does not answer */
  carreau_curve_value_fn curve_size;
  carreau_point_value_fn point_size;
  carreau_surface_value_fn surface_radius;
  carreau_curve_value_fn curve_radius;
  carreau_failure_fn failure;
  void (*release)(void* user); /* called once, when nothing asks the callbacks any more: the session has others or is
                                  freed, and no mesh is left that they have made. It makes no call on the session */
} carreau_cad;

/* Registers the callbacks in place of earlier ones of this call or of carreau_set_cad_m; geometries that were added
 * (carreau_geometry.h) stay. Copies the struct, but not the target of `user`.
 * Errors: ARGUMENT (a needed callback is missing, an order outside 0..2, struct_size). */
CARREAU_API carreau_status carreau_set_cad(carreau_session* session, const carreau_cad* callbacks);

/* ---- Prescribed sizes and metrics ---- */

/* *kind is the kind of the answer of a metric callback. Before the call it is NONE, and every value is NaN.
 *   NONE      nothing; the status CARREAU_NO_ANSWER means the same
 *   SIZE      value[0]: the same size in all directions, a model length
 *   SPACE     value[0..5]: xx, xy, xz, yy, yz, zz of a positive definite tensor M, in 1 / model length^2. A vector d
 *             has the length sqrt(d^T M d), and edges are to have length 1. Sizes along the axes of M are
 *             1 / sqrt(eigenvalue)
 *   TANGENT   value[0..4]: h1, h2 > 0, model lengths, and x, y, z of a direction of any length but zero. The size is h1
 *             along the direction and h2 across it. The direction should be tangent to the surface. If it is not, the
 *             answer is the SPACE metric with h1 along it and h2 across, restricted to the tangent plane; the size
 *             along the normal is h2
 * A size that is not finite and positive, or a tensor that is not positive definite, ends the run with
 * CARREAU_ERR_CALLBACK and a sentence with the place. */
enum { CARREAU_METRIC_NONE = 0, CARREAU_METRIC_SIZE = 1, CARREAU_METRIC_SPACE = 2, CARREAU_METRIC_TANGENT = 3 };

/* Answer at (u, v) in a face, at t on its curve number ic, and at a point (its reference). `value` has room for 6. */
typedef int32_t (*carreau_surface_metric_fn)(int32_t face, double u, double v, int32_t* kind, double* value,
                                             void* user);
typedef int32_t (*carreau_curve_metric_fn)(int32_t face, int32_t ic, double t, int32_t* kind, double* value,
                                           void* user);
typedef int32_t (*carreau_point_metric_fn)(int32_t point, int32_t* kind, double* value, void* user);

/* Does the same at n > 0 points: uv is n x 2, xyz (the points in space) n x 3, kind n and value n x 6, row by row. */
typedef int32_t (*carreau_surface_metric_batch_fn)(int32_t face, int64_t n, const double* uv, const double* xyz,
                                                   int32_t* kind, double* value, void* user);

/* Callbacks that prescribe metrics, beside the callbacks of a geometry. */
typedef struct carreau_metric_callbacks {
  size_t struct_size;
  void* user;                               /* handed to every callback; never looked at */
  carreau_surface_metric_fn surface_metric; /* all may be NULL: does not answer */
  carreau_curve_metric_fn curve_metric;
  carreau_point_metric_fn point_metric;
  carreau_surface_metric_batch_fn surface_metric_batch; /* used in place of surface_metric when given */
} carreau_metric_callbacks;

/* Registers metric callbacks beside a geometry of either kind. If all are NULL there are none, as in a new session.
 * Copies the struct. The library calls them unless hphy_flag is 0. It clamps sizes along the axes of a metric, in the
 * tangent plane, to [hphymin, hphymax]. If a size routine of the geometry answers too (hphy_flag 2), both hold: the
 * result is the largest ellipse inside both unit balls. The parameter metric_combination chooses how it is combined
 * with geometric sizes. On a curve the size is the size along its tangent. A curve or point without an answer takes the
 * answers of the surfaces beside it, by hmean_flag. Inside a face, a place without an answer takes hphydef (hphy_flag
 * 1) or the size interpolated from the curves around (hphy_flag 2). Errors: ARGUMENT (struct_size). */
CARREAU_API carreau_status carreau_set_metric_callbacks(carreau_session* session,
                                                        const carreau_metric_callbacks* callbacks);

/* ---- Model: faces, curves and points (RT-0232 sec. 3.2) ---- */

/* The kinds of curves (typc): on the boundary of a domain, or inside it. */
enum { CARREAU_BOUNDARY = 1, CARREAU_INTERNAL = 2 };

/* Drops all faces, and all geometries that were added (carreau_geometry.h). An earlier mesh stays. Errors:
 * ARGUMENT. */
CARREAU_API carreau_status carreau_model_clear(carreau_session* session);

/* Appends a face. Callbacks get the number `ref`, which differs from face to face. With an orientation of +k (-k) the
 * domain lies on the left (right) of the face's k-th curve, which must be a boundary.
 *
 * An orientation of 0 makes it a wire: curves of space that lie in no face, all of type CARREAU_INTERNAL. They are cut
 * by sizes and by their curvature like others, and the mesh has their edges, which no triangle has. Callbacks give them
 * like curves of faces, as C(t) in a plane and S(u, v): for instance, with C(t) = (t, 0), S(t, 0) is the curve. S is
 * evaluated on the curves, and within a step of finite differences beside them where its derivatives are not given.
 * Ends that have the reference of a point of a face are its vertices. Results list no wire among the faces. Errors:
 * ARGUMENT. */
CARREAU_API carreau_status carreau_model_add_face(carreau_session* session, int32_t ref, int32_t orientation);

/* Leaves a face out of the mesh, for the reason `why`; NULL or "" takes it in again. The mesh holds the face as failed,
 * with this reason. Its geometry is not evaluated, and it may have no curves. With the parameter failing_faces at
 * "leave_out", faces that fail during a run are left out, too. Errors: ARGUMENT (no such face). */
CARREAU_API carreau_status carreau_model_leave_out_face(carreau_session* session, int32_t face_ref, const char* why);

/* Appends a curve to face `face_ref`, as number ic = 1, 2, ... of that face. Curves that are one in space have the same
 * `ref`; a seam has it twice in one face. end1 and end2 are the references of the points at t = a and t = b. When the
 * first curve of the model has ref 0, the library finds all references of curves and ends by comparing positions
 * (parameter eps_glue). With the parameter glue_open = 1 it also compares curves that have references and that one face
 * only has, once.
 * Errors: ARGUMENT (no such face, unknown type). */
CARREAU_API carreau_status carreau_model_add_curve(carreau_session* session, int32_t face_ref, int32_t type,
                                                   int32_t ref, int32_t end1, int32_t end2);

/* How the lengths of edges follow one another. */
enum { CARREAU_EQUAL = 0, CARREAU_ARITHMETIC = 1, CARREAU_GEOMETRIC = 2 };

/* Prescribes the edges of curve number ic of a face, and so of all curves that are one with it in space, whatever the
 * prescribed sizes: `edges` arcs, whose lengths along the curve in space follow one another in the direction of its
 * parameter t. With CARREAU_EQUAL all are the same (`ratio` means nothing). With CARREAU_ARITHMETIC they grow by a
 * constant length, and the last is `ratio` times as long as the first. With CARREAU_GEOMETRIC each is `ratio` times as
 * long as its predecessor. edges = 0 removes prescriptions. Options that would refine or coarsen this curve
 * (CheckCloseEdges, geo_guarantee, narrow_faces, quadrilaterals without triangles) leave it unchanged, or warn.
 * Triangles beside short edges grow by edge_gradation (1.5 if it is 0). The prescriptions of one curve must not
 * contradict each other. A contradiction ends a run with MODEL, as does a closed curve of less than three edges, or a
 * curve that gluing cuts. Errors: ARGUMENT (no such face or curve, ratio not positive, edges that would have no
 * length). */
CARREAU_API carreau_status carreau_model_divide_curve(carreau_session* session, int32_t face_ref, int32_t ic,
                                                      int32_t edges, int32_t progression, double ratio);

/* Prescribes all vertices inside a curve by their parameters, strictly increasing, inside of its interval: n = 0 makes
 * it one edge. They are kept as they are, also on the parts of a curve that gluing cuts. Errors: ARGUMENT (no such face
 * or curve, parameters that do not increase); a run rejects parameters outside of the interval (MODEL). */
CARREAU_API carreau_status carreau_model_divide_curve_at(carreau_session* session, int32_t face_ref, int32_t ic,
                                                         int64_t n, const double t[]);

/* Imposes a vertex with reference `ref` at (u, v) inside face `face_ref`.
 * Errors: ARGUMENT (no such face, not finite). */
CARREAU_API carreau_status carreau_model_add_point(carreau_session* session, int32_t face_ref, int32_t ref, double u,
                                                   double v);

/* Names a face, for people and for files that hold names (.vtu, .msh, .stl). Several faces may have one name; "" takes
 * it away. Errors: ARGUMENT (no such face, NULL). */
CARREAU_API carreau_status carreau_model_name_face(carreau_session* session, int32_t face_ref, const char* name);
/* Names n entities of one dimension by their references: points (dimension 0), curves (1), faces (2) or solids (3).
 * Entities with one name form a group in files that hold groups (.msh, .inp, .unv, .bdf, .su2, .med, .vtu); curves and points are in
 * files when the parameter flag is 1. "" takes the name away. Errors: ARGUMENT (no such entity, NULL, a solid that no face has). */
CARREAU_API carreau_status carreau_model_name_entities(carreau_session* session, int32_t dimension, int64_t n,
                                                       const int32_t refs[], const char* name);
/* Sets the solids on both sides of a face, by references of the host from 1: the solid that its triangles look out of, and the
 * solid that they look into; 0: none. A file .msh then has volumes that Gmsh fills. Errors: ARGUMENT (no such face, below 0). */
CARREAU_API carreau_status carreau_model_set_face_sides(carreau_session* session, int32_t face_ref, int32_t solid,
                                                        int32_t other_solid);
/* Colours a face, for files that hold colours (.vtu). rgb is 0xRRGGBB in sRGB; -1, the default, takes the colour away.
 * Errors: ARGUMENT (no such face, no such colour). */
CARREAU_API carreau_status carreau_model_color_face(carreau_session* session, int32_t face_ref, int32_t rgb);

/* Makes a face a part of another face. A host that cuts a face where its surface bends adds its parts one after
 * another, and calls this for each but the first; `whole_ref` is the reference of the first. The results of a run have
 * one face, `whole_ref`, in their place: references of triangles, carreau_mesh_face, files. Callbacks, messages,
 * interfaces and images of fields know each part by its own reference. Errors: ARGUMENT (no such face, another face
 * comes before it). */
CARREAU_API carreau_status carreau_model_part_of_face(carreau_session* session, int32_t face_ref, int32_t whole_ref);

/* Makes the existing curves of a reference parts of another curve. Edges on them have the reference
 * `whole_ref`, as edges on the other parts of that curve have. Errors: ARGUMENT (no such curve). */
CARREAU_API carreau_status carreau_model_part_of_curve(carreau_session* session, int32_t ref, int32_t whole_ref);

/* Makes faces periodic: the mesh of slave_faces[i] is the image of the mesh of master_faces[i] (references, from 1) under the map x -> R x + d.
 * Curves and corners follow from the faces; faces, curves and corners may be of several pairs. `transform` holds R | d row by row (3 x 4), a
 * translation, rotation, reflection or product of them; NULL or all 0: found for each pair from its corners. With n = 0 all pairs are found that
 * the map has. If the map carries a face or a closed curve onto itself, or a face is its own master, its curves are periodic alone. Images lie
 * on the slave's own surface, within 1e-4 of the model's diagonal. carreau_mesh_generate checks the pairs. Errors: ARGUMENT (n < 0, no such
 * face, a face that is its own master without a map, lengths that the map changes, neither faces nor map); of carreau_mesh_generate: MODEL (faces that do not match: how far, where; chains that contradict each other;
 * prescribed edges that differ). */
CARREAU_API carreau_status carreau_model_add_periodicity(carreau_session* session, const int32_t slave_faces[],
                                                         const int32_t master_faces[], int64_t n, const double transform[]);
/* Makes all faces periodic that the translation along `direction` (3 numbers, any length but 0) by the model's extent along it
 * carries onto other faces. Errors: ARGUMENT; of carreau_mesh_generate: MODEL (no face matches another one). */
CARREAU_API carreau_status carreau_model_add_period(carreau_session* session, const double direction[]);

/* Replaces the model by the content of a file x.pardom. On an error the old model stays. Errors: FILE, MODEL. */
CARREAU_API carreau_status carreau_model_read_pardom(carreau_session* session, const char* path);

/* Writes the model in the layout of x.pardom. Errors: FILE. */
CARREAU_API carreau_status carreau_model_write_pardom(carreau_session* session, const char* path);

/* Checks the model against the rules that need no geometry, as carreau_mesh_generate does. Errors: MODEL. */
CARREAU_API carreau_status carreau_model_check(carreau_session* session);

/* Counts faces, curves (of all faces together) and imposed points. Any pointer but session may be NULL. Errors:
 * ARGUMENT. */
CARREAU_API carreau_status carreau_model_count(carreau_session* session, int64_t* out_faces, int64_t* out_curves,
                                               int64_t* out_points);

/* Read the model back. Once a mesh has been made, it has the references that gluing found. Faces come in the order in
 * which they were added, curves and points face by face. The arrays have room for `capacity` rows; each may be NULL.
 * Errors: ARGUMENT (capacity too small). */
CARREAU_API carreau_status carreau_model_faces(carreau_session* session, int64_t capacity, int32_t out_refs[],
                                               int32_t out_orientations[]);
/* out_ends is n x 2. */
CARREAU_API carreau_status carreau_model_curves(carreau_session* session, int64_t capacity, int32_t out_face_refs[],
                                                int32_t out_types[], int32_t out_refs[], int32_t out_ends[]);
/* out_uv is n x 2. */
CARREAU_API carreau_status carreau_model_points(carreau_session* session, int64_t capacity, int32_t out_face_refs[],
                                                int32_t out_refs[], double out_uv[]);

/* ---- Parameters (RT-0232 sec. 3.3) ---- */

/* The types of parameters. */
enum { CARREAU_INTEGER = 1, CARREAU_REAL = 2, CARREAU_TEXT = 3 };

/* The properties of a parameter that do not depend on its value. */
typedef struct carreau_parameter {
  size_t struct_size;
  const char* name;         /* strings are static */
  const char* help;         /* one line, with the unit */
  const char* default_text; /* of a text; "" otherwise */
  const char* choices;      /* of a text: "a|b|c", or "" when any text will do */
  double minimum, maximum;  /* of numbers, both allowed; maximum may be infinity */
  double default_number;    /* of numbers; times diag when diag_relative */
  int32_t type;             /* CARREAU_INTEGER, CARREAU_REAL, CARREAU_TEXT */
  int32_t diag_relative;    /* 1: the default is default_number times diag, the diagonal of the box of all curves */
  const char* set_by;       /* "effort" of a synonym, whose value follows that parameter until it is set itself; "" otherwise */
} carreau_parameter;

/* Give the number of parameters, and parameter `index` (from 0) in alphabetical order. Errors: ARGUMENT. */
CARREAU_API int32_t carreau_parameter_count(void);
CARREAU_API carreau_status carreau_parameter_info(int32_t index, carreau_parameter* out_parameter);

/* `effort` is the work beyond the first mesh. Its levels set five synonyms, each until it is set itself:
 *
 *     level                -1 (default)   0    1    2
 *     crossing_rounds       0             0   10   20   rounds in which triangles that cross become smaller
 *     shape_trials          0             0    1    1   changes are tried around the worst triangles
 *     certify               1             0    1    2   triangles that cross patches are bounded: none, suspects, all
 *     measure_bounds        1             0    1    2   bounds of A0 and A1 are measured: never, without patches, always
 *     measure_distances     1             0    1    1   distances from and to triangles given as input are measured
 *
 * All rounds of crossing_rounds together cost at most as much as the first mesh, or as 24 000 triangles when it has fewer; at
 * level 2 twice as much. Invalid elements cause finer meshes. These have together at most 12 times the triangles of the first
 * mesh, or 12 000 when it has fewer than 1 000; at level 0 there are none. */

/* Set a parameter for the runs to come. A real parameter takes an integer, too.
 * Errors: ARGUMENT (unknown name, for which the sentence has the nearest one; other type; out of range). */
CARREAU_API carreau_status carreau_set_integer(carreau_session* session, const char* name, int32_t value);
CARREAU_API carreau_status carreau_set_real(carreau_session* session, const char* name, double value);
CARREAU_API carreau_status carreau_set_text(carreau_session* session, const char* name, const char* value);
/* Sets a parameter from a word, as blsurf.env would ("hphydef", "1.5d-1"). Errors: ARGUMENT. */
CARREAU_API carreau_status carreau_set_word(carreau_session* session, const char* name, const char* word);
/* Sets the parameters that a blsurf.env has before its first action. No action is run. Other parameters keep their
 * values; on an error all do. Background meshes are files beside it. Errors: FILE, ARGUMENT (both with the line). */
CARREAU_API carreau_status carreau_read_env(carreau_session* session, const char* path);

/* Get the value that is set, or the default. Errors: ARGUMENT (unknown name, other type); SEQUENCE (the default is
 * relative to diag, and no mesh has been made yet). */
CARREAU_API carreau_status carreau_get_integer(carreau_session* session, const char* name, int32_t* out_value);
CARREAU_API carreau_status carreau_get_real(carreau_session* session, const char* name, double* out_value);
/* Gets a text, which lives until the next call on the session. */
CARREAU_API carreau_status carreau_get_text(carreau_session* session, const char* name, const char** out_value);

/* Set one parameter, or all, back to the default. Errors: ARGUMENT (unknown name). */
CARREAU_API carreau_status carreau_reset_parameter(carreau_session* session, const char* name);
CARREAU_API carreau_status carreau_reset_parameters(carreau_session* session);

/* ---- Messages, progress, stop ---- */

/* The levels of messages. The host gets those up to the parameter `verb`. */
enum {
  CARREAU_LEVEL_ERROR = 0,
  CARREAU_LEVEL_WARNING = 1,
  CARREAU_LEVEL_SUMMARY = 10,
  CARREAU_LEVEL_DETAIL = 50,
  CARREAU_LEVEL_DEBUG = 100
};

/* The phase of a run. */
enum {
  CARREAU_PHASE_IDLE = 0,
  CARREAU_PHASE_MODEL = 1,
  CARREAU_PHASE_CURVES = 2,
  CARREAU_PHASE_PATCHES = 3,
  CARREAU_PHASE_ASSEMBLY = 4,
  CARREAU_PHASE_WRITING = 5,
  CARREAU_PHASE_MEASURE = 6,  /* measures the delivered mesh; `fraction` is of the measure */
  CARREAU_PHASE_GRADATION = 7 /* before curves and patches, when the parameter gradation is not 0 */
};

/* Gets one sentence without a newline. The text lives until the callback returns. */
typedef void (*carreau_message_fn)(int32_t level, const char* text, void* user);
/* Gets the reference of the face or curve at work (0: none), and the fraction of the whole run, 0 to 1. The fraction
 * never falls, also when faces are left out and the rest is meshed again, and over the steps of an adaptation. Return 0, or
 * any other value to stop the run as carreau_stop does. */
typedef int32_t (*carreau_progress_fn)(int32_t phase, int32_t entity, double fraction, void* user);

/* Register a callback. NULL removes it, as in a new session. `user` is handed to it, never looked at. Errors: ARGUMENT.
 */
CARREAU_API carreau_status carreau_set_message_callback(carreau_session* session, carreau_message_fn callback,
                                                        void* user);
CARREAU_API carreau_status carreau_set_progress_callback(carreau_session* session, carreau_progress_fn callback,
                                                         void* user);

/* Requests the run under way to stop. The run ends with CARREAU_ERR_CANCELLED within 100 ms, plus the time of the
 * callback that it is in. You may call this from any callback, any thread or a signal handler. Without a run it does
 * nothing. NULL is allowed. */
CARREAU_API void carreau_stop(carreau_session* session);

/* ---- Many processes ---- */

/* Processes (ranks, from 0) can make one mesh together. This is the interface for whatever connects them; libcarreau_mpi
 * does it by MPI (carreau_mpi.h). Every rank has a session with the same geometry, model and parameters, and its callbacks. All ranks call
 * carreau_mesh_generate together, with the same values; likewise carreau_adapt, _estimate, _transfer, _transfer_files (rank 0 writes),
 * _set_background_fields, _triangles_distances, _triangles_bounds. The work is distributed, every rank gets the whole result, and it is
 * identical to the result of one process. An error of one rank ends the run of all. If the callbacks or parameters of a rank differ, the
 * run ends with CARREAU_ERR_MODEL or CARREAU_ERR_INTERNAL and a sentence that names the rank.
 *
 * A callback returns 0, CARREAU_ERR_MEMORY when some rank has not enough memory (the run ends with CARREAU_ERR_LIMIT), or
 * any other value when it has failed (CARREAU_ERR_CALLBACK). exchange must fail on all ranks or on none. */

/* Adds `count` to a number that all ranks share, and gives its previous value. */
typedef int32_t (*carreau_team_take_fn)(int64_t count, int64_t* out_before, void* user);
/* Waits until all ranks are here, and makes that number 0. Every rank gives n bytes, and gets the bytes of all:
 * out_sizes[r] bytes of rank r, one rank behind the other from *out_bytes, which stay until the next call. */
typedef int32_t (*carreau_team_exchange_fn)(int64_t n, const void* bytes, int64_t* out_sizes, const void** out_bytes,
                                            void* user);

/* The place of a rank among the others, and how it talks to them. */
typedef struct carreau_team {
  size_t struct_size;
  void* user;         /* handed to every callback; never looked at */
  int32_t rank, size; /* 0 <= rank < size */
  int32_t any_thread; /* 1: take may be called from several threads at a time; 0: from the caller's thread only */
  int32_t reserved;   /* 0 */
  carreau_team_take_fn take;         /* needed */
  carreau_team_exchange_fn exchange; /* needed */
  void (*release)(void* user);       /* called once, when the session has another team or is freed; may be NULL */
} carreau_team;

/* Makes the session part of a team, in place of an earlier one; NULL: it is alone, as at the start. Copies the struct.
 * Errors: ARGUMENT (a callback is missing, rank, size, struct_size). */
CARREAU_API carreau_status carreau_set_team(carreau_session* session, const carreau_team* team);

/* ---- Run ---- */

/* Makes the mesh of the model ("call inimesh"). On an error an earlier mesh stays, and the session can be used again.
 * Errors: SEQUENCE (no geometry, no model), ARGUMENT (parameters that contradict each other), MODEL, CALLBACK, DOMAIN,
 * LIMIT, CANCELLED, MEMORY; PARTIAL (there is a new mesh, without the faces whose status is CARREAU_FACE_FAILED). */
CARREAU_API carreau_status carreau_mesh_generate(carreau_session* session);

/* Runs all actions of a blsurf.env up to `call exit` (RT-0232 sec. 3.3). `call inimesh` reads <pref>.pardom beside the
 * env file, unless the session has a model already, from carreau_model_add_face and its like or from
 * carreau_model_read_pardom. `call export` writes beside it. Parameters have their defaults before the first action,
 * after each action, and when the call returns. When the file cannot be read they keep their values. Errors: FILE (with
 * the line), ARGUMENT (unknown names, wrong values, with the line), and the errors of carreau_mesh_generate. */
CARREAU_API carreau_status carreau_run_env(carreau_session* session, const char* path);

/* Counts and times of the last successful run. A point of a batch, or a call of any order, counts as one call of the
 * routine of the highest order requested. */
typedef struct carreau_report {
  size_t struct_size;
  double diag; /* diagonal of the box of all curves */
  int64_t surf0_calls, surf1_calls, surf2_calls;
  int64_t curv0_calls, curv1_calls, curv2_calls;
  int64_t size_calls; /* sizes and radii */
  double seconds_curves, seconds_sampling, seconds_plane, seconds_lift, seconds_total;
} carreau_report;

/* Gives the report of that run. Errors: ARGUMENT, SEQUENCE (no mesh yet). */
CARREAU_API carreau_status carreau_session_report(carreau_session* session, carreau_report* out_report);

/* ---- Interfaces: the curves of the last mesh in space ---- */

/* A curve of space and its places, the curves of faces that it is. It has one discretisation, whose vertices lie on the
 * surface of its first place. The other places may be apart from it, since curves that a model calls one, or that were
 * glued, need not agree. */
typedef struct carreau_interface {
  size_t struct_size;
  int32_t curve;      /* its reference; after gluing the reference of its first place */
  int32_t uses;       /* number of places. 1 on a boundary: open. Two in one face: a seam */
  int32_t face;       /* the first place */
  int32_t ic;         /* of the host's curve there, also where it was cut */
  int32_t other_face; /* the place that is farthest from the vertices; the first again when there is no other */
  int32_t other_ic;
  int32_t boundary;   /* 1: on the boundary of a face; 0: inside faces only */
  int32_t glued;      /* 1: places were found to be one by comparing positions */
  int32_t degenerate; /* 1: a point of space */
  int32_t loose;      /* 1: of wires alone, without a face */
  double gap; /* largest distance found between the places, model length: at the ends and at some vertices, at all where
                 it matters; of glued curves the Hausdorff distance of their polylines too. 0 when there is no other */
} carreau_interface;

/* Give the number of interfaces, and interface `index`, from 0, by first appearance. Errors: ARGUMENT, SEQUENCE (no
 * mesh yet). */
CARREAU_API carreau_status carreau_session_interface_count(carreau_session* session, int64_t* out_count);
CARREAU_API carreau_status carreau_session_interface(carreau_session* session, int64_t index,
                                                     carreau_interface* out_interface);

/* ---- Background meshes: desired sizes at the vertices of a mesh ---- */

/* The next meshes take their sizes from a background mesh, unless hphy_flag = 0. The library looks up the nearest point
 * of a surface in space, the tetrahedron that holds a point of space, or the triangle that holds (u, v) in a parameter
 * plane. Outside of it the nearest value holds, and the point is counted. Edges alone (of curves, RR-2818 sec. 4.1) hold
 * on curves and points; inside faces sizes are then interpolated from the sizes of their boundaries, as by hphy_flag = 2. Between vertices
 * sizes, or the sizes along common directions of metrics, vary by hinterpol_flag. Sizes are clamped to [hphymin, hphymax], whose defaults
 * (diag / 500, diag / 5) may be too narrow. If callbacks answer too, the smaller size, or the intersection, holds. Each of the four calls
 * copies its input and replaces the input of the others. On an error the old background mesh stays. Errors: ARGUMENT (sizes not positive,
 * metrics not positive definite, numbers not finite, no element, numbers of vertices that do not fit), FILE, SEQUENCE.
 */

/* Reads files: .mesh or .meshb (.vtu and .msh, too), and .sol or .solb with a scalar (size) or a symmetric tensor
 * (metric) at each vertex. A mesh of dimension 3 has triangles in space, tetrahedra, or edges, and a place takes the
 * value of the nearest of them. A mesh of dimension 2 lies in the parameter planes of the faces that the references of
 * its triangles name (0: any other face), and its metrics are metrics of the parameter plane. The parameters
 * background_mesh and background_sol name files, too, and take precedence over these calls. */
CARREAU_API carreau_status carreau_set_background_mesh(carreau_session* session, const char* mesh_path,
                                                       const char* sol_path);

/* A background mesh in arrays of the caller. */
typedef struct carreau_background {
  size_t struct_size;
  int32_t dimension; /* 3: in space; 2: in parameter planes */
  int32_t reserved;
  int64_t vertex_count, triangle_count;
  const double* vertices;   /* vertex_count x dimension */
  const int32_t* triangles; /* triangle_count x 3; NULL when that is 0 */
  const int32_t* faces;     /* triangle_count, dimension 2: reference of the face; 0, or NULL: any other face */
  const double* sizes;      /* vertex_count, model lengths; or NULL */
  const double* metrics;    /* vertex_count x 6 (xx xy xz yy yz zz), dimension 2: x 3 (uu uv vv); or NULL */
  int64_t tetrahedron_count, edge_count;
  const int32_t* tetrahedra; /* tetrahedron_count x 4, dimension 3; NULL when that is 0 */
  const int32_t* edges;      /* edge_count x 2; NULL when that is 0 */
} carreau_background;
/* Takes arrays in place of files. */
CARREAU_API carreau_status carreau_set_background(carreau_session* session, const carreau_background* background);

/* Set n sizes, or n metrics (n x 6), at the n vertices of the session's own mesh; of elements of second order at all nodes,
 * or at their corners, which come first. Each face is looked up in its own parameter plane. */
CARREAU_API carreau_status carreau_set_vertex_sizes(carreau_session* session, int64_t n, const double sizes[]);
CARREAU_API carreau_status carreau_set_vertex_metrics(carreau_session* session, int64_t n, const double metrics[]);

/* Removes the background mesh. */
CARREAU_API carreau_status carreau_clear_background(carreau_session* session);

/* Reads sizes or metrics at the n vertices of a mesh from a .sol, .solb or BL2D's .h as metrics of space (n x 6, xx xy xz
 * yy yz zz; of dimension 2 with the smaller size across). Errors: ARGUMENT (capacity), FILE. */
CARREAU_API carreau_status carreau_mesh_read_metrics(carreau_mesh* mesh, const char* sol_path, int64_t capacity,
                                                     double out_metrics[]);

/* How the last mesh has used its background mesh. All members are zero when there was none. */
typedef struct carreau_background_report {
  size_t struct_size;
  int64_t asked;   /* points looked up */
  int64_t outside; /* of them farther away than 1/8 of the longest edge of the nearest element */
  double farthest; /* distance of the farthest one; model length, or parameter length */
  double estimated_error; /* of the fields of carreau_set_background_fields on the background mesh, in the unit of the tolerance */
  double tolerance;       /* of the estimate; 0: there was none. A loop ends when estimated_error is below it */
} carreau_background_report;
/* Gives the report on the background of the last mesh. Errors: ARGUMENT, SEQUENCE (no mesh yet). */
CARREAU_API carreau_status carreau_session_background(carreau_session* session, carreau_background_report* out_report);

/* ---- Attractors: sizes near points, edges and triangles ---- */

/* Adds small sizes near things of space to the next meshes, unless hphy_flag = 0: `size` on the elements, and a size that
 * grows linearly with the distance to `surrounding` at the distance `reach`. Farther away the attractor gives no size.
 * If several attractors, a background mesh or callbacks give sizes, the smallest one counts. All are model lengths.
 * vertices: vertex_count x 3. elements: element_count x 3 indices of vertices from 0: a triangle; an edge (a, b, b); a
 * point (a, a, a). The call copies them. Errors: ARGUMENT (a length that is not positive, surrounding below size, numbers
 * not finite, no element, an index out of range), SEQUENCE. */
CARREAU_API carreau_status carreau_add_attractor(carreau_session* session, int64_t vertex_count, const double vertices[],
                                                 int64_t element_count, const int32_t elements[], double size,
                                                 double surrounding, double reach);

/* Removes all attractors. Errors: BUSY. */
CARREAU_API carreau_status carreau_clear_attractors(carreau_session* session);

/* ---- Layers: rows of cells along curves ---- */

/* Lets rows of cells grow from curves into their faces in the next meshes: the first row is `first` high (model length),
 * each other row `ratio` (1 to 10) times as high as the row below. There are `count` rows, fewer where they would be
 * higher than the edges of the curve are long, or would meet other rows or boundaries. Corners beyond 240 degrees get a
 * fan of cells, corners below 60 degrees none. Curves inside a face have rows on both sides. Halves of the cells are triangles of
 * p1 and p2; q1.1 and q2.1 make an even number of rows. curves: curve_count references; the call copies them.
 * Errors: ARGUMENT (no curve, numbers out of range), SEQUENCE. carreau_mesh_generate returns ARGUMENT for a reference that
 * no face has, and for a curve with two sets of layers. */
CARREAU_API carreau_status carreau_add_layers(carreau_session* session, int64_t curve_count, const int32_t curves[],
                                              double first, double ratio, int32_t count);

/* Removes all layers. Errors: BUSY. */
CARREAU_API carreau_status carreau_clear_layers(carreau_session* session);

/* One set of layers of the last mesh. The height of a cell is its area over the mean of its two edges along the row; the
 * growth is its height over the height of the cell below. Fans at corners count for cells and rows only. */
typedef struct carreau_layers_report {
  size_t struct_size;
  int64_t cells;                              /* in all faces */
  int32_t rows, fewest_rows;                  /* above an edge of a curve: largest and smallest number; 0: an edge has none */
  double first_min, first_mean, first_max;    /* heights of cells in the first row, model length; times u_tau / nu: y+ */
  double growth_min, growth_mean, growth_max; /* 0 if there is one row */
} carreau_layers_report;
/* Gives the report on the set `index`, from 0 in the order of carreau_add_layers. Errors: ARGUMENT (index), SEQUENCE (no
 * mesh yet). */
CARREAU_API carreau_status carreau_session_layers(carreau_session* session, int64_t index, carreau_layers_report* out_report);

/* ---- Adaptation: from a field to a mesh that carries it (HDR sec. 3.4.3, 4.8) ---- */

/* The source of the error estimate: the interpolation error, by second derivatives; the angles between edges and the
 * graph's tangent planes; the distance from the graph's tangent planes. The graph is the graph of the field. */
enum { CARREAU_HESSIAN = 0, CARREAU_CURVATURE = 1, CARREAU_DEFORMATION = 2 };
/* The prescription: a size; circles in the tangent planes of the graph; or sizes by both principal values. */
enum { CARREAU_ISOTROPIC = 0, CARREAU_GRAPH = 1, CARREAU_ANISOTROPIC = 2 };
/* How derivatives are found from values at vertices: quadratics that fit the neighbours of each vertex; or the gradients
 * of triangles averaged at vertices, twice (double L2 projection), which is smoother, and biased at boundaries; or the mean normals and
 * centred quadrics of the graph (HDR sec. 3.4.3 a.2). */
enum { CARREAU_FIT = 0, CARREAU_PROJECTION = 1, CARREAU_QUADRIC = 2 };

/* How sizes are found from a field. Zeros in all members but struct_size are the defaults. */
typedef struct carreau_estimator {
  size_t struct_size;
  int32_t source, shape; /* as above; GRAPH not with HESSIAN, and GRAPH, CURVATURE, DEFORMATION in the plane z = 0 */
  int32_t relative;      /* 1: the tolerance is a share of the field's absolute value */
  int32_t recovery;      /* how derivatives are found; CARREAU_PROJECTION and CARREAU_QUADRIC are for plane meshes */
  double tolerance;      /* error in units of the field, or share; CURVATURE: degrees. 0: 0.01 */
  double relative_floor; /* below this share of its largest absolute value the field counts as that share. 0: 0.1 */
  double hmin, hmax;     /* bounds of the sizes, CURVATURE and DEFORMATION: in the tangent plane of the graph.
                            0: hphymin, hphymax */
  double ratio;          /* largest ratio of the two sizes of a metric. 0: 1000 */
} carreau_estimator;

/* Finds sizes or metrics at the n vertices of the session's mesh from the values of a field there. Give them back to
 * carreau_set_vertex_sizes or carreau_set_vertex_metrics. With ISOTROPIC, out_sizes (n) or out_metrics (n x 6) may be
 * NULL. Otherwise out_metrics is needed, and out_sizes is the smallest size of each. On fronts much steeper than long, set
 * the parameter gradation (for instance to 2): sizes that jump between neighbours hide the bends of a front from the fit of
 * its values. On elements of second order n is the number of all nodes, or of corners alone. Sizes are always sizes for
 * straight elements, so that quadratic elements carry the field with a smaller error. Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_estimate(carreau_session* session, const carreau_estimator* estimator, int64_t n,
                                            const double values[], double out_sizes[], double out_metrics[]);

/* Interpolates a field from the n vertices of the session's previous mesh to the vertices of its current mesh. `values`
 * has `components` values a vertex (n x components), and out_values has room for `capacity` such rows. Elements of second
 * order carry values at all their nodes, corners first, by their shape functions, and out_values gets the values at all
 * nodes of the new mesh. With n the number of corners alone, both are at corners, and the field is linear. *out_outside,
 * which may be NULL, counts the vertices beside the old mesh; they take the nearest value. Errors: ARGUMENT, SEQUENCE (fewer
 * than two meshes made). */
CARREAU_API carreau_status carreau_transfer(carreau_session* session, int32_t components, int64_t n,
                                            const double values[], int64_t capacity, double out_values[],
                                            int64_t* out_outside);

/* The loop by files: fields at the vertices of the last mesh, the next mesh, the fields on it. `carreau adapt` is made
 * of these two. The first sets a background mesh (see carreau_set_background_mesh) from a .sol or .solb with any number
 * of scalars and vectors at the vertices of a mesh. Each scalar and each component is estimated by the parameters
 * adapt_*, and the smallest size, or the intersection of the metrics, holds. A file of one symmetric tensor holds
 * metrics. It comes after the model. The second writes fields of any types, as they are at the vertices of the
 * session's mesh, to a .sol or .solb; of a plane domain it has dimension 2. *out_outside, which may be NULL, counts the
 * vertices beside the old mesh; they take the nearest values. Errors: ARGUMENT, FILE (with the line), SEQUENCE (no mesh
 * yet). */
CARREAU_API carreau_status carreau_set_background_fields(carreau_session* session, const char* mesh_path,
                                                         const char* sol_path);
CARREAU_API carreau_status carreau_transfer_files(carreau_session* session, const char* mesh_path, const char* sol_path,
                                                  const char* out_path, int64_t* out_outside);

/* Gives the field at n points of space; xyz is n x 3. Returns 0, or any other value to report a failure. */
typedef int32_t (*carreau_field_fn)(int64_t n, const double* xyz, double* values, void* user);

/* A loop of adaptation. */
typedef struct carreau_adaptation {
  size_t struct_size;
  const carreau_estimator* estimator;
  carreau_field_fn field;
  void* user;          /* handed to field */
  int32_t iterations;  /* at most; 0: 5. The first mesh whose estimated error is within the tolerance ends the loop */
  int32_t differences; /* 1: derivatives of the field itself, by differences (plane z = 0 only); 0: from values at the
                          vertices alone, as carreau_estimate does, best with a gradation of 2 */
  double convergence;  /* ends when the number of triangles changes by a smaller share; 0: makes all iterations */
} carreau_adaptation;

/* The outcome of a loop. An error of the field is its distance from its interpolation on the mesh: linear, or, on elements of
 * second order, by their shape functions; vertices are all nodes then. */
typedef struct carreau_adaptation_report {
  size_t struct_size;
  int32_t iterations; /* meshes made, without the one that it started with */
  int32_t converged;  /* 1: ended by `convergence` */
  int64_t vertices, triangles;
  int64_t triangles_before;
  double error_max, error_rms;               /* on the session's mesh, as vertices, triangles and the next ones */
  double error_max_before, error_rms_before; /* on the mesh that it started with */
  double size_min;                           /* smallest size that was prescribed for it */
  double stretch_max;                        /* largest ratio of two sizes of one metric */
  int64_t outside;                           /* points outside of its background mesh */
  int32_t best;                              /* the iteration that made it, from 1: the one with the smallest estimate */
  int32_t within;                            /* 1: its estimated error is not above the tolerance */
  double tolerance;                          /* of the estimator */
  double estimated_error; /* in the unit of the tolerance. HESSIAN: error_max, or the largest share of the field's value. CURVATURE,
                             DEFORMATION: largest angle or distance between an edge of the graph and the tangent plane at its end */
} carreau_adaptation_report;

/* Adapts the mesh in a loop: it estimates, sets new sizes on the mesh, and meshes again. It starts with the session's
 * mesh, or makes one by the parameters. To look at each mesh, set iterations = 1 and call it again. In the end the
 * session has the mesh with the smallest estimated error (HDR sec. 1.2), and no background mesh. hphymin and hphymax, unless they are set, are the bounds of the
 * estimator. out_report may be NULL. Errors: as carreau_mesh_generate; the session then has the last mesh that was
 * made. */
CARREAU_API carreau_status carreau_adapt(carreau_session* session, const carreau_adaptation* adaptation,
                                         carreau_adaptation_report* out_report);

/* ---- Meshes ---- */

/* Gives the mesh of a session. The handle belongs to the session, and always shows its latest mesh. It lives until
 * carreau_session_free; carreau_mesh_free leaves it alone. Errors: ARGUMENT, SEQUENCE (no mesh yet). */
CARREAU_API carreau_status carreau_session_mesh(carreau_session* session, carreau_mesh** out_mesh);

/* Creates an empty mesh. Fill it by carreau_mesh_read, and free it by carreau_mesh_free. Errors: ARGUMENT, MEMORY. */
CARREAU_API carreau_status carreau_mesh_create(carreau_mesh** out_mesh);
CARREAU_API void carreau_mesh_free(carreau_mesh* mesh); /* Frees it. NULL is allowed */

/* Returns the sentence of the last call on the mesh, "" after success. It lives until the next call on the mesh. */
CARREAU_API const char* carreau_mesh_last_error(const carreau_mesh* mesh);

/* Replaces the content by the content of a file. The suffix determines the format: .mesh, .meshb (Medit), .vtu (VTK, also
 * compressed by zlib), .stl (text or binary; equal points become one vertex), .msh, .msh2 (Gmsh 4.1 and 2.2, ASCII and
 * binary), .inp (Abaqus, CalculiX), .bdf (Nastran), .unv (I-DEAS), .su2, .off (text), .obj, .ply (text and binary), whose
 * polygons become triangles, .vtk (VTK's legacy format, text and binary), .tri (Cart3D). Without a surface the outer
 * faces of solids are read. It restores meshes of carreau_mesh_write: points, exactly except in binary .stl, and the references and
 * names that the format holds. Elements of order 3 and 4 of .msh, .msh2, .vtu (Lagrange cells) and .mesh (MFEM, as carreau_raised_write has
 * it) are kept: the arrays have elements of order 2 through the middles of their edges. A .vtu holds all of them, with status and colour of faces; a .msh the references of faces and
 * curves, and of corners if positive; a .stl has solids as faces. On an error the old content stays.
 * Errors: FILE; ARGUMENT (suffix, mesh of a session). */
CARREAU_API carreau_status carreau_mesh_read(carreau_mesh* mesh, const char* path);

/* A mesh in arrays of the caller, to be checked, measured, written to any format. (To take sizes from it, give the
 * arrays to carreau_set_background.) Arrays may be NULL where their comment allows it. */
typedef struct carreau_mesh_arrays {
  size_t struct_size;
  int32_t dimension; /* 3; 2: of the plane z = 0 */
  int32_t reserved;  /* 0 */
  int64_t vertex_count, triangle_count, edge_count;
  const double* vertices;       /* vertex_count x dimension, model length */
  const int32_t* triangles;     /* triangle_count x 3 vertices, from 0 */
  const int32_t* edges;         /* edge_count x 2 vertices, from 0, of curves; NULL when edge_count is 0 */
  const int32_t* vertex_refs;   /* vertex_count; NULL: all 0 */
  const int32_t* triangle_refs; /* triangle_count, references of faces; NULL: all 1 */
  const int32_t* edge_refs;     /* edge_count, references of curves; NULL: all 0 */
  const double* corner_uv;      /* triangle_count x 3 x 2; NULL: carreau_mesh_corner_uv has none */
} carreau_mesh_arrays;

/* Replaces the content of a mesh that carreau_mesh_create has made by a copy of arrays. On an error the old content
 * stays. Errors: ARGUMENT (an index out of range, with the triangle or edge; a coordinate that is not finite; no vertex
 * or no triangle; mesh of a session). carreau_mesh_defects reports all other faults. */
CARREAU_API carreau_status carreau_mesh_from_arrays(carreau_mesh* mesh, const carreau_mesh_arrays* arrays);

/* Writes the mesh to a file. The suffix chooses the format: .mesh, .meshb (Medit), .vtu (VTK), .stl (a solid a face),
 * .msh and .msh2 (Gmsh 4.1 and 2.2, with physical names), .inp (Abaqus, CalculiX), .bdf (Nastran), .unv (I-DEAS), .su2,
 * with named sets; .off, .obj, .ply, .vtk, .tri. Surfaces for programs that fill solids, which are not read: .smesh, .poly (TetGen), .vol
 * (Netgen), .geo (a script of Gmsh for the .msh file of the same name). Elements of order 2 are an error in .su2, .off, .obj, .ply and .tri. The parameters
 * option, refs and flag choose how the mesh of a session is written (RT-0232 sec. 4); association = 1 adds the places of nodes on the geometry
 * to .mesh, .meshb, .vtu, .msh and .msh2. onesurf2d of a face that has failed gives its curves
 * in the parameter plane. .exr gets the fields of a session, as by carreau_write_exr with multi_part. A mesh from a file has binary .stl.
 * The file is complete, or as it was before. Errors: FILE; ARGUMENT (suffix, refs). */
CARREAU_API carreau_status carreau_mesh_write(carreau_mesh* mesh, const char* path);

/* Gets n bytes of a file from `position` on. Returns 0, or any other value to end the call. */
typedef int32_t (*carreau_bytes_fn)(int64_t position, int64_t n, const void* bytes, void* user);
/* Gives the bytes that carreau_mesh_write would write to a file with this suffix (".meshb"), in ascending positions, to
 * `sink`: for files that the host writes itself. Not ".exr". A part (carreau_mesh_generate_part) has ".meshb" alone: the bytes of
 * this process in the file of the whole mesh. Each byte of that file belongs to one process. Errors: ARGUMENT (suffix, refs);
 * CALLBACK (the result of sink). */
CARREAU_API carreau_status carreau_mesh_encode(carreau_mesh* mesh, const char* suffix, carreau_bytes_fn sink, void* user);

/* ---- Meshes in parts ---- */

/* Runs carreau_mesh_generate by the processes of the session's team (carreau_set_team), each of which keeps its part. The parts together
 * are identical to the mesh of one process. `part` (carreau_mesh_create) becomes the part of this process: the triangles of the faces that
 * it has meshed and, behind them, ghosts. Ghosts are elements of other processes that touch them in a vertex. Vertices that this process
 * owns come first. The faces of the part are the faces of the whole mesh. carreau_mesh_encode writes the bytes of this process in the
 * ".meshb" of the whole mesh; other functions treat the part as a complete mesh. No process has the whole mesh, and the mesh of the session
 * does not change. Exceptions: gradation, elements other than p1, patches=independent, periodic faces, cracks, faces that
 * narrow_faces=collapse lets vanish, measure, and surfaces given as triangles work on the whole mesh. The session then has it, as after
 * carreau_mesh_generate, and the part has a share of consecutive elements.
 * Errors: as carreau_mesh_generate, on all processes; carreau_last_error has the sentence. ARGUMENT (no team; part is NULL or a
 * session's). */
CARREAU_API carreau_status carreau_mesh_generate_part(carreau_session* session, carreau_mesh* part);

/* Numbers of a mesh in parts. */
typedef struct carreau_part_counts {
  size_t struct_size;
  int32_t rank, size;                     /* of the process and of the team */
  int64_t own_vertices, own_triangles;    /* the first ones of the part */
  int64_t all_vertices, all_triangles;    /* of the whole mesh */
  int64_t all_edges;                      /* on curves */
  int64_t crossings;                      /* pairs of triangles of the whole mesh that cross; -1: they were not looked for */
} carreau_part_counts;
/* Gives the counts of a part. Errors: ARGUMENT (out_counts, struct_size), SEQUENCE (the mesh is no part). */
CARREAU_API carreau_status carreau_mesh_part_count(carreau_mesh* part, carreau_part_counts* out_counts);
/* Copy results into arrays with room for `capacity` rows, one for each vertex or triangle of the part (carreau_mesh_count). Any array may
 * be NULL. Errors: ARGUMENT (capacity), SEQUENCE (the mesh is no part).
 *   numbers   in the whole mesh, from 0: ascending for owned vertices, then for ghosts
 *   owners    ranks; for a vertex on curves the lowest rank that keeps a face of one of its curves
 *   rows      numbers of the same vertices, consecutive on each rank */
CARREAU_API carreau_status carreau_mesh_part_vertices(carreau_mesh* part, int64_t capacity, int64_t out_numbers[], int32_t out_owners[],
                                                      int64_t out_rows[]);
CARREAU_API carreau_status carreau_mesh_part_triangles(carreau_mesh* part, int64_t capacity, int64_t out_numbers[],
                                                       int32_t out_owners[]);

/* Counts vertices (n), triangles (m), edges of curves (k), and faces (f). Any pointer but mesh may be NULL. Errors:
 * ARGUMENT, SEQUENCE (no mesh). */
CARREAU_API carreau_status carreau_mesh_count(carreau_mesh* mesh, int64_t* out_vertices, int64_t* out_triangles,
                                              int64_t* out_edges, int64_t* out_faces);
/* Gives the order of the elements: 1, 2, or, of a file, 3 or 4. carreau_mesh_write keeps orders 3 and 4 in the formats that have them; other
 * formats are errors. Errors as above. */
CARREAU_API carreau_status carreau_mesh_order(carreau_mesh* mesh, int32_t* out_order);
/* Gives the dimension: 3, or 2 when the mesh was read from a plane mesh. Errors as above. */
CARREAU_API carreau_status carreau_mesh_dimension(carreau_mesh* mesh, int32_t* out_dimension);

/* Copy results into arrays of the caller, which have room for `capacity` rows (n, m or k).
 * Errors: ARGUMENT (NULL, capacity too small), SEQUENCE (no mesh; data that a mesh from a file does not have).
 *   vertices        n x 3      x y z, model length
 *   vertex_refs     n          reference of the corner or imposed point, 0: made by the mesher
 *   vertex_sizes    n          prescribed size, model length; mesh of a session only
 *   triangles       m x 3      vertices, counterclockwise in (u, v); face by face in the order of the model
 *   triangle_refs   m          reference of the face
 *   corner_uv       m x 3 x 2  u v of each corner in the face of the triangle, or, in a cross-patch mesh (parameter
 *                              patches), in the face of corner_faces; mesh of a session, or of arrays with it
 *   corner_faces    m x 3      reference of the face of corner_uv; mesh of a session only
 *   edges           k x 2      vertices, along each curve from its first end to its second
 *   edge_refs       k          reference of the curve */
CARREAU_API carreau_status carreau_mesh_vertices(carreau_mesh* mesh, int64_t capacity, double out_xyz[]);
CARREAU_API carreau_status carreau_mesh_vertex_refs(carreau_mesh* mesh, int64_t capacity, int32_t out_refs[]);
CARREAU_API carreau_status carreau_mesh_vertex_sizes(carreau_mesh* mesh, int64_t capacity, double out_sizes[]);
CARREAU_API carreau_status carreau_mesh_triangles(carreau_mesh* mesh, int64_t capacity, int32_t out_vertices[]);
CARREAU_API carreau_status carreau_mesh_triangle_refs(carreau_mesh* mesh, int64_t capacity, int32_t out_refs[]);
CARREAU_API carreau_status carreau_mesh_corner_uv(carreau_mesh* mesh, int64_t capacity, double out_uv[]);
CARREAU_API carreau_status carreau_mesh_corner_faces(carreau_mesh* mesh, int64_t capacity, int32_t out_refs[]);
CARREAU_API carreau_status carreau_mesh_edges(carreau_mesh* mesh, int64_t capacity, int32_t out_vertices[]);
CARREAU_API carreau_status carreau_mesh_edge_refs(carreau_mesh* mesh, int64_t capacity, int32_t out_refs[]);

/* Elements (parameter element): kinds, the number of nodes of each, and their order. The order agrees with VTK's cells
 * 5, 22, 9, 23 and Gmsh's elements 2, 9, 3, 16: corners counterclockwise, then the nodes of the edges 01, 12, 20, or 01,
 * 12, 23, 30. A mesh of p1 has elements of the first kind, which are its triangles. For other meshes
 * carreau_mesh_triangles gives straight triangles between the same corners, two for a quadrilateral.
 * carreau_mesh_vertices gives all nodes: corners first, then nodes on edges, whose reference is 0. */
enum {
  CARREAU_CELL_TRIANGLE3 = 1, /* 3 nodes: straight triangle */
  CARREAU_CELL_TRIANGLE6 = 2, /* 6: P2 */
  CARREAU_CELL_QUAD4 = 3,     /* 4: Q1 */
  CARREAU_CELL_QUAD8 = 4      /* 8: Q2, no node inside */
};

/* The number of elements of a kind; it may be 0. Errors: ARGUMENT (no such kind), SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_cell_count(carreau_mesh* mesh, int32_t kind, int64_t* out_count);
/* The elements of a kind, face by face: rows of their nodes (vertices from 0), and, unless NULL, the references of their
 * faces. Errors as above, and ARGUMENT for a capacity (rows) that is too small. */
CARREAU_API carreau_status carreau_mesh_cells(carreau_mesh* mesh, int32_t kind, int64_t capacity, int32_t out_nodes[],
                                              int32_t out_refs[]);
/* Gives u v of each node of each element of a kind in its face, in the order of the elements. In a cross-patch mesh
 * (parameter patches) the face is in carreau_mesh_cell_faces. Mesh of a session only. Errors as above. */
CARREAU_API carreau_status carreau_mesh_cell_uv(carreau_mesh* mesh, int32_t kind, int64_t capacity, double out_uv[]);
/* For each node of each element of a kind the reference of the face that carreau_mesh_cell_uv is of, in the same order;
 * mesh of a session only. Errors as above. */
CARREAU_API carreau_status carreau_mesh_cell_faces(carreau_mesh* mesh, int32_t kind, int64_t capacity,
                                                   int32_t out_refs[]);
/* For each edge of carreau_mesh_edges the node between its ends; -1: the edge is straight. Errors as there. */
CARREAU_API carreau_status carreau_mesh_edge_mids(carreau_mesh* mesh, int64_t capacity, int32_t out_vertices[]);

/* The quality of the elements. shape is sigma of the regular polygon over sigma = diameter / least inradius of two sides
 * that meet (HDR sec. 1.1.1). scaled_jacobian is the least sine of an element's angles over the sine of the regular
 * polygon's angle. Both are 1 for a square and an equilateral triangle. least_jacobian is the least Bernstein
 * coefficient of the Jacobian over its mean: 1 for triangles of p1, positive for a valid element. If elements have order 3 or 4
 * (carreau_mesh_order), this figure, the number of invalid elements and the area are measured on them, and other figures on their elements of
 * order 2. */
typedef struct carreau_cell_quality {
  size_t struct_size;
  int64_t triangles3, triangles6, quads4, quads8; /* elements by kind */
  int64_t invalid;                                /* whose least Jacobian is not positive */
  double shape_mean, shape_min;
  double scaled_jacobian_mean, scaled_jacobian_min;
  double least_jacobian_mean, least_jacobian_min;
  double angle_min, angle_max; /* degrees, between tangents of curved sides */
  double area;                 /* of the curved elements */
  double triangle_share;       /* share of the area of triangles */
} carreau_cell_quality;

/* Measures the elements. Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_cell_quality(carreau_mesh* mesh, carreau_cell_quality* out_quality);

/* The status of a face. A `mended` face is meshed, but something was repaired, or triangles are turned over; `why`
 * holds the reason. A `failed` face has no triangles. A `collapsed` face has vanished between its neighbours: it is
 * narrow (parameter narrow_faces), and they share one curve in its place, or its borders mean nothing (parameter
 * patches). */
enum {
  CARREAU_FACE_NOT_MESHED = 0,
  CARREAU_FACE_MESHED = 1,
  CARREAU_FACE_MENDED = 2,
  CARREAU_FACE_FAILED = 3,
  CARREAU_FACE_COLLAPSED = 4
};

/* The result of meshing a face. */
typedef struct carreau_face {
  size_t struct_size;
  int32_t ref;       /* reference of the face */
  int32_t status;    /* CARREAU_FACE_... */
  int64_t triangles; /* their number; they follow the triangles of the previous face. For a face of parts
                        (carreau_model_part_of_face) the sum; the face has failed when one part has */
  const char* why; /* sentence for `mended`, `failed` and `collapsed`, else ""; lives until the next call on the mesh */
  const char* name; /* given by carreau_model_name_face, else ""; lives as `why` does */
  int32_t rgb;      /* given by carreau_model_color_face, 0xRRGGBB, or -1 */
} carreau_face;

/* Describes face `index`, from 0. The faces of a mesh from a file are its triangle references, ascending, and other faces that the
 * file describes. Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_face(carreau_mesh* mesh, int64_t index, carreau_face* out_face);

/* Counts the pairs of entities that periodicities carry onto each other, and their pairs of nodes. Errors: ARGUMENT. */
CARREAU_API carreau_status carreau_mesh_periodic_count(carreau_mesh* mesh, int64_t* out_pairs, int64_t* out_nodes);
/* Gets the pairs: corners first, then curves, then faces. Each pair has its dimension (0, 1, 2), its references {slave, master}, the map of the
 * master onto the slave (3 x 4, row by row) and the number of its pairs of nodes. The nodes {slave, master} (indices from 0) of all pairs
 * follow each other, ascending in each pair, with nodes of second order. A closed curve that is carried onto itself is a pair with itself, with
 * the images of its first arc. Arrays may be NULL and have room for the counts above. Errors: ARGUMENT
 * (room too small). */
CARREAU_API carreau_status carreau_mesh_periodic(carreau_mesh* mesh, int64_t capacity, int64_t node_capacity, int32_t out_dimensions[],
                                                 int32_t out_refs[], double out_transforms[], int64_t out_counts[], int32_t out_nodes[]);

/* Gets the solids on both sides of a face by its reference (carreau_model_set_face_sides); 0: none. Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_face_sides(carreau_mesh* mesh, int32_t face_ref, int32_t out_solids[2]);
/* Returns the name that carreau_model_name_entities gave to points (dimension 0), curves (1), a face (2) or a solid (3); "": none, or no
 * such entity. It lives until the next call on the mesh. NULL: no mesh. */
CARREAU_API const char* carreau_mesh_entity_name(carreau_mesh* mesh, int32_t dimension, int32_t ref);

/* The shapes and sizes of the triangles. Both q1 = 2 sqrt(3) inradius / longest edge (HDR eq. 1.5) and q2 = 4 sqrt(3)
 * area / sum of squared edges (HDR eq. 1.6) are 1 for an equilateral triangle. p1 is the first percentile. */
typedef struct carreau_quality {
  size_t struct_size;
  int64_t vertices, triangles, edges; /* all edges of triangles */
  int64_t open_edges;                 /* edges of one triangle only */
  double q1_mean, q1_min, q1_p1, q1_max;
  double q2_mean, q2_min, q2_p1, q2_max;
  double angle_min, angle_max; /* degrees */
  double area;
  double edge_min, edge_mean, edge_max; /* lengths */
  double degree6;                       /* share of interior vertices with six edges */
} carreau_quality;

/* Measures the triangles. Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_quality(carreau_mesh* mesh, carreau_quality* out_quality);
/* Gives the quality of the whole mesh to which a part belongs, as all processes have measured it together: sums are rounded otherwise
 * than in one process. Errors: ARGUMENT, SEQUENCE (the mesh is no part). */
CARREAU_API carreau_status carreau_mesh_part_quality(carreau_mesh* part, carreau_quality* out_quality);

/* Looks for defects that make a mesh unusable: indices out of range, numbers that are not finite, triangles without
 * area or duplicates, vertices without a triangle, edges of more than two triangles away from curves, and curves that
 * are not in their faces. With closed = 1 an edge with one triangle is a defect too. *out_count is the number of
 * defects found, at most `limit` (> 0). *out_text has one sentence a line, and lives until the next call on the mesh.
 * Finding defects is CARREAU_OK.
 * Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_defects(carreau_mesh* mesh, int32_t closed, int64_t limit, int64_t* out_count,
                                                const char** out_text);

/* Looks for pairs of triangles that cross: with a point in common that is on no vertex and no edge of both. Decided
 * exactly. Vertices at one place count as one; triangles without area are passed over. threads: at work, 0: all
 * processors; the result does not depend on it. *out_count: all such pairs. For the first `capacity` pairs, ascending,
 * out_triangles has the indices of both triangles (rows of 2) and out_xyz a place (rows of 3); both may be NULL. A
 * capacity below *out_count is no error. Finding pairs is CARREAU_OK. Errors: ARGUMENT, SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_intersections(carreau_mesh* mesh, int32_t threads, int64_t capacity,
                                                      int64_t* out_count, int32_t out_triangles[], double out_xyz[]);

/* Finds the connected regions of space that the mesh bounds, for programs that fill them with solid elements: solids in ascending order,
 * then holes, which no solid fills. *out_count: all of them. out_solids gets the numbers of the solids of the first `capacity` regions, 0: a
 * hole, and out_xyz a point inside each (rows of 3, model length); both may be NULL. A capacity below *out_count is no error. Solids are those of
 * carreau_model_set_face_sides; a mesh without them has a solid for each region that its triangles look out of. Each point lies halfway
 * between two triangles on a ray, and its winding number is 1. Errors: ARGUMENT (NULL; the surface is open, or its solids contradict
 * each other, with the place), SEQUENCE. */
CARREAU_API carreau_status carreau_mesh_regions(carreau_mesh* mesh, int64_t capacity, int64_t* out_count, int32_t out_solids[],
                                                double out_xyz[]);
/* Copies the solids on both sides of each triangle (m x 2) as carreau_mesh_regions has them: the solid that the triangle looks out of, and
 * the solid on the other side; 0: none. Errors as there, and ARGUMENT for a capacity below m. */
CARREAU_API carreau_status carreau_mesh_triangle_sides(carreau_mesh* mesh, int64_t capacity, int32_t out_solids[]);

/* ---- Fields as images (OpenEXR) ---- */

/* The groups of channels. They are 32-bit reals unless another type is given.
 *   SIZE        size.h                       prescribed size: sqrt(h1 h2); model length
 *               size.h1 size.h2 size.angle   sizes along the axes of the prescribed metric, h1 <= h2, and the
 *                                            direction of h1 in the tangent plane, from Su to Sv; degrees, 0 to 180
 *   INDUCED     induced.e .f .g              Su.Su, Su.Sv, Sv.Sv
 *   TARGET      target.m11 .m12 .m22         metric of the parameter plane that the mesher used, as its control space
 *                                            holds it; 1 / parameter^2
 *   CURVATURE   curvature.k1 .k2             principal curvatures, k1 >= k2; 1 / model length; positive where the
 *                                            surface bends towards the normal
 *   POSITION    position.x .y .z             model length
 *   NORMAL      normal.x .y .z               unit, along Su x Sv
 *   DEVIATION   deviation.a0 .a1             of the pixel's triangle: largest distance from the surface (model length)
 *                                            and largest angle with its normals (degrees), at sample points
 *   TRIANGLE    triangle                     unsigned integer: index of the pixel's triangle in the mesh of the
 *                                            session, from 0; 4294967295: none
 *   MASK        mask                         1 in the domain, 0 outside
 *   PREVIEW     R G B A                      16-bit reals of linear light: size in false colours, from red, the
 *                                            smallest of the face, to blue, the largest, on a logarithmic scale;
 *                                            sides of triangles and curves dark; purple: there is no size
 *   GOVERNS     physical.h .h1 .h2 .angle    the physical size by itself, within its bounds; as size.h ... size.angle
 *               geometric.h .h1 .h2 .angle   the geometric one; NaN where it is ignored (hgeo_flag = 0), as is the
 *                                            physical one by hphy_flag = 0
 *               governs                      unsigned integer: CARREAU_GOVERNS_...; 4294967295: not known
 * A pixel stands for the point of the parameter plane at its centre. Unknown values are NaN: outside the domain all but
 * the mask and the preview, and inside it the values that the host fails to give. */
enum {
  CARREAU_EXR_SIZE = 1,
  CARREAU_EXR_INDUCED = 2,
  CARREAU_EXR_TARGET = 4,
  CARREAU_EXR_CURVATURE = 8,
  CARREAU_EXR_POSITION = 16,
  CARREAU_EXR_NORMAL = 32,
  CARREAU_EXR_DEVIATION = 64,
  CARREAU_EXR_TRIANGLE = 128,
  CARREAU_EXR_MASK = 256,
  CARREAU_EXR_PREVIEW = 512,
  CARREAU_EXR_GOVERNS = 1024
};
/* The origin of the smallest size at a place: the physical size; the geometric size; the smaller of both, moved by
 * hphymin, hphymax, hgeomin or hgeomax; or the gradation, from a neighbouring place. */
enum {
  CARREAU_GOVERNS_PHYSICAL = 0,
  CARREAU_GOVERNS_GEOMETRIC = 1,
  CARREAU_GOVERNS_BOUNDS = 2,
  CARREAU_GOVERNS_GRADATION = 3
};
/* Both compress without loss. */
enum { CARREAU_EXR_ZIP = 0, CARREAU_EXR_PIZ = 1 };

/* Which images are written, and how. Zeros in all members but struct_size are the defaults. */
typedef struct carreau_exr_options {
  size_t struct_size;
  int32_t longest; /* pixels of the longer side, up to 65536; the shorter one follows the patch in space; 0: 1024 */
  int32_t width;   /* with height, both > 0: pixels of every image, in place of longest */
  int32_t height;
  int32_t channels;    /* sum of CARREAU_EXR_...; 0: all */
  int32_t face;        /* reference of the only face to be written; 0: every face */
  int32_t multi_part;  /* 1: one file of a part a face, named face.<ref>; 0: a file a face */
  int32_t raw;         /* 1: of the model as it is now, without its mesh */
  int32_t compression; /* CARREAU_EXR_ZIP or CARREAU_EXR_PIZ */
  int32_t threads;     /* that compute and compress; 0: parameter threads. The files do not depend on it */
  int32_t reserved;    /* 0 */
} carreau_exr_options;

/* Samples the fields that governed the mesh of each face on a grid over the box of its parameter domain, and writes
 * images. From "a/x.exr" it makes the files a/x.face.<ref>.exr, or a/x.exr itself with `face` or `multi_part`. Columns
 * go from the smallest u to the largest, rows from the largest v down to the smallest. Attributes hold the box (uv.low,
 * uv.high), the reference (face), diag, face.status and face.why, all parameters that shape a mesh (parameter.<name>),
 * the first triangle of the face, the sizes at both ends of the colours (preview.size), the direction of rows, and the
 * version of the library. `options` may be NULL, which means all zero.
 *
 * From "a/x.png" it makes pictures a/x.face.<ref>.png, or a/x.png with `face`: the preview over white, 8 bits of sRGB.
 * They need no OpenEXR; a library that was built without it rejects .exr files (FILE).
 *
 * The fields belong to the session's mesh. Without a mesh, after a failed carreau_mesh_generate, for failed faces, and
 * if `raw` is 1, they are the answers of the geometry: positions, derivatives and sizes in the domain, as far as its
 * curves are known. There are then no triangles, and no target unless the mesher had sampled it. A host that fails at
 * some points leaves NaN there, and a warning; its sentence is no error of this call.
 *
 * The call evaluates the geometry at every pixel of the domain, from the caller's thread, and for CARREAU_EXR_DEVIATION
 * at some 20 points a vertex of the mesh. It never touches the mesh. Each file is complete, or as it was before.
 * Errors: ARGUMENT, SEQUENCE (no geometry, no model), MODEL, FILE, CANCELLED, MEMORY. */
CARREAU_API carreau_status carreau_write_exr(carreau_session* session, const char* path,
                                             const carreau_exr_options* options);

/* ---- Curves in metrics ---- */

/* A polyline of the plane or of space, with metrics that are known at places of it. */
typedef struct carreau_curve {
  size_t struct_size;
  int32_t dimension;       /* 2 or 3 */
  int32_t law;             /* between metrics: 0 linear, 1 geometric, 2 sinusoidal in sizes (RR-2818 sec. 4.3.2) */
  int64_t point_count;     /* 2 or more */
  int64_t metric_count;    /* 2 or more */
  const double* points;    /* point_count x dimension */
  const double* abscissae; /* metric_count: usual lengths from the first point, ascending from 0 to the length of the curve */
  const double* metrics;   /* metric_count x 3 (xx xy yy) or x 6 (xx xy xz yy yz zz), positive definite */
  double lss;              /* largest length of a trapezoid in the metric, as parameter LSS; 0: 0.5 */
} carreau_curve;

/* Cuts a curve into edges of equal length in the metric, as near to 1 as a whole number of edges allows (RR-2818 sec.
 * 4; if all metrics are isotropic, by the closed forms of sec. 5, without lss). *out_edges is n. *out_length is the length
 * of the whole curve in the metric, so that each edge has out_length / n. out_abscissae gets n + 1 usual lengths from the
 * first point, or nothing when capacity is 0: request n first. Each may be NULL. The session only keeps the sentence of an
 * error; its geometry and mesh are not touched. Errors: ARGUMENT (also a metric that is not positive definite, points that
 * coincide, capacity below n + 1), LIMIT. */
CARREAU_API carreau_status carreau_curve_split(carreau_session* session, const carreau_curve* curve, int64_t capacity,
                                               double out_abscissae[], int64_t* out_edges, double* out_length);

/* ---- Algebra of metrics ---- */

/* For n metrics of one dimension, 2 or 3, at once: rows of 3 numbers (xx xy yy) or of 6 (xx xy xz yy yz zz), in 1 / model
 * length^2, positive definite. A vector d has the length sqrt(d^T M d), and a size h along it is d / length for |d| = 1.
 * The session only keeps the sentence of an error; its geometry and mesh are not touched. Errors: ARGUMENT (also a
 * metric that is not positive definite, with its rank from 0). */

/* Gives sizes along the axes of each metric, the smallest first, n x dimension; and unit axes, n x dimension x dimension,
 * one after another, or nothing when out_axes is NULL. */
CARREAU_API carreau_status carreau_metric_sizes(carreau_session* session, int32_t dimension, int64_t n,
                                                const double metrics[], double out_sizes[], double out_axes[]);
/* Does the reverse: metrics of sizes > 0 along axes of any length but zero, which are made orthogonal from the first. */
CARREAU_API carreau_status carreau_metric_of_sizes(carreau_session* session, int32_t dimension, int64_t n,
                                                   const double sizes[], const double axes[], double out_metrics[]);
/* Gives the metric at share[i] in [0, 1] from p to q: sizes along the axes of their simultaneous reduction follow the
 * law, 0 linear, 1 geometric, 2 sinusoidal (RR-2818 sec. 4.3.2). */
CARREAU_API carreau_status carreau_metric_interpolate(carreau_session* session, int32_t dimension, int32_t law,
                                                      int64_t n, const double p[], const double q[],
                                                      const double share[], double out_metrics[]);
/* IN_TURN: two by two, the smallest unit ball first (HDR eq. 2.22): the largest ellipsoid inside two, not inside more.
 * LARGEST: the largest ellipsoid inside all unit balls (HDR sec. 2.5.4); a tenth of a millisecond each. Neither depends
 * on the order. */
enum { CARREAU_INTERSECT_IN_TURN = 0, CARREAU_INTERSECT_LARGEST = 1 };
/* Intersects `count` > 0 metrics at each of n places: metrics is n x count rows. */
CARREAU_API carreau_status carreau_metric_intersect(carreau_session* session, int32_t dimension, int32_t how, int64_t n,
                                                    int64_t count, const double metrics[], double out_metrics[]);
/* Gives the simultaneous reduction of p and q: directions that are orthogonal in both, unit vectors, n x dimension x
 * dimension, and the sizes of p and of q along them, n x dimension each. */
CARREAU_API carreau_status carreau_metric_reduce(carreau_session* session, int32_t dimension, int64_t n,
                                                 const double p[], const double q[], double out_p_sizes[],
                                                 double out_q_sizes[], double out_directions[]);
/* Gives lengths of straight edges, n x 2 x dimension coordinates, with metrics at their ends, n x 2 rows, which are
 * interpolated between by the law, to one part in ten thousand (RR-2818 sec. 4.4). */
CARREAU_API carreau_status carreau_metric_lengths(carreau_session* session, int32_t dimension, int32_t law, int64_t n,
                                                  const double edges[], const double metrics[], double out_lengths[]);

/* ---- The delivered mesh ---- */

/* These functions measure the latest mesh of a session on the surface of the callbacks, against the sizes and metrics
 * that they prescribe. They do not use the samples of the run. The first call of one of them measures the mesh; with
 * the parameter measure at 1, the run does. It takes about 24 evaluations a vertex, by the callbacks that made the
 * mesh: their data must still exist. Messages report the result (levels SUMMARY and WARNING). .vtu files written from
 * then on hold the values, on triangles and vertices, and with flag = 1 on all edges.
 *
 *   kind                            of         unit
 *   CARREAU_MEASURE_LENGTH          edges      length of the edge's image on the surface in the prescribed metric, by
 *                                              Gauss quadrature; 1 is as prescribed
 *   CARREAU_MEASURE_EDGE_ANGLE      edges      largest angle with the tangent planes at its ends, degrees
 *   CARREAU_MEASURE_GRADATION       edges      ratio of the prescribed sizes at its ends, for a step of length 1
 *   CARREAU_MEASURE_LENGTH_RATIO    vertices   longest over shortest of its edges; in an anisotropic metric each is
 *                                              divided by the size along it over the mean size
 *   CARREAU_MEASURE_Q1, Q2          triangles  shape in space, as in carreau_quality
 *   CARREAU_MEASURE_METRIC_QUALITY  triangles  Q2 in the metric
 *   CARREAU_MEASURE_A0              triangles  distance of the surface above it, at sample points; model length
 *   CARREAU_MEASURE_A1              triangles  largest angle between its normal and the surface's, degrees, 0 to 180
 *   CARREAU_MEASURE_CURVE_A0        edges      of edges of curves: distance of the curve's arc to it, model length
 *   CARREAU_MEASURE_CURVE_A1        edges      of edges of curves: largest angle with tangents of its arc, degrees
 *   CARREAU_MEASURE_VERTEX_ANGLE    triangles  largest angle between its normal and the normals of the surface at its vertices,
 *                                              degrees: angle_mesh limits it (RT-0232 sec. 3.3)
 *   CARREAU_MEASURE_A0_BOUND        triangles  upper bound of A0 over the whole triangle, of first order; model length
 *   CARREAU_MEASURE_A1_BOUND        triangles  upper bound of A1 over the whole triangle, of first order; degrees
 *   CARREAU_MEASURE_BOUND_SHARE     triangles  the larger of both over its tolerance: eps_chord and angle_mesh where they govern,
 *                                              else 0.3 of the size and 52 degrees
 *   CARREAU_MEASURE_INPUT_BOUND     triangles  of a surface given as triangles, of first order: upper bound of the distance from any point
 *                                              of it to them; model length. NaN with the parameter measure_distances at 0
 *
 * Bounds assume that over each part of a triangle second derivatives of the surface are almost constant: they differ from a constant by at
 * most the largest second difference of the samples. Triangles are cut into parts until the bounds decide. They take 16 evaluations a
 * vertex and more. The parameter measure_bounds chooses the meshes with bounds: 0 none, 1 cross-patch meshes and meshes of triangulated
 * surfaces, 2 all. Without bounds the values are NaN. A value is NaN where it has no meaning (sizes at a singular point, curves of edges
 * inside faces). */
enum {
  CARREAU_MEASURE_LENGTH = 1,
  CARREAU_MEASURE_EDGE_ANGLE = 2,
  CARREAU_MEASURE_GRADATION = 3,
  CARREAU_MEASURE_LENGTH_RATIO = 4,
  CARREAU_MEASURE_Q1 = 5,
  CARREAU_MEASURE_Q2 = 6,
  CARREAU_MEASURE_METRIC_QUALITY = 7,
  CARREAU_MEASURE_A0 = 8,
  CARREAU_MEASURE_A1 = 9,
  CARREAU_MEASURE_CURVE_A0 = 10,
  CARREAU_MEASURE_CURVE_A1 = 11,
  CARREAU_MEASURE_VERTEX_ANGLE = 12,
  CARREAU_MEASURE_A0_BOUND = 13,
  CARREAU_MEASURE_A1_BOUND = 14,
  CARREAU_MEASURE_BOUND_SHARE = 15,
  CARREAU_MEASURE_INPUT_BOUND = 16
};
/* The entities of a measure. */
enum { CARREAU_OF_EDGES = 1, CARREAU_OF_VERTICES = 2, CARREAU_OF_TRIANGLES = 3 };

/* Totals of a delivered mesh. */
typedef struct carreau_delivered {
  size_t struct_size;
  int64_t vertices, edges, triangles;
  int64_t short_edges, long_edges; /* metric length below 1 / sqrt(2), above sqrt(2) */
  int64_t folded_triangles;        /* turned by more than 90 degrees against the surface */
  double in_range;                 /* share of the edges with a length between */
  int64_t not_met;                 /* number of prescriptions that are not met everywhere */
  const char* text;                /* for a person: a line for each kind, then a sentence for each prescription not
                                      met; lives until the next call on the session */
  int64_t surf0_calls, surf1_calls, surf2_calls, size_calls; /* of the measure, not of the run */
  double seconds;
  /* For a surface given as triangles; NaN otherwise and with the parameter measure_distances at 0. The largest distance from
     the mesh to these triangles lies between input_distance and input_bound, the largest distance from them to the mesh between
     the next two. Model length. */
  double input_distance, input_bound;
  double input_back_distance, input_back_bound;
} carreau_delivered;

/* Measures the mesh as a whole. Errors of these functions: ARGUMENT, SEQUENCE (no mesh yet), CALLBACK, CANCELLED,
 * MEMORY. */
CARREAU_API carreau_status carreau_session_delivered(carreau_session* session, carreau_delivered* out_delivered);

/* The spread of one measure. */
typedef struct carreau_measure {
  size_t struct_size;
  const char* name;  /* as in files; static */
  const char* title; /* for a person, with the unit; static */
  int32_t entity;    /* CARREAU_OF_... */
  int32_t classes;   /* of the histogram */
  int64_t values;    /* number of entities */
  int64_t count;     /* entities whose value is not NaN; the spread is over them, and zero when there are none */
  double mean, min, p1, p99, max; /* p1, p99: percentiles */
  double limit;                   /* the prescribed limit: no value above this; infinity if there is none */
  int64_t beyond;                 /* values above it (gradation: by more than 2 %) */
  int64_t forced; /* forced among them: angles of edges as short as hgeomin allows (at most sqrt(2) times as long) and
                     of triangles with such edges only; gradations of edges that cross a face from a vertex of a curve
                     to another vertex of a curve */
} carreau_measure;

/* Gives the spread of a kind. */
CARREAU_API carreau_status carreau_delivered_measure(carreau_session* session, int32_t kind,
                                                     carreau_measure* out_measure);

/* Gives a histogram: counts[i] values from bounds[i] up to bounds[i + 1], where bounds[0] is -infinity. Both arrays
 * have room for `capacity` rows. */
CARREAU_API carreau_status carreau_delivered_histogram(carreau_session* session, int32_t kind, int64_t capacity,
                                                       double out_bounds[], int64_t out_counts[]);
/* Gives one value for each edge, vertex or triangle. Triangles and vertices are in the order of the mesh. */
CARREAU_API carreau_status carreau_delivered_values(carreau_session* session, int32_t kind, int64_t capacity,
                                                    double out_values[]);
/* Gives the edges of all triangles, each once: k x 2 vertices, the smaller first, and the reference of the curve, 0
 * inside a face. Either array may be NULL. */
CARREAU_API carreau_status carreau_delivered_edges(carreau_session* session, int64_t capacity, int32_t out_vertices[],
                                                   int32_t out_curves[]);
/* Gives the edge that leaves each corner of a triangle, m x 3. */
CARREAU_API carreau_status carreau_delivered_triangle_edges(carreau_session* session, int64_t capacity,
                                                            int32_t out_edges[]);

/* Writes the spreads, histograms, counts and sentences as JSON. Numbers that are not finite are null. Errors: FILE. */
CARREAU_API carreau_status carreau_delivered_write(carreau_session* session, const char* path);

#ifdef __cplusplus
}
#endif

#endif
