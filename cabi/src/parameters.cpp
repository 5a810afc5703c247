// SPDX-License-Identifier: BSD-3-Clause
#include "session/parameters.h"

#include <cmath>
#include <limits>

#include "arguments.h"
#include "guard.h"

using carreau::ParameterInfo;
using namespace carreau::abi;

static_assert(int(carreau::ParameterType::integer) == CARREAU_INTEGER);
static_assert(int(carreau::ParameterType::real) == CARREAU_REAL);
static_assert(int(carreau::ParameterType::text) == CARREAU_TEXT);

int32_t carreau_parameter_count(void) { return int32_t(carreau::parameter_table().size()); }

carreau_status carreau_parameter_info(int32_t index, carreau_parameter* out_parameter) {
  const auto fill = [&] {
    if (index < 0 || index >= carreau_parameter_count()) throw carreau::InvalidArgument("no such parameter");
    const ParameterInfo& info = carreau::parameter_table()[std::size_t(index)];
    carreau_parameter parameter{};
    parameter.name = info.name;
    parameter.help = info.help;
    parameter.default_text = info.default_text;
    parameter.choices = info.choices != nullptr ? info.choices : "";
    parameter.minimum = info.minimum;
    parameter.maximum = info.maximum;
    parameter.default_number = info.default_number;
    parameter.type = std::int32_t(info.type);
    parameter.diag_relative = info.diag_relative ? 1 : 0;
    parameter.set_by = info.set_by;
    write_struct(parameter, out_parameter, "out_parameter");
  };
  return status_of(fill);
}

carreau_status carreau_set_integer(carreau_session* session, const char* name, int32_t value) {
  return guarded(session, [&] { session->session.parameters().set(required(name, "name"), int(value)); });
}

carreau_status carreau_set_real(carreau_session* session, const char* name, double value) {
  return guarded(session, [&] { session->session.parameters().set(required(name, "name"), value); });
}

carreau_status carreau_set_text(carreau_session* session, const char* name, const char* value) {
  return guarded(session, [&] {
    session->session.parameters().set(required(name, "name"), std::string_view(required(value, "value")));
  });
}

carreau_status carreau_set_word(carreau_session* session, const char* name, const char* word) {
  return guarded(session, [&] {
    session->session.parameters().set_from_text(required(name, "name"), required(word, "word"), false);
  });
}

carreau_status carreau_read_env(carreau_session* session, const char* path) {
  return guarded(session, [&] { session->session.read_env(required(path, "path")); });
}

carreau_status carreau_get_integer(carreau_session* session, const char* name, int32_t* out_value) {
  return guarded(session, [&] {
    required(out_value, "out_value");
    *out_value = session->session.parameters().integer(required(name, "name"));
  });
}

carreau_status carreau_get_real(carreau_session* session, const char* name, double* out_value) {
  return guarded(session, [&] {
    required(out_value, "out_value");
    const bool has_mesh = session->session.has_mesh();
    const double diag = has_mesh ? session->session.report().diag : std::numeric_limits<double>::quiet_NaN();
    const double value = session->session.parameters().real(required(name, "name"), diag);
    if (std::isnan(value))
      throw StatusError(CARREAU_ERR_SEQUENCE, std::string("the default of ") + name +
                                                  " is relative to diag, which is known after the first mesh");
    *out_value = value;
  });
}

carreau_status carreau_get_text(carreau_session* session, const char* name, const char** out_value) {
  return guarded(session, [&] {
    required(out_value, "out_value");
    session->text = session->session.parameters().text(required(name, "name"));
    *out_value = session->text.c_str();
  });
}

carreau_status carreau_reset_parameter(carreau_session* session, const char* name) {
  return guarded(session, [&] { session->session.parameters().reset(required(name, "name")); });
}

carreau_status carreau_reset_parameters(carreau_session* session) {
  return guarded(session, [&] { session->session.parameters().reset_all(); });
}
