// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/curve_edges.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/failure.h"
#include "base/lengths.h"
#include "files/session_handle.h"
#include "mesh/selection.h"

namespace command {

namespace {

constexpr const char* edges_option = "--curve-edges";
constexpr const char* vertices_option = "--curve-vertices";

template <typename Number>
bool parse(std::string_view word, Number& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && !word.empty();
}

[[noreturn]] void refuse(const char* option, const std::string& setting, const std::string& expected) {
  throw Failure(std::string(option) + " '" + setting + "': " + expected);
}

struct EdgesOfCurve {
  std::int32_t edges = 1, progression = CARREAU_EQUAL;
  double ratio = 1;
};

/// "8", "8,arithmetic:3" or "8,geometric:1.2".
EdgesOfCurve parse_edges(const std::string& setting, const std::string& text) {
  const char* expected = "a number of edges N, or N,arithmetic:RATIO or N,geometric:RATIO must follow the sign";
  EdgesOfCurve told;
  const std::size_t comma = text.find(',');
  if (!parse(std::string_view(text).substr(0, comma), told.edges) || told.edges < 1)
    refuse(edges_option, setting, expected);
  if (comma == text.npos) return told;
  const std::string_view rest = std::string_view(text).substr(comma + 1);
  const std::size_t colon = rest.find(':');
  const std::string_view name = rest.substr(0, colon);
  if (colon == rest.npos || (name != "arithmetic" && name != "geometric") ||
      !parse(rest.substr(colon + 1), told.ratio) || !(told.ratio > 0))
    refuse(edges_option, setting, expected);
  told.progression = name == "arithmetic" ? CARREAU_ARITHMETIC : CARREAU_GEOMETRIC;
  return told;
}

std::vector<double> parse_vertices(const std::string& setting, const std::string& text) {
  std::vector<double> t;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    double value = 0;
    if (!parse(std::string_view(text).substr(begin, end - begin), value) || (!t.empty() && !(t.back() < value)))
      refuse(vertices_option, setting, "increasing parameters with commas between them must follow the sign");
    t.push_back(value);
    begin = end + 1;
  }
  return t;
}

/// A curve in a face that has it.
struct CurvePlace {
  std::int32_t face = 0, ic = 0;
};

/// "12", the number of a curve, or "7/2", curve 2 of face 7.
class CurvesOfModel {
 public:
  CurvesOfModel(carreau_session* session, const CadInput& input) : input_(input) {
    std::int64_t n = 0;
    require(session, carreau_model_count(session, nullptr, &n, nullptr));
    face_.resize(static_cast<std::size_t>(n)), ref_.resize(static_cast<std::size_t>(n));
    require(session, carreau_model_curves(session, n, face_.data(), nullptr, ref_.data(), nullptr));
  }

  [[nodiscard]] CurvePlace find(const char* option, const std::string& setting, const std::string& name) const {
    CurvePlace place;
    const std::size_t slash = name.find('/');
    if (slash != name.npos) {
      if (parse(std::string_view(name).substr(0, slash), place.face) &&
          parse(std::string_view(name).substr(slash + 1), place.ic))
        return place;
      refuse(option, setting, "a curve is its number, or FACE/RANK, the rank in one of its faces");
    }
    std::int32_t number = 0;
    if (!parse(std::string_view(name), number) || number < 1)
      refuse(option, setting, "a curve is its number, or FACE/RANK, the rank in one of its faces");
    return of_number(option, setting, number);
  }

 private:
  [[nodiscard]] CurvePlace of_number(const char* option, const std::string& setting, std::int32_t number) const {
    std::int32_t ic = 0;
    bool numbered = false;
    std::vector<std::int32_t> pieces;
    for (std::size_t i = 0; i < ref_.size(); ++i) {
      ic = i > 0 && face_[i] == face_[i - 1] ? ic + 1 : 1;
      numbered = numbered || ref_[i] != 0;
      if (ref_[i] == number) return {face_[i], ic};
      if (input_.whole_curve(ref_[i]) == number) pieces.push_back(ref_[i]);
    }
    if (!pieces.empty())
      refuse(option, setting,
             "the curve is cut where faces bend; its pieces begin with number " + std::to_string(pieces.front()));
    refuse(option, setting,
           numbered ? "no curve has this number" : "curves of this file have no numbers yet: name one as FACE/RANK");
  }

  const CadInput& input_;
  std::vector<std::int32_t> face_, ref_;
};

}  // namespace

void check_curve_edges(const MeshOptions& options) {
  for (const std::string& each : options.curve_edges)
    (void)parse_edges(each, parse_assignment(each, edges_option).second);
  for (const std::string& each : options.curve_vertices)
    (void)parse_vertices(each, parse_assignment(each, vertices_option).second);
}

