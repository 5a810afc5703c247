// SPDX-License-Identifier: BSD-3-Clause
#include "projection/face_leaves.h"

#include <algorithm>
#include <cmath>

#include "projection/thresholds.h"
#include "support/infinity.h"
#include "support/pieces.h"
#include "support/shares.h"

namespace carreau::projection {

namespace {

namespace limit = thresholds::projection;

constexpr int side = 5;  // samples of a side of a cell
using Samples = std::array<Vec3, side * side>;
const Vec3& sample(const Samples& samples, int i, int j) { return samples[static_cast<std::size_t>(side * j + i)]; }

struct Shape {
  std::array<double, 3> value, slope, bend;
};

/// Quadratic Lagrange polynomials of the places 0, 1/2, 1.
Shape shape_at(double w) {
  return {{(2 * w - 1) * (w - 1), 4 * w * (1 - w), w * (2 * w - 1)}, {4 * w - 3, 4 - 8 * w, 4 * w - 1}, {4, -8, 4}};
}

SurfaceJet interpolated(const std::array<Vec3, 9>& at, const Vec2& w) {
  const Shape u = shape_at(w.x()), v = shape_at(w.y());
  SurfaceJet jet;
  for (std::size_t j = 0; j < 3; ++j) {
    Vec3 s, su, suu;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = at[3 * j + i];
      s += u.value[i] * p, su += u.slope[i] * p, suu += u.bend[i] * p;
    }
    jet.s += v.value[j] * s, jet.su += v.value[j] * su, jet.suu += v.value[j] * suu;
    jet.sv += v.slope[j] * s, jet.suv += v.slope[j] * su, jet.svv += v.bend[j] * s;
  }
  return jet;
}

/// Coefficients of the polynomial through values at 0, 1/2, 1.
std::array<Vec3, 3> polynomial_of(const Vec3& p, const Vec3& q, const Vec3& r) {
  return {p, Vec3(-3 * p + 4 * q - r), Vec3(2 * p - 4 * q + 2 * r)};
}

std::array<Vec3, 9> terms_of(const std::array<Vec3, 9>& at) {
  std::array<Vec3, 9> rows, terms;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::array<Vec3, 3> row = polynomial_of(at[3 * j], at[3 * j + 1], at[3 * j + 2]);
    for (std::size_t i = 0; i < 3; ++i) rows[3 * j + i] = row[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<Vec3, 3> column = polynomial_of(rows[i], rows[3 + i], rows[6 + i]);
    for (std::size_t j = 0; j < 3; ++j) terms[3 * j + i] = column[j];
  }
  return terms;
}

SurfaceJet at_terms(const std::array<Vec3, 9>& c, const Vec2& w) {
  const double u = w.x(), v = w.y();
  const Vec3 p = c[0] + u * (c[1] + u * c[2]), q = c[3] + u * (c[4] + u * c[5]), r = c[6] + u * (c[7] + u * c[8]);
  const Vec3 pu = c[1] + 2 * u * c[2], qu = c[4] + 2 * u * c[5], ru = c[7] + 2 * u * c[8];
  SurfaceJet jet;
  jet.s = p + v * (q + v * r), jet.sv = q + 2 * v * r, jet.svv = 2 * r;
  jet.su = pu + v * (qu + v * ru), jet.suv = qu + 2 * v * ru;
  jet.suu = 2 * (c[2] + v * (c[5] + v * c[8]));
  return jet;
}

/// Around points, `margin` farther, along the lines of the middle of a leaf.
template <typename Points>
TurnedBox turned_box(const std::array<Vec3, 9>& at, const Points& points, double margin) {
  TurnedBox box{at[4], {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  const Vec3 along = at[5] - at[3], across = at[7] - at[1], normal = cross(along, across);
  if (norm(normal) > 1e-6 * norm(along) * norm(across) && norm(along) > 0 && norm(across) > 0) {
    box.axes[0] = along / norm(along), box.axes[2] = normal / norm(normal);
    box.axes[1] = cross(box.axes[2], box.axes[0]);
  }
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) {
      const double on = dot(Vec3(p - box.origin), box.axes[static_cast<std::size_t>(k)]);
      box.low[k] = std::min(box.low[k], on), box.high[k] = std::max(box.high[k], on);
    }
  const Vec3 by{margin, margin, margin};
  box.low -= by, box.high += by;
  return box;
}

std::array<Vec3, 9> nine_of(const Samples& samples) {
  std::array<Vec3, 9> at;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) at[static_cast<std::size_t>(3 * j + i)] = sample(samples, 2 * i, 2 * j);
  return at;
}

struct Cell {
  Vec2 low, high;
  bool cut = false;
  int depth = 0;
};

struct Judgement {
  double size = 0, error = 0, bulge = 0;
  bool in_u = false, in_v = false;  // to be halved
  bool known = true;                // all samples are finite
};

double angle_between(const Vec3& p, const Vec3& q) { return std::atan2(norm(cross(p, q)), dot(p, q)); }

/// How much a line of samples turns, and how far it leaves its middle parabola.
struct Line {
  double turn = 0, off = 0, bulge = 0;
};

Line line_of(const std::array<Vec3, side>& p, double size) {
  Line line;
  const Vec3 first = p[1] - p[0], last = p[4] - p[3];
  if (norm(first) > 1e-9 * size && norm(last) > 1e-9 * size) line.turn = angle_between(first, last);
  for (const double w : {0.25, 0.75}) {
    const Shape shape = shape_at(w);
    const Vec3 q = shape.value[0] * p[0] + shape.value[1] * p[2] + shape.value[2] * p[4];
    line.off = std::max(line.off, norm(q - p[w < 0.5 ? 1 : 3]));
  }
  for (std::size_t i = 1; i + 1 < side; ++i) line.bulge = std::max(line.bulge, norm(p[i - 1] - 2 * p[i] + p[i + 1]) / 8);
  return line;
}

Judgement judge(const Samples& samples, double smallest) {
  Judgement judgement;
  BoxTree::Box box;
  for (const Vec3& p : samples) {
    if (!is_finite(p)) judgement.known = false;
    box.add(p);
  }
  if (!judgement.known) {
    judgement.in_u = judgement.in_v = true;
    return judgement;
  }
  judgement.size = norm(box.high - box.low);
  const std::array<Vec3, 9> nine = nine_of(samples);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      judgement.error = std::max(judgement.error, norm(interpolated(nine, {i / 4.0, j / 4.0}).s - sample(samples, i, j)));
  if (!(judgement.size > smallest)) return judgement;
  Line u, v;
  const auto widen = [](Line& all, const Line& one) {
    all = {std::max(all.turn, one.turn), std::max(all.off, one.off), std::max(all.bulge, one.bulge)};
  };
  for (int k = 0; k < side; ++k) {
    std::array<Vec3, side> along_u, along_v;
    for (int i = 0; i < side; ++i) along_u[static_cast<std::size_t>(i)] = sample(samples, i, k), along_v[static_cast<std::size_t>(i)] = sample(samples, k, i);
    widen(u, line_of(along_u, judgement.size)), widen(v, line_of(along_v, judgement.size));
  }
  judgement.bulge = u.bulge + v.bulge;
  const double most = limit::error_of_leaf * judgement.size;
  judgement.in_u = u.turn > limit::turn_of_leaf || u.off > most, judgement.in_v = v.turn > limit::turn_of_leaf || v.off > most;
  if (!judgement.in_u && !judgement.in_v && judgement.error > most) judgement.in_u = judgement.in_v = true;
  return judgement;
}

void add_children(const Cell& cell, const Judgement& judgement, std::vector<Cell>& to) {
  const Vec2 middle = (cell.low + cell.high) / 2;
  const int nu = judgement.in_u ? 2 : 1, nv = judgement.in_v ? 2 : 1;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      Cell child = cell;
      ++child.depth;
      if (nu == 2) (i == 0 ? child.high : child.low).x() = middle.x();
      if (nv == 2) (j == 0 ? child.high : child.low).y() = middle.y();
      to.push_back(child);
    }
}

