// SPDX-License-Identifier: BSD-3-Clause
#include "base/suggestions.h"

#include <carreau.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <utility>

namespace command {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Least number of slips from one word to the other (optimal string alignment).
std::size_t slips_between(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1] ? 1 : 0)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::vector<std::string> near_words(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t most = 3, longest = 200;
  if (word.empty() || word.size() > longest) return {};
  const std::string wanted = lower(word);
  std::vector<std::pair<std::size_t, std::string>> found;
  for (const std::string& each : known) {
    if (each.size() > longest) continue;
    const std::string name = lower(each);
    const std::size_t slips = slips_between(wanted, name);
    const bool begins = wanted.size() >= 3 && name.starts_with(wanted);
    if (begins || slips <= std::max<std::size_t>(1, std::min(wanted.size(), name.size()) / 3))
      found.emplace_back(begins ? std::min<std::size_t>(slips, 1) : slips, each);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<std::string> words;
  for (std::size_t i = 0; i < found.size() && i < most; ++i) words.push_back(found[i].second);
  return words;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::vector<std::string> words = near_words(word, known);
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "; did you mean '" : i + 1 == words.size() ? " or '" : ", '") + words[i] + "'";
  return text.empty() ? "." : text + "?";
}

std::vector<std::string> parameter_names() {
  std::vector<std::string> names;
  for (std::int32_t i = 0; i < carreau_parameter_count(); ++i) {
    carreau_parameter parameter{};
    parameter.struct_size = sizeof parameter;
    if (carreau_parameter_info(i, &parameter) == CARREAU_OK) names.emplace_back(parameter.name);
  }
  return names;
}

}  // namespace command
