// SPDX-License-Identifier: BSD-3-Clause
// Figures of a mesh as JSON.
#pragma once

#include <carreau.h>

#include <nlohmann/json_fwd.hpp>

namespace command {

/// The members of carreau_quality by their names.
nlohmann::ordered_json quality_json(const carreau_quality& quality);

/// The members of carreau_cell_quality by their names.
nlohmann::ordered_json elements_json(const carreau_cell_quality& quality);

}  // namespace command
