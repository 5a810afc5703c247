// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "io/files.h"
#include "io/medit/gmf_sections.h"
#include "io/medit/medit_words.h"
#include "io/medit/sol_files.h"
#include "io/text.h"
#include "metric/metric3_algebra.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr std::int32_t max_fields = 64;  // a file of more is no solution, but a mistake

/// Empty if values of the type can be a size, a field or a metric, else the reason.
std::string refusal_of(std::int32_t type) {
  switch (static_cast<ValueType>(type)) {
    case ValueType::scalar:
    case ValueType::symmetric:
      return {};
    case ValueType::vector:
      return "the values are vectors (type 2); scalars (1) or symmetric tensors (3) are required";
    case ValueType::full:
      return "the values are tensors that are not symmetric (type 4); scalars (1) or symmetric tensors (3) are required";
  }
  return "type " + std::to_string(type) + " is not 1 (scalar), 2 (vector), 3 (symmetric tensor) or 4 (tensor)";
}

std::string list_of(const std::vector<ValueType>& fields) {
  constexpr const char* names[] = {"scalar", "vector", "symmetric tensor", "tensor"};
  std::string text;
  for (std::size_t i = 0; i < fields.size(); ++i)
    text += (i > 0 ? ", " : "") + std::to_string(i + 1) + " " + names[static_cast<std::size_t>(fields[i]) - 1];
  return text;
}

/// The numbers of each vertex that are read, among all of its record.
struct Record {
  std::size_t first = 0, width = 0, all = 0;
};

/// Reads the list of types behind their number, and chooses a field. next() gives an integer, fail(sentence) does not
/// return.
Record read_types(std::int32_t how_many, const SolutionChoice& choice, Solution& solution, const auto& next,
                  const auto& fail) {
  const auto fail_number = [&](const std::string& list) {
    fail("there are " + std::to_string(how_many) + " values at each vertex" + list);
  };
  const bool any = choice.use == SolutionUse::fields;
  if (how_many < 1 || how_many > max_fields)
    fail_number(any ? "; 1 to " + std::to_string(max_fields) + " are required"
                    : "; one size, field or metric is required");
  std::vector<ValueType> types;
  Record record;
  for (std::int32_t i = 0; i < how_many; ++i) {
    const std::int32_t type = next();
    if (type < 1 || type > 4) fail(refusal_of(type));
    types.push_back(static_cast<ValueType>(type));
    record.all += components_of(types.back(), solution.dimension);
  }
  if (any && choice.field == 0) {
    solution.fields = std::move(types);
    record.width = record.all;
    return record;
  }
  if (choice.field == 0 && how_many > 1)
    fail_number(" (" + list_of(types) +
                "); one size, field or metric is required, which the parameter sol_field chooses");
  const auto chosen = static_cast<std::size_t>(choice.field > 0 ? choice.field - 1 : 0);
  if (chosen >= types.size())
    fail("sol_field chooses field " + std::to_string(choice.field) + ", but these are there: " + list_of(types));
  const ValueType type = types[chosen];
  for (std::size_t i = 0; i < chosen; ++i) record.first += components_of(types[i], solution.dimension);
  record.width = components_of(type, solution.dimension);
  if (any) {
    solution.fields = {type};
    return record;
  }
  if (const std::string why = refusal_of(static_cast<std::int32_t>(type)); !why.empty())
    fail(types.size() > 1 ? why + "; the fields are: " + list_of(types) : why);
  solution.tensor = type == ValueType::symmetric;
  return record;
}

