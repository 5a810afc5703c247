// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for an unknown word.
#pragma once

#include <string>
#include <vector>

namespace command {

/// Known words within a few slips (letters added, left out, changed, two exchanged), nearest first, at most three; then
/// words that begin with the word. Capitals do not count.
std::vector<std::string> near_words(const std::string& word, const std::vector<std::string>& known);

/// "; did you mean 'size'?", "; did you mean 'size' or 'size-map'?", "." without any.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

}  // namespace command
