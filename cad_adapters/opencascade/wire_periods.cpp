// SPDX-License-Identifier: BSD-3-Clause
#include "wire_periods.h"

#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

#include "wire_order.h"

namespace carreau_occ {

Periods periods_of(Handle(Geom_Surface) surface) {
  while (!surface.IsNull() && surface->IsKind(STANDARD_TYPE(Geom_RectangularTrimmedSurface)))
    surface = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface)->BasisSurface();
  Periods periods;
  if (surface.IsNull()) return periods;
  if (surface->IsUPeriodic()) periods.u = surface->UPeriod();
  if (surface->IsVPeriodic()) periods.v = surface->VPeriod();
  return periods;
}

namespace {

bool meet(gp_Pnt2d p, gp_Pnt2d q, Periods periods) {
  constexpr double share = 0.01;  // of a period
  return (periods.u == 0 || std::abs(p.X() - q.X()) < share * periods.u) &&
         (periods.v == 0 || std::abs(p.Y() - q.Y()) < share * periods.v);
}

bool follows(const EdgeImage& image, const EdgeImage& before) {
  return TopExp::LastVertex(before.edge, Standard_True).IsSame(TopExp::FirstVertex(image.edge, Standard_True));
}

}  // namespace

// Neighbours in the wire first, they nearly always are.
bool closes(const std::vector<EdgeImage>& loop, Periods periods) {
  const std::size_t n = loop.size();
  std::vector<char> taken(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    const auto take = [&](std::size_t i) {
      if (taken[i] != 0 || !follows(loop[i], loop[k]) || !meet(end_of(loop[k]), start_of(loop[i]), periods))
        return false;
      taken[i] = 1;
      return true;
    };
    bool found = take((k + 1) % n) || take((k + n - 1) % n);
    for (std::size_t i = 0; i < n && !found; ++i) found = take(i);
    if (!found) return false;
  }
  return true;
}

std::vector<EdgeImage> in_order(const std::vector<EdgeImage>& loop) {
  std::vector<std::size_t> path, circuit;
  std::vector<char> taken(loop.size(), 0);
  if (!loop.empty()) path.push_back(0), taken[0] = 1;
  while (!path.empty()) {
    std::size_t next = 0;
    while (next < loop.size() && (taken[next] != 0 || !follows(loop[next], loop[path.back()]))) ++next;
    if (next < loop.size()) {
      taken[next] = 1;
      path.push_back(next);
    } else {
      circuit.push_back(path.back());
      path.pop_back();
    }
  }
  std::vector<EdgeImage> ordered;
  for (auto i = circuit.rbegin(); i != circuit.rend(); ++i) {
    if (!ordered.empty() && !follows(loop[*i], ordered.back())) return {};
    ordered.push_back(loop[*i]);
  }
  if (ordered.size() != loop.size() || (!ordered.empty() && !follows(ordered.front(), ordered.back()))) return {};
  return ordered;
}

double whole_periods(double distance, double period) { return period > 0 ? period * std::round(distance / period) : 0; }

void move(EdgeImage& image, gp_Vec2d by) {
  if (by.SquareMagnitude() > 0) image.curve = Handle(Geom2d_Curve)::DownCast(image.curve->Translated(by));
}

LoopArea area_of(const std::vector<EdgeImage>& loop) {
  constexpr int chords = 16;  // of a curve: the polygon of a circle that is one edge has its area within 3 %
  LoopArea found;
  gp_XY origin, low(0, 0), high(0, 0), sum(0, 0);
  bool any = false;
  for (const EdgeImage& image : loop) {
    if (!bounds(image)) continue;
    if (!any) origin = start_of(image).XY();
    any = true;
    gp_XY before = start_of(image).XY() - origin;
    for (int i = 0; i <= chords; ++i) {
      const double share = static_cast<double>(is_forward(image) ? i : chords - i) / chords;
      const gp_XY at = image.curve->Value(image.first + share * (image.last - image.first)).XY() - origin;
      found.area += (before ^ at) / 2;
      found.perimeter += (at - before).Modulus();
      sum += at - before;
      before = at;
      low.SetCoord(std::min(low.X(), at.X()), std::min(low.Y(), at.Y()));
      high.SetCoord(std::max(high.X(), at.X()), std::max(high.Y(), at.Y()));
    }
  }
  found.gap = sum.Modulus();
  found.width = high.X() - low.X(), found.height = high.Y() - low.Y();
  return found;
}

