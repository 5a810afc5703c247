// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/curve_edges.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/failure.h"
#include "base/lengths.h"
#include "files/session_handle.h"

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

}  // namespace command
