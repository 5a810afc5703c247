// SPDX-License-Identifier: BSD-3-Clause
// The domain of a face for many points.
#pragma once

#include <BRepTopAdaptor_FClass2d.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt2d.hxx>
#include <optional>
#include <vector>

namespace carreau_occ {

/// States of points in the parameters of a face, as BRepTopAdaptor_FClass2d has them. It goes through all pieces of the
/// borders at each point. Here it answers for points beside borders, and once for each part between them.
class DomainCells {
 public:
  explicit DomainCells(const TopoDS_Face& face);
  [[nodiscard]] TopAbs_State state(const gp_Pnt2d& uv);

 private:
  /// False if a border has no curve, or steps of it are longer than cells.
  bool mark_borders(const TopoDS_Face& face);
  void number_parts();
  /// -1: outside of the box of the face.
  [[nodiscard]] int cell_of(const gp_Pnt2d& uv) const;

  BRepTopAdaptor_FClass2d exact_;
  double u_ = 0, v_ = 0, du_ = 0, dv_ = 0;         // the first corner and the sides of cells
  std::vector<int> part_;                          // by cell; -1: beside a border
  std::vector<std::optional<TopAbs_State>> state_; // by part
};

}  // namespace carreau_occ
