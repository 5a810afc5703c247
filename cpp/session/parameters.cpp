// SPDX-License-Identifier: BSD-3-Clause
#include "session/parameters.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <climits>
#include <cmath>
#include <numeric>

#include "io/text.h"
#include "support/error.h"
#include "support/format.h"
#include "support/infinity.h"

namespace carreau {
namespace {

/// Stands for "greater than 0": bounds are allowed values.
constexpr double kPositive = std::numeric_limits<double>::min();

constexpr ParameterInfo integer_row(const char* name, int minimum, int maximum, int value, const char* help) {
  return {name, ParameterType::integer, double(minimum), double(maximum), double(value), false, "", nullptr, help};
}
/// A row whose value follows `effort` until it is set itself.
constexpr ParameterInfo by_effort(ParameterInfo row) {
  row.set_by = "effort";
  return row;
}
constexpr ParameterInfo real_row(const char* name, double minimum, double maximum, double value, const char* help) {
  return {name, ParameterType::real, minimum, maximum, value, false, "", nullptr, help};
}
constexpr ParameterInfo diag_row(const char* name, double minimum, double factor, const char* help) {
  return {name, ParameterType::real, minimum, infinity, factor, true, "", nullptr, help};
}
constexpr ParameterInfo text_row(const char* name, const char* value, const char* choices, const char* help) {
  return {name, ParameterType::text, 0, 0, 0, false, value, choices, help};
}

// RT-0232 fig. 13, in its order (capitals first). `call` is an action of blsurf.env, not a variable; the "hphymmin" of
// the figure is hphymin in the text, hinterpol_flag is hinterp_flag in sec. 3.1.3: all four words are read. Ours: max_triangles, certify, effort, measure, measure_bounds,
// measure_distances, cracks, crossing_rounds, edge_gradation, shape_trials, sol_field, stagger_strips, patches, sharp_angle, and the
// parameters of metrics (anisotropy_max, eps_chord, geo_guarantee, geo_metric, geo_rule, metric_combination). effort sets the rows
// by_effort().
constexpr std::array kTable = {
    integer_row("CheckAdjacentEdges", 0, 1000, 0, "number of passes that balance the lengths of adjacent edges"),
    integer_row("CheckCloseEdges", 0, 1000, 0, "number of passes that refine boundary curves close to each other"),
    integer_row("CheckWellDefined", 0, 1000, 0,
                "number of passes that check that each parameter domain is well defined"),
    real_row("CoefRectangle", 0, 10, 0.25, "thickness of the rectangles of CheckCloseEdges, as a share of the edge"),
    real_row("LSS", 1e-3, 10, 0.5, "longest sub-segment, in the metric, when the length of an edge is integrated"),
    real_row("adapt_floor", kPositive, infinity, 0.1,
             "call adapt: below this share of its largest absolute value, a field does not sharpen adapt_relative"),
    real_row("adapt_hmax", 0, infinity, 0, "call adapt: largest size (0: a fifth of the diagonal of its mesh)"),
    real_row("adapt_hmin", 0, infinity, 0, "call adapt: smallest size (0: 1/500 of the diagonal of its mesh)"),
    text_row("adapt_mesh", "", nullptr, "call adapt: mesh file that adapt_sol belongs to (\"\": the mesh made last)"),
    text_row("adapt_out", "", nullptr, "call adapt: .sol file for the fields on the new mesh (\"\": none)"),
    real_row("adapt_ratio", 1, infinity, 1000, "call adapt: largest ratio of the two sizes of a metric"),
    text_row("adapt_recovery", "fit", "fit|projection|quadric",
             "call adapt: derivatives by quadratics through each vertex; of plane meshes: L2 projection, or quadrics on the graph"),
    integer_row("adapt_relative", 0, 1, 0, "call adapt: 1: adapt_tolerance is a share of the field's absolute value"),
    text_row("adapt_shape", "isotropic", "isotropic|graph|anisotropic",
             "call adapt: sizes, circles in the tangent planes of the graph, or metrics by both principal values"),
    text_row("adapt_sol", "", nullptr, "call adapt: file of fields, or of one metric, at the vertices of adapt_mesh"),
    text_row("adapt_source", "hessian", "hessian|curvature|deformation",
             "call adapt: source of the estimated error"),
    real_row("adapt_tolerance", kPositive, infinity, 0.01, "call adapt: error of the field (curvature: degrees)"),
    real_row("adjacent_ratio", 2, infinity, 2,
             "CheckAdjacentEdges: largest ratio of the lengths of adjacent edges, in the metric, at least 2"),
    real_row("angle_mesh", 0.01, 89, 8, "angle between the mesh and the tangents of surfaces and curves, degrees"),
    real_row("angle_smo", 0.001, 89, 1, "angle between the supports of curves and their tangents, degrees"),
    real_row("anisotropy_max", 1, infinity, 1000,
             "largest ratio of the geometric sizes in two directions (geo_metric 1)"),
    integer_row("association", 0, 1, 0,
                "1: .msh, .mesh, .meshb and .vtu files have the places of nodes on the geometry: entities, t, (u, v); MFEM and libMesh stop at such a .msh"),
    text_row("background_mesh", "", nullptr, "mesh file of the background mesh, with background_sol (\"\": none)"),
    text_row("background_sol", "", nullptr, "file of the sizes or metrics at the vertices of background_mesh"),
    by_effort(integer_row("certify", 0, 2, 1,
                          "cross-patch meshes: edits triangles whose upper bounds of A0 or A1 are beyond the tolerances; bounds 0 no triangles, "
                          "1 triangles with suspect normals at their corners, 2 all")),
    integer_row("cracks", 0, 1, 0, "1: internal curves are cracks: their vertices are doubled, one for each side"),
    by_effort(integer_row("crossing_rounds", 0, 20, 0,
                          "most rounds in which triangles that cross, but need not, become smaller; together they cost at most as much as the first mesh (0: none)")),
    integer_row("curve_groups", 0, 1, 1, "1: .msh files have the curves and corners too, as groups; 0: faces only"),
    real_row("edge_gradation", 0, infinity, 0,
             "largest ratio of sizes one unit edge apart, inward from short edges of curves, greater than 1 (0: any)"),
    integer_row("effort", classic_effort, more_effort, classic_effort,
                "work beyond the first mesh: 0 none; 1 as carreau mesh, at most as much as the first mesh; 2 more, at most twice as much; "
                "-1 as RT-0232"),
    text_row("element", "p1", "p1|p2|q1.0|q1.1|q2.0|q2.1",
             "type of the elements: triangles (p) or quadrilaterals (q; .1: no triangle), of order 1 or 2 (curved)"),
    diag_row("embed_tolerance", kPositive, 1e-3, "embedded places are so far from faces at most, and join nearer curves and points, model length"),
    diag_row("eps_chord", kPositive, 1.0 / 5000,
             "distance between the mesh and the surface or curve (geo_rule chord and both), model length"),
    real_row("eps_collapse", 0, infinity, 0, "curves shorter than this are removed, model length (0: none)"),
    diag_row("eps_ends", 0, 1.0 / 500, "curves whose ends are nearer than this are reported, model length"),
    diag_row("eps_glue", 0, 1.0 / 500, "points nearer than this are one when references are sought, model length"),
    real_row("eps_glue_face", 0, infinity, 0,
             "two sides of one face nearer than this are a seam, model length (0: a thousandth of eps_glue)"),
    real_row("eps_glue_open", 0, infinity, 0,
             "curves that stay open are one within this and a tenth of their lengths, model length (0: eps_glue)"),
    real_row("eps_match", 0, infinity, 0,
             "curves of one reference, and ends at one point, may be so far apart, model length (0: a hundredth of diag; x.pardom: any, warned)"),
    real_row("eps_smooth", 1e-6, 1, 0.01,
             "plane domains: polylines by which their curves are compared, distance as a share of the edge"),
    text_row("failing_faces", "stop", "stop|leave_out",
             "a face whose geometry fails or whose curves break a rule: ends the run, or is left out of the mesh"),
    integer_row("flag", 0, 1, 0, "1: exported files hold the edges of the curves too"),
    text_row("format", "mesh",
             "mesh|meshb|vtu|stl|msh|msh2|bl2d|inp|bdf|unv|su2|off|obj|ply|vtk|tri|smesh|poly|vol|geo|exr", "format and suffix of exported files"),
    integer_row("frontal", 0, 1, 1, "placement of points: 1 frontal, 0 algebraic (on edges)"),
    integer_row("geo_guarantee", 0, 2, 0,
                "1: geometric sizes a little smaller, so that nearly every edge and triangle keeps geo_rule; 2: also the planes of triangles "
                "keep angle_mesh"),
    integer_row("geo_metric", 0, 1, 0, "geometric sizes: 0 by the smallest radius, 1 by both principal radii"),
    text_row("geo_rule", "angle", "angle|chord|both|radii",
             "geometric sizes from: angle_mesh, eps_chord, the smaller of both, or the principal radii (RR-2928)"),
    integer_row("glue_open", 0, 1, 0,
                "1: curves that one face only has are glued too (eps_glue) when the model has references"),
    real_row("gradation", 0, infinity, 0,
             "largest ratio of sizes one unit edge apart, greater than 1 (0: no gradation)"),
    integer_row("hgeo_flag", 0, 2, 0, "geometric size: 0 ignored, 1 from the curvature, 2 from cad_rads and cad_radc"),
    diag_row("hgeomax", kPositive, 1.0 / 5, "largest geometric size, model length"),
    diag_row("hgeomin", kPositive, 1.0 / 500, "smallest geometric size, model length"),
    integer_row("hinterpol_flag", 0, 2, 0, "interpolation of sizes: 0 linear, 1 geometric, 2 sinusoidal"),
    integer_row("hmean_flag", -1, 2, 0, "mean of sizes: -1 minimum, 0 or 2 arithmetic, 1 geometric"),
    integer_row("hphy_flag", 0, 2, 1, "physical size: 0 ignored, 1 hphydef, 2 from cad_hphys, cad_hphyc and cad_hphyp"),
    diag_row("hphydef", kPositive, 1.0 / 50, "predefined physical size, model length; clamped to [hphymin, hphymax]"),
    diag_row("hphymax", kPositive, 1.0 / 5, "largest physical size, model length"),
    diag_row("hphymin", kPositive, 1.0 / 500, "smallest physical size, model length"),
    integer_row("max_triangles", 0, INT_MAX, 0, "largest number of triangles of a mesh (0: by memory)"),
    integer_row("measure", 0, 1, 0, "1: the mesh is measured against surface and sizes; the measures are reported and exported to vtu"),
    by_effort(integer_row("measure_bounds", 0, 2, 1,
                          "measures have upper bounds of A0 and A1: 0 never, 1 for cross-patch meshes and surfaces of triangles, 2 always")),
    by_effort(integer_row("measure_distances", 0, 1, 1,
                          "measures of surfaces given as triangles have bounds of the distances to these and back: 0 no, 1 yes")),
    integer_row("metric_combination", 0, 1, 1,
                "prescribed and geometric metrics: 0 the prescribed one is scaled and keeps its shape, 1 intersection"),
    text_row("narrow_faces", "keep", "keep|one_layer|collapse",
             "faces narrower than narrow_ratio: as others, with one layer of triangles, or collapsed"),
    real_row("narrow_ratio", 0, 1, 0.1, "narrow_faces: largest width, as a share of the size prescribed there"),
    text_row("option", "", "|allsurf3d|allsurf2d|onesurf3d|onesurf2d|smo3d", "content of exports (\"\": allsurf3d)"),
    real_row("parameter_size", 0, infinity, 0,
             "length of edges in the parameter planes of faces, between hphymin and hphymax in space (0: sizes are lengths of space)"),
    text_row("patches", "dependent", "dependent|independent",
             "borders between patches that are not sharp: kept, or ignored by cross-patch remeshing"),
    text_row("pref", "x", nullptr, "prefix of the names of files"),
    integer_row(
        "proximity", 0, 1000, 0,
        "least number of layers across narrow zones of a face and between faces (0: any; else gradation is needed)"),
    integer_row("refs", INT_MIN, INT_MAX, 1, "reference of the face that onesurf3d and onesurf2d export"),
    by_effort(integer_row("shape_trials", 0, 1, 0,
                          "1: changes of the mesh around its worst triangles are tried, the best is kept")),
    real_row("sharp_angle", 0, 180, 1, "patches independent: borders whose normals differ by more are sharp, degrees"),
    integer_row("sol_field", 0, 64, 0,
                "field of a .sol or .solb with several, from 1 (0: all fields that an adaptation estimates, else the only one)"),
    integer_row("solid_groups", 0, 1, 1, "1: .msh files have groups of solids, for volumes that Gmsh makes; 0: none, since dolfinx rejects groups without elements"),
    integer_row("stagger_strips", 0, 1, 0,
                "1: vertices of one side of a strip of one layer face the middles of the other side's edges"),
    integer_row("threads", 0, 1024, 1, "threads at work, 0: one for each processor; the mesh does not depend on it"),
    integer_row("verb", 0, 100, 10, "verbosity, per cent"),
};
static_assert(std::is_sorted(kTable.begin(), kTable.end(), [](const ParameterInfo& p, const ParameterInfo& q) {
  return std::string_view(p.name) < std::string_view(q.name);
}));

/// Values of the parameters that follow `effort`, by its levels from 0.
struct EffortRow {
  std::string_view name;
  std::array<int, 3> values;
};
constexpr std::array kByEffort = {EffortRow{"certify", {0, 1, 2}}, EffortRow{"crossing_rounds", {0, 10, 20}},
                                  EffortRow{"measure_bounds", {0, 1, 2}}, EffortRow{"measure_distances", {0, 1, 1}},
                                  EffortRow{"shape_trials", {0, 1, 1}}};

int index_of(std::string_view name) {
  if (name == "hphymmin") name = "hphymin";
  if (name == "hinterp_flag") name = "hinterpol_flag";
  const auto row =
      std::lower_bound(kTable.begin(), kTable.end(), name,
                       [](const ParameterInfo& info, std::string_view n) { return std::string_view(info.name) < n; });
  return row != kTable.end() && row->name == name ? int(row - kTable.begin()) : -1;
}

int known_index(std::string_view name) {
  const int index = index_of(name);
  if (index >= 0) return index;
  if (name == "call") throw InvalidArgument("'call' is an action of blsurf.env, not a parameter");
  const std::string nearest = nearest_parameter(name);
  throw InvalidArgument("there is no parameter " + shown(name) +
                        (nearest.empty() ? std::string() : "; did you mean '" + nearest + "'?"));
}

const char* type_name(ParameterType type) {
  switch (type) {
    case ParameterType::integer:
      return "an integer";
    case ParameterType::real:
      return "a number";
    default:
      return "a text";
  }
}

[[noreturn]] void wrong_type(const ParameterInfo& info, const std::string& given) {
  throw InvalidArgument(std::string("parameter ") + info.name + " is " + type_name(info.type) + ", not " + given);
}

void check_range(const ParameterInfo& info, double value) {
  const auto fail = [&](const std::string& rule) {
    throw InvalidArgument(std::string("parameter ") + info.name + " must be " + rule + "; " + format_number(value) +
                          " is not");
  };
  if (!std::isfinite(value)) fail("a finite number");
  if (std::string_view(info.name).ends_with("gradation") && value != 0 && !(value > 1))
    fail("greater than 1, or 0 (no gradation)");
  if (value >= info.minimum && value <= info.maximum) return;
  if (info.minimum == kPositive) fail("greater than 0");
  if (info.maximum == infinity) fail("at least " + format_number(info.minimum));
  fail("between " + format_number(info.minimum) + " and " + format_number(info.maximum));
}

/// The choices as a list for a sentence: 'a', 'b' or 'c'.
std::string quoted_choices(std::string_view choices) {
  std::vector<std::string> names;
  for (std::size_t from = 0; from <= choices.size();) {
    const std::size_t to = std::min(choices.find('|', from), choices.size());
    names.push_back("'" + std::string(choices.substr(from, to - from)) + "'");
    from = to + 1;
  }
  std::string list = names[0];
  for (std::size_t i = 1; i < names.size(); ++i) list += (i + 1 == names.size() ? " or " : ", ") + names[i];
  return list;
}

void check_text(const ParameterInfo& info, std::string_view value) {
  if (info.choices == nullptr) {
    if (value.empty() && *info.default_text != '\0')
      throw InvalidArgument(std::string("parameter ") + info.name + " must not be empty");
    if (value.find('\0') != value.npos)
      throw InvalidArgument(std::string("parameter ") + info.name + " must not hold a zero byte");
    return;
  }
  const std::string_view choices = info.choices;
  for (std::size_t from = 0; from <= choices.size();) {
    const std::size_t to = std::min(choices.find('|', from), choices.size());
    if (choices.substr(from, to - from) == value) return;
    from = to + 1;
  }
  throw InvalidArgument(std::string("parameter ") + info.name + " must be " + quoted_choices(choices) + "; '" +
                        std::string(value) + "' is not");
}

/// Levenshtein's distance, letters compared without their case.
int edit_distance(std::string_view p, std::string_view q) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
  std::vector<int> row(q.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    int diagonal = row[0];
    row[0] = int(i) + 1;
    for (std::size_t j = 0; j < q.size(); ++j) {
      const int replaced = diagonal + (lower(p[i]) == lower(q[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::span<const ParameterInfo> parameter_table() { return kTable; }

const ParameterInfo* find_parameter(std::string_view name) {
  const int index = index_of(name);
  return index < 0 ? nullptr : &kTable[std::size_t(index)];
}

std::string nearest_parameter(std::string_view name) {
  // A word that shares less than two thirds of its letters with a name is something else; a very long one would only
  // cost time.
  if (name.size() > 64) return {};
  int best = std::max(1, int(name.size()) / 3) + 1;
  std::string nearest;
  for (const ParameterInfo& info : kTable) {
    const int distance = edit_distance(name, info.name);
    if (distance < best) best = distance, nearest = info.name;
  }
  return nearest;
}

void Parameters::set(std::string_view name, int value) {
  const auto index = std::size_t(known_index(name));
  const ParameterInfo& info = kTable[index];
  if (info.type == ParameterType::text) wrong_type(info, "the number " + format_number(value));
  check_range(info, value);
  values_.resize(kTable.size());
  if (info.type == ParameterType::real)
    values_[index] = double(value);
  else
    values_[index] = value;
}

void Parameters::set(std::string_view name, double value) {
  const auto index = std::size_t(known_index(name));
  const ParameterInfo& info = kTable[index];
  if (info.type != ParameterType::real) wrong_type(info, "the real number " + format_number(value));
  check_range(info, value);
  values_.resize(kTable.size());
  values_[index] = value;
}

void Parameters::set(std::string_view name, std::string_view value) {
  const auto index = std::size_t(known_index(name));
  const ParameterInfo& info = kTable[index];
  if (info.type != ParameterType::text) wrong_type(info, "the text '" + std::string(value) + "'");
  check_text(info, value);
  values_.resize(kTable.size());
  values_[index] = std::string(value);
}

void Parameters::set_from_text(std::string_view name, std::string_view word, bool quoted) {
  const ParameterInfo& info = kTable[std::size_t(known_index(name))];
  if (info.type == ParameterType::text || quoted) return set(name, word);
  if (info.type == ParameterType::integer) {
    int value = 0;
    if (!parse_number(word, value)) wrong_type(info, shown(word));
    return set(name, value);
  }
  double value = 0;
  if (!parse_number(word, value)) wrong_type(info, shown(word));
  set(name, value);
}

int Parameters::integer(std::string_view name) const {
  const auto index = std::size_t(known_index(name));
  const ParameterInfo& info = kTable[index];
  if (info.type != ParameterType::integer) wrong_type(info, "an integer");
  if (is_set(name)) return std::get<int>(*values_[index]);
  if (*info.set_by == '\0') return int(info.default_number);
  const int effort = integer(info.set_by);
  if (effort == classic_effort) return int(info.default_number);
  const auto row = std::find_if(kByEffort.begin(), kByEffort.end(), [&](const EffortRow& r) { return r.name == name; });
  return row->values[std::size_t(effort)];
}

double Parameters::real(std::string_view name, double diag) const {
  const auto index = std::size_t(known_index(name));
  const ParameterInfo& info = kTable[index];
  if (info.type == ParameterType::integer) return integer(name);
  if (info.type != ParameterType::real) wrong_type(info, "a number");
  if (is_set(name)) return std::get<double>(*values_[index]);
  return info.diag_relative ? info.default_number * diag : info.default_number;
}

std::string Parameters::text(std::string_view name) const {
  const auto index = std::size_t(known_index(name));
  const ParameterInfo& info = kTable[index];
  if (info.type != ParameterType::text) wrong_type(info, "a text");
  return is_set(name) ? std::get<std::string>(*values_[index]) : std::string(info.default_text);
}

bool Parameters::is_set(std::string_view name) const {
  const auto index = std::size_t(known_index(name));
  return index < values_.size() && values_[index].has_value();
}

void Parameters::reset(std::string_view name) {
  const auto index = std::size_t(known_index(name));
  if (index < values_.size()) values_[index].reset();
}

void Parameters::reset_all() { values_.clear(); }

}  // namespace carreau