BoxTree::Box box_of(const Samples& samples, double margin) {
  BoxTree::Box box;
  for (const Vec3& p : samples) box.add(p);
  const Vec3 by{margin, margin, margin};
  box.low -= by, box.high += by;
  return box;
}

BoxTree::Box box_of(const CurveLeaf& leaf) {
  BoxTree::Box box;
  box.add(leaf.from), box.add(leaf.to);
  const Vec3 by{leaf.error, leaf.error, leaf.error};
  box.low -= by, box.high += by;
  return box;
}

void add_curve(int face, int curve, const CurveSupport& support, std::vector<CurveLeaf>& to) {
  double length = 0;
  for (std::size_t i = 1; i < support.t.size(); ++i) length += norm(support.xyz[i] - support.xyz[i - 1]);
  for (std::size_t i = 1; i < support.t.size(); ++i)
    to.push_back({face, curve, support.t[i - 1], support.t[i], support.t.front(), support.t.back(), support.xyz[i - 1], support.xyz[i],
                  limit::beside_chord * norm(support.xyz[i] - support.xyz[i - 1]) + 1e-5 * length});
}

/// Points of a parallelogram are no farther from its nearest corner than half of its longer diagonal.
double cover_of(const SurfaceLeaf& leaf, double bulge) {
  double most = 0;
  for (const std::size_t k : {0U, 1U, 3U, 4U}) {
    const auto& p = leaf.at;
    most = std::max({most, norm(p[k] - p[k + 4]), norm(p[k + 1] - p[k + 3])});
    if (leaf.region.triangle) most = std::max({most, 2 * norm(p[k] - p[k + 1]), 2 * norm(p[k] - p[k + 3])});
  }
  return most / 2 + leaf.error + limit::error_margin * bulge;
}

