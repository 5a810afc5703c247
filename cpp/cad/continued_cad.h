// SPDX-License-Identifier: BSD-3-Clause
// Faces whose formulas hold beyond their parameter domains.
#pragma once

#include "cad/cad.h"

namespace carreau {

/// An evaluator that knows such faces, beside Cad.
class ContinuedCad {
 public:
  virtual ~ContinuedCad() = default;
  /// True if the surface of a face may be evaluated in the whole box of its parameter domain, and is smooth there.
  [[nodiscard]] virtual bool is_continued(int face) const noexcept = 0;
};

/// False for evaluators that do not know.
inline bool is_continued(const Cad& cad, int face) noexcept {
  const auto* const known = dynamic_cast<const ContinuedCad*>(&cad);
  return known != nullptr && known->is_continued(face);
}

}  // namespace carreau
