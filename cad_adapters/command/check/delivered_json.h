// SPDX-License-Identifier: BSD-3-Clause
// What a mesh delivers as JSON.
#pragma once

#include <carreau.h>

#include <nlohmann/json_fwd.hpp>

namespace command {

/// Measures, shares and sentences as carreau_delivered_write writes them, without the mesh and the counts of calls. Throws
/// Failure when the mesh cannot be measured.
nlohmann::ordered_json delivered_json(carreau_session* session);

}  // namespace command
