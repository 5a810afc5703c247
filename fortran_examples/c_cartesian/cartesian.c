/* SPDX-License-Identifier: BSD-3-Clause */
/* Cartesian surfaces (HDR sec. 4.8): the graph of z = f(x, y) over a plane domain, which is meshed so that the
 * triangles carry f. Here f = tanh((sin x - y) / 0.03) over the disc of radius 3 (HDR eq. 4.95). The four estimates of
 * the error are the largest curvature, both curvatures, the relative and the absolute error by the Hessian (HDR
 * fig. 4.35 and 4.36), with five iterations each. The mesh lies in the plane; the error is measured against f between
 * the vertices.
 */
#include <carreau.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double epsilon = 0.03, radius = 3, half_pi = 1.5707963267948966;

/* ---- The domain: the disc, in the plane z = 0 ---- */

static int32_t plane(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv, double* Suu,
                     double* Suv, double* Svv, void* user) {
  (void)face, (void)user;
  S[0] = u, S[1] = v, S[2] = 0;
  if (order >= 1) Su[0] = Sv[1] = 1, Su[1] = Su[2] = Sv[0] = Sv[2] = 0;
  if (order >= 2)
    for (int k = 0; k < 3; ++k) Suu[k] = Suv[k] = Svv[k] = 0;
  return 0;
}

static int32_t interval(int32_t face, int32_t ic, double* a, double* b, void* user) {
  (void)face, (void)user;
  return *a = (ic - 1) * half_pi, *b = ic * half_pi, 0;
}

static int32_t arc(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt, void* user) {
  const double x = radius * cos(t), y = radius * sin(t);
  (void)face, (void)ic, (void)user;
  C[0] = x, C[1] = y;
  if (order >= 1) Ct[0] = -y, Ct[1] = x;
  if (order >= 2) Ctt[0] = -x, Ctt[1] = -y;
  return 0;
}

static carreau_status describe(carreau_session* session) {
  const carreau_cad cad = {.struct_size = sizeof cad,
                           .surface_order = 2,
                           .curve_order = 2,
                           .surface = plane,
                           .curve_interval = interval,
                           .curve = arc};
  carreau_status status = carreau_set_cad(session, &cad);
  if (status == CARREAU_OK) status = carreau_model_add_face(session, 1, 1);
  for (int32_t ic = 1; ic <= 4 && status == CARREAU_OK; ++ic)
    status = carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, ic, ic, ic % 4 + 1);
  return status;
}

/* ---- The field ---- */

static double f(double x, double y) { return tanh((sin(x) - y) / epsilon); }

static int32_t field(int64_t n, const double* xyz, double* values, void* user) {
  (void)user;
  for (int64_t i = 0; i < n; ++i) values[i] = f(xyz[3 * i], xyz[3 * i + 1]);
  return 0;
}

/* ---- Checks of the meshes ---- */

static int wrong = 0;
static void claim(int holds, const char* sentence) {
  if (!holds) wrong = 1, fprintf(stderr, "this does not hold: %s\n", sentence);
}

struct measure {
  int64_t vertices, triangles;
  double error_rms, error_max; /* of z */
  double away_rms, away_max; /* distance from the surface, to first order: error of z over the root of 1 + |grad f|^2 */
};

/* At 28 places inside each triangle. */
static struct measure measure(carreau_session* session) {
  struct measure m = {0};
  carreau_mesh* mesh = NULL;
  double area = 0;
  if (carreau_session_mesh(session, &mesh) || carreau_mesh_count(mesh, &m.vertices, &m.triangles, NULL, NULL))
    return claim(0, carreau_last_error(session)), m;
  double* xyz = malloc((size_t)m.vertices * 3 * sizeof *xyz);
  int32_t* triangles = malloc((size_t)m.triangles * 3 * sizeof *triangles);
  if (!xyz || !triangles || carreau_mesh_vertices(mesh, m.vertices, xyz) ||
      carreau_mesh_triangles(mesh, m.triangles, triangles))
    return claim(0, "the arrays can be had"), free(xyz), free(triangles), m;
  for (const int32_t* t = triangles; t < triangles + 3 * m.triangles; t += 3) {
    const double *a = xyz + 3 * t[0], *b = xyz + 3 * t[1], *c = xyz + 3 * t[2];
    const double fa = f(a[0], a[1]), fb = f(b[0], b[1]), fc = f(c[0], c[1]);
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    area += twice / 2;
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; i + j <= 6; ++j) {
        const double p = (i + 1.0 / 3) / 7, q = (j + 1.0 / 3) / 7, r = 1 - p - q;
        const double x = p * a[0] + q * b[0] + r * c[0], y = p * a[1] + q * b[1] + r * c[1], z = f(x, y);
        const double error = fabs(p * fa + q * fb + r * fc - z), slope = (1 - z * z) / epsilon;
        const double away = error / sqrt(1 + slope * slope * (1 + cos(x) * cos(x)));
        m.error_max = fmax(m.error_max, error), m.away_max = fmax(m.away_max, away);
        m.error_rms += twice / 56 * error * error, m.away_rms += twice / 56 * away * away;
      }
  }
  claim(fabs(area / (2 * half_pi * radius * radius) - 1) < 0.02, "the disc is covered");
  free(xyz), free(triangles);
  m.error_rms = sqrt(m.error_rms / area), m.away_rms = sqrt(m.away_rms / area);
  return m;
}

static void print(const char* name, struct measure m) {
  printf("%-28s %6" PRId64 " triangles; z: rms %.2e, max %.2e; distance: rms %.2e, max %.2e\n", name, m.triangles,
         m.error_rms, m.error_max, m.away_rms, m.away_max);
}

