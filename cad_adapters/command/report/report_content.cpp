// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_content.h"

#include <cmath>

#include "files/session_handle.h"
#include "mesh/mesh_summary.h"
#include "report/html_text.h"

namespace command {
namespace {

AskedValue text_value(carreau_session* session, const carreau_parameter& p) {
  const char* value = "";
  require(session, carreau_get_text(session, p.name, &value));
  return {p.name, value, p.default_text, p.help};
}

AskedValue integer_value(carreau_session* session, const carreau_parameter& p) {
  std::int32_t value = 0;
  require(session, carreau_get_integer(session, p.name, &value));
  return {p.name, std::to_string(value), std::to_string(std::lround(p.default_number)), p.help};
}

AskedValue real_value(carreau_session* session, const carreau_parameter& p, double diagonal) {
  double value = 0;
  require(session, carreau_get_real(session, p.name, &value));
  const double usual = p.default_number * (p.diag_relative != 0 ? diagonal : 1);
  return {p.name, number_text(value), number_text(usual), p.help};
}

}  // namespace

ReportContent content_of(carreau_mesh* mesh, const Crossings* known) {
  constexpr CheckLimits limits{.closed = false, .limit = defects_told, .worst = 0};
  ReportContent content;
  content.mesh = arrays_of(mesh);
  content.check = check_of(mesh, content.mesh, limits, known);
  if (!content.check.measured || content.mesh.triangles.empty()) return content;
  content.halves = halves_of(content.mesh);
  content.values = shape_values(content.mesh, content.halves);
  return content;
}

std::vector<AskedValue> asked_of(carreau_session* session) {
  const double diagonal = report_of(session).diag;
  std::vector<AskedValue> asked;
  for (std::int32_t i = 0; i < carreau_parameter_count(); ++i) {
    carreau_parameter p{};
    p.struct_size = sizeof p;
    if (carreau_parameter_info(i, &p) != CARREAU_OK) throw Failure("The parameters cannot be listed.");
    AskedValue value = p.type == CARREAU_TEXT      ? text_value(session, p)
                       : p.type == CARREAU_INTEGER ? integer_value(session, p)
                                                   : real_value(session, p, diagonal);
    if (value.value != value.usual) asked.push_back(std::move(value));
  }
  return asked;
}

}  // namespace command
