// SPDX-License-Identifier: BSD-3-Clause
// Systems of coordinates of Nastran: rectangular, cylindrical and spherical ones, by points or by nodes (CORD1R, CORD1C,
// CORD1S, CORD2R, CORD2C, CORD2S), each perhaps in terms of others.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "io/words.h"
#include "support/vec.h"

namespace carreau {

/// A node in the coordinates of a system.
struct LocalPoint {
  Vec3 coordinates;
  std::int64_t system = -1;  ///< 0: the basic one; -1: the default of the file
  const char* at = nullptr;
};

struct LocalSystem {
  char kind = 'R';                       ///< 'R': x, y, z; 'C': r, angle, z; 'S': r, angle from z, angle; in degrees
  std::int64_t reference = 0;            ///< system of `points`
  std::array<Vec3, 3> points = {};       ///< origin, a point of the z axis, a point of the half plane of x and z
  bool by_nodes = false;                 ///< the three points are nodes
  std::array<std::int64_t, 3> nodes = {};
  const char* at = nullptr;
};

/// Finds nodes in the basic system. Keeps references to the arguments.
class LocalSystems {
 public:
  LocalSystems(const Words& in, const std::map<std::int64_t, LocalPoint>& points, const std::int64_t& default_system)
      : in_(in), points_(points), default_(default_system) {}

  /// Throws FileError when the number comes twice.
  void add(std::int64_t number, const LocalSystem& system);
  /// The place of a node. Throws FileError: a system that is missing, has no axes or depends on itself.
  Vec3 in_basic(std::int64_t node);

 private:
  struct Frame {
    Vec3 origin, x, y, z;
  };
  struct Known {
    LocalSystem system;
    std::optional<Frame> frame = {};
    bool open = false;  ///< its frame is being found
  };

  const Frame& frame_of(std::int64_t number, const char* at);
  Vec3 placed(const Vec3& coordinates, std::int64_t number, const char* at);

  const Words& in_;
  const std::map<std::int64_t, LocalPoint>& points_;
  const std::int64_t& default_;
  std::map<std::int64_t, Known> systems_;
  int depth_ = 0;
};

}  // namespace carreau