void prescribe_curve_edges(carreau_session* session, const MeshOptions& options, const CadInput& input) {
  if (options.curve_edges.empty() && options.curve_vertices.empty()) return;
  const CurvesOfModel curves(session, input);
  for (const std::string& each : options.curve_edges) {
    const auto [name, text] = parse_assignment(each, edges_option);
    const CurvePlace place = curves.find(edges_option, each, name);
    const EdgesOfCurve told = parse_edges(each, text);
    require(session,
            carreau_model_divide_curve(session, place.face, place.ic, told.edges, told.progression, told.ratio));
  }
  for (const std::string& each : options.curve_vertices) {
    const auto [name, text] = parse_assignment(each, vertices_option);
    const CurvePlace place = curves.find(vertices_option, each, name);
    const std::vector<double> t = parse_vertices(each, text);
    require(session, carreau_model_divide_curve_at(session, place.face, place.ic, static_cast<std::int64_t>(t.size()),
                                                   t.data()));
  }
}

// ---- layers ----

namespace {

constexpr const char* layers_option = "--layers";

struct LayerRule {
  std::string entities, first;  ///< first is empty if y+ gives the height
  double ratio = 1.2;
  double wall_units = 0, y_plus = 0;  ///< friction velocity over viscosity, 1 / length; y+ of the first height; 0: not given

  [[nodiscard]] double first_height(double diagonal) const {
    return first.empty() ? y_plus / wall_units : parse_length(first, layers_option).of(diagonal);
  }
  std::int32_t count = 10;
};

LayerRule parse_layers(const std::string& rule) {
  const auto [entities, words] = parse_assignment(rule, layers_option);
  LayerRule parsed{.entities = entities, .first = {}};
  const auto refuse = [&] {
    throw Failure(std::string(layers_option) + " '" + rule + "': layers are written as in " + entities +
                  "=first:0.001,ratio:1.2,count:20; u_tau/nu:50000 gives y+ of the first height, and yplus:1 beside it the height.");
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
    else if (name == "u_tau/nu")
      number(value, parsed.wall_units);
    else if (name == "yplus")
      number(value, parsed.y_plus);
    else
      refuse();
    begin = end + 1;
  }
  const bool by_wall = parsed.wall_units > 0 && std::isfinite(parsed.wall_units);
  if (parsed.first.empty() ? !(by_wall && parsed.y_plus > 0) : parsed.y_plus != 0 || !(by_wall || parsed.wall_units == 0)) refuse();
  if (!parsed.first.empty()) (void)parse_length(parsed.first, std::string(layers_option) + " '" + rule + "'");
  return parsed;
}

carreau_layers_report report_on(carreau_session* session, std::size_t index) {
  carreau_layers_report report{};
  report.struct_size = sizeof report;
  require(session, carreau_session_layers(session, static_cast<std::int64_t>(index), &report));
  return report;
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
                                        rule.first_height(input.diagonal()), rule.ratio, rule.count));
  }
}

std::string missing_rows(carreau_session* session, const MeshOptions& options) {
  std::string rules;
  for (std::size_t i = 0; i < options.layers.size(); ++i)
    if (report_on(session, i).fewest_rows == 0) rules += (rules.empty() ? "'" : ", '") + options.layers[i] + "'";
  return rules.empty() ? "" : std::string(layers_option) + " " + rules + ": some edges have no row.";
}

std::vector<std::string> y_plus_lines(carreau_session* session, const MeshOptions& options) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < options.layers.size(); ++i) {
    const double scale = parse_layers(options.layers[i]).wall_units;
    const carreau_layers_report r = report_on(session, i);
    if (!(scale > 0) || r.rows == 0) continue;
    std::array<char, 128> line{};
    (void)std::snprintf(line.data(), line.size(), "layers     y+ %.4g (%.4g to %.4g) at the first height, ", scale * r.first_mean,
                        scale * r.first_min, scale * r.first_max);
    lines.push_back(line.data() + options.layers[i]);
  }
  return lines;
}

nlohmann::ordered_json layers_json(carreau_session* session, const MeshOptions& options, double diagonal) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < options.layers.size(); ++i) {
    const carreau_layers_report r = report_on(session, i);
    list.push_back({{"rule", options.layers[i]},
                    {"cells", r.cells},
                    {"rows", r.rows},
                    {"fewest_rows", r.fewest_rows},
                    {"first_height", {{"min", r.first_min}, {"mean", r.first_mean}, {"max", r.first_max}}},
                    {"growth", {{"min", r.growth_min}, {"mean", r.growth_mean}, {"max", r.growth_max}}}});
    const LayerRule rule = parse_layers(options.layers[i]);
    const auto times = [&r](double scale) -> nlohmann::ordered_json {
      return {{"min", scale * r.first_min}, {"mean", scale * r.first_mean}, {"max", scale * r.first_max}};
    };
    list.back()["first_over_request"] = times(1 / rule.first_height(diagonal));
    if (rule.wall_units > 0) list.back()["y_plus"] = times(rule.wall_units);
  }
  return list;
}

}  // namespace command