/// Empty when the values of a vertex (from 0) can be used.
std::string refusal_of_values(const Solution& solution, std::size_t vertex, SolutionUse use) {
  if (use != SolutionUse::prescription) return {};
  const std::string name = "vertex " + std::to_string(vertex + 1);
  if (!solution.tensor) {
    const double size = solution.values[vertex];
    return size > 0 ? "" : name + " has the size " + format_number(size) + ", which is not positive";
  }
  const bool definite = solution.dimension == 2 ? is_positive_definite(plane_tensor(solution, vertex))
                                                : is_positive_definite(space_tensor(solution, vertex));
  return definite ? "" : name + " has a metric that is not positive definite";
}

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& name, const SolutionChoice& choice)
      : in_(text, name), choice_(choice) {}

  Solution read() {
    in_.header("a solution file");
    in_.skip_any_section();  // only SolAtVertices counts, and programs add sections of their own
    for (;;) {
      const std::string_view name = in_.next_section({"SolAtVertices"});
      if (name.empty()) break;
      values(name.data());
    }
    if (!has_values_) in_.fail(in_.position(), "the file has no SolAtVertices");
    return std::move(solution_);
  }

 private:
  void values(const char* at) {
    if (!in_.dimension()) in_.fail(at, "SolAtVertices comes before Dimension");
    if (has_values_) in_.fail(at, "SolAtVertices comes twice");
    has_values_ = true;
    solution_.dimension = *in_.dimension();
    const char* number = in_.position();
    in_.integer("the number of vertices");
    const std::int32_t how_many = in_.integer("the number of values at a vertex");
    const Record record = read_types(
        how_many, choice_, solution_, [&] { return in_.integer("the type of the values"); },
        [&](const std::string& why) { in_.fail(in_.position(), why); });
    const char* start = in_.position();
    in_.go_back(number);  // count() compares with the rest of the text
    const std::size_t each = record.width, n = in_.count("vertices", record.all);
    in_.go_back(start);
    solution_.values.resize(n * each);
    for (std::size_t v = 0; v < n; ++v) {
      for (std::size_t k = 0; k < record.all; ++k)
        if (const double value = in_.real("a value"); k >= record.first && k < record.first + each)
          solution_.values[v * each + k - record.first] = value;
      if (const std::string why = refusal_of_values(solution_, v, choice_.use); !why.empty())
        in_.fail(in_.position(), why);
    }
  }

  MeditWords in_;
  SolutionChoice choice_;
  Solution solution_;
  bool has_values_ = false;
};

class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, const std::string& name, const SolutionChoice& choice)
      : in_(bytes, name), choice_(choice) {}

  Solution read() {
    in_.header();
    for (std::int32_t code; (code = in_.next()) != static_cast<std::int32_t>(GmfCode::end);) section(code);
    if (!has_values_) in_.fail(in_.position(), "the file has no solution at vertices");
    return std::move(solution_);
  }

 private:
  void section(std::int32_t code) {
    if (code == static_cast<std::int32_t>(GmfCode::dimension)) {
      if (has_dimension_) in_.fail(in_.position(), "the dimension is given twice");
      has_dimension_ = true;
      solution_.dimension = in_.dimension();
    } else if (code == static_cast<std::int32_t>(GmfCode::sol_at_vertices)) {
      values();
    }
  }

  void values() {
    const std::size_t at = in_.position();
    if (!has_dimension_) in_.fail(at, "the solution comes before the dimension");
    if (has_values_) in_.fail(at, "the solution at vertices is given twice");
    has_values_ = true;
    const std::int64_t announced = in_.announced();
    const std::size_t types = in_.position();
    const std::int32_t how_many = in_.integer();
    const Record record = read_types(
        how_many, choice_, solution_, [&] { return in_.integer(); },
        [&](const std::string& why) { in_.fail(types, why); });
    const std::size_t each = record.width;
    const std::size_t n = in_.checked_count(announced, at, "values", record.all * in_.sizes().real);
    solution_.values.resize(n * each);
    for (std::size_t v = 0; v < n; ++v) {
      const std::size_t start = in_.position();
      for (std::size_t k = 0; k < record.all; ++k)
        if (const double value = in_.real("a value"); k >= record.first && k < record.first + each)
          solution_.values[v * each + k - record.first] = value;
      if (const std::string why = refusal_of_values(solution_, v, choice_.use); !why.empty()) in_.fail(start, why);
    }
  }

  GmfSections in_;
  SolutionChoice choice_;
  Solution solution_;
  bool has_dimension_ = false, has_values_ = false;
};

}  // namespace

Metric2 plane_tensor(const Solution& solution, std::size_t vertex) noexcept {
  const double* m = solution.values.data() + 3 * vertex;
  return {m[0], m[1], m[2]};
}

Metric3 space_tensor(const Solution& solution, std::size_t vertex) noexcept {
  const double* m = solution.values.data() + 6 * vertex;
  return {.xx = m[0], .xy = m[1], .xz = m[3], .yy = m[2], .yz = m[4], .zz = m[5]};
}

Solution read_solution_text(std::string_view text, const std::string& name, const SolutionChoice& choice) {
  return TextReader(without_byte_order_mark(text), name, choice).read();
}

Solution read_solution_binary(std::string_view bytes, const std::string& name, const SolutionChoice& choice) {
  return BinaryReader(bytes, name, choice).read();
}

Solution read_solution(const std::string& path, const SolutionChoice& choice) {
  const std::string content = read_file(path);
  return starts_as_gmf(content) ? read_solution_binary(content, path, choice)
                                : read_solution_text(content, path, choice);
}

}  // namespace carreau
