// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "entity_kinds.h"

namespace carreau_occ {

class IgesEntities final : public EntityKinds {
 public:
  [[nodiscard]] bool is_face(const Entity& entity) const override;
  [[nodiscard]] bool is_geometry(const Entity& entity) const override;
  [[nodiscard]] bool carries_faces(const Entity& entity, const Interface_Graph& graph) const override;
  [[nodiscard]] Spline spline(const Entity& entity) const override;
  [[nodiscard]] std::string lost_scale(const Entity& entity) const override;
};

}  // namespace carreau_occ
