/* SPDX-License-Identifier: BSD-3-Clause */
/* Curves in metrics that vary along them, as in section 6 of RR-2818: a segment with five sizes (its figures 20 to 23), a
 * segment with five metrics (24 to 27) and a closed curve of the plane with nine. The latter is like its figures 28 to
 * 32, whose data the report does not give. Each has the three laws of interpolation. A helix of space follows. Every
 * curve is cut into edges of equal length in the metric. The program measures each edge again, by a separate rule, and
 * fails when an edge is off by 2 %.
 * metric_curves <folder>: writes a picture (SVG) of each plane curve there, with its cuts and unit circles of the metric;
 * for the sizes, h(s) over squares that stand on the edges. */
#include <carreau.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;
static const char* const law_names[] = {"linear", "geometric", "sinusoidal"};

enum { most_points = 401, most_metrics = 9 };
struct plane_curve {
  const char* name;
  int64_t n, m;
  double points[most_points][2], abscissae[most_metrics], metrics[most_metrics][3];
};

/* Size h1 along the direction at `degrees`, h2 across: the triplets of RR-2818 sec. 4.3.1. */
static void set_metric(double* metric, double degrees, double h1, double h2) {
  const double a = degrees * pi / 180, c = cos(a), s = sin(a), p = 1 / (h1 * h1), q = 1 / (h2 * h2);
  metric[0] = p * c * c + q * s * s, metric[1] = (p - q) * c * s, metric[2] = p * s * s + q * c * c;
}

/* RR-2818 sec. 6.2, its table. */
static void set_segment(struct plane_curve* curve) {
  static const double s[] = {0, 2, 3, 6, 7.5}, angle[] = {30, 90, 0, -60, -45};
  static const double h1[] = {0.7, 1.1, 0.3, 1.5, 1}, h2[] = {0.25, 0.15, 0.3, 0.4, 0.35};
  *curve = (struct plane_curve){.name = "segment", .n = 2, .m = 5, .points = {{0, 0}, {7.5, 0}}};
  for (int i = 0; i < 5; ++i) curve->abscissae[i] = s[i], set_metric(curve->metrics[i], angle[i], h1[i], h2[i]);
}

/* RR-2818 sec. 6.1, its table. */
static void set_sizes(struct plane_curve* curve) {
  static const double s[] = {0, 3, 4, 8, 10}, h[] = {1.5, 0.5, 2, 0.1, 0.7};
  *curve = (struct plane_curve){.name = "sizes", .n = 2, .m = 5, .points = {{0, 0}, {10, 0}}};
  for (int i = 0; i < 5; ++i) curve->abscissae[i] = s[i], set_metric(curve->metrics[i], 0, h[i], h[i]);
}

static void set_closed_curve(struct plane_curve* curve) {
  static const double angle[] = {0, 40, 75, -30, 10, 90, -60, 20, 0}, ratio[] = {1, 4, 6, 2, 1, 8, 3, 5, 1};
  double total = 0;
  *curve = (struct plane_curve){.name = "closed", .n = most_points, .m = 9};
  for (int i = 0; i < most_points; ++i) {
    const double t = 2 * pi * (i % (most_points - 1)) / (most_points - 1), r = 2 + 0.6 * cos(3 * t);
    curve->points[i][0] = 1.5 * r * cos(t), curve->points[i][1] = r * sin(t);
    if (i > 0)
      total += hypot(curve->points[i][0] - curve->points[i - 1][0], curve->points[i][1] - curve->points[i - 1][1]);
  }
  for (int i = 0; i < 9; ++i) {
    curve->abscissae[i] = total * i / 8;
    set_metric(curve->metrics[i], angle[i], 0.8, 0.8 / ratio[i]);
  }
}

/* ---- Checks without the library ---- */

static double size_between(double h, double t, int law) {
  if (law == 0) return 1 + t * (h - 1);
  if (law == 1) return pow(h, t);
  return (1 + h) / 2 + (1 - h) / 2 * cos(pi * t);
}

/* Squared length of x in the metric at fraction t between p and q (RR-2818 sec. 4.3.2), by Cholesky's factor L of p.
 * In coordinates y = L^T x the first metric is the identity, and both metrics have the axes of the second. */
