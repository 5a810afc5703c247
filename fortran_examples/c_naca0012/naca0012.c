/* SPDX-License-Identifier: BSD-3-Clause */
/* Adaptation around the profile NACA 0012 (RR-2818 sec. 6.4): three iterations, metrics by the Hessian. The field
 * stands in for the flow at Mach 0.8 and 1.25 degrees: a strong shock above the profile, a weak one below, stagnation
 * at the leading edge. The first mesh follows the geometry alone, graded. The program prints the table of the
 * report: points of the boundary, points, largest stretching; and the error of the field. */
#include <carreau.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "naca0012_field.h"

static const double far_radius = 5, half_pi = 1.5707963267948966;

/* ---- The domain: a disc around the profile, in the plane z = 0 ---- */

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
  if (ic <= 4) return *a = (ic - 1) * half_pi, *b = ic * half_pi, 0;
  return *a = 0, *b = 1, 0;
}

/* 1 to 4: the circle. 5 and 6: the profile, below from the leading to the trailing edge and above back again. In t,
 * with x = t^2, the root in the thickness is gone: 0.6 (0.2969 t - 0.126 t^2 - 0.3516 t^4 + 0.2843 t^6 - 0.1036 t^8).
 */
static int32_t curve(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt,
                     void* user) {
  (void)face, (void)user;
  if (ic <= 4) {
    const double x = far_radius * cos(t), y = far_radius * sin(t);
    C[0] = 0.5 + x, C[1] = y;
    if (order >= 1) Ct[0] = -y, Ct[1] = x;
    if (order >= 2) Ctt[0] = -x, Ctt[1] = -y;
    return 0;
  }
  const double way = ic == 5 ? 1 : -1, side = ic == 5 ? -0.6 : 0.6, s = ic == 5 ? t : 1 - t, p = s * s;
  C[0] = p, C[1] = side * (0.2969 * s + p * (-0.126 + p * (-0.3516 + p * (0.2843 - 0.1036 * p))));
  if (order >= 1) {
    Ct[0] = way * 2 * s;
    Ct[1] = way * side * (0.2969 + s * (-0.252 + p * (-1.4064 + p * (1.7058 - 0.8288 * p))));
  }
  if (order >= 2) Ctt[0] = 2, Ctt[1] = side * (-0.252 + p * (-4.2192 + p * (8.529 - 5.8016 * p)));
  return 0;
}

static carreau_status describe(carreau_session* session) {
  const carreau_cad cad = {.struct_size = sizeof cad,
                           .surface_order = 2,
                           .curve_order = 2,
                           .surface = plane,
                           .curve_interval = interval,
                           .curve = curve};
  carreau_status status = carreau_set_cad(session, &cad);
  if (status == CARREAU_OK) status = carreau_model_add_face(session, 1, 1);
  for (int32_t ic = 1; ic <= 4 && status == CARREAU_OK; ++ic)
    status = carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, ic, ic, ic % 4 + 1);
  if (status == CARREAU_OK) status = carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, 5, 5, 6);
  if (status == CARREAU_OK) status = carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, 6, 6, 5);
  return status;
}

static int32_t field(int64_t n, const double* xyz, double* values, void* user) {
  (void)user;
  for (int64_t i = 0; i < n; ++i) values[i] = f(xyz[3 * i], xyz[3 * i + 1]);
  return 0;
}

static int wrong = 0;
static void claim(int holds, const char* sentence) {
  if (!holds) wrong = 1, fprintf(stderr, "this does not hold: %s\n", sentence);
}

/* Without arguments, checks only; otherwise each mesh is written to the folder that is named. */
int main(int argc, char** argv) {
  const carreau_estimator estimator = {.struct_size = sizeof estimator,
                                       .source = CARREAU_HESSIAN,
                                       .shape = CARREAU_ANISOTROPIC,
                                       .tolerance = 0.008,
                                       .hmin = 0.004,
                                       .hmax = 0.8};
  const carreau_adaptation loop = {
      .struct_size = sizeof loop, .estimator = &estimator, .field = field, .iterations = 1, .differences = 1};
  carreau_adaptation_report report = {.struct_size = sizeof report};
  carreau_session* session = NULL;
  if (carreau_session_create(&session) != CARREAU_OK) return 1;
  if (describe(session) || carreau_set_real(session, "hphydef", 0.8) || carreau_set_integer(session, "hgeo_flag", 1) ||
      carreau_set_real(session, "hgeomin", 0.004) || carreau_set_real(session, "gradation", 1.2) ||
      carreau_set_real(session, "angle_mesh", 4) || carreau_mesh_generate(session))
    return fprintf(stderr, "%s\n", carreau_last_error(session)), 1;
  double error = 0;
  int64_t n = 0, m = 0, k = 0, defects = 0;
  printf(" i  boundary  points  triangles  largest h2/h1   error of the field: rms, max\n");
  for (int i = 0; i <= 3; ++i) {
    carreau_mesh* mesh = NULL;
    const char* text = NULL;
    if (i > 0 && carreau_adapt(session, &loop, &report)) claim(0, carreau_last_error(session));
    if (i == 1) {
      error = report.error_rms_before;
      printf("%.2e, %.2e\n", report.error_rms_before, report.error_max_before);
    }
    if (carreau_session_mesh(session, &mesh) || carreau_mesh_count(mesh, &n, &m, &k, NULL) ||
        carreau_mesh_defects(mesh, 0, 10, &defects, &text))
      return fprintf(stderr, "%s\n", carreau_last_error(session)), 1;
    claim(defects == 0, "the mesh is sound");
    claim(n - (m + k) / 2 == 0, "Euler's number of a disc with a hole is 0");
    printf("%2d  %8" PRId64 "  %6" PRId64 "  %9" PRId64 "  %13.1f   ", i, k, n, m, i > 0 ? report.stretch_max : 1);
    if (i > 0)
      printf("%.2e, %.2e\n", report.error_rms, report.error_max); /* that of the first is known with the second */
    if (argc > 1) {
      char path[400];
      snprintf(path, sizeof path, "%s/naca_%d.mesh", argv[1], i);
      claim(carreau_mesh_write(mesh, path) == CARREAU_OK, "the mesh can be written");
    }
  }
  claim(fabs((double)n / 2223 - 1) <= 0.15, "as many points as in RR-2818 within 15 %");
  claim(report.stretch_max >= 8.5, "the largest stretching is at least that in RR-2818");
  claim(report.error_rms <= error / 5, "the error is a fifth of that before, or less");
  carreau_session_free(session);
  return wrong;
}
