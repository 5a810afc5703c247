// SPDX-License-Identifier: BSD-3-Clause
#include "report/curved_pieces.h"

#include <algorithm>
#include <map>
#include <unordered_set>
#include <utility>

#include "draw/drawn_elements.h"
#include "draw/face_colours.h"

namespace command {
namespace {

constexpr int pieces_of_side = 4;  // a quarter of a circle leaves it by less than a hundredth of its radius

using Corners = std::array<std::int32_t, 3>;

/// The first triangle of an element, a quadrilateral's first half: how set_cells() and add_cell() of the library cut.
Corners first_triangle(const Element& element) { return {element.nodes[0], element.nodes[1], element.nodes[2]}; }

class Cutter {
 public:
  /// Keeps references.
  Cutter(const MeshArrays& mesh, const std::vector<std::uint8_t>& halves)
      : mesh_(mesh), halves_(halves), on_curves_(sides_on_curves(mesh)) {
    for (const Element& element : mesh.elements)
      if (element.is_curved()) element_of_.emplace(first_triangle(element), &element);
  }

  CurvedPieces run() {
    bool curved = false;  // the element that the triangle is of
    for (std::size_t t = 0; t < mesh_.triangles.size() && !element_of_.empty(); ++t) {
      if (halves_[t] == 2 && curved) continue;  // its pieces came with the first half
      const auto found = halves_[t] == 2 ? element_of_.end() : element_of_.find(mesh_.triangles[t]);
      curved = found != element_of_.end();
      if (curved)
        add(*found->second, t);
      else
        add_straight(t);
    }
    return std::move(pieces_);
  }

 private:
  void add(const Element& element, std::size_t triangle) {
    std::array<Point, 8> x{};
    for (int i = 0; i < 2 * element.corners(); ++i) x[i] = mesh_.vertices[element.nodes[i]];
    std::vector<DrawnTriangle> all = drawn(element, x, pieces_of_side);
    std::stable_sort(all.begin(), all.end(), [](const DrawnTriangle& a, const DrawnTriangle& b) { return a.half < b.half; });
    std::map<Point, std::int32_t> known;
    for (int i = 0; i < element.corners(); ++i) known.emplace(x[i], element.nodes[i]);
    for (const DrawnTriangle& piece : all) {
      Corners corners{};
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = number_of(piece.corners[k], known);
        const int side = piece.side[k];
        if (side < 0)
          bits |= 1u << (3 + k);
        else if (on_curves_.contains(side_key(element.nodes[side], element.nodes[(side + 1) % element.corners()])))
          bits |= 1u << k;
      }
      add(corners, triangle + static_cast<std::size_t>(piece.half), bits);
    }
  }

  std::int32_t number_of(const Point& p, std::map<Point, std::int32_t>& known) {
    const auto next = static_cast<std::int32_t>(mesh_.vertices.size() + pieces_.points.size());
    const auto [found, is_new] = known.emplace(p, next);
    if (is_new) pieces_.points.push_back(p);
    return found->second;
  }

  void add_straight(std::size_t t) {
    std::uint32_t bits = halves_[t] == 1 ? 4u << 3 : halves_[t] == 2 ? 1u << 3 : 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (on_curves_.contains(side_key(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]))) bits |= 1u << k;
    add(mesh_.triangles[t], t, bits);
  }

  void add(const Corners& corners, std::size_t triangle, std::uint32_t bits) {
    pieces_.corners.push_back(corners);
    pieces_.triangle.push_back(static_cast<std::uint32_t>(triangle));
    pieces_.sides.push_back(bits);
  }

  const MeshArrays& mesh_;
  const std::vector<std::uint8_t>& halves_;
  std::unordered_set<std::uint64_t> on_curves_;
  std::map<Corners, const Element*> element_of_;
  CurvedPieces pieces_;
};

}  // namespace

CurvedPieces curved_pieces(const MeshArrays& mesh, const std::vector<std::uint8_t>& halves) {
  return Cutter(mesh, halves).run();
}

}  // namespace command
