/* SPDX-License-Identifier: BSD-3-Clause */
/* The three annuli of Atlas fig. 5.26 to 5.28: pictures of the lines of both parameters, the pivots and the pseudo-skeleton, and
 * the parameters themselves as OpenEXR files.
 *
 *   c_annuli [FOLDER]        writes squares.png, squares.exr, hexagons.png, ... and prints how much of each annulus is covered
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
  carreau_annulus_build(annulus, f->n, f->inner, f->m, f->outer, CARREAU_BORDER_CUBIC, 0);
  const double simple = covered(annulus, f);
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
  printf("%-9s %2d pivots; covered by splines %.3f, by one cubic a pivot %.3f\n", f->name, (int)count, covered(annulus, f), simple);
  carreau_annulus_free(annulus);
  return 0;
}

int main(int argc, char** argv) {
  for (size_t k = 0; k < sizeof figures / sizeof *figures; ++k)
    if (draw(&figures[k], argc > 1 ? argv[1] : ".") != 0) return 1;
  return 0;
}
