// SPDX-License-Identifier: BSD-3-Clause
// Vectors and metrics as rows of numbers.
#pragma once

#include "metric/metric3.h"

namespace carreau::abi {

inline void read(const double* p, Vec2& out) { out = {p[0], p[1]}; }
inline void read(const double* p, Vec3& out) { out = {p[0], p[1], p[2]}; }
inline void read(const double* p, Metric2& out) { out = {p[0], p[1], p[2]}; }
inline void read(const double* p, Metric3& out) { out = {p[0], p[1], p[2], p[3], p[4], p[5]}; }

}  // namespace carreau::abi
