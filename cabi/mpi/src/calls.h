// SPDX-License-Identifier: BSD-3-Clause
// Calls of MPI, whose errors are exceptions here, and of carreau.h.
#pragma once

#include <mpi.h>

#include <stdexcept>
#include <string>

#include "carreau_mpi.h"

namespace carreau_mpi {

/// With the status and sentence that the caller of the library gets.
struct Failure : std::runtime_error {
  Failure(carreau_status of, const std::string& sentence) : std::runtime_error(sentence), status(of) {}
  carreau_status status;
};

/// Throws Failure with MPI's own words. `what` was to be done: "MPI could not <what>".
void check(int code, const std::string& what);

/// A duplicate of a communicator that returns errors in place of ending the program; freed with the object, unless MPI
/// has been finalised before.
class Communicator {
 public:
  /// `handle`: of Fortran. Throws Failure.
  explicit Communicator(std::int32_t handle);
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  /// It is not freed: other ranks may be elsewhere.
  void keep() noexcept { comm_ = MPI_COMM_NULL; }

  operator MPI_Comm() const noexcept { return comm_; }
  [[nodiscard]] int rank() const noexcept { return rank_; }
  [[nodiscard]] int size() const noexcept { return size_; }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
};

/// Runs body() and returns the status of its exception, which becomes the last error of the session.
template <typename Body>
carreau_status guarded(carreau_session* session, Body&& body) noexcept {
  if (session == nullptr) return CARREAU_ERR_ARGUMENT;
  try {
    body();
    return CARREAU_OK;
  } catch (const Failure& failure) {
    return carreau_set_error(session, failure.status, failure.what());
  } catch (const std::bad_alloc&) {
    return CARREAU_ERR_MEMORY;
  } catch (const std::exception& error) {
    return carreau_set_error(session, CARREAU_ERR_INTERNAL, error.what());
  } catch (...) {
    return CARREAU_ERR_INTERNAL;
  }
}

}  // namespace carreau_mpi
