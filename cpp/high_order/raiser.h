// SPDX-License-Identifier: BSD-3-Clause
// Elements of order two raised to a higher order: places of their nodes, repairs, periodic images.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "high_order/raise_order.h"
#include "periodic/closest.h"
#include "surface/elements/base/poles.h"

namespace carreau {

/// Makes one mesh of a higher order.
class Raiser {
 public:
  Raiser(const CurveModel& model, const CompositeResult& result, int order, NodePlaces places, bool lowers, Monitor& monitor)
      : model_(model), result_(result), mesh_(result.mesh), lowers_(lowers), monitor_(monitor), places_(places_on_edge(order, places)), triangle_(false, order, places),
        quad_(true, order, places), p_(static_cast<std::size_t>(order)) {
    out_.order = order, out_.places = places;
    out_.nodes = mesh_.vertices, out_.corners = static_cast<std::int32_t>(mesh_.vertices.size());
    out_.corner_refs = mesh_.vertex_ref;
    node_uv_.resize(out_.nodes.size(), Vec2{0, 0});
  }

  HighOrderMesh run();

 private:
  using Key = std::array<std::int32_t, 2>;
  /// An element of a face: local corners, and its nodes.
  struct Element {
    std::int32_t face = 0;
    int corners = 3;
    std::array<std::int32_t, 4> local{-1, -1, -1, -1};
    std::array<std::int32_t, 25> node{};
  };
  static Key ordered(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }
  [[nodiscard]] const ElementShape& shape(const Element& e) const { return e.corners == 4 ? quad_ : triangle_; }

  /// First of the nodes on an edge, from its lesser vertex.
  std::int32_t add_nodes(std::size_t n);

  // The places between two vertices, at shares of the length between them.
  void place_curves();
  void list_elements();

  /// Nodes of a face with the points that they are near.
  struct Wanted {
    std::vector<std::int32_t> node;
    std::vector<Vec3> target;
    std::vector<Vec2> guess;
    std::vector<double> reach;  // farthest that a closest point may be
  };

  // Closest points; where the way leaves the sheet of the surface, or the host fails beside its domain, the guess.
  void place(std::size_t f, const Wanted& wanted);
  void place_edges(std::size_t f);
  [[nodiscard]] std::int32_t node_of_side(const FaceMesh& face, const Element& e, int side, std::size_t m) const {
    return node_between(face.vertex[e.local[side]], face.vertex[e.local[(side + 1) % e.corners]], m);
  }

  void place_inside(std::size_t f);
  [[nodiscard]] std::array<Vec3, 25> positions(const Element& e) const;

  // (u, v) of a corner, which at a pole is the mean of the others.
  [[nodiscard]] std::array<Vec2, 4> corners_uv(const Element& e) const;
  void want_inner(const Element& e, Wanted& wanted) const;
  [[nodiscard]] double score(const Element& e) const;

  // Repairs
  void repair();
  void list_neighbours();
  [[nodiscard]] std::ptrdiff_t invalid_among(const std::vector<std::size_t>& all) const;
  [[nodiscard]] std::vector<std::size_t> invalid_about(const std::vector<std::size_t>& moved) const;
  [[nodiscard]] std::array<Vec2, 2> box(const Element& e) const;

  /// Moves one node in (u, v) to the best value of `judge`; the host may fail beside its domain.
  template <typename Judge>
  bool search(std::int32_t node, const Element& e, const Judge& judge);
  void move_inner(std::size_t k);

  /// Inner nodes where the edges imply them.
  void settle(const Element& e);
  [[nodiscard]] double worst(const std::vector<std::size_t>& all) const;

  /// The state of the elements at an edge, to undo.
  struct Saved {
    std::vector<std::int32_t> node;
    std::vector<Vec3> xyz;
    std::vector<Vec2> uv;
  };
  [[nodiscard]] Saved save(const std::vector<std::size_t>& all) const;
  void restore(const Saved& saved) {
    for (std::size_t i = 0; i < saved.node.size(); ++i) out_.nodes[saved.node[i]] = saved.xyz[i], node_uv_[saved.node[i]] = saved.uv[i];
  }

  /// Index in FaceMesh::mid_uv of the node of second order on a side of an element.
  [[nodiscard]] std::int32_t mid_of(std::size_t k, int side) const;
  [[nodiscard]] std::vector<std::size_t> neighbours(std::size_t k) const;

  // Gives an element the polynomial of order 2.
  void take_second_order(std::size_t k);

  // Elements of order 2 are valid: as polynomials of a higher order they are, too. Neighbours that become invalid follow.
  bool lower(std::size_t k, std::vector<std::size_t>& lowered);
  void lower(std::vector<std::size_t>& bad);

  // The parabola through the node of second order, which repairs of that order have found.
  void follow_second_order(std::size_t k);
  void move_edges(std::size_t k);
  void fill();

  /// The node of order p at rank m from vertex a to b.
  [[nodiscard]] std::int32_t node_between(std::int32_t a, std::int32_t b, std::size_t m) const {
    return edges_.at(ordered(a, b)).first + static_cast<std::int32_t>(a < b ? m : p_ - m) - 1;
  }

  // Nodes of edges follow their vertices; inner nodes are next to the images of their masters.
  void link_nodes(const PeriodicLink& of);

  // All maps of a curve onto itself at once, with the first of them.
  void link_itself(const PeriodicLink& of);

  /// A node of a curve: its record there, its first record by use, and the use that has the curve's parameter.
  struct CurvePlace {
    std::size_t on_curve = 0, side = 0;
    const CurveUse* use = nullptr;
  };
  // Tables of lengths have placed nodes of curves; images of nodes have the places of the images, first on the roots of classes.
  void follow_on_curves();
  // Returns whether the node has moved by more than rounding.
  bool move_on_curve(std::int32_t node, const CurvePlace& place, std::int32_t master, const Isometry& map, double exact);

  // Repairs have moved nodes of a face and of its image each in their own way: the image follows.
  void follow_masters();
  void link_inner(const Element& slave, const Element& master, PeriodicLink& link) const;

  // Nodes that repairs have moved off the surface have no parameters.
  void associate_nodes();
  void associate_element(const Element& e, MeshAssociation& all);
  void list_coarse(const Element& e);

  struct Edge {
    std::int32_t first = -1;
    bool fixed = false;  // on a curve
  };
  const CurveModel& model_;
  const CompositeResult& result_;
  const SurfaceMesh& mesh_;
  bool lowers_;
  Monitor& monitor_;
  std::vector<double> places_;
  ElementShape triangle_, quad_;
  std::size_t p_;
  HighOrderMesh out_;
  std::vector<Vec2> node_uv_;  // of inner nodes and nodes of inner edges
  std::map<Key, Edge> edges_;
  struct OnSide {
    std::int32_t node;
    int face;  // by index
    Vec2 uv;
  };
  std::vector<MeshAssociation::OnCurve> on_curves_;  // nodes of curves
  std::vector<OnSide> on_sides_;                     // the same by use
  std::map<std::int32_t, CurvePlace> place_of_;      // by node of a curve
  std::vector<Element> elements_;
  std::vector<std::size_t> first_element_;  // by face
  std::map<Key, std::vector<std::size_t>> around_;
  std::vector<std::size_t> invalid_;
  mutable std::optional<Poles> poles_;  // of the last face
};

}  // namespace carreau
