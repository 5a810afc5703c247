/* SPDX-License-Identifier: BSD-3-Clause */
/* The loop around the profile NACA 0012 (RR-2818 sec. 6.4) on a plane domain from arrays. The contour is read from the
 * file that is named: two splines of Catmull and Rom between its leading edge and both ends of its blunt trailing edge.
 * The far boundary is a spline through 32 points of a circle. The field stands in for the flow. The program prints the
 * table of the report. */
#include <carreau_geometry.h>
#include <inttypes.h>
#include <stdio.h>

#include "../c_naca0012/naca0012_field.h"

enum { far_points = 32, most_points = 2000 };
static const double far_radius = 5, two_pi = 6.283185307179586;

static int wrong = 0;
static void claim(int holds, const char* sentence) {
  if (!holds) wrong = 1, fprintf(stderr, "this does not hold: %s\n", sentence);
}

static int32_t field(int64_t n, const double* xyz, double* values, void* user) {
  (void)user;
  for (int64_t i = 0; i < n; ++i) values[i] = f(xyz[3 * i], xyz[3 * i + 1]);
  return 0;
}

/* Reads the contour into `points`, and gives its number of points. */
static int read_contour(const char* path, double* points) {
  FILE* file = fopen(path, "r");
  int n = 0;
  if (!file) return 0;
  while (n < most_points && fscanf(file, "%lf %lf", &points[2 * n], &points[2 * n + 1]) == 2) ++n;
  fclose(file);
  return n;
}

static carreau_status describe(carreau_session* session, const char* path) {
  static double points[2 * (most_points + far_points)];
  static int32_t passed[most_points + far_points + 8];
  const int n = read_contour(path, points);
  int nose = 0;
  for (int i = 0; i < n; ++i)
    if (points[2 * i] < points[2 * nose]) nose = i;
  claim(n > 10 && nose > 2 && nose < n - 2, "the file holds a contour from a trailing edge to a trailing edge");
  if (wrong) return CARREAU_OK;
  for (int i = 0; i < far_points; ++i) {
    points[2 * (n + i)] = 0.5 + far_radius * cos(two_pi * i / far_points);
    points[2 * (n + i) + 1] = far_radius * sin(two_pi * i / far_points);
  }
  int64_t starts[5] = {0, nose + 1, n + 1, n + 3, n + 3 + far_points + 1}, k = 0;
  for (int i = 0; i <= nose; ++i) passed[k++] = i;
  for (int i = nose; i < n; ++i) passed[k++] = i;
  passed[k++] = n - 1, passed[k++] = 0; /* the blunt edge */
  for (int i = 0; i <= far_points; ++i) passed[k++] = n + i % far_points;
  const int32_t smooth[4] = {1, 1, 0, 1}, controls[8] = {-1, nose + 1, nose - 1, -1, -1, -1, -1, -1},
                refs[4] = {1, 1, 2, 3};
  const carreau_plane_domain domain = {.struct_size = sizeof domain,
                                       .point_count = n + far_points,
                                       .curve_count = 4,
                                       .points = points,
                                       .curve_starts = starts,
                                       .curve_points = passed,
                                       .smooth = smooth,
                                       .controls = controls,
                                       .curve_refs = refs};
  return carreau_add_plane_domain(session, &domain);
}

/* The contour, and perhaps a folder to which each mesh is written. */
int main(int argc, char** argv) {
  const carreau_estimator estimator = {.struct_size = sizeof estimator,
                                       .source = CARREAU_HESSIAN,
                                       .shape = CARREAU_ANISOTROPIC,
                                       .tolerance = 0.008,
                                       .hmin = 0.004,
                                       .hmax = 0.8};
  const carreau_adaptation step_of_loop = {
      .struct_size = sizeof step_of_loop, .estimator = &estimator, .field = field, .iterations = 1, .differences = 1};
  carreau_adaptation_report report = {.struct_size = sizeof report};
  carreau_session* session = NULL;
  if (argc < 2 || carreau_session_create(&session) != CARREAU_OK)
    return fprintf(stderr, "usage: plane_naca0012 CONTOUR [FOLDER]\n"), 2;
  if (describe(session, argv[1]) || carreau_set_real(session, "hphydef", 0.8) ||
      carreau_set_integer(session, "hgeo_flag", 1) || carreau_set_real(session, "hgeomin", 0.002) ||
      carreau_set_real(session, "gradation", 1.2) || carreau_set_real(session, "angle_mesh", 4) ||
      carreau_mesh_generate(session))
    return fprintf(stderr, "%s\n", carreau_last_error(session)), 1;
  int64_t n = 0, m = 0, k = 0, defects = 0;
  double error = 0;
  printf(
      " i  boundary  points  triangles  largest h2/h1  (RR-2818: 129 1344 1.0, 161 2099 3.4, 168 2117 6.8, 181 2223 "
      "8.5)\n");
  for (int i = 0; i <= 3; ++i) {
    carreau_mesh* mesh = NULL;
    const char* text = NULL;
    if (i > 0 && carreau_adapt(session, &step_of_loop, &report)) claim(0, carreau_last_error(session));
    if (i == 1) error = report.error_rms_before;
    if (carreau_session_mesh(session, &mesh) || carreau_mesh_count(mesh, &n, &m, &k, NULL) ||
        carreau_mesh_defects(mesh, 0, 10, &defects, &text))
      return fprintf(stderr, "%s\n", carreau_last_error(session)), 1;
    claim(defects == 0, "the mesh is sound");
    claim(n - (m + k) / 2 == 0, "Euler's number of a disc with a hole is 0");
    printf("%2d  %8" PRId64 "  %6" PRId64 "  %9" PRId64 "  %13.1f\n", i, k, n, m, i > 0 ? report.stretch_max : 1);
    char path[400];
    snprintf(path, sizeof path, "%s/naca_%d.mesh", argc > 2 ? argv[2] : ".", i);
    if (argc > 2) claim(carreau_mesh_write(mesh, path) == CARREAU_OK, "the mesh can be written");
  }
  claim(fabs((double)n / 2223 - 1) <= 0.15, "as many points as in RR-2818 within 15 %");
  claim(report.stretch_max >= 8.5, "the largest stretching is at least that in RR-2818");
  claim(report.error_rms <= error / 5, "the error is a fifth of that before, or less");
  carreau_session_free(session);
  return wrong;
}