static double squared_length(const double* p, const double* q, double t, int law, const double* x) {
  const double l11 = sqrt(p[0]), l21 = p[1] / l11, l22 = sqrt(p[2] - l21 * l21);
  const double y1 = l11 * x[0] + l21 * x[1], y2 = l22 * x[1];
  const double a = q[0] / p[0], b = (q[1] - a * l11 * l21) / (l11 * l22);
  const double c = (q[2] - a * l21 * l21 - 2 * b * l21 * l22) / (l22 * l22);
  const double angle = atan2(2 * b, a - c) / 2, cosine = cos(angle), sine = sin(angle);
  const double d = hypot((a - c) / 2, b), high = (a + c) / 2 + d, low = (a + c) / 2 - d;
  const double z1 = cosine * y1 + sine * y2, z2 = cosine * y2 - sine * y1;
  const double h1 = size_between(1 / sqrt(high), t, law), h2 = size_between(1 / sqrt(low), t, law);
  return z1 * z1 / (h1 * h1) + z2 * z2 / (h2 * h2);
}

static void point_at(const struct plane_curve* curve, double s, double* point) {
  int64_t i = 1;
  double before = 0, length = 0;
  for (;; ++i) {
    length = hypot(curve->points[i][0] - curve->points[i - 1][0], curve->points[i][1] - curve->points[i - 1][1]);
    if (before + length >= s || i + 1 == curve->n) break;
    before += length;
  }
  const double t = (s - before) / length;
  for (int k = 0; k < 2; ++k) point[k] = (1 - t) * curve->points[i - 1][k] + t * curve->points[i][k];
}

/* Interval of the metrics that holds s. */
static int64_t metrics_around(const struct plane_curve* curve, double s) {
  int64_t i = 0;
  while (i + 2 < curve->m && curve->abscissae[i + 1] <= s) ++i;
  return i;
}

/* Computes by midpoints and chords. */
static double measured_length(const struct plane_curve* curve, int law, double from, double to) {
  enum { steps = 400 };
  double sum = 0, p[2], q[2];
  point_at(curve, from, p);
  for (int i = 0; i < steps; ++i) {
    const double s = from + (to - from) * (i + 0.5) / steps;
    const int64_t k = metrics_around(curve, s);
    const double t = (s - curve->abscissae[k]) / (curve->abscissae[k + 1] - curve->abscissae[k]);
    point_at(curve, from + (to - from) * (i + 1) / steps, q);
    const double x[2] = {q[0] - p[0], q[1] - p[1]};
    sum += sqrt(squared_length(curve->metrics[k], curve->metrics[k + 1], t, law, x));
    memcpy(p, q, sizeof p);
  }
  return sum;
}

/* ---- The picture ---- */

/* The unit circle { x : x^T M x = 1 } around a point. */
static void draw_circle(FILE* file, const double* centre, const struct plane_curve* curve, double s, int law) {
  const int64_t k = metrics_around(curve, s);
  const double t = (s - curve->abscissae[k]) / (curve->abscissae[k + 1] - curve->abscissae[k]);
  /* The metric from three lengths, and its factor M = L L^T: x = L^-T (cos, sin). */
  const double along[3][2] = {{1, 0}, {0, 1}, {1, 1}};
  double q[3];
  for (int i = 0; i < 3; ++i) q[i] = squared_length(curve->metrics[k], curve->metrics[k + 1], t, law, along[i]);
  const double l11 = sqrt(q[0]), l21 = (q[2] - q[0] - q[1]) / 2 / l11, l22 = sqrt(q[1] - l21 * l21);
  fprintf(file, "<polygon class=\"metric\" points=\"");
  for (int i = 0; i < 48; ++i) {
    const double y = sin(2 * pi * i / 48) / l22, x = (cos(2 * pi * i / 48) - l21 * y) / l11;
    fprintf(file, "%.3f,%.3f ", centre[0] + x, -centre[1] - y);
  }
  fprintf(file, "\"/>\n");
}

static double size_at(const struct plane_curve* curve, int law, double s) {
  const int64_t k = metrics_around(curve, s);
  const double t = (s - curve->abscissae[k]) / (curve->abscissae[k + 1] - curve->abscissae[k]), x[2] = {1, 0};
  return 1 / sqrt(squared_length(curve->metrics[k], curve->metrics[k + 1], t, law, x));
}

