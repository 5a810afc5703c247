// SPDX-License-Identifier: BSD-3-Clause
// Shapes of triangles that a refinement keeps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "association/keep_quads.h"
#include "association/mesh_edges.h"
#include "cad/cad.h"
#include "support/monitor.h"

namespace carreau::refining {

/// Restores the shapes of divided triangles. The middle of a curve's edge lies beside its chord, by its sagitta: triangles beside curves lose
/// height, and may turn. Swaps and moves as after meshing repair them, two rings around; restore_quads() moves vertices of quadrilaterals.
/// Vertices of curves stay.
class ShapeKeeper {
 public:
  /// `first_new`: the first vertex of the division. `isotropic`: shapes in space count; else only turned triangles are repaired.
  /// `quadratic`: only turned quadrilaterals are, since the nodes on edges decide. Keeps references.
  ShapeKeeper(SurfaceMesh& mesh, std::int32_t first_new, Cad& cad, bool isotropic, bool quadratic, Monitor& monitor);

  /// `before`: as divide_elements() returns it. Does not evaluate the host if no shape is worse.
  void restore(std::size_t face, std::span<const float> before);
  /// Moves vertices around triangles whose shapes have fallen much, and of quadrilaterals, and keeps the elements. Leaves faces that are
  /// stretched as a whole. Returns whether a vertex has moved.
  bool smooth(std::size_t face, std::span<const float> before);

 private:
  enum class Edits { swaps, moves, both };
  /// An edge between two vertices of curves that is no edge of a curve: neighbouring faces must not have it too.
  struct Chord {
    Key vertices;
    std::int32_t face;
    Key local;
    friend auto operator<=>(const Chord&, const Chord&) = default;
  };
  void list_chords(std::size_t face, std::vector<Chord>& to) const;
  [[nodiscard]] bool repeats_chord(std::size_t face, std::vector<Chord> before);
  template <typename Kept>
  [[nodiscard]] std::vector<std::int32_t> triangles_below(const FaceMesh& face, const Kept& kept) const;
  /// Moves only vertices of triangles below their `goals`, by triangle of the face.
  void repair(std::size_t face, const std::vector<std::int32_t>& worse, std::span<const double> goals, Edits edits);
  [[nodiscard]] std::vector<char> fixed_of(const FaceMesh& face) const;
  [[nodiscard]] bool is_curve_edge(std::int32_t v, std::int32_t w) const;

  SurfaceMesh& mesh_;
  std::int32_t first_new_;
  Cad& cad_;
  bool isotropic_, quadratic_;
  Monitor& monitor_;
  std::vector<char> fixed_;        // by vertex: on a curve, or imposed
  std::vector<Key> curve_edges_;   // ascending
  std::vector<Chord> chords_;      // of all faces, ascending, once one was restored
  bool knows_chords_ = false;
};

/// The worst shape (Q2) of a face's triangles and halves of quadrilaterals, and a corner of that triangle; 1 and -1 without triangles.
struct WorstShape {
  double shape = 1;
  std::int32_t vertex = -1;
  TurnedElements turned;
};
/// Returns the worst shape of each face.
std::vector<WorstShape> worst_shapes(const SurfaceMesh& mesh);

/// Warns of each face whose worst shape has fallen much, and marks faces with more turned elements. `by`: a noun, the step that has changed
/// the mesh.
void report_losses(SurfaceMesh& mesh, std::span<const WorstShape> before, const char* by, Monitor& monitor);

}  // namespace carreau::refining
