// SPDX-License-Identifier: BSD-3-Clause
#include "projection/face_leaves.h"

#include <algorithm>
#include <cmath>

#include "projection/face_boundary.h"
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

/// Coefficients of the cubic polynomial through values at 0, 1/4, 3/4, 1.
std::array<Vec3, 4> cubic_of(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  return {p, Vec3((-19 * p + 24 * q - 8 * r + 3 * s) / 3), Vec3((32 * p - 56 * q + 40 * r - 16 * s) / 3), Vec3((-16 * p + 32 * q - 32 * r + 16 * s) / 3)};
}

/// Interpolates 16 of the samples: the lines of the middle measure the error.
BicubicTerms terms_of(const Samples& samples) {
  std::array<Vec3, 16> rows;
  BicubicTerms terms;
  constexpr std::array<int, 4> lines{0, 1, 3, 4};
  for (std::size_t j = 0; j < 4; ++j) {
    const auto at = [&](int i) -> const Vec3& { return sample(samples, i, lines[j]); };
    const std::array<Vec3, 4> row = cubic_of(at(0), at(1), at(3), at(4));
    for (std::size_t i = 0; i < 4; ++i) rows[4 * j + i] = row[i];
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const std::array<Vec3, 4> column = cubic_of(rows[i], rows[4 + i], rows[8 + i], rows[12 + i]);
    for (std::size_t j = 0; j < 4; ++j) terms.set(static_cast<int>(i), static_cast<int>(j), column[j]);
  }
  return terms;
}

/// The derivative of order (a, b).
Vec3 derivative_at(const BicubicTerms& terms, int a, int b, const Vec2& w) {
  const auto powers = [](int order, double t) {
    std::array<double, 4> power{};
    double rising = 1;
    for (int i = order; i < 4; ++i, rising *= t) {
      power[static_cast<std::size_t>(i)] = rising;
      for (int k = 0; k < order; ++k) power[static_cast<std::size_t>(i)] *= i - k;
    }
    return power;
  };
  const std::array<double, 4> u = powers(a, w.x()), v = powers(b, w.y());
  Vec3 sum;
  for (int j = b; j < 4; ++j)
    for (int i = a; i < 4; ++i) sum += u[static_cast<std::size_t>(i)] * v[static_cast<std::size_t>(j)] * terms.at(i, j);
  return sum;
}

/// Bounds of the terms of third order; the places between the samples get a margin.
void bound_third_order(SurfaceLeaf& leaf) {
  double first = 0, second = 0, third = 0;
  for (const double u : {0.0, 0.5, 1.0})
    for (const double v : {0.0, 0.5, 1.0}) {
      const auto size = [&](int a, int b) { return norm(derivative_at(leaf.terms, a, b, {u, v})); };
      first = std::max(first, std::hypot(size(1, 0), size(0, 1)));
      second = std::max(second, size(2, 0) + size(1, 1) + size(0, 2));
      third = std::max(third, size(3, 0) + 3 * size(2, 1) + 3 * size(1, 2) + size(0, 3));
    }
  leaf.bend = limit::error_margin / 2 * first * second / 2, leaf.third = limit::error_margin / 2 * third / 6;
}

/// Around points, `margin` farther, along the lines of the middle of a leaf.
template <typename Points>
TurnedBox turned_box(const std::array<Vec3, 9>& at, const Points& points, double margin) {
  TurnedBox box{at[4], {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, {}};
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
  for (int k = 0; k < 2; ++k) box.scale[k] = box.high[k] > box.low[k] ? std::min(1 / (box.high[k] - box.low[k]), 1e300) : 0;
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
  BicubicTerms terms;
};

double angle_between(const Vec3& p, const Vec3& q) { return std::atan2(norm(cross(p, q)), dot(p, q)); }

/// How much a line of samples turns, and how far it leaves its middle parabola.
struct Line {
  double turn = 0, off = 0, bulge = 0;
};

Line line_of(const std::array<Vec3, side>& p, double size) {
  Line line;
  const std::array<Vec3, 4> c = cubic_of(p[0], p[1], p[3], p[4]);
  const Vec3 middle = c[1] + c[2];
  Vec3 before = c[1];
  for (const Vec3& leg : {middle, Vec3(middle + c[2] + 3 * c[3])}) {  // of Bezier's polygon: its turn bounds the turn of the curve
    if (!(norm(leg) > 1e-9 * size)) continue;
    if (norm(before) > 1e-9 * size) line.turn += angle_between(before, leg);
    before = leg;
  }
  for (const auto& [near, far, between] : {std::array{p[0], p[4], p[1]}, std::array{p[4], p[0], p[3]}})
    line.off = std::max(line.off, norm((3 * near - far + 6 * p[2]) / 8 - between));
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
  judgement.terms = terms_of(samples);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      if (i == 2 || j == 2) judgement.error = std::max(judgement.error, norm(derivative_at(judgement.terms, 0, 0, {i / 4.0, j / 4.0}) - sample(samples, i, j)));
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
                  beside_chord * norm(support.xyz[i] - support.xyz[i - 1]) + 1e-5 * length});
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

}  // namespace

