// SPDX-License-Identifier: BSD-3-Clause
// The files of report/viewer, as the build puts them into the program.
#pragma once

namespace command::page_parts {

extern const char* const page;    ///< with {{places}} for the parts of a report
extern const char* const style;   ///< content of the style element
extern const char* const script;  ///< content of the script element
extern const char* const style_sha256;  ///< hexadecimal, of exactly these bytes
extern const char* const script_sha256;

}  // namespace command::page_parts
