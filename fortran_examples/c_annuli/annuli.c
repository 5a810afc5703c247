/* SPDX-License-Identifier: BSD-3-Clause */
/* The three annuli of Atlas fig. 5.26 to 5.28: pictures of the lines of both parameters, the pivots and the pseudo-skeleton, and
 * the parameters themselves as OpenEXR files. Zones of a chart by four kinds of borders, and a transition (fig. 5.22 and 5.23).
 *
 *   c_annuli [FOLDER]        writes squares.png, squares.exr, hexagons.png, ..., zones.png and transition.png, and prints how much
 *                            of each annulus is covered
 */
#include <carreau_atlas.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZE = 640, MOST = 64 };

typedef struct {
  const char* name;
  int64_t n, m;
  double inner[20], outer[20];
} figure;

static const figure figures[] = {
    {"squares", 4, 4, {-1, -1, 1, -1, 1, 1, -1, 1}, {-2, -2, 2, -2, 2, 2, -2, 2}},
    {"hexagons", 6, 6,
     {1, 0, .5, .8660254037844386, -.5, .8660254037844386, -1, 0, -.5, -.8660254037844386, .5, -.8660254037844386},
     {2, 0, 1, 1.7320508075688772, -1, 1.7320508075688772, -2, 0, -1, -1.7320508075688772, 1, -1.7320508075688772}},
    {"hook", 10, 10,
     {0, 0, 6, 0, 6, 5, 3.4, 5, 3.4, 4, 5, 4, 5, 1, 1, 1, 1, 6, 0, 6},
     {-.6, -.6, 6.6, -.6, 6.6, 5.6, 2.8, 5.6, 2.8, 3.4, 4.4, 3.4, 4.4, 1.6, 1.6, 1.6, 1.6, 6.6, -.6, 6.6}}};

enum { KINDS = 4 };
static const int32_t kinds[KINDS] = {CARREAU_BORDER_SPLINE, CARREAU_BORDER_CUBIC, CARREAU_BORDER_OUTER_SPLINE, CARREAU_BORDER_OUTER_CUBIC};

static unsigned char image[SIZE][SIZE][3];

/* From places to pixels. */
static double low[2], scale;

static void put(double x, double y, int r, int g, int b) {
  const int i = (int)((x - low[0]) * scale), j = SIZE - 1 - (int)((y - low[1]) * scale);
  if (i < 0 || j < 0 || i >= SIZE || j >= SIZE) return;
  image[j][i][0] = (unsigned char)r, image[j][i][1] = (unsigned char)g, image[j][i][2] = (unsigned char)b;
}

static void line(double ax, double ay, double bx, double by, int r, int g, int b) {
  for (int k = 0; k <= 2 * SIZE; ++k) {
    const double x = ax + (bx - ax) * k / (2 * SIZE), y = ay + (by - ay) * k / (2 * SIZE);
    put(x, y, r, g, b), put(x + 1 / scale, y, r, g, b);
  }
}

static void polygon(const double* xy, int64_t n, int r, int g, int b) {
  for (int64_t k = 0; k < n; ++k) {
    const int64_t l = (k + 1) % n;
    line(xy[2 * k], xy[2 * k + 1], xy[2 * l], xy[2 * l + 1], r, g, b);
  }
}

static uint32_t crc_of(const unsigned char* bytes, size_t n, uint32_t crc) {
  while (n-- > 0) {
    crc ^= *bytes++;
    for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
  }
  return crc;
}

static void big_endian(unsigned char* out, uint32_t value) {
  for (int k = 0; k < 4; ++k) out[k] = (unsigned char)(value >> (24 - 8 * k));
}

static void chunk(FILE* file, const char* type, unsigned char* data, size_t n) {
  unsigned char word[4];
  big_endian(word, (uint32_t)n), fwrite(word, 1, 4, file), fwrite(type, 1, 4, file), fwrite(data, 1, n, file);
  big_endian(word, ~crc_of(data, n, crc_of((const unsigned char*)type, 4, 0xffffffffu))), fwrite(word, 1, 4, file);
}