PieceTree::PieceTree(std::span<const Pieces> entities, std::int32_t only) : entities_(entities) {
  std::vector<Piece> pieces;
  for (std::size_t e = 0; e < entities.size(); ++e) {
    if (only >= 0 && e != static_cast<std::size_t>(only)) continue;
    const Pieces& of = entities[e];
    for (std::size_t k = 0; k < of.boxes.size(); ++k) {
      const bool is_leaf = k < of.turned.size();
      pieces.push_back({of.boxes[k], is_leaf ? of.turned[k] : TurnedBox(), static_cast<std::int32_t>(e), static_cast<std::int32_t>(k), is_leaf});
    }
  }
  std::vector<BoxTree::Box> boxes;
  std::vector<Vec3> centres;
  boxes.reserve(pieces.size()), centres.reserve(pieces.size());
  for (const Piece& piece : pieces) boxes.push_back(piece.box), centres.push_back((piece.box.low + piece.box.high) / 2);
  tree_ = BoxTree(boxes, centres);
  pieces_.reserve(pieces.size());
  for (const std::int32_t k : tree_.order()) pieces_.push_back(pieces[static_cast<std::size_t>(k)]);
}

Pieces pieces_of_face(const Model& model, std::size_t face, const std::vector<CurveSupport>& supports, const EvaluateFace& evaluate, Monitor& monitor) {
  Pieces pieces;
  const Face& of = model.faces[face];
  const auto [low, high] = box_of_boundary(of, supports);
  pieces.region = {low, high};
  if (low.x() < high.x() && low.y() < high.y()) {
    if (!is_box(of, supports, low, high)) pieces.domain.emplace(of.ref, boundary_of(of, supports));
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
          // A bound of memory.
          if ((judgement.in_u || judgement.in_v) && cell.depth < (judgement.known ? deepest : 8) && made < 40'000) {
            add_children(cell, judgement, next);
            continue;
          }
          if (!judgement.known) continue;  // beside the domain
          const double error = limit::error_margin * judgement.error;
          pieces.leaves.push_back({{cell.low, cell.high}, nine_of(samples), error, judgement.size, 0, cell.cut});
          SurfaceLeaf& leaf = pieces.leaves.back();
          const double margin = error + limit::error_margin * judgement.bulge;
          leaf.cover = cover_of(leaf, judgement.bulge), leaf.terms = judgement.terms, pieces.turned.push_back(turned_box(leaf.at, samples, margin));
          bound_third_order(leaf);
          pieces.boxes.push_back(box_of(samples, margin));
        }
      });
    }
  }
  if (pieces.domain || pieces.leaves.empty())
    for (std::size_t c = 0; c < supports.size(); ++c)
      if (of.curves[c].type == CurveType::boundary) add_curve(static_cast<int>(face), static_cast<int>(c), supports[c], pieces.curves);
  for (const CurveLeaf& leaf : pieces.curves) pieces.boxes.push_back(box_of(leaf));
  for (const BoxTree::Box& each : pieces.boxes) pieces.box.add(each);
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
      leaf.cover = cover_of(leaf, bulge);
      leaf.terms.set(0, 0, a), leaf.terms.set(1, 0, -3 * a + 4 * ab - b), leaf.terms.set(2, 0, 2 * (a - 2 * ab + b));
      leaf.terms.set(0, 1, -3 * a + 4 * ac - c), leaf.terms.set(1, 1, 4 * (a - ab - ac + bc)), leaf.terms.set(0, 2, 2 * (a - 2 * ac + c));
      bound_third_order(leaf);
      pieces.turned.push_back(turned_box(leaf.at, std::span<const Vec3>(places.data() + t * each, each), leaf.error + bulge));
      const Vec3 by = (leaf.error + bulge) * Vec3(1, 1, 1);
      box.low -= by, box.high += by;
      pieces.leaves.push_back(leaf), pieces.boxes.push_back(box);
    }
  });
  for (const BoxTree::Box& each : pieces.boxes) pieces.box.add(each);
  return pieces;
}

Pieces pieces_of_curve(int face, int curve, const CurveSupport& support) {
  Pieces pieces;
  add_curve(face, curve, support, pieces.curves);
  for (const CurveLeaf& leaf : pieces.curves) pieces.boxes.push_back(box_of(leaf));
  for (const BoxTree::Box& each : pieces.boxes) pieces.box.add(each);
  return pieces;
}

}  // namespace carreau::projection
