// SPDX-License-Identifier: BSD-3-Clause
// bl2d.env: which domain, which step of its adaptation.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace bl2d {

/// The sentence of the error that stops the program.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Setting {
  std::string name, value;
  int line = 0;
};

struct Env {
  std::string path, folder;  ///< folder: of the file, with a slash at its end, or ""
  std::string base;
  int geometry = 0;
  std::vector<int> steps;         ///< values of `adapt`, in their order; 0 if not given
  bool writes_sizes = false;      ///< file_h 1
  bool writes_bl2d = true;        ///< the format knows element p1 only
  std::vector<Setting> settings;  ///< other names: parameters of the library
};

/// Pairs of a name and a value, one a line; `--` starts a comment. Throws Failure with file and line.
Env read_env(const std::string& path);

}  // namespace bl2d
