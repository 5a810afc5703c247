// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "entity_kinds.h"

namespace carreau_occ {

class StepEntities final : public EntityKinds {
 public:
  [[nodiscard]] bool is_face(const Entity& entity) const override;
  [[nodiscard]] bool is_geometry(const Entity& entity) const override;
  [[nodiscard]] bool carries_faces(const Entity& entity, const Interface_Graph& graph) const override;
  [[nodiscard]] Spline spline(const Entity& entity) const override;
  bool mend_numbers(const Entity& entity) const override;
  [[nodiscard]] std::string lost_scale(const Entity& entity) const override;
  [[nodiscard]] std::vector<Entity> wholes_of(const Entity& entity, const Interface_Graph& graph) const override;
  /// Out of shells.
  void take_out(const Handle(Interface_InterfaceModel) & model, const std::set<Entity>& faces) const override;
};

}  // namespace carreau_occ