void chain(std::vector<EdgeImage>& loop, Periods periods) {
  for (std::size_t i = 1; i < loop.size(); ++i) {
    const gp_Pnt2d from = start_of(loop[i]), to = end_of(loop[i - 1]);
    move(loop[i], {whole_periods(to.X() - from.X(), periods.u), whole_periods(to.Y() - from.Y(), periods.v)});
  }
}

namespace {

/// The chain of the loop, where the surface begins.
std::vector<EdgeImage> moved(std::vector<EdgeImage> loop, Periods periods, const Handle(Geom_Surface) & surface) {
  chain(loop, periods);
  gp_Pnt2d low = start_of(loop.front());
  for (const EdgeImage& image : loop) {
    const gp_Pnt2d start = start_of(image);
    low = {std::min(low.X(), start.X()), std::min(low.Y(), start.Y())};
  }
  double u = 0, u_end = 0, v = 0, v_end = 0;
  surface->Bounds(u, u_end, v, v_end);
  constexpr double rounding = 1e-6;
  const auto to_bounds = [](double bound, double lowest, double period) {
    return period > 0 && std::abs(bound) < Precision::Infinite()
               ? -period * std::floor((lowest - bound) / period + rounding)
               : 0;
  };
  const gp_Vec2d by(to_bounds(u, low.X(), periods.u), to_bounds(v, low.Y(), periods.v));
  for (EdgeImage& image : loop) move(image, by);
  return loop;
}

/// A closed edge that runs the wrong way has both ends at its vertex all the same. The loop that results, empty: none
/// closes. Outer borders are counterclockwise.
std::vector<EdgeImage> with_a_closed_edge_turned(const std::vector<EdgeImage>& loop, Periods periods,
                                                 const Handle(Geom_Surface) & surface) {
  std::vector<EdgeImage> best;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (!TopExp::FirstVertex(loop[i].edge).IsSame(TopExp::LastVertex(loop[i].edge))) continue;
    std::vector<EdgeImage> turned = loop;
    turned[i].edge.Reverse();
    turned = moved(std::move(turned), periods, surface);
    if (!closes(turned, periods)) continue;
    if (area_of(turned).area > 0) return turned;
    if (best.empty()) best = std::move(turned);
  }
  return best;
}

bool is_falsely_degenerate(const EdgeImage& image, const Handle(Geom_Surface) & surface) {
  if (!BRep_Tool::Degenerated(image.edge)) return false;
  constexpr int samples = 8;
  Bnd_Box box;
  for (int i = 0; i <= samples; ++i) {
    const gp_Pnt2d uv = image.curve->Value(image.first + i * (image.last - image.first) / samples);
    box.Add(surface->Value(uv.X(), uv.Y()));
  }
  const double tolerance = std::max(BRep_Tool::Tolerance(image.edge), Precision::Confusion());
  return std::sqrt(box.SquareExtent()) > 10 * tolerance;
}

}  // namespace

void close_over_periods(std::vector<EdgeImage>& wire, const TopoDS_Face& face) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  const Periods periods = periods_of(surface);
  if (periods.u == 0 && periods.v == 0) return;
  std::vector<EdgeImage> loop, plain, others;
  for (const EdgeImage& image : wire) (bounds(image) ? loop : others).push_back(image);
  for (const EdgeImage& image : loop)
    if (!is_falsely_degenerate(image, surface)) plain.push_back(image);
  if (plain.size() == loop.size() && closes(loop, periods)) return;
  plain = in_order(plain);
  if (plain.empty()) return;
  std::vector<EdgeImage> closed = moved(plain, periods, surface);
  if (!closes(closed, periods)) closed = with_a_closed_edge_turned(plain, periods, surface);
  if (closed.empty()) return;
  wire = std::move(closed);
  wire.insert(wire.end(), others.begin(), others.end());
}

}  // namespace carreau_occ
