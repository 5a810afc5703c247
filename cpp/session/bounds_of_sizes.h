// SPDX-License-Identifier: BSD-3-Clause
// Settings of a session that an adaptation changes while it makes a mesh.
#pragma once

#include <cmath>
#include <vector>

#include "adapt/estimators.h"
#include "session/parameters.h"
#include "session/session.h"

namespace carreau {

/// Smallest and largest size, largest ratio of the two in the tangent plane.
struct SizeRange {
  double low = HUGE_VAL, high = 0, stretch = 1;
};

SizeRange range_of(const VertexPrescriptions& prescriptions);

/// While this object lives, the prescriptions supply the bounds that the user has not set.
class OpenBounds {
 public:
  OpenBounds(Parameters& parameters, SizeRange range);
  ~OpenBounds();
  OpenBounds(const OpenBounds&) = delete;
  OpenBounds& operator=(const OpenBounds&) = delete;

 private:
  void open(const char* name, double value);
  Parameters& parameters_;
  std::vector<const char*> opened_;
};

/// Takes the background mesh away in the end.
class NoBackgroundAfterwards {
 public:
  explicit NoBackgroundAfterwards(Session& session) : session_(session) {}
  ~NoBackgroundAfterwards() { session_.set_background(nullptr); }
  NoBackgroundAfterwards(const NoBackgroundAfterwards&) = delete;
  NoBackgroundAfterwards& operator=(const NoBackgroundAfterwards&) = delete;

 private:
  Session& session_;
};

}  // namespace carreau
