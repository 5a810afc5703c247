// SPDX-License-Identifier: BSD-3-Clause
// Why the command cannot do what it is asked.
#pragma once

#include <stdexcept>

namespace command {

/// Ends the program with exit code 2 and the sentence.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace command
