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

constexpr std::int32_t most_fields = 64;  // a file of more is no solution, but a mistake

/// Empty when the list of types is one that is wanted, else what is wrong with it. Only the first type is looked at
/// when there are several: that alone is wrong then.
std::string refusal_of(std::int32_t how_many, std::int32_t type) {
  if (how_many != 1)
    return "there are " + std::to_string(how_many) + " values at each vertex; one size, field or metric is wanted";
  switch (static_cast<ValueType>(type)) {
    case ValueType::scalar:
    case ValueType::symmetric:
      return {};
    case ValueType::vector:
      return "the values are vectors (type 2); scalars (1) or symmetric tensors (3) are wanted";
    case ValueType::full:
      return "the values are tensors that are not symmetric (type 4); scalars (1) or symmetric tensors (3) are wanted";
  }
  return "type " + std::to_string(type) + " is none of 1 (scalar), 2 (vector), 3 (symmetric tensor), 4 (tensor)";
}

/// The same where fields of all types are wanted.
std::string refusal_of_field(std::int32_t type) {
  return type >= 1 && type <= 4 ? "" : refusal_of(1, type);
}
std::string refusal_of_number(std::int32_t how_many) {
  if (how_many >= 1 && how_many <= most_fields) return {};
  return "there are " + std::to_string(how_many) + " values at each vertex; 1 to " + std::to_string(most_fields) +
         " are wanted";
}

/// Reads the list of types behind their number. next() gives an integer, fail(sentence) does not return.
void read_types(std::int32_t how_many, SolutionUse use, Solution& solution, const auto& next, const auto& fail) {
  if (use != SolutionUse::fields) {
    const std::int32_t type = how_many == 1 ? next() : 0;
    if (const std::string why = refusal_of(how_many, type); !why.empty()) fail(why);
    solution.tensor = static_cast<ValueType>(type) == ValueType::symmetric;
    return;
  }
  if (const std::string why = refusal_of_number(how_many); !why.empty()) fail(why);
  for (std::int32_t i = 0; i < how_many; ++i) {
    const std::int32_t type = next();
    if (const std::string why = refusal_of_field(type); !why.empty()) fail(why);
    solution.fields.push_back(static_cast<ValueType>(type));
  }
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
  TextReader(std::string_view text, const std::string& name, SolutionUse use) : in_(text, name), use_(use) {}

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
    read_types(
        how_many, use_, solution_, [&] { return in_.integer("the type of the values"); },
        [&](const std::string& why) { in_.fail(in_.position(), why); });
    const char* start = in_.position();
    in_.go_back(number);  // count() compares with the rest of the text
    const std::size_t each = solution_.components(), n = in_.count("vertices", each);
    in_.go_back(start);
    solution_.values.resize(n * each);
    for (std::size_t v = 0; v < n; ++v) {
      for (std::size_t k = 0; k < each; ++k) solution_.values[v * each + k] = in_.real("a value");
      if (const std::string why = refusal_of_values(solution_, v, use_); !why.empty()) in_.fail(in_.position(), why);
    }
  }

  MeditWords in_;
  SolutionUse use_;
  Solution solution_;
  bool has_values_ = false;
};

class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, const std::string& name, SolutionUse use) : in_(bytes, name), use_(use) {}

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
    read_types(
        how_many, use_, solution_, [&] { return in_.integer(); },
        [&](const std::string& why) { in_.fail(types, why); });
    const std::size_t each = solution_.components();
    const std::size_t n = in_.checked_count(announced, at, "values", each * in_.sizes().real);
    solution_.values.resize(n * each);
    for (std::size_t v = 0; v < n; ++v) {
      const std::size_t record = in_.position();
      for (std::size_t k = 0; k < each; ++k) solution_.values[v * each + k] = in_.real("a value");
      if (const std::string why = refusal_of_values(solution_, v, use_); !why.empty()) in_.fail(record, why);
    }
  }

  GmfSections in_;
  SolutionUse use_;
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

Solution read_solution_text(std::string_view text, const std::string& name, SolutionUse use) {
  return TextReader(without_byte_order_mark(text), name, use).read();
}

Solution read_solution_binary(std::string_view bytes, const std::string& name, SolutionUse use) {
  return BinaryReader(bytes, name, use).read();
}

Solution read_solution(const std::string& path, SolutionUse use) {
  const std::string content = read_file(path);
  return starts_as_gmf(content) ? read_solution_binary(content, path, use) : read_solution_text(content, path, use);
}

}  // namespace carreau