/* A picture without compression: each row is a stored block. */
static int write_png(const char* path) {
  enum { ROW = 1 + 3 * SIZE, BYTES = 2 + SIZE * (5 + ROW) + 4 };
  static unsigned char stream[BYTES];
  unsigned char head[13] = {0}, *p = stream;
  uint32_t a = 1, b = 0;
  FILE* file = fopen(path, "wb");
  if (file == NULL) return 1;
  big_endian(head, SIZE), big_endian(head + 4, SIZE), head[8] = 8, head[9] = 2;
  *p++ = 0x78, *p++ = 0x01;
  for (int j = 0; j < SIZE; ++j) {
    *p++ = j + 1 == SIZE, *p++ = ROW & 255, *p++ = ROW >> 8, *p++ = (unsigned char)~(ROW & 255), *p++ = (unsigned char)~(ROW >> 8);
    for (int k = 0; k < ROW; ++k) {
      *p = k == 0 ? 0 : (&image[j][0][0])[k - 1];
      a = (a + *p) % 65521, b = (b + a) % 65521, ++p;
    }
  }
  big_endian(p, b << 16 | a);
  fwrite("\x89PNG\r\n\x1a\n", 1, 8, file);
  chunk(file, "IHDR", head, sizeof head), chunk(file, "IDAT", stream, sizeof stream), chunk(file, "IEND", head, 0);
  return fclose(file);
}

/* Lines where a multiple of a parameter is an integer, one and a half pixels wide by its gradient. */
static int on_line(double here, double right, double up, double step, double period) {
  double dx = right - here, dy = up - here;
  if (period > 0) dx -= period * floor(dx / period + .5), dy -= period * floor(dy / period + .5);
  const double off = fabs(here / step - floor(here / step + .5)) * step;
  return off < .75 * hypot(dx, dy);
}

static void lines_of_parameters(carreau_annulus* annulus) {
  const double turn = 2 * acos(-1.);
  for (int j = 0; j < SIZE; ++j)
    for (int i = 0; i < SIZE; ++i) {
      const double x = low[0] + (i + .5) / scale, y = low[1] + (SIZE - j - .5) / scale;
      const double xy[6] = {x, y, x + 1 / scale, y, x, y + 1 / scale};
      double place[6];
      int32_t zones[3];
      carreau_annulus_invert(annulus, 3, xy, place, zones);
      int grey = zones[0] == CARREAU_ZONE_ANNULUS ? 235 : (zones[0] == CARREAU_ZONE_INSIDE ? 250 : 255);
      int red = grey, blue = grey;
      if (zones[0] == CARREAU_ZONE_ANNULUS && zones[1] == CARREAU_ZONE_ANNULUS && zones[2] == CARREAU_ZONE_ANNULUS) {
        if (on_line(place[0], place[2], place[4], .2, 0)) red = 30, grey = 90, blue = 200;
        else if (on_line(place[1], place[3], place[5], turn / 48, turn)) red = 200, grey = 60, blue = 30;
      }
      image[j][i][0] = (unsigned char)red, image[j][i][1] = (unsigned char)grey, image[j][i][2] = (unsigned char)blue;
    }
}

static double area(const double* xy, int64_t n) {
  double twice = 0;
  for (int64_t k = 0; k < n; ++k) {
    const int64_t l = (k + 1) % n;
    twice += xy[2 * k] * xy[2 * l + 1] - xy[2 * l] * xy[2 * k + 1];
  }
  return twice / 2;
}

/* Share of the polygonal annulus that the smooth one covers. */
static double covered(carreau_annulus* annulus, const figure* f) {
  enum { N = 4000 };
  static double places[2 * N], in[2 * N], out[2 * N];
  for (int side = 0; side < 2; ++side) {
    for (int k = 0; k < N; ++k) places[2 * k] = side, places[2 * k + 1] = 2 * acos(-1.) * k / N;
    carreau_annulus_points(annulus, N, places, side == 0 ? in : out, NULL);
  }
  return (area(out, N) - area(in, N)) / (area(f->outer, f->m) - area(f->inner, f->n));
}

