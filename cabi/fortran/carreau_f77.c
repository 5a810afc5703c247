/* SPDX-License-Identifier: BSD-3-Clause */
/* libcarreau_f77: the program of RT-0232 sec. 5 as subroutines that FORTRAN 77 calls. The host writes the routines of
 * RT-0232 sec. 3.1 as external subroutines (SURF0, CURV_INT, CURV0, and the optional others), without a module:
 *
 *       CALL CRINIT                                starts a session, finds the host's routines, calls CAD_INIT
 *       CALL CRRUN ('blsurf.env', ISTAT)           runs a blsurf.env; its variable verb governs messages
 *       CALL CRGETN (NV, NT, NE, ISTAT)            counts vertices, triangles, edges of curves
 *       CALL CRGETV (N, XYZ, IREF, ISTAT)          XYZ(3,N) and the references of corners and points IREF(N)
 *       CALL CRGETT (N, ITRI, IREF, ISTAT)         ITRI(3,N), vertices from 1, and references of faces IREF(N)
 *       CALL CRGETE (N, IEDG, IREF, ISTAT)         IEDG(2,N), vertices from 1, and references of curves IREF(N)
 *       CALL CRERR (TEXT)                          the sentence of the last error, blank after success
 *       CALL CREND                                 ends the session
 *
 * ISTAT is a carreau_status: 0 is success. N is the room of the arrays, at least the count. Integers are INTEGER, real
 * numbers DOUBLE PRECISION. The only global state is the session, since FORTRAN 77 has no type for a handle: a program has
 * one. CRINIT has no status: CRRUN reports its failure. Each name exists as crrun_ (gfortran, g77, f2c, ifort on Unix),
 * CRRUN and crrun. The host's names are looked up as surf0_, surf0__ (g77 and f2c, for names with an underscore), SURF0
 * and surf0. They are weak: the linker takes them from object files, and from archives only by -u surf0_. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "carreau.h"

/* A routine under all its names: `f` is the first that the program has, or NULL. */
#define WEAK extern __attribute__((weak))
#define HOST(name, NAME, arguments)                                         \
  WEAK void name##_ arguments;                                              \
  WEAK void name##__ arguments;                                             \
  WEAK void NAME arguments;                                                 \
  WEAK void name arguments;                                                 \
  typedef void(*name##_fn) arguments;                                       \
  static name##_fn find_##name(void) {                                      \
    if (name##_) return name##_;                                            \
    if (name##__) return name##__;                                          \
    return NAME ? NAME : name;                                              \
  }                                                                         \
  static name##_fn host_##name;

HOST(cad_init, CAD_INIT, (void))
HOST(surf0, SURF0, (int*, double*, double*))
HOST(surf1, SURF1, (int*, double*, double*, double*))
HOST(surf2, SURF2, (int*, double*, double*, double*, double*))
HOST(curv_int, CURV_INT, (int*, int*, double*, double*))
HOST(curv0, CURV0, (int*, int*, double*, double*))
HOST(curv1, CURV1, (int*, int*, double*, double*))
HOST(curv2, CURV2, (int*, int*, double*, double*))
HOST(cad_hphys, CAD_HPHYS, (int*, double*, double*))
HOST(cad_hphyc, CAD_HPHYC, (int*, int*, double*, double*))
HOST(cad_hphyp, CAD_HPHYP, (int*, double*))
HOST(cad_rads, CAD_RADS, (int*, double*, double*))
HOST(cad_radc, CAD_RADC, (int*, int*, double*, double*))

/* FORTRAN 77 has no intent: the host gets copies that it may change. Results start as NaN, so that the library finds
 * results that the host left unset. */
static void set_nan(double* values, int n) {
  while (n > 0) values[--n] = NAN;
}

static void surf0_of_host(const int32_t* refs, const double* uv, double* S) {
  int r = *refs;
  double p[2] = {uv[0], uv[1]};
  set_nan(S, 3);
  host_surf0(&r, p, S);
}

static void surf1_of_host(const int32_t* refs, const double* uv, double* Su, double* Sv) {
  int r = *refs;
  double p[2] = {uv[0], uv[1]};
  set_nan(Su, 3), set_nan(Sv, 3);
  host_surf1(&r, p, Su, Sv);
}

static void surf2_of_host(const int32_t* refs, const double* uv, double* Suu, double* Suv, double* Svv) {
  int r = *refs;
  double p[2] = {uv[0], uv[1]};
  set_nan(Suu, 3), set_nan(Suv, 3), set_nan(Svv, 3);
  host_surf2(&r, p, Suu, Suv, Svv);
}

static void curv_int_of_host(const int32_t* refs, const int32_t* ic, double* a, double* b) {
  int r = *refs, i = *ic;
  set_nan(a, 1), set_nan(b, 1);
  host_curv_int(&r, &i, a, b);
}

#define CURVE_OF_HOST(name)                                                                          \
  static void name##_of_host(const int32_t* refs, const int32_t* ic, const double* t, double* C) { \
    int r = *refs, i = *ic;                                                                          \
    double w = *t;                                                                                   \
    set_nan(C, 2);                                                                                   \
    host_##name(&r, &i, &w, C);                                                                      \
  }
CURVE_OF_HOST(curv0)
CURVE_OF_HOST(curv1)
CURVE_OF_HOST(curv2)

/* Sizes and radii: a routine that does not answer leaves the value (RT-0232 sec. 3.1.3). */
#define SIZE_ON_FACE(name)                                                        \
  static void name##_of_host(const int32_t* refs, const double* uv, double* h) { \
    int r = *refs;                                                                \
    double p[2] = {uv[0], uv[1]};                                                 \
    host_##name(&r, p, h);                                                        \
  }
