// SPDX-License-Identifier: BSD-3-Clause
// sweep [--sizes N] [--from A] [--to B] [--set NAME=VALUE]... [--verbose] [--torture | NAME | FILE]...
// Meshes each file, or shape of the torture set, with N sizes between diag/A and diag/B in geometric progression, and
// prints a row a shape: failures, worst quality, error and order of convergence of the volume. Status 1 when anything
// failed.
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "measured_mesh.h"
#include "shape_file.h"
#include "shapes.h"

namespace {

struct Options {
  int sizes = 20;
  double from = 5, to = 300;
  double worst_q2 = 0.02;
  bool verbose = false;
  std::vector<std::pair<std::string, std::string>> settings;
};

struct Row {
  int bad = 0, flat = 0, forced = 0;  // forced: only where the input has a feature that is as flat
  std::array<std::int64_t, adapters::flat_causes> causes{};  // triangles of Q2 below worst_q2, of all sizes
  double worst = 1, worst_divisor = 0, seconds = 0;
  std::int64_t triangles = 0;
  std::vector<std::pair<double, double>> volume_error;  // size, relative error
};

/// Slope of log |error| against log size over the finer half.
double order_of(const std::vector<std::pair<double, double>>& errors) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = errors.size() / 2; i < errors.size(); ++i) {
    if (!(std::abs(errors[i].second) > 1e-12)) return NAN;  // planes: exact
    const double a = std::log(errors[i].first), b = std::log(std::abs(errors[i].second));
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

Row sweep(const std::string& name, const carreau_occ::ShapeFile& file, const Options& options) {
  carreau_occ::BrepHost host(file);
  const double diagonal = host.diagonal();
  const bool closed = host.is_closed();
  GProp_GProps properties;
  BRepGProp::VolumeProperties(file.shape, properties, 1e-10);
  Row row;
  for (int i = 0; i < options.sizes; ++i) {
    const double share = options.sizes > 1 ? double(i) / (options.sizes - 1) : 0;
    const double divisor = options.from * std::pow(options.to / options.from, share);
    const adapters::MeasuredMesh m =
        adapters::mesh_and_measure(host, diagonal / divisor, [&](carreau_session* session) {
          for (const auto& [parameter, value] : options.settings)
            if (carreau_set_word(session, parameter.c_str(), value.c_str()) != CARREAU_OK)
              std::fprintf(stderr, "%s\n", carreau_last_error(session));
        });
    const std::string trouble = m.trouble(closed);
    const double worst = m.triangles.empty() ? 0 : m.quality.q2_min;
    if (!trouble.empty()) {
      ++row.bad;
      std::printf("  %s, diag/%.4g: %s\n", name.c_str(), divisor, trouble.c_str());
    }
    if (!m.triangles.empty() && worst < options.worst_q2 && m.free_q2_min >= options.worst_q2) ++row.forced;
    if (!m.triangles.empty() && m.free_q2_min < options.worst_q2) {
      ++row.flat;
      if (options.verbose) std::printf("  %s, diag/%.4g: worst Q2 %.4f\n", name.c_str(), divisor, worst);
    }
    for (const adapters::FlatTriangle& f : m.flat)
      if (f.q2 < options.worst_q2) ++row.causes[static_cast<std::size_t>(f.cause)];
    if (worst < row.worst) row.worst = worst, row.worst_divisor = divisor;
    if (closed && trouble.empty()) row.volume_error.emplace_back(diagonal / divisor, m.volume / properties.Mass() - 1);
    row.seconds += m.seconds;
    row.triangles += static_cast<std::int64_t>(m.triangles.size());
    std::fflush(stdout);
  }
  return row;
}

bool run(const std::string& name, const carreau_occ::ShapeFile& file, const Options& options) {
  const Row row = sweep(name, file, options);
  const std::size_t slash = name.find_last_of('/');
  std::printf(
      "%-34s %3d of %3d bad, %3d with Q2 < %.2g (and %d forced by the input: triangles by angles %lld, short curves "
      "%lld, narrow faces %lld); worst Q2 %.4f at diag/%-5.4g",
      name.substr(slash + 1).c_str(), row.bad, options.sizes, row.flat, options.worst_q2, row.forced,
      static_cast<long long>(row.causes[1]), static_cast<long long>(row.causes[2]),
      static_cast<long long>(row.causes[3]), row.worst, row.worst_divisor);
  if (!row.volume_error.empty())
    std::printf(" volume error %9.2e, order %.2f;", row.volume_error.back().second, order_of(row.volume_error));
  std::printf(" %9lld triangles in %.2f s\n", static_cast<long long>(row.triangles), row.seconds);
  std::fflush(stdout);
  return row.bad == 0 && row.flat == 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  bool good = true;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&] { return i + 1 < argc ? argv[++i] : ""; };
    try {
      if (word == "--sizes") {
        options.sizes = std::atoi(value());
      } else if (word == "--from") {
        options.from = std::atof(value());
      } else if (word == "--to") {
        options.to = std::atof(value());
      } else if (word == "--verbose") {
        options.verbose = true;
      } else if (word == "--set") {
        const std::string setting = value();
        const std::size_t at = setting.find('=');
        options.settings.emplace_back(setting.substr(0, at), setting.substr(at + 1));
      } else if (word == "--torture") {
        for (const shapes::NamedShape& shape : shapes::torture_set())
          good = run(shape.name, {.shape = shape.make(), .labels = {}, .unit = ""}, options) && good;
      } else if (word.find('.') == std::string::npos) {
        good = run(word, {.shape = shapes::make(word), .labels = {}, .unit = ""}, options) && good;
      } else {
        good = run(word, carreau_occ::read_shape(word), options) && good;
      }
    } catch (const std::exception& error) {
      std::printf("%s: %s\n", word.c_str(), error.what());
      good = false;
    }
  }
  return good ? 0 : 1;
}
