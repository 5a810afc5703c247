// SPDX-License-Identifier: BSD-3-Clause
#include "missing_seams.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "wire_order.h"

namespace carreau_occ {
namespace {

constexpr double closing_share = 0.01;       // of a period: as near as ends of a loop are to it
constexpr int samples_of_curve = 24;         // chords that stand for a curve where lines must not cross it
constexpr std::size_t max_candidates = 24;  // vertices of a loop at which seams may end
constexpr double end_share = 1e-6;           // of a seam, at its ends, where it meets its loops

using Loop = std::vector<EdgeImage>;
using Polyline = std::vector<gp_XY>;

/// A loop that goes round: its edges in order, one behind the other in the parameter plane.
struct Round {
  std::size_t wire = 0;
  Loop edges;
  int times = 0;  // round the surface
};

TopoDS_Vertex first_vertex(const EdgeImage& image) { return TopExp::FirstVertex(image.edge, Standard_True); }

TopoDS_Edge edge_between(const TopoDS_Vertex& from, const TopoDS_Vertex& to, bool degenerate) {
  const BRep_Builder builder;
  TopoDS_Edge edge;
  builder.MakeEdge(edge);
  builder.UpdateEdge(edge, std::max(BRep_Tool::Tolerance(from), BRep_Tool::Tolerance(to)));
  builder.Add(edge, from.Oriented(TopAbs_FORWARD));
  builder.Add(edge, to.Oriented(TopAbs_REVERSED));
  builder.Degenerated(edge, degenerate);
  return edge;
}

EdgeImage segment(const TopoDS_Edge& edge, gp_XY from, gp_XY to) {
  const gp_XY along = to - from;
  return {edge, new Geom2d_Line(gp_Pnt2d(from), gp_Dir2d(along)), 0, along.Modulus()};
}

Polyline polyline_of(const Loop& loop) {
  Polyline points;
  for (const EdgeImage& image : loop)
    for (int i = 0; i <= samples_of_curve; ++i) {
      const double share = static_cast<double>(is_forward(image) ? i : samples_of_curve - i) / samples_of_curve;
      points.push_back(image.curve->Value(image.first + share * (image.last - image.first)).XY());
    }
  return points;
}

bool cross(gp_XY a, gp_XY b, gp_XY c, gp_XY d) {
  const auto side = [](gp_XY p, gp_XY q, gp_XY r) { return (q - p) ^ (r - p); };
  return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0 &&
         (side(a, b, c) != 0 || side(a, b, d) != 0);
}

/// One direction of one face.
class SeamMaker {
 public:
  SeamMaker(std::vector<Loop>& wires, const TopoDS_Face& face, bool along_u)
      : wires_(wires), surface_(BRep_Tool::Surface(face)), periods_(periods_of(surface_)), along_u_(along_u) {}

  /// False: nothing was changed.
  bool run() {
    if (period() == 0 || !find_rounds()) return false;
    if (rounds_.size() == 1 && !add_pole()) return false;
    if (rounds_.size() != 2 || rounds_[0].times + rounds_[1].times != 0) return false;
    if (rounds_[0].times < 0) std::swap(rounds_[0], rounds_[1]);
    put_on_left();
    const std::optional<Place> place = find_place();
    if (!place) return false;
    join(*place);
    return true;
  }

 private:
  struct Place {
    std::size_t from = 0, to = 0;  // edges of the two loops that begin at the ends of the seam
    gp_XY p, q;
  };

  [[nodiscard]] double period() const { return along_u_ ? periods_.u : periods_.v; }
  [[nodiscard]] double other_period() const { return along_u_ ? periods_.v : periods_.u; }
  [[nodiscard]] gp_XY step(double by) const { return along_u_ ? gp_XY(by, 0) : gp_XY(0, by); }
  [[nodiscard]] gp_XY across(double by) const { return along_u_ ? gp_XY(0, by) : gp_XY(by, 0); }
  [[nodiscard]] double along(gp_XY p) const { return along_u_ ? p.X() : p.Y(); }
  [[nodiscard]] double beside(gp_XY p) const { return along_u_ ? p.Y() : p.X(); }

  bool find_rounds() {
    for (std::size_t w = 0; w < wires_.size(); ++w) {
      Loop loop;
      for (const EdgeImage& image : wires_[w])
        if (bounds(image)) loop.push_back(image);
      if (loop.empty()) continue;
      if (closes(loop, periods_)) {
        others_.push_back(w);
        continue;
      }
      loop = in_order(loop);
      if (loop.empty()) return false;
      chain(loop, periods_);
      const gp_XY whole = end_of(loop.back()).XY() - start_of(loop.front()).XY();
      const int times = static_cast<int>(std::lround(along(whole) / period()));
      const double rest = along(whole) - times * period();
      if (std::abs(times) != 1 || std::abs(rest) > closing_share * period() ||
          (other_period() > 0 && std::abs(beside(whole)) > closing_share * other_period()))
        return false;
      rounds_.push_back({w, std::move(loop), times});
    }
    return !rounds_.empty() && rounds_.size() <= 2;
  }