#define SIZE_ON_CURVE(name)                                                                          \
  static void name##_of_host(const int32_t* refs, const int32_t* ic, const double* t, double* h) { \
    int r = *refs, i = *ic;                                                                          \
    double w = *t;                                                                                   \
    host_##name(&r, &i, &w, h);                                                                      \
  }
SIZE_ON_FACE(cad_hphys)
SIZE_ON_FACE(cad_rads)
SIZE_ON_CURVE(cad_hphyc)
SIZE_ON_CURVE(cad_radc)

static void cad_hphyp_of_host(const int32_t* refp, double* h) {
  int r = *refp;
  host_cad_hphyp(&r, h);
}

/* The session of the program, and the sentence and status of its last error. */
#define NO_SESSION "no session is open: CALL CRINIT comes first"
static carreau_session* session;
static char sentence[1024] = NO_SESSION;
static carreau_status crinit_status = CARREAU_ERR_SEQUENCE;

static carreau_status failed(carreau_status status, const char* text) {
  sentence[0] = '\0';
  strncat(sentence, text, sizeof sentence - 1);
  return status;
}

static carreau_status done(carreau_status status) { return failed(status, carreau_last_error(session)); }

static carreau_status done_with_mesh(carreau_mesh* mesh, carreau_status status) {
  return failed(status, carreau_mesh_last_error(mesh));
}

/* The Fortran runtime and C have buffers of their own: flushing keeps the order of lines. */
static void print_message(int32_t level, const char* text, void* user) {
  (void)user;
  fprintf(level <= CARREAU_LEVEL_WARNING ? stderr : stdout, "%s%s\n", level <= CARREAU_LEVEL_WARNING ? "carreau: warning: " : " ", text);
  fflush(stdout);
}

static void end_session(void) {
  carreau_session_free(session);
  session = NULL;
  crinit_status = failed(CARREAU_ERR_SEQUENCE, NO_SESSION);
}

