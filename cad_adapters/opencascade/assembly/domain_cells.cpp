// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/domain_cells.h"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cmath>

namespace carreau_occ {
namespace {

constexpr int cells = 64;  // in each direction
/// Steps of a border: at least so many, at least so many for each span of a spline, and at most so many.
constexpr int min_steps = 64, steps_of_span = 8, max_steps = 1 << 14;
constexpr int unknown = -2;

}  // namespace

DomainCells::DomainCells(const TopoDS_Face& face) : exact_(face, Precision::PConfusion()) {
  double u = 0, v = 0;
  BRepTools::UVBounds(face, u_, u, v_, v);
  du_ = (u - u_) / cells, dv_ = (v - v_) / cells;
  if (!(du_ > 0) || !(dv_ > 0) || !std::isfinite(du_) || !std::isfinite(dv_)) return;
  part_.assign(cells * cells, unknown);
  if (mark_borders(face))
    number_parts();
  else
    part_.clear();
}

int DomainCells::cell_of(const gp_Pnt2d& uv) const {
  const double i = std::floor((uv.X() - u_) / du_), j = std::floor((uv.Y() - v_) / dv_);
  return i >= 0 && i < cells && j >= 0 && j < cells ? static_cast<int>(j) * cells + static_cast<int>(i) : -1;
}

// Steps are shorter than half a cell, and the cells around each step belong to the border.
bool DomainCells::mark_borders(const TopoDS_Face& face) {
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    double a = 0, b = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edges.Current()), face, a, b);
    if (curve.IsNull()) return false;
    const int spans = Geom2dAdaptor_Curve(curve, a, b).NbIntervals(GeomAbs_CN);
    int steps = std::max(min_steps, steps_of_span * spans);
    for (bool fine = false; !fine; steps *= 2) {
      if (steps > max_steps) return false;
      fine = true;
      gp_Pnt2d last = curve->Value(a);
      for (int k = 0; k <= steps && fine; ++k) {
        const gp_Pnt2d p = curve->Value(a + (b - a) * k / steps);
        fine = std::abs(p.X() - last.X()) <= du_ / 2 && std::abs(p.Y() - last.Y()) <= dv_ / 2;
        last = p;
        const auto clamped = [](double x) { return static_cast<int>(std::clamp(std::floor(x), -2.0, cells + 1.0)); };
        const int i = clamped((p.X() - u_) / du_), j = clamped((p.Y() - v_) / dv_);
        for (int y = std::max(j - 1, 0); y <= std::min(j + 1, cells - 1); ++y)
          for (int x = std::max(i - 1, 0); x <= std::min(i + 1, cells - 1); ++x) part_[static_cast<std::size_t>(y * cells + x)] = -1;
      }
    }
  }
  return true;
}

void DomainCells::number_parts() {
  std::vector<int> open;
  const auto take = [&](int cell, int part) {
    int& known = part_[static_cast<std::size_t>(cell)];
    if (known == unknown) known = part, open.push_back(cell);
  };
  for (int first = 0; first < cells * cells; ++first) {
    if (part_[static_cast<std::size_t>(first)] != unknown) continue;
    const int part = static_cast<int>(state_.size());
    state_.emplace_back();
    take(first, part);
    while (!open.empty()) {
      const int cell = open.back(), i = cell % cells;
      open.pop_back();
      if (i > 0) take(cell - 1, part);
      if (i + 1 < cells) take(cell + 1, part);
      if (cell >= cells) take(cell - cells, part);
      if (cell + cells < cells * cells) take(cell + cells, part);
    }
  }
}

TopAbs_State DomainCells::state(const gp_Pnt2d& uv) {
  const int cell = part_.empty() ? -1 : cell_of(uv);
  const int part = cell < 0 ? -1 : part_[static_cast<std::size_t>(cell)];
  if (part < 0) return exact_.Perform(uv);
  std::optional<TopAbs_State>& known = state_[static_cast<std::size_t>(part)];
  if (!known) known = exact_.Perform(uv);
  return *known;
}

}  // namespace carreau_occ
