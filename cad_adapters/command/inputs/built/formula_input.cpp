// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/built/formula_input.h"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/failure.h"
#include "base/text_file.h"
#include "inputs/base/model_input.h"
#include "inputs/built/formula.h"

namespace command {
namespace {

constexpr double pi = std::numbers::pi;

/// A side of the domain, by t in [0, 1]: a segment, or an arc when there is a radius.
struct Side {
  double x = 0, y = 0, dx = 0, dy = 0;  ///< a segment: its beginning and its way; an arc: its centre
  double radius = 0, from = 0, turn = 0;

  void at(double t, int order, double* c, double* ct, double* ctt) const {
    if (radius == 0) {
      c[0] = x + t * dx, c[1] = y + t * dy;
      if (order > 0) ct[0] = dx, ct[1] = dy;
      if (order > 1) ctt[0] = ctt[1] = 0;
      return;
    }
    const double a = from + t * turn, cosine = radius * std::cos(a), sine = radius * std::sin(a);
    c[0] = x + cosine, c[1] = y + sine;
    if (order > 0) ct[0] = -turn * sine, ct[1] = turn * cosine;
    if (order > 1) ctt[0] = -turn * turn * cosine, ctt[1] = -turn * turn * sine;
  }
};

/// Two halves, counterclockwise or the other way round.
void add_circle(double x, double y, double radius, bool outer, std::vector<Side>& sides) {
  const double turn = outer ? pi : -pi;
  for (int half = 0; half < 2; ++half) sides.push_back({.x = x, .y = y, .radius = radius, .from = half * turn, .turn = turn});
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const char *p = text.data(), *const end = p + text.size();
  while (p != end) {
    double value = 0;
    const auto [next, error] = std::from_chars(p, end, value);
    if (error != std::errc() || !std::isfinite(value) || (next != end && *next != ',')) return {};
    numbers.push_back(value);
    p = next == end ? end : next + 1;
  }
  return text.empty() || text.back() == ',' ? std::vector<double>{} : numbers;
}

/// Empty: the text is no domain.
std::vector<Side> sides_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {};
  const std::string word = text.substr(0, colon);
  const std::vector<double> n = numbers_of(text.substr(colon + 1));
  std::vector<Side> sides;
  if (word == "box" && n.size() == 4 && n[0] < n[2] && n[1] < n[3]) {
    const double w = n[2] - n[0], h = n[3] - n[1];
    sides = {{.x = n[0], .y = n[1], .dx = w}, {.x = n[2], .y = n[1], .dy = h}, {.x = n[2], .y = n[3], .dx = -w}, {.x = n[0], .y = n[3], .dy = -h}};
  } else if (word == "disc" && n.size() == 3 && n[2] > 0) {
    add_circle(n[0], n[1], n[2], true, sides);
  } else if (word == "ring" && n.size() == 4 && n[2] > 0 && n[2] < n[3]) {
    add_circle(n[0], n[1], n[3], true, sides);
    add_circle(n[0], n[1], n[2], false, sides);
  }
  return sides;
}

/// "z" of "z = x * y"; ' ': no equation.
char left_side(const std::string& text) {
  const std::size_t name = text.find_first_not_of(" \t"), equals = text.find_first_not_of(" \t", name + 1);
  if (name == std::string::npos || equals == std::string::npos || text[equals] != '=') return ' ';
  return text.find_first_of("xyz", name) == name ? text[name] : ' ';
}

class FormulaInput final : public ModelInput {
 public:
  FormulaInput(const std::string& input, std::vector<Side> sides) : ModelInput(model_of(sides)), sides_(std::move(sides)) {
    for (std::size_t from = 0; from <= input.size();) {
      const std::size_t end = std::min(input.find(';', from), input.size());
      add(input.substr(from, end - from));
      from = end + 1;
    }
    const bool cartesian = formula_[2] && !formula_[0] && !formula_[1];
    if (!cartesian && !(formula_[0] && formula_[1] && formula_[2]))
      throw Failure("A surface is 'z = ...' in x and y, or 'x = ...; y = ...; z = ...' in u and v.");
    const char* const names = cartesian ? "xy" : "uv";
    for (std::unique_ptr<Formula>& each : formula_)
      if (each) each = std::make_unique<Formula>(each->text(), names);
    measure(input);
  }

  [[nodiscard]] bool locate(std::int32_t, double u, double v, Place& place) const noexcept override {
    const Place at{u, v, 0, u, v};
    place = at;
    if (formula_[0]) place.x = (*formula_[0])(at), place.y = (*formula_[1])(at);
    place.z = (*formula_[2])(at);
    return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z);
  }

  [[nodiscard]] bool on_curve(std::int32_t, std::int32_t ic, double share, double& u, double& v) const noexcept override {
    double c[2];
    sides_[static_cast<std::size_t>(ic) - 1].at(share, 0, c, nullptr, nullptr);
    u = c[0], v = c[1];
    return true;
  }

 private:
  static FaceModel model_of(const std::vector<Side>& sides) {
    FaceModel model;
    model.faces.push_back({.ref = 1, .curves = std::vector<FaceModel::Curve>(sides.size()), .points = {}});
    return model;
  }

  void add(const std::string& equation) {
    const char name = left_side(equation);
    if (name == ' ') throw Failure("'" + equation + "' is not an equation of x, y or z.");
    std::unique_ptr<Formula>& formula = formula_[static_cast<std::size_t>(name - 'x')];
    if (formula) throw Failure(std::string("There are two equations of ") + name + ".");
    formula = std::make_unique<Formula>(equation.substr(equation.find('=') + 1));
  }

  [[nodiscard]] std::string kind(std::int32_t) const override { return "formula"; }

  carreau_status give_geometry(carreau_session* session) override {
    carreau_cad cad{};
    cad.struct_size = sizeof cad;
    cad.user = this;
    cad.curve_order = 2;
    cad.reentrant = 1;
    cad.surface = [](std::int32_t face, double u, double v, std::int32_t, double* S, double*, double*, double*, double*,
                     double*, void* user) -> std::int32_t {
      Place place;
      if (!static_cast<const FormulaInput*>(user)->locate(face, u, v, place)) return 1;
      S[0] = place.x, S[1] = place.y, S[2] = place.z;
      return 0;
    };
    cad.curve_interval = [](std::int32_t, std::int32_t, double* a, double* b, void*) -> std::int32_t {
      *a = 0, *b = 1;
      return 0;
    };
    cad.curve = [](std::int32_t, std::int32_t ic, double t, std::int32_t order, double* c, double* ct, double* ctt,
                   void* user) -> std::int32_t {
      static_cast<const FormulaInput*>(user)->sides_[static_cast<std::size_t>(ic) - 1].at(t, order, c, ct, ctt);
      return 0;
    };
    cad.failure = [](std::int32_t, void*) { return "the formula has no value there"; };
    return carreau_set_cad(session, &cad);
  }

  std::vector<Side> sides_;
  std::array<std::unique_ptr<Formula>, 3> formula_;  // x, y, z
};

}  // namespace

bool is_formula(const std::string& input) {
  std::error_code none;
  return left_side(input) != ' ' && input.find("==") != input.find('=') && !std::filesystem::exists(input, none);
}

std::string domain_defect(const std::string& text) {
  return sides_of(text).empty() ? "'" + text + "' is not a domain: box:x0,y0,x1,y1, disc:x,y,radius or ring:x,y,inner,outer" : "";
}

std::unique_ptr<CadInput> open_formula(const std::string& input, const std::string& domain) {
  return std::make_unique<FormulaInput>(input, sides_of(domain.empty() ? usual_domain : domain));
}

}  // namespace command