static int draw(const figure* f, const char* folder) {
  double pivots[2 * MOST], skeleton[4 * MOST], high[2];
  int64_t count = 0, edges = 0;
  char path[1024];
  carreau_annulus* annulus;
  if (carreau_annulus_create(&annulus) != CARREAU_OK) return 1;
  double share[KINDS];
  for (int k = 0; k < KINDS; ++k)
    if (carreau_annulus_build(annulus, f->n, f->inner, f->m, f->outer, kinds[k], 0) == CARREAU_OK) share[k] = covered(annulus, f);
  if (carreau_annulus_build(annulus, f->n, f->inner, f->m, f->outer, CARREAU_BORDER_SPLINE, 0) != CARREAU_OK)
    return fprintf(stderr, "%s\n", carreau_annulus_last_error(annulus)), 1;
  carreau_annulus_pivots(annulus, MOST, pivots, &count), carreau_annulus_skeleton(annulus, MOST, skeleton, &edges);
  for (int c = 0; c < 2; ++c) {
    low[c] = high[c] = f->outer[c];
    for (int64_t k = 0; k < f->m; ++k) low[c] = fmin(low[c], f->outer[2 * k + c]), high[c] = fmax(high[c], f->outer[2 * k + c]);
    for (int64_t k = 0; k < count; ++k) low[c] = fmin(low[c], pivots[2 * k + c]), high[c] = fmax(high[c], pivots[2 * k + c]);
  }
  const double width = 1.04 * fmax(high[0] - low[0], high[1] - low[1]);
  scale = SIZE / width;
  for (int c = 0; c < 2; ++c) low[c] = (low[c] + high[c] - width) / 2;
  lines_of_parameters(annulus);
  polygon(f->inner, f->n, 0, 0, 0), polygon(f->outer, f->m, 0, 0, 0), polygon(pivots, count, 150, 150, 150);
  for (int64_t k = 0; k < edges; ++k) line(skeleton[4 * k], skeleton[4 * k + 1], skeleton[4 * k + 2], skeleton[4 * k + 3], 20, 150, 60);
  for (int64_t k = 0; k < count; ++k)
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j)
        if (i * i + j * j <= 18) put(pivots[2 * k] + i / scale, pivots[2 * k + 1] + j / scale, k % 2 == 0 ? 20 : 200, k % 2 == 0 ? 150 : 20, 60);
  snprintf(path, sizeof path, "%s/%s.png", folder, f->name);
  if (write_png(path) != 0) return fprintf(stderr, "%s cannot be written\n", path), 1;
  snprintf(path, sizeof path, "%s/%s.exr", folder, f->name);
  if (carreau_annulus_write_exr(annulus, path, SIZE) != CARREAU_OK) fprintf(stderr, "%s\n", carreau_annulus_last_error(annulus)); /* no OpenEXR */
  printf("%-9s %2d pivots; covered by splines %.3f, by one cubic a pivot %.3f; from the outer border %.3f, %.3f\n", f->name, (int)count,
         share[0], share[1], share[2], share[3]);
  carreau_annulus_free(annulus);
  return 0;
}

/* ---- An atlas of a sphere of 320 triangles: chart 0, and the neighbour that shares most of it ---- */

enum { PARTS = 4, VERTICES = 10 * PARTS * PARTS + 2, HALF = SIZE / 2 };

/* The number of a vertex, which may be new. */
static int32_t vertex_at(const double* p, double* xyz, int* count) {
  const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  for (int v = 0; v < *count; ++v)
    if (fabs(xyz[3 * v] - p[0] / length) + fabs(xyz[3 * v + 1] - p[1] / length) + fabs(xyz[3 * v + 2] - p[2] / length) < 1e-9) return v;
  for (int c = 0; c < 3; ++c) xyz[3 * *count + c] = p[c] / length;
  return (*count)++;
}