  /// The inside is on the left of a loop. If the surface ends there in one point, this is the other loop.
  bool add_pole() {
    const Round& round = rounds_.front();
    double u1 = 0, u2 = 0, v1 = 0, v2 = 0;
    surface_->Bounds(u1, u2, v1, v2);
    const bool upper = (round.times > 0) == along_u_;
    const double limit = along_u_ ? (upper ? v2 : v1) : (upper ? u2 : u1);
    if (Precision::IsInfinite(limit)) return false;
    const gp_XY start = start_of(round.edges.front()).XY(), at = start + across(limit - beside(start));
    const gp_Pnt pole = surface_->Value(at.X(), at.Y());
    for (int i = 1; i < samples_of_curve; ++i) {
      const gp_XY p = at + step(period() * i / samples_of_curve);
      if (pole.Distance(surface_->Value(p.X(), p.Y())) > Precision::Confusion()) return false;
    }
    TopoDS_Vertex vertex;
    BRep_Builder().MakeVertex(vertex, pole, Precision::Confusion());
    const gp_XY beyond = at + step(round.times * period());
    Round other{wires_.size(), {segment(edge_between(vertex, vertex, true), beyond, at)}, -round.times};
    wires_.emplace_back();
    rounds_.push_back(std::move(other));
    return true;
  }

  /// On a torus the second loop may be a period too far on the wrong side.
  void put_on_left() {
    if (other_period() == 0) return;
    const double sign = along_u_ ? 1 : -1;
    const gp_XY p = start_of(rounds_[0].edges.front()).XY(), q = start_of(rounds_[1].edges.front()).XY();
    const double ahead = sign * (beside(q) - beside(p));
    const gp_Vec2d by(across(-sign * other_period() * std::floor(ahead / other_period())));
    for (EdgeImage& image : rounds_[1].edges) move(image, by);
  }

  /// The shortest line that crosses nothing.
  [[nodiscard]] std::optional<Place> find_place() const {
    std::vector<Polyline> obstacles{polyline_of(rounds_[0].edges), polyline_of(rounds_[1].edges)};
    for (const std::size_t w : others_) obstacles.push_back(polyline_of(wires_[w]));
    std::vector<std::pair<double, Place>> candidates;
    const auto stride = [](const Loop& loop) { return 1 + loop.size() / max_candidates; };
    const Loop &from = rounds_[0].edges, &to = rounds_[1].edges;
    for (std::size_t i = 0; i < from.size(); i += stride(from))
      for (std::size_t j = 0; j < to.size(); j += stride(to)) {
        Place place{i, j, start_of(from[i]).XY(), start_of(to[j]).XY()};
        place.q += step(-period() * std::round(along(place.q - place.p) / period()));
        candidates.emplace_back((place.q - place.p).Modulus(), place);
      }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [length, place] : candidates)
      if (length > Precision::PConfusion() && is_free(place, obstacles)) return place;
    return std::nullopt;
  }

  [[nodiscard]] bool is_free(const Place& place, const std::vector<Polyline>& obstacles) const {
    const gp_XY d = place.q - place.p, a = place.p + end_share * d, b = place.q - end_share * d;
    for (const Polyline& line : obstacles)
      for (std::size_t k = 1; k < line.size(); ++k) {
        const double near = std::round((along(a) - along(line[k])) / period());
        for (int turn = -2; turn <= 2; ++turn) {
          const gp_XY by = step((near + turn) * period());
          if (cross(a, b, line[k - 1] + by, line[k] + by)) return false;
        }
      }
    return true;
  }

  static Loop beginning_at(const Loop& loop, std::size_t first) {
    Loop turned(loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
    turned.insert(turned.end(), loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first));
    return turned;
  }

  void join(const Place& place) {
    const TopoDS_Edge seam =
        edge_between(first_vertex(rounds_[0].edges[place.from]), first_vertex(rounds_[1].edges[place.to]), false);
    const gp_XY turn = step(period());
    Loop whole = beginning_at(rounds_[0].edges, place.from);
    move(whole.front(), gp_Vec2d(place.p - start_of(whole.front()).XY()));
    chain(whole, periods_);
    whole.push_back(segment(seam, place.p + turn, place.q + turn));
    Loop back = beginning_at(rounds_[1].edges, place.to);
    move(back.front(), gp_Vec2d(place.q + turn - start_of(back.front()).XY()));
    chain(back, periods_);
    whole.insert(whole.end(), back.begin(), back.end());
    whole.push_back(segment(seam, place.p, place.q));
    whole.back().edge.Reverse();
    for (const std::size_t w : others_) put_beside(place, wires_[w]);
    for (const Round& round : rounds_)
      for (const EdgeImage& image : wires_[round.wire])
        if (!bounds(image)) whole.push_back(image);
    for (const Round& round : rounds_) wires_[round.wire].clear();
    wires_[rounds_[0].wire] = std::move(whole);
  }

  /// Holes lie between the two sides of the seam.
  void put_beside(const Place& place, Loop& hole) const {
    const gp_XY at = start_of(hole.front()).XY(), d = place.q - place.p;
    const double share = beside(d) != 0 ? beside(at - place.p) / beside(d) : 0;
    const double turns = std::floor(along(at - place.p - share * d) / period());
    for (EdgeImage& image : hole) move(image, gp_Vec2d(step(-turns * period())));
  }

  std::vector<Loop>& wires_;
  Handle(Geom_Surface) surface_;
  Periods periods_;
  bool along_u_;
  std::vector<Round> rounds_;
  std::vector<std::size_t> others_;  // wires that close
};

}  // namespace

void add_missing_seams(std::vector<std::vector<EdgeImage>>& wires, const TopoDS_Face& face) {
  if (!SeamMaker(wires, face, true).run()) SeamMaker(wires, face, false).run();
}

}  // namespace carreau_occ
