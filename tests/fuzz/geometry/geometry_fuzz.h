// SPDX-License-Identifier: BSD-3-Clause
// Meshes random geometry: each seed makes a geometry, whose run must end with a mesh without defects or with a sentence.
#pragma once

#include <carreau_geometry.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace geometry_fuzz {

/// The numbers of one seed, which are the same with every standard library. No call has two of them as arguments: compilers
/// evaluate arguments in different orders.
/// Seeds from first_small_seed on make coarse meshes of a few milliseconds, for a million runs.
class Random {
 public:
  static constexpr std::uint64_t first_small_seed = 1'000'000;
  explicit Random(std::uint64_t seed) : engine_(seed * 0x9E3779B97F4A7C15u + 1), small_(seed >= first_small_seed) {}
  [[nodiscard]] bool is_small() const noexcept { return small_; }
  /// A number from 0 to n - 1.
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  bool chance(double share) { return uniform() < share; }
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// A power of ten.
  double power(double low, double high) { return std::pow(10, uniform(low, high)); }

 private:
  std::mt19937_64 engine_;
  bool small_;
};

/// While one lives another library is at work: a signal or a run without end is not a fault of this one.
class Foreign {
 public:
  Foreign();
  ~Foreign();
  Foreign(const Foreign&) = delete;
  Foreign& operator=(const Foreign&) = delete;
};

enum class Result { whole, partial, rejected };

struct Outcome {
  Result result = Result::rejected;
  std::string fault;  ///< a sentence; "": none
};

/// Returns the outcome of a seed.
using Run = std::function<Outcome(std::uint64_t seed)>;

struct Kind {
  std::string name;
  Run run;
};

/// The rules for a call that may fail: a failure has a sentence, and is no defect of the library. Returns the fault.
std::string fault_of(carreau_session* session, carreau_status status, const char* call);

/// Sets sizes and some other parameters: `diagonal` of the geometry.
void set_parameters(carreau_session* session, double diagonal, Random& random);

/// Makes the mesh of a session that has a geometry, and checks it. `closed`: a whole mesh has no open edges.
Outcome mesh_and_check(carreau_session* session, bool closed, Random& random);

/// The kinds of geometry_fuzz.cpp.
Outcome run_triangles(std::uint64_t seed);
Outcome run_bezier(std::uint64_t seed);
Outcome run_plane(std::uint64_t seed);
Outcome run_molecule(std::uint64_t seed);
Outcome run_grid(std::uint64_t seed);

/// KIND [--first SEED] [--count N] [--seeds SEED,SEED,...] [--seconds-per-run S] [--jobs N]: runs seeds in processes of their own. A signal or a
/// run that takes longer than S seconds of the processor is a fault, which names its seed. Returns 1 when there is one.
int main_of(const std::vector<Kind>& kinds, int argc, char** argv);

}  // namespace geometry_fuzz
