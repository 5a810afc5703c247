// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TCollection_AsciiString.hxx>
#include <TCollection_ExtendedString.hxx>
#include <string>

namespace carreau_occ {

/// A text as a reader of OpenCASCADE has it; bytes that are no UTF-8 are replaced.
inline std::string utf8(const TCollection_AsciiString& text) {
  return TCollection_AsciiString(TCollection_ExtendedString(text)).ToCString();
}

}  // namespace carreau_occ
