// SPDX-License-Identifier: BSD-3-Clause
// OpenEXR files of named channels, written block by block.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// The storage of a channel: 32-bit real, 16-bit real (of pictures for the eye), unsigned 32-bit integer.
enum class ExrType { real, half, integer };

struct ExrChannel {
  std::string name;  ///< dotted, lower case: "layer.channel"
  ExrType type = ExrType::real;
};

struct ExrAttribute {
  std::string name;
  std::variant<std::int32_t, double, Vec2, std::string> value;
};

/// An image of a file. Row 0 is the upper one in viewers.
struct ExrPart {
  std::string name;  ///< different for each part of a file
  int width = 0, height = 0;
  std::vector<ExrChannel> channels;  ///< in any order; a file has them in the order of their names
  std::vector<ExrAttribute> attributes;
};

/// Both are lossless.
enum class ExrCompression { zip, piz };

struct ExrOptions {
  ExrCompression compression = ExrCompression::zip;
  int threads = 1;  ///< that fill and compress blocks, besides the caller's; 1: none
};

/// Some rows of one channel, row by row: the bits of a float (of ExrType::half too) or an integer for each pixel.
using ExrPlane = std::vector<std::uint32_t>;

/// Fills the planes of a block, in the order of ExrPart::channels, each rows x width entries. Called from any thread,
/// several at a time.
using ExrFill = std::function<void(std::span<ExrPlane>)>;
/// Prepares the data of a block of rows [first, first + rows). Called from the caller's thread, in order of the rows.
using ExrPrepare = std::function<ExrFill(int first, int rows)>;

/// A file of one or more parts. It appears under its name when complete, or not at all (io/files.h). Its bytes depend
/// neither on the number of threads nor on time.
class ExrWriter {
 public:
  /// Writes the headers. Throws InvalidArgument for a part that cannot be (size, no channel, a name twice), FileError.
  ExrWriter(const std::string& path, std::span<const ExrPart> parts, const ExrOptions& options);
  ~ExrWriter();
  ExrWriter(const ExrWriter&) = delete;
  ExrWriter& operator=(const ExrWriter&) = delete;

  /// Writes all pixels of a part; parts in order, each once. A few blocks are in memory at a time. Throws FileError and
  /// whatever prepare and fill throw; commit() must not follow then.
  void write_part(int part, const ExrPrepare& prepare);
  /// After all parts. Throws FileError.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carreau
