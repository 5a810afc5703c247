// SPDX-License-Identifier: BSD-3-Clause
// The error that ends a command.
#pragma once

#include <stdexcept>

namespace command {

/// Ends the program with exit code 2 and the sentence.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace command