static carreau_status sphere(carreau_atlas* atlas, int32_t border) {
  const double g = 1.618033988749895;
  const double corner[12][3] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const int face[20][3] = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                           {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
  static double xyz[3 * VERTICES];
  static int32_t triangles[60 * PARTS * PARTS];
  int count = 0, m = 0;
  for (int f = 0; f < 20; ++f)
    for (int i = 0; i < PARTS; ++i)
      for (int j = 0; i + j < PARTS; ++j)
        for (int up = 0; up <= (i + j + 1 < PARTS); ++up) {
          const int at[3][2] = {{i + up, j + up}, {i + 1 - up, j + up}, {i + up, j + 1 - up}};
          for (int k = 0; k < 3; ++k) {
            double p[3];
            for (int c = 0; c < 3; ++c)
              p[c] = (PARTS - at[k][0] - at[k][1]) * corner[face[f][0]][c] + at[k][0] * corner[face[f][1]][c] + at[k][1] * corner[face[f][2]][c];
            triangles[3 * m + k] = vertex_at(p, xyz, &count);
          }
          ++m;
        }
  const carreau_atlas_options options = {.struct_size = sizeof options, .border = border};
  return carreau_atlas_build(atlas, &options, count, xyz, m, triangles, NULL);
}

/* Puts the box of a chart's annulus into a square of pixels. */
static void frame_chart(carreau_atlas* atlas, int64_t chart) {
  enum { N = 400 };
  double places[2 * N], xy[2 * N], high[2];
  carreau_atlas_chart info = {.struct_size = sizeof info};
  carreau_atlas_chart_info(atlas, chart, &info);
  for (int k = 0; k < N; ++k) places[2 * k] = 1, places[2 * k + 1] = info.period * k / N;
  carreau_atlas_annulus_points(atlas, chart, N, places, xy);
  for (int c = 0; c < 2; ++c) {
    low[c] = high[c] = xy[c];
    for (int k = 0; k < N; ++k) low[c] = fmin(low[c], xy[2 * k + c]), high[c] = fmax(high[c], xy[2 * k + c]);
  }
  const double width = 1.06 * fmax(high[0] - low[0], high[1] - low[1]);
  scale = HALF / width;
  for (int c = 0; c < 2; ++c) low[c] = (low[c] + high[c] - width) / 2;
}

static void pixels_of(double* xy) {
  for (int j = 0; j < HALF; ++j)
    for (int i = 0; i < HALF; ++i) xy[2 * (j * HALF + i)] = low[0] + (i + .5) / scale, xy[2 * (j * HALF + i) + 1] = low[1] + (HALF - j - .5) / scale;
}

static void colour(int left, int top, int pixel, int r, int g, int b) {
  unsigned char* at = image[top + pixel / HALF][left + pixel % HALF];
  at[0] = (unsigned char)r, at[1] = (unsigned char)g, at[2] = (unsigned char)b;
}

static double xy[2 * HALF * HALF], other[2 * HALF * HALF];
static int32_t zones[HALF * HALF], found[HALF * HALF], sharing[HALF * HALF];

/* Pure, double and triple zones of chart 0. Returns the neighbour with the most common places. */
static int64_t draw_zones(carreau_atlas* atlas, int left, int top) {
  carreau_atlas_counts counts = {.struct_size = sizeof counts};
  carreau_atlas_count(atlas, &counts);
  frame_chart(atlas, 0), pixels_of(xy);
  carreau_atlas_zones(atlas, 0, HALF * HALF, xy, zones, NULL);
  for (int k = 0; k < HALF * HALF; ++k) sharing[k] = 0;
  int64_t neighbour = 1;
  int most = 0;
  for (int64_t j = 1; j < counts.charts; ++j) {
    int common = 0;
    carreau_atlas_transition(atlas, 0, j, HALF * HALF, xy, other, found);
    for (int k = 0; k < HALF * HALF; ++k) common += found[k], sharing[k] += found[k];
    if (common > most) most = common, neighbour = j;
  }
  for (int k = 0; k < HALF * HALF; ++k) {
    const int grey = zones[k] == CARREAU_ZONE_OUTSIDE ? 255 : (zones[k] == CARREAU_ZONE_INSIDE ? 225 : (sharing[k] > 1 ? 90 : 165));
    colour(left, top, k, grey, grey, zones[k] == CARREAU_ZONE_OUTSIDE ? 255 : grey + 20);
  }
  return neighbour;
}

/* The part of chart i that it shares with chart j, with lines of chart 0's coordinates. */
static void draw_shared(carreau_atlas* atlas, int64_t i, int64_t j, double step, int left, int top) {
  frame_chart(atlas, i), pixels_of(xy);
  carreau_atlas_zones(atlas, i, HALF * HALF, xy, zones, NULL);
  carreau_atlas_transition(atlas, i, j, HALF * HALF, xy, other, found);
  for (int k = 0; k < HALF * HALF; ++k) {
    const double* own = i == 0 ? xy + 2 * k : other + 2 * k;
    const int dark = ((int)floor(own[0] / step) + (int)floor(own[1] / step)) & 1;
    const int grey = zones[k] == CARREAU_ZONE_OUTSIDE ? 255 : 230;
    if (found[k]) colour(left, top, k, dark ? 40 : 120, dark ? 90 : 160, 210);
    else colour(left, top, k, grey, grey, grey);
  }
}

static int draw_atlas(const char* folder) {
  char path[1024];
  carreau_atlas* atlas;
  if (carreau_atlas_create(&atlas) != CARREAU_OK) return 1;
  int64_t neighbour = 1;
  for (int k = KINDS - 1; k >= 0; --k) {
    if (sphere(atlas, kinds[k]) != CARREAU_OK) return fprintf(stderr, "%s\n", carreau_atlas_last_error(atlas)), 1;
    neighbour = draw_zones(atlas, k % 2 * HALF, k / 2 * HALF);
  }
  snprintf(path, sizeof path, "%s/zones.png", folder);
  if (write_png(path) != 0) return fprintf(stderr, "%s cannot be written\n", path), 1;
  for (int j = 0; j < SIZE; ++j)
    for (int i = 0; i < 3 * SIZE; ++i) image[j][i / 3][i % 3] = 255;
  const double step = 12 / scale;
  draw_shared(atlas, 0, neighbour, step, 0, HALF / 2), draw_shared(atlas, neighbour, 0, step, HALF, HALF / 2);
  snprintf(path, sizeof path, "%s/transition.png", folder);
  if (write_png(path) != 0) return fprintf(stderr, "%s cannot be written\n", path), 1;
  carreau_atlas_free(atlas);
  return 0;
}

int main(int argc, char** argv) {
  for (size_t k = 0; k < sizeof figures / sizeof *figures; ++k)
    if (draw(&figures[k], argc > 1 ? argv[1] : ".") != 0) return 1;
  return draw_atlas(argc > 1 ? argv[1] : ".");
}
