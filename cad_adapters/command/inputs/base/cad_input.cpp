// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/base/cad_input.h"

namespace command {

std::string in_terms_of_file(const CadInput& input, const std::string& sentence) {
  static const std::string word = "face ";
  std::string text;
  std::size_t from = 0;
  for (std::size_t at = sentence.find(word); at != std::string::npos; at = sentence.find(word, from)) {
    std::size_t end = at += word.size();
    while (end < sentence.size() && sentence[end] >= '0' && sentence[end] <= '9') ++end;
    text.append(sentence, from, at - from);
    constexpr std::size_t digits = 9;
    if (end > at && end - at <= digits)
      text += std::to_string(input.whole_face(static_cast<std::int32_t>(std::stol(sentence.substr(at, end - at)))));
    else
      text.append(sentence, at, end - at);
    from = end;
  }
  return text + sentence.substr(from);
}

}  // namespace command
