// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ShapeAlgo_ToolContainer.hxx>

namespace carreau_occ {

/// While one of these lives, OpenCASCADE's healing looks for replaced parts of a shape without copies of the shape. The
/// healed shape stays identical. One at a time in the whole process.
class QuickHealing {
 public:
  QuickHealing();
  ~QuickHealing();
  QuickHealing(const QuickHealing&) = delete;
  QuickHealing& operator=(const QuickHealing&) = delete;

 private:
  Handle(ShapeAlgo_ToolContainer) before_;
};

}  // namespace carreau_occ
