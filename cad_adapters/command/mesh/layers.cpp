// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/layers.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "base/failure.h"
#include "base/lengths.h"
#include "files/session_handle.h"
#include "mesh/selection.h"

namespace command {
namespace {

constexpr const char* layers_option = "--layers";

struct LayerRule {
  std::string entities, first;
  double ratio = 1.2;
  std::int32_t count = 10;
};

LayerRule parse_layers(const std::string& rule) {
  const auto [entities, words] = parse_assignment(rule, layers_option);
  LayerRule parsed{.entities = entities, .first = {}};
  const auto refuse = [&] {
    throw Failure(std::string(layers_option) + " '" + rule + "': layers are written as in " + entities +
                  "=first:0.001,ratio:1.2,count:20.");
  };
  const auto number = [&](std::string_view word, auto& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) refuse();
  };
  for (std::size_t begin = 0; begin <= words.size();) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    const std::string word = words.substr(begin, end - begin);
    const std::size_t colon = word.find(':');
    const std::string name = word.substr(0, colon), value = colon == word.npos ? "" : word.substr(colon + 1);
    if (name == "first")
      parsed.first = value;
    else if (name == "ratio")
      number(value, parsed.ratio);
    else if (name == "count")
      number(value, parsed.count);
    else
      refuse();
    begin = end + 1;
  }
  if (parsed.first.empty()) refuse();
  (void)parse_length(parsed.first, std::string(layers_option) + " '" + rule + "'");
  return parsed;
}

carreau_layers_report report_on(carreau_session* session, std::size_t index) {
  carreau_layers_report report{};
  report.struct_size = sizeof report;
  require(session, carreau_session_layers(session, static_cast<std::int64_t>(index), &report));
  return report;
}

std::string range_text(double mean, double low, double high) {
  return number_text(mean) + " (" + number_text(low) + " to " + number_text(high) + ")";
}

}  // namespace

void check_layers(const MeshOptions& options) {
  for (const std::string& each : options.layers) (void)parse_layers(each);
}

void add_layers(carreau_session* session, const MeshOptions& options, const CadInput& input) {
  require(session, carreau_clear_layers(session));
  if (options.layers.empty()) return;
  std::int64_t n = 0;
  require(session, carreau_model_count(session, nullptr, &n, nullptr));
  std::vector<std::int32_t> known(static_cast<std::size_t>(n));
  require(session, carreau_model_curves(session, n, nullptr, nullptr, known.data(), nullptr));
  for (const std::string& each : options.layers) {
    const LayerRule rule = parse_layers(each);
    const Selection selection = select(input, rule.entities, layers_option);
    const std::string label = std::string(layers_option) + " '" + each + "': ";
    if (selection.dimension != 1) throw Failure(label + "layers grow from edges, as in edge:3.");
    std::set<std::int32_t> curves;
    for (const std::int32_t ref : selection.refs) {
      const std::size_t before = curves.size();
      for (const std::int32_t curve : known)
        if (input.whole_curve(curve) == ref) curves.insert(curve);
      if (curves.size() == before) throw Failure(label + "there is no edge " + std::to_string(ref) + " on a face.");
    }
    const std::vector<std::int32_t> refs(curves.begin(), curves.end());
    require(session, carreau_add_layers(session, static_cast<std::int64_t>(refs.size()), refs.data(),
                                        parse_length(rule.first, layers_option).of(input.diagonal()), rule.ratio, rule.count));
  }
}

std::vector<std::string> layer_lines(carreau_session* session, const MeshOptions& options) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < options.layers.size(); ++i) {
    const carreau_layers_report r = report_on(session, i);
    std::string line = "layers " + parse_layers(options.layers[i]).entities + ": ";
    if (r.cells == 0)
      line += "no row has room";
    else
      line += std::to_string(r.cells) + " cells in " + (r.fewest_rows < r.rows ? std::to_string(r.fewest_rows) + " to " : "") +
              std::to_string(r.rows) + " rows, first height " + range_text(r.first_mean, r.first_min, r.first_max) +
              (r.growth_max > 0 ? ", growth " + range_text(r.growth_mean, r.growth_min, r.growth_max) : "");
    lines.push_back(std::move(line));
  }
  return lines;
}

nlohmann::ordered_json layers_json(carreau_session* session, const MeshOptions& options) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < options.layers.size(); ++i) {
    const carreau_layers_report r = report_on(session, i);
    list.push_back({{"rule", options.layers[i]},
                    {"cells", r.cells},
                    {"rows", r.rows},
                    {"fewest_rows", r.fewest_rows},
                    {"first_height", {{"min", r.first_min}, {"mean", r.first_mean}, {"max", r.first_max}}},
                    {"growth", {{"min", r.growth_min}, {"mean", r.growth_mean}, {"max", r.growth_max}}}});
  }
  return list;
}

}  // namespace command
