// SPDX-License-Identifier: BSD-3-Clause
// Common parts of the cases of one rank.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "carreau_mpi.h"
#include "waves.h"

namespace mpi_tests {

inline int rank = 0, size = 1, failures = 0;
inline double bulge = 0;  // of all hosts

inline void expect(bool holds, const std::string& what) {
  if (holds) return;
  ++failures;
  std::fprintf(stderr, "rank %d of %d: not true: %s\n", rank, size, what.c_str());
}

inline std::int32_t world() { return MPI_Comm_c2f(MPI_COMM_WORLD); }

/// A session of the waves, with parameters "name=word".
struct Run {
  explicit Run(const std::vector<std::string>& settings = {}, Fault fault = Fault::none, int cells = 4) {
    waves.fault = fault, waves.cells = cells, waves.bulge = bulge;
    expect(carreau_session_create(&session) == CARREAU_OK, "a session is made");
    expect(give(session, waves) == CARREAU_OK, "the model is taken");
    std::vector<std::string> all{"hphydef=0.1"};
    all.insert(all.end(), settings.begin(), settings.end());
    for (const std::string& setting : all) {
      const std::size_t at = setting.find('=');
      expect(carreau_set_word(session, setting.substr(0, at).c_str(), setting.substr(at + 1).c_str()) == CARREAU_OK,
             setting + ": " + carreau_last_error(session));
    }
  }
  ~Run() { carreau_session_free(session); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  [[nodiscard]] carreau_mesh* mesh() const {
    carreau_mesh* mesh = nullptr;
    expect(carreau_session_mesh(session, &mesh) == CARREAU_OK, "there is a mesh");
    return mesh;
  }
  [[nodiscard]] std::string sentence() const { return carreau_last_error(session); }

  Waves waves;
  carreau_session* session = nullptr;
};

}  // namespace mpi_tests