std::vector<Cell> first_cells(const Vec2& low, const Vec2& high) {
  std::vector<Cell> cells;
  constexpr int n = limit::first_cells;
  const auto at = [&](int i, int j) -> Vec2 {
    return {i == n ? high.x() : low.x() + i * (high.x() - low.x()) / n, j == n ? high.y() : low.y() + j * (high.y() - low.y()) / n};
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) cells.push_back({at(i, j), at(i + 1, j + 1)});
  return cells;
}

constexpr int deepest = 20;

/// Both eigenvalues of the Hessian are positive, and not small.
bool is_convex(const Symmetric2& h, const Symmetric2& form) {
  const double det = h.xx * h.yy - h.xy * h.xy, sum = h.xx * form.yy + h.yy * form.xx;
  return h.xx > 0 && form.xx * form.yy > 0 && det * form.xx * form.yy > limit::regular_hessian * sum * sum;
}

/// The minimum of a convex quadratic function over the unit square, from a place in it.
RestrictedStep step_in_square(const Vec2& w, const Vec2& g, const Symmetric2& h) {
  const double det = h.xx * h.yy - h.xy * h.xy;
  const auto gain_of = [&](const Vec2& d) { return -dot(g, d) - 0.5 * (h.xx * d.x() * d.x() + 2 * h.xy * d.x() * d.y() + h.yy * d.y() * d.y()); };
  RestrictedStep step;
  step.d = {-(h.yy * g.x() - h.xy * g.y()) / det, -(h.xx * g.y() - h.xy * g.x()) / det};
  step.to = w + step.d;
  const Vec2 inside = step.to.cwiseMax(Vec2(0, 0)).cwiseMin(Vec2(1, 1));
  if (inside == step.to) {
    step.gain = -0.5 * dot(g, step.d);
    return step;
  }
  // The minimum lies on a side beyond which the free minimum lies.
  const Vec2 beyond = step.to;
  step.gain = -infinity;
  if (inside.x() != beyond.x()) {
    const double dx = inside.x() - w.x(), y = std::clamp(w.y() - (g.y() + h.xy * dx) / h.yy, 0.0, 1.0);
    step.to = {inside.x(), y}, step.d = step.to - w, step.gain = gain_of(step.d);
  }
  if (inside.y() != beyond.y()) {
    const double dy = inside.y() - w.y(), x = std::clamp(w.x() - (g.x() + h.xy * dy) / h.xx, 0.0, 1.0);
    const Vec2 to{x, inside.y()}, d = to - w;
    if (const double gain = gain_of(d); gain > step.gain) step.to = to, step.d = d, step.gain = gain;
  }
  return step;
}

}  // namespace

NearestSample nearest_sample(const SurfaceLeaf& leaf, const Vec3& x) {
  NearestSample nearest{0, infinity};
  for (std::size_t k = 0; k < 9; ++k) {
    if (leaf.region.triangle && k % 3 + k / 3 > 2) continue;
    const Vec3 r = leaf.at[k] - x;
    if (const double d = dot(r, r); d < nearest.square) nearest = {k, d};
  }
  return nearest;
}

