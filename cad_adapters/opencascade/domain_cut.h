// SPDX-License-Identifier: BSD-3-Clause
// A domain of the (u, v) plane cut along lines of constant parameter.
#pragma once

#include <gp_Pnt2d.hxx>
#include <gp_XY.hxx>
#include <limits>
#include <optional>
#include <vector>

namespace carreau_occ {

/// The parameters of the cuts of a domain; each ascends.
struct CutLines {
  std::vector<double> u, v;  ///< of constant u, of constant v
};

/// A curve that bounds a domain, or lies inside it, by points of it. No line of the cut crosses it between its ends.
struct DomainArc {
  int end1 = 0, end2 = 0;         ///< numbers of the vertices where it begins and ends
  bool forward = true;            ///< the domain lies on its left
  bool internal = false;          ///< the domain lies on both sides
  std::vector<gp_Pnt2d> samples;  ///< two at least
};

/// A straight piece of a line, from one vertex to another; the parts on both sides share it.
struct CutEdge {
  gp_Pnt2d from, to;
  int end1 = 0, end2 = 0;
};

struct CutPart {
  struct Use {
    int curve = 0;          ///< index of an arc, or behind all arcs of a CutEdge
    bool forward = true;    ///< the part lies on its left
    bool internal = false;  ///< the part lies on both sides
  };
  std::vector<Use> uses;
  /// The cell between lines that holds it; infinite where there is no line.
  gp_XY low{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  gp_XY high{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};

struct DomainCut {
  std::vector<CutEdge> edges;
  std::vector<gp_Pnt2d> vertices;  ///< new ones, where two lines cross inside the domain
  std::vector<CutPart> parts;      ///< connected, cell by cell
};

/// `near`: ends of arcs that are no farther from a line in u or v lie on it. New vertices have numbers from
/// `next_vertex` on. A curve inside the domain that runs along a line bounds parts on both sides. Nothing: the arcs do
/// not bound a domain, or a line crosses one.
std::optional<DomainCut> cut_domain(const std::vector<DomainArc>& arcs, const CutLines& lines, gp_XY near,
                                    int next_vertex);

}  // namespace carreau_occ
