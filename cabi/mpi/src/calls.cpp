// SPDX-License-Identifier: BSD-3-Clause
#include "calls.h"

#include <array>

namespace carreau_mpi {

void check(int code, const std::string& what) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING + 1> words{};
  int length = 0;
  MPI_Error_string(code, words.data(), &length);
  throw Failure(CARREAU_ERR_CALLBACK, "MPI could not " + what + ": " + std::string(words.data(), static_cast<std::size_t>(length)));
}

Communicator::Communicator(std::int32_t handle) {
  int initialised = 0, finalised = 0;
  MPI_Initialized(&initialised);
  MPI_Finalized(&finalised);
  if (initialised == 0 || finalised != 0) throw Failure(CARREAU_ERR_ARGUMENT, "MPI is not initialised: call MPI_Init_thread first");
  const MPI_Comm given = MPI_Comm_f2c(handle);
  if (given == MPI_COMM_NULL) throw Failure(CARREAU_ERR_ARGUMENT, "comm is MPI_COMM_NULL");
  check(MPI_Comm_dup(given, &comm_), "duplicate the communicator");
  MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN);
  check(MPI_Comm_rank(comm_, &rank_), "get the rank");
  check(MPI_Comm_size(comm_, &size_), "get the number of ranks");
}

Communicator::~Communicator() {
  int finalised = 0;
  MPI_Finalized(&finalised);
  if (finalised == 0 && comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
}

}  // namespace carreau_mpi