static carreau_status start_session(void) {
  carreau_cad_m routines = {0};
  carreau_status status;
  end_session();
  routines.struct_size = sizeof routines;
#define TAKE(name)           \
  host_##name = find_##name(); \
  if (host_##name) routines.name = name##_of_host
  host_cad_init = find_cad_init();
  routines.cad_init = host_cad_init;
  TAKE(surf0);
  TAKE(surf1);
  TAKE(surf2);
  TAKE(curv_int);
  TAKE(curv0);
  TAKE(curv1);
  TAKE(curv2);
  TAKE(cad_hphys);
  TAKE(cad_hphyc);
  TAKE(cad_hphyp);
  TAKE(cad_rads);
  TAKE(cad_radc);
  if (!host_surf0 || !host_curv_int || !host_curv0)
    return failed(CARREAU_ERR_ARGUMENT,
                  "the program lacks one of the subroutines SURF0, CURV_INT, CURV0: link the object file that holds it");
  status = carreau_session_create(&session);
  if (status != CARREAU_OK) return failed(status, carreau_status_meaning(status));
  if ((status = carreau_set_message_callback(session, print_message, NULL)) != CARREAU_OK) return done(status);
  return done(carreau_set_cad_m(session, &routines));
}

/* A Fortran text without its trailing blanks. */
static carreau_status run(const char* env, int length) {
  char path[4096];
  if (crinit_status != CARREAU_OK) return crinit_status;
  while (length > 0 && env[length - 1] == ' ') --length;
  if (length < 0 || length >= (int)sizeof path) return failed(CARREAU_ERR_ARGUMENT, "the name of the env file is too long");
  memcpy(path, env, (size_t)length);
  path[length] = '\0';
  return done(carreau_run_env(session, path));
}

static carreau_status find_mesh(carreau_mesh** mesh) {
  return session ? done(carreau_session_mesh(session, mesh)) : crinit_status;
}

static carreau_status get_counts(int* nv, int* nt, int* ne) {
  carreau_mesh* mesh;
  int64_t vertices = 0, triangles = 0, edges = 0;
  carreau_status status = find_mesh(&mesh);
  if (status == CARREAU_OK) status = done_with_mesh(mesh, carreau_mesh_count(mesh, &vertices, &triangles, &edges, NULL));
  *nv = (int)vertices, *nt = (int)triangles, *ne = (int)edges;
  return status;
}

static carreau_status get_vertices(int n, double* xyz, int* refs) {
  carreau_mesh* mesh;
  carreau_status status = find_mesh(&mesh);
  if (status == CARREAU_OK) status = done_with_mesh(mesh, carreau_mesh_vertices(mesh, n, xyz));
  if (status == CARREAU_OK) status = done_with_mesh(mesh, carreau_mesh_vertex_refs(mesh, n, refs));
  return status;
}

/* FORTRAN 77 counts vertices from 1. */
static void count_from_1(int64_t n, int* vertices) {
  while (n > 0) ++vertices[--n];
}

static carreau_status get_triangles(int n, int* vertices, int* refs) {
  carreau_mesh* mesh;
  int64_t count = 0;
  carreau_status status = find_mesh(&mesh);
  if (status == CARREAU_OK) status = done_with_mesh(mesh, carreau_mesh_count(mesh, NULL, &count, NULL, NULL));
  if (status == CARREAU_OK) status = done_with_mesh(mesh, carreau_mesh_triangle_refs(mesh, n, refs));
  if (status == CARREAU_OK) status = done_with_mesh(mesh, carreau_mesh_triangles(mesh, n, vertices));
  if (status == CARREAU_OK) count_from_1(3 * count, vertices);
  return status;
}

static carreau_status get_edges(int n, int* vertices, int* refs) {
  carreau_mesh* mesh;
  int64_t count = 0;
  carreau_status status = find_mesh(&mesh);
  if (status == CARREAU_OK) status = done_with_mesh(mesh, carreau_mesh_count(mesh, NULL, NULL, &count, NULL));
  if (status == CARREAU_OK) status = done_with_mesh(mesh, carreau_mesh_edge_refs(mesh, n, refs));
  if (status == CARREAU_OK) status = done_with_mesh(mesh, carreau_mesh_edges(mesh, n, vertices));
  if (status == CARREAU_OK) count_from_1(2 * count, vertices);
  return status;
}

static void get_error(char* text, int length) {
  size_t used = strlen(sentence);
  if (length <= 0) return;
  if (used > (size_t)length) used = (size_t)length;
  memset(text, ' ', (size_t)length);
  memcpy(text, sentence, used);
}

/* Names for callers. The length of a text comes last: f2c passes an int, gfortran and ifort a size_t, and both leave
 * lengths below 2^31 in the place of an int. */
#define CALLABLE(name, NAME, arguments, body) \
  void name##_ arguments;                     \
  void NAME arguments;                        \
  void name arguments;                        \
  void name##_ arguments { body; }            \
  void NAME arguments { body; }               \
  void name arguments { body; }

CALLABLE(crinit, CRINIT, (void), crinit_status = start_session())
CALLABLE(crrun, CRRUN, (const char* env, int* istat, int length), *istat = run(env, length))
CALLABLE(crgetn, CRGETN, (int* nv, int* nt, int* ne, int* istat), *istat = get_counts(nv, nt, ne))
CALLABLE(crgetv, CRGETV, (const int* n, double* xyz, int* iref, int* istat), *istat = get_vertices(*n, xyz, iref))
CALLABLE(crgett, CRGETT, (const int* n, int* itri, int* iref, int* istat), *istat = get_triangles(*n, itri, iref))
CALLABLE(crgete, CRGETE, (const int* n, int* iedg, int* iref, int* istat), *istat = get_edges(*n, iedg, iref))
CALLABLE(crerr, CRERR, (char* text, int length), get_error(text, length))
CALLABLE(crend, CREND, (void), end_session())