/* A uniform mesh of about so many triangles. */
static struct measure uniform(carreau_session* session, double triangles) {
  const double h = sqrt(2 * half_pi * radius * radius / triangles * 4 / sqrt(3));
  struct measure none = {0};
  if (carreau_reset_parameters(session) || carreau_set_real(session, "hphydef", h) ||
      carreau_set_real(session, "hphymin", h / 2) || carreau_mesh_generate(session) ||
      carreau_reset_parameters(session))
    return claim(0, carreau_last_error(session)), none;
  return measure(session);
}

struct variant {
  const char* name;
  int32_t source, shape, relative;
  double tolerance, hmin, hmax;
  double paper;    /* number of triangles in the figure */
  double gain;     /* how many times smaller the error is than that of a uniform mesh of as many triangles */
  int by_distance; /* curvatures bound angles and so distances from the surface; Hessians bound errors of z */
};

/* Iteration 1 of HDR fig. 4.35 has 27 130 triangles, and iteration 5 has 8 736. Sizes of 8 degrees make the second number of
 * triangles. Half of them make the first one, and ever more triangles later: from values on triangles that are eight times wider
 * than the front, the paper's estimate at iteration 0 is twice as strict as its estimate at the end. Ours has derivatives of f. */
static void first_iteration(carreau_session* session, const struct variant* v) {
  const carreau_estimator estimator = {.struct_size = sizeof estimator,
                                       .source = v->source,
                                       .shape = v->shape,
                                       .tolerance = v->tolerance / 2,
                                       .hmin = v->hmin,
                                       .hmax = v->hmax};
  const carreau_adaptation loop = {
      .struct_size = sizeof loop, .estimator = &estimator, .field = field, .iterations = 1, .differences = 1};
  uniform(session, 1053);
  if (carreau_adapt(session, &loop, NULL)) {
    claim(0, carreau_last_error(session));
    return;
  }
  const struct measure m = measure(session);
  print("  iteration 1, half the sizes", m);
  claim(fabs((double)m.triangles / 27130 - 1) < 0.05, "half the sizes make iteration 1 of the figure");
}

static void adapt(carreau_session* session, const struct variant* v, const char* folder) {
  const carreau_estimator estimator = {.struct_size = sizeof estimator,
                                       .source = v->source,
                                       .shape = v->shape,
                                       .relative = v->relative,
                                       .tolerance = v->tolerance,
                                       .hmin = v->hmin,
                                       .hmax = v->hmax};
  const carreau_adaptation loop = {
      .struct_size = sizeof loop, .estimator = &estimator, .field = field, .iterations = 1, .differences = 1};
  struct measure m = uniform(session, 1053); /* iteration 0 of HDR fig. 4.35 */
  print(v->name, m);
  claim(fabs((double)m.triangles / 1053 - 1) < 0.05, "the uniform mesh has the triangles of the figure");
  for (int i = 1; i <= 5; ++i) {
    if (carreau_adapt(session, &loop, NULL)) {
      claim(0, carreau_last_error(session));
      return;
    }
    m = measure(session);
    char name[32];
    snprintf(name, sizeof name, "  iteration %d", i);
    print(name, m);
  }
  if (folder) {
    carreau_mesh* mesh = NULL;
    char path[400];
    snprintf(path, sizeof path, "%s/%s.mesh", folder, v->name);
    carreau_session_mesh(session, &mesh);
    claim(carreau_mesh_write(mesh, path) == CARREAU_OK, "the mesh can be written");
  }
  carreau_mesh* mesh = NULL;
  int64_t defects = -1;
  const char* text = NULL;
  carreau_session_mesh(session, &mesh);
  claim(carreau_mesh_defects(mesh, 0, 10, &defects, &text) == CARREAU_OK && defects == 0, "the mesh is sound");
  const struct measure even = uniform(session, (double)m.triangles);
  print("  uniform", even);
  printf("  figure: %.0f triangles; error of the uniform mesh / error of this mesh: %.1f of z, %.1f of the distance\n",
         v->paper, even.error_rms / m.error_rms, even.away_rms / m.away_rms);
  claim(fabs((double)m.triangles / v->paper - 1) <= 0.15, "the number of triangles agrees with the figure within 15 %");
  claim((v->by_distance ? even.away_rms / m.away_rms : even.error_rms / m.error_rms) >= v->gain,
        "the error is that many times smaller than on a uniform mesh");
}

/* Without arguments, all variants; otherwise their meshes are written to the folder that is named. */
int main(int argc, char** argv) {
  /* The figures give numbers of triangles, no thresholds: these make as many. */
  const struct variant variants[] = {
      {"largest curvature", CARREAU_CURVATURE, CARREAU_GRAPH, 0, 8, 0.002, 0.6, 8736, 10, 1},
      {"both curvatures", CARREAU_CURVATURE, CARREAU_ANISOTROPIC, 0, 6.5, 0.002, 0.6, 2110, 50, 1},
      {"relative error", CARREAU_HESSIAN, CARREAU_ISOTROPIC, 1, 0.11, 0.002, 0.3, 5258, 8, 0},
      {"absolute error", CARREAU_HESSIAN, CARREAU_ISOTROPIC, 0, 0.01, 0.002, 0.3, 31177, 15, 0},
  };
  carreau_session* session = NULL;
  if (carreau_session_create(&session) != CARREAU_OK) return 1;
  if (describe(session) != CARREAU_OK) return fprintf(stderr, "%s\n", carreau_last_error(session)), 1;
  for (size_t i = 0; i < sizeof variants / sizeof variants[0]; ++i)
    adapt(session, &variants[i], argc > 1 ? argv[1] : NULL);
  first_iteration(session, &variants[0]);
  carreau_session_free(session);
  return wrong;
}
