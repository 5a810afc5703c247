// Faces, curves and points with their references: the content of x.pardom (RT-0232 sec. 3.2).
#pragma once

#include <string>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// A point imposed inside a face.
struct FacePoint {
  int ref = 0;
  Vec2 uv;
  int line = 0;  ///< of the file it was read from; 0: from memory
};

enum class CurveType : int { boundary = 1, internal = 2 };

/// A curve as one face sees it; its rank `ic` (from 1) is its index in Face::curves + 1.
struct FaceCurve {
  CurveType type = CurveType::boundary;
  int ref = 0;             ///< refc: the same for curves that are one in space
  int end1 = 0, end2 = 0;  ///< references of the points at t = a and t = b
  int line = 0;
  /// Treated as one point of space although it has a small extent (eps_collapse, RT-0232 sec. 3.3). The curve keeps its
  /// rank: hosts address curves by it.
  bool collapsed = false;
};

struct Face {
  int ref = 0;
  /// |orientation| is the rank of a boundary curve; the surface lies on its left when positive, on its right when
  /// negative.
  int orientation = 1;
  std::vector<FaceCurve> curves;
  std::vector<FacePoint> points;
  int line = 0;
};

struct Model {
  std::vector<Face> faces;
  std::string source;  ///< name of the file it was read from; empty: from memory
};

}  // namespace carreau
