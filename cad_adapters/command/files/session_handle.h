// SPDX-License-Identifier: BSD-3-Clause
// A session of the C interface for as long as a command needs it.
#pragma once

#include <carreau.h>

#include <memory>

#include "files/mesh_file.h"

namespace command {

struct FreeSession {
  void operator()(carreau_session* session) const noexcept { carreau_session_free(session); }
};
using SessionHandle = std::unique_ptr<carreau_session, FreeSession>;

/// A session whose errors and warnings go to the error output, a line each. Throws Failure.
SessionHandle make_session();

/// Throws Failure with the sentence of the last call on `session` when `status` is an error.
void require(carreau_session* session, carreau_status status);

}  // namespace command
