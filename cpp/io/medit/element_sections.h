// SPDX-License-Identifier: BSD-3-Clause
// The elements of a Medit file, text or binary: a section a kind, each at most once.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "io/element_lists.h"
#include "io/solid_skin.h"
#include "support/error.h"

namespace carreau {

/// `Place` points into the file; `Place{}`: the section has not come yet.
template <class Place>
struct ElementSections {
  template <std::size_t N>
  struct Section {
    ElementList<N> list;
    Place start{};  ///< of the first record
  };

  Section<2> edges;
  Section<3> edges3, triangles;
  Section<4> quads, tetrahedra;
  Section<5> pyramids;
  Section<6> triangles6, prisms;
  Section<8> hexahedra;
  Section<9> quads9;
  Section<10> tetrahedra10;

  /// True when a section of elements has come.
  [[nodiscard]] bool any() const noexcept {
    bool found = false;
    for_each([&](const char*, const auto& section) { found = found || section.start != Place{}; });
    return found;
  }

  /// Reads `count` records of N vertices from one and a reference, by `vertex()` and `reference()`. Vertices below one
  /// become -1, which check_indices rejects.
  template <std::size_t N, class Vertex, class Reference>
  static void read(Section<N>& section, std::size_t count, Vertex&& vertex, Reference&& reference) {
    section.list.nodes.resize(count);
    section.list.refs.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::int32_t& node : section.list.nodes[i]) {
        const std::int32_t from_one = vertex();
        node = from_one > 0 ? from_one - 1 : -1;  // the smallest integer has no predecessor
      }
      section.list.refs[i] = reference();
    }
  }

  /// Calls `refuse(what, section, i, k)` for node k of element i, the first invalid vertex of a section.
  template <class Refuse>
  void check_indices(std::size_t vertices, Refuse&& refuse) const {
    for_each([&](const char* what, const auto& section) { check(what, section, vertices, refuse); });
  }

  /// Moves all elements into the mesh; of solids without a surface their outer faces. `fail(place, sentence)` throws; `end`: the place for
  /// errors that concern several sections.
  template <class Fail>
  void give_to(FlatMesh& mesh, Place end, Fail&& fail) {
    ElementLists lists{.triangles = std::move(triangles.list),
                       .triangles6 = std::move(triangles6.list),
                       .quads = std::move(quads.list),
                       .quads8 = {},
                       .edges = std::move(edges.list),
                       .edges3 = std::move(edges3.list)};
    SolidSkin skin;
    add_solids(SolidShape::tetrahedron, tetrahedra, skin), add_solids(SolidShape::tetrahedron, tetrahedra10, skin);
    add_solids(SolidShape::pyramid, pyramids, skin), add_solids(SolidShape::prism, prisms, skin);
    add_solids(SolidShape::hexahedron, hexahedra, skin);
    if (quads9.list.nodes.empty()) skin.give_to(lists, mesh.vertices);
    mesh.tetrahedra = std::move(tetrahedra.list.nodes);
    take_quads9(quads9.list.nodes, quads9.list.refs, lists, mesh);
    try {
      set_elements(lists, mesh);
    } catch (const InvalidArgument& error) {
      fail(end, error.what());
    }
  }

 private:
  /// Calls `use(what, section)` for each section.
  template <class Use>
  void for_each(Use&& use) const {
    use("edge", edges), use("edge of order 2", edges3), use("triangle", triangles), use("quadrilateral", quads);
    use("triangle of order 2", triangles6), use("quadrilateral of order 2", quads9), use("tetrahedron", tetrahedra);
    use("tetrahedron of order 2", tetrahedra10), use("pyramid", pyramids), use("prism", prisms), use("hexahedron", hexahedra);
  }
  template <std::size_t N>
  static void add_solids(SolidShape shape, const Section<N>& section, SolidSkin& skin) {
    for (std::size_t i = 0; i < section.list.nodes.size(); ++i) skin.add(shape, section.list.nodes[i], section.list.refs[i]);
  }
  template <std::size_t N, class Refuse>
  static void check(const char* what, const Section<N>& section, std::size_t vertices, Refuse& refuse) {
    for (std::size_t i = 0; i < section.list.nodes.size(); ++i)
      for (std::size_t k = 0; k < N; ++k) {
        const std::int32_t v = section.list.nodes[i][k];
        if (v < 0 || static_cast<std::size_t>(v) >= vertices) refuse(what, section, i, k);
      }
  }
};

}  // namespace carreau
