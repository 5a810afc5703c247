// SPDX-License-Identifier: BSD-3-Clause
// Replaces exr.cpp if OpenEXR is not built in.
#include "io/exr.h"
#include "support/error.h"

namespace carreau {

struct ExrWriter::State {};

ExrWriter::ExrWriter(const std::string& path, std::span<const ExrPart>, const ExrOptions&) {
  throw FileError("'" + path + "' cannot be written: this library was built without OpenEXR (.png files can)");
}
ExrWriter::~ExrWriter() = default;
void ExrWriter::write_part(int, const ExrPrepare&) {}
void ExrWriter::commit() {}

}  // namespace carreau
