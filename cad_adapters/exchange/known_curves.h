// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <XSAlgo_AlgoContainer.hxx>

namespace carreau_occ {

/// While one of these lives, OpenCASCADE finds curves of edges in the parameters of planes once for each shape that it
/// heals, and not at each call. The healed shape stays identical. One at a time in the whole process.
class KnownCurves {
 public:
  KnownCurves();
  ~KnownCurves();
  KnownCurves(const KnownCurves&) = delete;
  KnownCurves& operator=(const KnownCurves&) = delete;

 private:
  Handle(XSAlgo_AlgoContainer) before_;
};

}  // namespace carreau_occ
