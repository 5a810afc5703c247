// SPDX-License-Identifier: BSD-3-Clause
#include "atlas_input.h"
#include "cad_input.h"
#include "failure.h"
#include "formula_input.h"
#include "model_input.h"
#include "text_file.h"

namespace command {

bool needs_host(const std::string& path) { return suffix_of(path) == ".pardom"; }

void check_geometry_name(const std::string& path) {
  if (path.empty()) throw Failure("The name of the input is empty.");
}

std::unique_ptr<CadInput> open_input(const std::string& path, const InputChoice& choice,
                                     const ReadingProgress& progress) {
  if (is_formula(path)) return open_formula(path, choice.domain);
  if (choice.molecule.surface == atlas_surface) return open_atlas(path);
  check_geometry_name(path);
  if (needs_host(path)) {
    if (choice.host.empty()) throw Failure("'" + path + "' has no geometry: --host names the shared library that has.");
    return open_pardom(path, choice.host);
  }
  if (is_grid(path, choice.grid)) return open_grid(path, choice.grid);
  if (is_triangles(path)) return open_triangles(path, choice.triangles);
  if (is_molecule(path)) return open_molecule(path, choice.molecule);
  return suffix_of(path) == ".bpt" ? open_bezier(path) : open_cad(path, choice.loose_edges, progress);
}

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
