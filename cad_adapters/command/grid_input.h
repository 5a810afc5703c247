// SPDX-License-Identifier: BSD-3-Clause
// Structured grids as geometry.
#pragma once

#include <memory>
#include <string>

namespace command {

class CadInput;

/// How a grid is read and made a surface.
struct GridChoice {
  std::string format;        ///< one of grid_formats; empty: by suffix
  std::string smoothing;     ///< "rounds" or "rounds,w1,w2" of Taubin's filter; empty: none
  bool lengths = false;      ///< parameters are cumulated lengths of edges
  double join_angle = 0;     ///< degrees; 0: borders of blocks keep their angles
  double tolerance = 0;      ///< below which nodes of borders are one; 0: a millionth of the diagonal
  bool fill = false;         ///< holes inside
  double step = 0;           ///< of heights and scans whose file does not tell it; 0: 1
};

inline constexpr const char* grid_formats[] = {"plot3d", "heights", "scan", "nodes"};
inline constexpr const char* grid_suffixes[] = {".fmt", ".p3d", ".x", ".grd", ".asc", ".dem", ".txt", ".cyl", ".ijk"};

/// Whether a format is given, or the suffix is that of a grid, or a file .xyz begins as one of PLOT3D.
bool is_grid(const std::string& path, const GridChoice& choice);
/// "" or what is wrong with the text of --smooth.
std::string smoothing_defect(const std::string& text);

/// Throws Failure.
std::unique_ptr<CadInput> open_grid(const std::string& path, const GridChoice& choice);

}  // namespace command