/* The theorem of RR-2818 sec. 6.1: the curve u h(s) passes through each square that stands on an edge of length u. */
static int passes_through_squares(const struct plane_curve* curve, int law, int64_t n, const double* cuts, double u) {
  for (int64_t i = 0; i < n; ++i) {
    double least = HUGE_VAL, most = 0;
    for (int j = 0; j <= 100; ++j) {
      const double h = size_at(curve, law, cuts[i] + (cuts[i + 1] - cuts[i]) * j / 100);
      least = fmin(least, h), most = fmax(most, h);
    }
    const double side = (cuts[i + 1] - cuts[i]) / u;
    if (side < least * 0.999 || side > most * 1.001) return 0;
  }
  return 1;
}

/* h(s) over the squares. */
static int draw_squares(const char* path, const struct plane_curve* curve, int law, int64_t n, const double* cuts) {
  FILE* file = fopen(path, "w");
  if (!file) return 1;
  fprintf(file,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\" viewBox=\"-.1 -2.2 10.2 2.4\">\n"
          "<style>rect{fill:#4a90d922;stroke:#4a90d9;stroke-width:.012}polyline{fill:none;stroke:#222;"
          "stroke-width:.02}circle{fill:#c0392b}</style>\n");
  for (int64_t i = 0; i < n; ++i) {
    const double d = cuts[i + 1] - cuts[i];
    fprintf(file, "<rect x=\"%.4f\" y=\"%.4f\" width=\"%.4f\" height=\"%.4f\"/>\n", cuts[i], -d, d, d);
  }
  fprintf(file, "<polyline points=\"");
  for (int i = 0; i <= 400; ++i) fprintf(file, "%.3f,%.4f ", i / 40.0, -size_at(curve, law, i / 40.0));
  fprintf(file, "\"/>\n");
  for (int64_t k = 0; k < curve->m; ++k)
    fprintf(file, "<circle cx=\"%.4f\" cy=\"%.4f\" r=\".04\"/>\n", curve->abscissae[k],
            -size_at(curve, law, curve->abscissae[k]));
  fprintf(file, "</svg>\n");
  return fclose(file) != 0;
}

static int draw(const char* folder, const struct plane_curve* curve, int law, int64_t n, const double* cuts) {
  char path[4096];
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  if (snprintf(path, sizeof path, "%s/%s_%s.svg", folder, curve->name, law_names[law]) >= (int)sizeof path) return 1;
  if (strcmp(curve->name, "sizes") == 0) return draw_squares(path, curve, law, n, cuts);
  FILE* file = fopen(path, "w");
  if (!file) return 1;
  for (int64_t i = 0; i < curve->n; ++i)
    for (int k = 0; k < 2; ++k) {
      low[k] = fmin(low[k], curve->points[i][k] - 1.6);
      high[k] = fmax(high[k], curve->points[i][k] + 1.6);
    }
  fprintf(file, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\" viewBox=\"%.3f %.3f %.3f %.3f\">\n", low[0],
          -high[1], high[0] - low[0], high[1] - low[1]);
  fprintf(file,
          "<style>polyline{fill:none;stroke:#888;stroke-width:.02}.metric{fill:#4a90d922;stroke:#4a90d9;"
          "stroke-width:.012}circle{fill:#c0392b}</style>\n<polyline points=\"");
  for (int64_t i = 0; i < curve->n; ++i) fprintf(file, "%.4f,%.4f ", curve->points[i][0], -curve->points[i][1]);
  fprintf(file, "\"/>\n");
  for (int64_t i = 0; i <= n; ++i) {
    double point[2];
    point_at(curve, cuts[i], point);
    draw_circle(file, point, curve, cuts[i], law);
    fprintf(file, "<circle cx=\"%.4f\" cy=\"%.4f\" r=\"0.04\"/>\n", point[0], -point[1]);
  }
  fprintf(file, "</svg>\n");
  return fclose(file) != 0;
}

/* ---- The runs ---- */

/* Number of edges and their abscissae; NULL after an error, which is printed. */
static double* split(carreau_session* session, const carreau_curve* curve, int64_t* n, double* length) {
  double* cuts = NULL;
  if (carreau_curve_split(session, curve, 0, NULL, n, length) == CARREAU_OK) {
    cuts = malloc((size_t)(*n + 1) * sizeof *cuts);
    if (cuts && carreau_curve_split(session, curve, *n + 1, cuts, n, length) == CARREAU_OK) return cuts;
  }
  fprintf(stderr, "%s\n", carreau_last_error(session));
  free(cuts);
  return NULL;
}

