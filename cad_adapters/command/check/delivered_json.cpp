// SPDX-License-Identifier: BSD-3-Clause
#include "check/delivered_json.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "files/session_handle.h"

namespace command {
namespace {

const char* entity_word(std::int32_t entity) {
  return entity == CARREAU_OF_EDGES ? "edge" : entity == CARREAU_OF_VERTICES ? "vertex" : "triangle";
}

nlohmann::ordered_json measure_json(carreau_session* session, std::int32_t kind, const carreau_measure& measure) {
  std::vector<double> bounds(static_cast<std::size_t>(measure.classes));
  std::vector<std::int64_t> counts(bounds.size());
  require(session, carreau_delivered_histogram(session, kind, measure.classes, bounds.data(), counts.data()));
  // The first class has no lower bound.
  if (!bounds.empty()) bounds.erase(bounds.begin());
  const auto value = [&](double x) {
    return measure.count > 0 ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
  };
  return {{"of", entity_word(measure.entity)},
          {"count", measure.count},
          {"mean", value(measure.mean)},
          {"min", value(measure.min)},
          {"p1", value(measure.p1)},
          {"p99", value(measure.p99)},
          {"max", value(measure.max)},
          {"limit", measure.limit},
          {"beyond", measure.beyond},
          {"forced", measure.forced},
          {"histogram", {{"bounds", bounds}, {"counts", counts}}}};
}

/// The last `n` lines.
std::vector<std::string> last_lines(const std::string& text, std::size_t n) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  if (lines.size() > n) lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(n));
  return lines;
}

}  // namespace

nlohmann::ordered_json delivered_json(carreau_session* session) {
  carreau_delivered delivered{};
  delivered.struct_size = sizeof delivered;
  require(session, carreau_session_delivered(session, &delivered));
  // The text lives until the next call.
  const std::vector<std::string> not_met = last_lines(delivered.text, static_cast<std::size_t>(delivered.not_met));
  nlohmann::ordered_json measures;
  for (std::int32_t kind = CARREAU_MEASURE_LENGTH; kind <= CARREAU_MEASURE_INPUT_BOUND; ++kind) {
    carreau_measure measure{};
    measure.struct_size = sizeof measure;
    require(session, carreau_delivered_measure(session, kind, &measure));
    measures[measure.name] = measure_json(session, kind, measure);
  }
  nlohmann::ordered_json all = {{"measures", measures},
                                {"lengths_in_range", delivered.in_range},
                                {"folded_triangles", delivered.folded_triangles},
                                {"not_met", not_met}};
  if (std::isfinite(delivered.input_bound))
    all["input"] = {{"distance", delivered.input_distance},
                    {"bound", delivered.input_bound},
                    {"back_distance", delivered.input_back_distance},
                    {"back_bound", delivered.input_back_bound}};
  return all;
}

}  // namespace command