LeafPlace nearest_on(const SurfaceLeaf& leaf, const Vec3& x, const NearestSample& from) {
  double least = from.square, slack = 0;
  const Region unit{{0, 0}, {1, 1}, leaf.region.triangle};
  Vec2 w{static_cast<double>(from.rank % 3) / 2, static_cast<double>(from.rank / 3) / 2};
  Vec2 best = w;
  for (int k = 0; k < 6; ++k) {
    const SurfaceJet jet = at_terms(leaf.terms, w);
    const Vec3 r = jet.s - x;
    const double d = dot(r, r);
    if (k > 0 && !(d < least)) break;
    least = d, best = w;
    const Symmetric2 form{dot(jet.su, jet.su), dot(jet.su, jet.sv), dot(jet.sv, jet.sv)};
    const Symmetric2 hessian{form.xx + dot(r, jet.suu), form.xy + dot(r, jet.suv), form.yy + dot(r, jet.svv)};
    const Vec2 gradient{dot(r, jet.su), dot(r, jet.sv)};
    RestrictedStep step;
    if (!leaf.region.triangle && is_convex(hessian, form))
      step = step_in_square(w, gradient, hessian);
    else
      step = restricted_step(unit, w, gradient, hessian, form);
    const double move = norm(step.d);
    if (move < limit::last_step_in_leaf) {  // the expansion holds over such a step, but for the slack
      best = step.to, least = std::max(0.0, least - 2 * step.gain), slack = move * std::sqrt(move) * leaf.size;
      break;
    }
    w = step.to;
  }
  return {leaf.region.low + Vec2(best.cwiseProduct(leaf.region.size())), std::sqrt(least), slack};
}

LeafPlace nearest_on(const CurveLeaf& leaf, const Vec3& x) {
  const Vec3 d = leaf.to - leaf.from;
  const double square = dot(d, d), share = square > 0 ? std::clamp(dot(x - leaf.from, d) / square, 0.0, 1.0) : 0;
  return {{leaf.t0 + share * (leaf.t1 - leaf.t0), 0}, norm(leaf.from + share * d - x), 0};
}

void Pieces::plant() {
  std::vector<Vec3> centres;
  centres.reserve(boxes.size());
  for (const BoxTree::Box& each : boxes) centres.push_back((each.low + each.high) / 2), box.add(each);
  tree = BoxTree(boxes, centres);
}

Pieces pieces_of_face(const Model& model, std::size_t face, const std::vector<CurveSupport>& supports, const EvaluateFace& evaluate, Monitor& monitor) {
  Pieces pieces;
  const Face& of = model.faces[face];
  const auto [low, high] = box_of_boundary(of, supports);
  pieces.region = {low, high};
  if (low.x() < high.x() && low.y() < high.y()) {
    if (!is_box(of, supports, low, high)) pieces.domain.emplace(of, supports);
    BoxTree::Box extent;
    for (const CurveSupport& support : supports)
      for (const Vec3& p : support.xyz) extent.add(p);
    const double smallest = shares::negligible * norm(extent.high - extent.low);
    std::vector<Cell> cells = first_cells(low, high), next;
    std::vector<Vec2> uv;
    std::vector<SurfaceJet> jets;
    for (std::size_t made = 0; !cells.empty(); cells.swap(next), next.clear()) {
      if (pieces.domain) {
        std::vector<Cell> inside;
        for (Cell& cell : cells) {
          const TrimmedDomain::Side where = pieces.domain->side_of(cell.low, cell.high);
          cell.cut = where == TrimmedDomain::Side::crossing;
          if (where != TrimmedDomain::Side::outside) inside.push_back(cell);
        }
        cells.swap(inside);
      }
      made += cells.size();
      for_pieces(cells.size(), 64, [&](std::size_t first, std::size_t n) {
        monitor.checkpoint();
        uv.clear();
        for (std::size_t c = first; c < first + n; ++c)
          for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
              const Vec2 size = cells[c].high - cells[c].low;
              uv.emplace_back(i == side - 1 ? cells[c].high.x() : cells[c].low.x() + i / 4.0 * size.x(),
                              j == side - 1 ? cells[c].high.y() : cells[c].low.y() + j / 4.0 * size.y());
            }
        jets.resize(uv.size());
        evaluate(uv, jets);
        for (std::size_t c = 0; c < n; ++c) {
          const Cell& cell = cells[first + c];
          Samples samples;
          for (std::size_t k = 0; k < samples.size(); ++k) samples[k] = jets[c * samples.size() + k].s;
          const Judgement judgement = judge(samples, smallest);
          if ((judgement.in_u || judgement.in_v) && cell.depth < (judgement.known ? deepest : 8) && made < limit::max_cells) {
            add_children(cell, judgement, next);
            continue;
          }
          if (!judgement.known) continue;  // beside the domain
          const double error = limit::error_margin * judgement.error;
          pieces.leaves.push_back({{cell.low, cell.high}, nine_of(samples), error, judgement.size, 0, cell.cut});
          SurfaceLeaf& leaf = pieces.leaves.back();
          const double margin = error + limit::error_margin * judgement.bulge;
          leaf.cover = cover_of(leaf, judgement.bulge), leaf.terms = terms_of(leaf.at), leaf.box = turned_box(leaf.at, samples, margin);
          pieces.boxes.push_back(box_of(samples, margin));
        }
      });
    }
  }
  if (pieces.domain || pieces.leaves.empty())
    for (std::size_t c = 0; c < supports.size(); ++c)
      if (of.curves[c].type == CurveType::boundary) add_curve(static_cast<int>(face), static_cast<int>(c), supports[c], pieces.curves);
  for (const CurveLeaf& leaf : pieces.curves) pieces.boxes.push_back(box_of(leaf));
  pieces.plant();
  return pieces;
}