static int run_plane_curve(carreau_session* session, const struct plane_curve* curve, int law, const char* folder) {
  const carreau_curve given = {.struct_size = sizeof given,
                               .dimension = 2,
                               .law = law,
                               .point_count = curve->n,
                               .metric_count = curve->m,
                               .points = &curve->points[0][0],
                               .abscissae = curve->abscissae,
                               .metrics = &curve->metrics[0][0]};
  int64_t n = 0;
  double length = 0, least = HUGE_VAL, most = 0, sum = 0;
  double* cuts = split(session, &given, &n, &length);
  if (!cuts) return 1;
  for (int64_t i = 0; i < n; ++i) {
    const double l = measured_length(curve, law, cuts[i], cuts[i + 1]);
    least = fmin(least, l), most = fmax(most, l), sum += l;
  }
  const double u = sum / (double)n;
  printf("%-8s %-10s %3" PRId64 " edges, common length u = %.4f, each edge from %+.2f %% to %+.2f %% of it\n",
         curve->name, law_names[law], n, u, 100 * (least / u - 1), 100 * (most / u - 1));
  int wrong = fabs(length / sum - 1) > 0.002 || least < 0.98 * u || most > 1.02 * u;
  if (strcmp(curve->name, "sizes") == 0) {
    static const int64_t of_the_report[] = {17, 26, 21};
    wrong |= n != of_the_report[law] || !passes_through_squares(curve, law, n, cuts, u);
  }
  if (folder && draw(folder, curve, law, n, cuts))
    wrong = 1, fprintf(stderr, "no picture could be written in %s\n", folder);
  free(cuts);
  return wrong;
}

/* A helix of radius 1 and slope 1/2. One metric holds everywhere: size 0.1 along z, 0.4 across. The length of an edge
 * has a closed form: sqrt((1 / 0.4)^2 + (0.5 / 0.1)^2) / sqrt(1.25) for each unit of usual length. */
static int run_helix(carreau_session* session) {
  enum { points = 2001 };
  const double a = 1 / (0.4 * 0.4), c = 1 / (0.1 * 0.1), metrics[2][6] = {{a, 0, 0, a, 0, c}, {a, 0, 0, a, 0, c}};
  double p[points][3], s[2] = {0, 0}, length = 0;
  int64_t n = 0;
  for (int i = 0; i < points; ++i) {
    const double t = 4 * pi * i / (points - 1);
    p[i][0] = cos(t), p[i][1] = sin(t), p[i][2] = t / 2;
    if (i > 0)
      s[1] += sqrt(pow(p[i][0] - p[i - 1][0], 2) + pow(p[i][1] - p[i - 1][1], 2) + pow(p[i][2] - p[i - 1][2], 2));
  }
  const carreau_curve given = {.struct_size = sizeof given,
                               .dimension = 3,
                               .point_count = points,
                               .metric_count = 2,
                               .points = &p[0][0],
                               .abscissae = s,
                               .metrics = &metrics[0][0]};
  double* cuts = split(session, &given, &n, &length);
  if (!cuts) return 1;
  const double exact = 4 * pi * sqrt(a + c / 4);
  int wrong = fabs(length / exact - 1) > 1e-5 || n != llround(exact);
  for (int64_t i = 0; i < n; ++i) wrong |= fabs((cuts[i + 1] - cuts[i]) * (double)n / s[1] - 1) > 1e-3;
  printf("helix    %20" PRId64 " edges, length in the metric %.5f (exact %.5f)\n", n, length, exact);
  free(cuts);
  return wrong;
}

int main(int argc, char** argv) {
  static struct plane_curve curves[3];
  carreau_session* session = NULL;
  int wrong = 0;
  if (carreau_session_create(&session) != CARREAU_OK) return 1;
  set_sizes(&curves[0]);
  set_segment(&curves[1]);
  set_closed_curve(&curves[2]);
  for (int i = 0; i < 3; ++i)
    for (int law = 0; law < 3; ++law) wrong |= run_plane_curve(session, &curves[i], law, argc > 1 ? argv[1] : NULL);
  wrong |= run_helix(session);
  if (wrong) fprintf(stderr, "an edge or a length is wrong\n");
  carreau_session_free(session);
  return wrong;
}