Pieces pieces_of_triangles(std::span<const Region> regions, const EvaluateFace& evaluate, Monitor& monitor) {
  Pieces pieces;
  pieces.triangles = true;
  std::vector<Vec2> uv;
  std::vector<SurfaceJet> jets;
  std::vector<Vec3> places;
  for_pieces(regions.size(), 64, [&](std::size_t first, std::size_t n) {
    monitor.checkpoint();
    uv.clear();
    for (std::size_t t = first; t < first + n; ++t)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i + j < side; ++i) uv.push_back(regions[t].low + Vec2(Vec2(i / 4.0, j / 4.0).cwiseProduct(regions[t].size())));
    jets.resize(uv.size());
    evaluate(uv, jets);
    const std::size_t each = uv.size() / n;
    places.clear();
    for (const SurfaceJet& jet : jets) places.push_back(jet.s);
    for (std::size_t t = 0; t < n; ++t) {
      const auto at = [&](int i, int j) -> const Vec3& { return jets[t * each + static_cast<std::size_t>(side * j - j * (j - 1) / 2 + i)].s; };
      SurfaceLeaf leaf;
      leaf.region = regions[first + t];
      leaf.region.triangle = true;
      // The quadratic polynomial of six places, by its values beyond the hypotenuse.
      const Vec3 a = at(0, 0), b = at(4, 0), c = at(0, 4), ab = at(2, 0), ac = at(0, 2), bc = at(2, 2);
      const auto polynomial = [&](double u, double v) -> Vec3 {
        const double w = 1 - u - v;
        return w * (2 * w - 1) * a + u * (2 * u - 1) * b + v * (2 * v - 1) * c + 4 * u * w * ab + 4 * v * w * ac + 4 * u * v * bc;
      };
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) leaf.at[static_cast<std::size_t>(3 * j + i)] = polynomial(i / 2.0, j / 2.0);
      BoxTree::Box box;
      for (int j = 0; j < side; ++j)
        for (int i = 0; i + j < side; ++i) {
          box.add(at(i, j));
          leaf.error = std::max(leaf.error, limit::error_margin * norm(polynomial(i / 4.0, j / 4.0) - at(i, j)));
        }
      leaf.size = norm(box.high - box.low);
      const double bulge = (norm(a - 2 * ab + b) + norm(a - 2 * ac + c) + norm(b - 2 * bc + c)) / 16;
      leaf.cover = cover_of(leaf, bulge), leaf.terms = terms_of(leaf.at);
      leaf.box = turned_box(leaf.at, std::span<const Vec3>(places.data() + t * each, each), leaf.error + bulge);
      const Vec3 by = (leaf.error + bulge) * Vec3(1, 1, 1);
      box.low -= by, box.high += by;
      pieces.leaves.push_back(leaf), pieces.boxes.push_back(box);
    }
  });
  pieces.plant();
  return pieces;
}

Pieces pieces_of_curve(int face, int curve, const CurveSupport& support) {
  Pieces pieces;
  add_curve(face, curve, support, pieces.curves);
  for (const CurveLeaf& leaf : pieces.curves) pieces.boxes.push_back(box_of(leaf));
  pieces.plant();
  return pieces;
}

}  // namespace carreau::projection
