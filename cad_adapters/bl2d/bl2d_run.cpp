// SPDX-License-Identifier: BSD-3-Clause
#include "bl2d_run.h"

#include <carreau_geometry.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>

namespace bl2d {

namespace {

struct FreeSession {
  void operator()(carreau_session* session) const noexcept { carreau_session_free(session); }
};
using SessionHandle = std::unique_ptr<carreau_session, FreeSession>;

void require(carreau_session* session, carreau_status status, const std::string& where = "") {
  if (status == CARREAU_OK) return;
  const std::string sentence = carreau_last_error(session);
  throw Failure(where + (sentence.empty() ? carreau_status_meaning(status) : sentence));
}

void print(std::int32_t level, const char* text, void*) {
  if (level <= CARREAU_LEVEL_WARNING) std::fprintf(stderr, "bl2d: %s\n", text);
}

SessionHandle make_session() {
  carreau_session* session = nullptr;
  if (carreau_session_create(&session) != CARREAU_OK) throw Failure("there is no memory for a session");
  SessionHandle handle(session);
  require(session, carreau_set_message_callback(session, print, nullptr));
  return handle;
}

/// The first of the files that exists. Throws Failure with all of them.
std::string find_file(const std::vector<std::string>& candidates, const std::string& what) {
  std::string all;
  for (const std::string& path : candidates) {
    if (access(path.c_str(), F_OK) == 0) return path;
    all += (all.empty() ? "" : ", ") + path;
  }
  throw Failure("there is no " + what + ": none of " + all + " exists");
}

double diagonal_of(carreau_session* session) {
  std::int64_t curves = 0;
  require(session, carreau_model_count(session, nullptr, &curves, nullptr));
  std::vector<std::int32_t> faces(static_cast<std::size_t>(curves));
  require(session, carreau_model_curves(session, curves, faces.data(), nullptr, nullptr, nullptr));
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<double, 2> low{far, far}, high{-far, -far};
  std::int32_t ic = 0;
  for (std::size_t c = 0; c < faces.size(); ++c) {
    ic = c > 0 && faces[c] == faces[c - 1] ? ic + 1 : 1;
    constexpr int samples = 32;
    for (int i = 0; i <= samples; ++i) {
      std::array<double, 2> p{};
      require(session, carreau_geometry_curve(session, faces[c], ic, static_cast<double>(i) / samples, p.data()));
      for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    }
  }
  return std::hypot(high[0] - low[0], high[1] - low[1]);
}

class Step {
 public:
  Step(const Env& env, int number) : env_(env), number_(number), session_(make_session()) {}

  void make() {
    carreau_session* const session = session_.get();
    const std::string name = env_.folder + env_.base, geometry = name + "." + std::to_string(env_.geometry);
    const std::string domain = find_file(
        {geometry + ".0.data", geometry + ".data", name + ".data", geometry + ".0.g", geometry + ".g", name + ".g"},
        "domain");
    require(session, carreau_load_plane_domain(session, domain.c_str(), nullptr, 0));
    if (number_ > 0) take_sizes(geometry + "." + std::to_string(number_ - 1));
    set_parameters();
    require(session, carreau_mesh_generate(session));
    write(geometry + "." + std::to_string(number_));
  }

 private:
  void take_sizes(const std::string& before) {
    const std::string mesh =
        find_file({before + ".bl2d", before + ".mesh"}, "mesh of step " + std::to_string(number_ - 1));
    const std::string sizes = find_file({before + ".h", before + ".sol"}, "file of sizes at its vertices");
    if (mesh.ends_with(".bl2d"))
      bound_sizes(mesh, sizes);
    else
      require(session_.get(), carreau_set_background_mesh(session_.get(), mesh.c_str(), sizes.c_str()));
  }

  /// The largest size: hmax of the env file, or a fifth of the diagonal.
  double largest_size() {
    for (auto setting = env_.settings.rbegin(); setting != env_.settings.rend(); ++setting)
      if (setting->name == "hmax" || setting->name == "hphymax") return std::atof(setting->value.c_str());
    return diagonal_of(session_.get()) / 5;
  }

  /// Bounds sizes at the vertices, as BL2D does, and not between them: its boundaries depend on it.
  void bound_sizes(const std::string& mesh_path, const std::string& sizes_path) {
    carreau_mesh* made = nullptr;
    if (carreau_mesh_create(&made) != CARREAU_OK) throw Failure("there is no memory for a mesh");
    const std::unique_ptr<carreau_mesh, decltype(&carreau_mesh_free)> mesh(made, carreau_mesh_free);
    const auto done = [&](carreau_status status) {
      if (status != CARREAU_OK) throw Failure(carreau_mesh_last_error(made));
    };
    done(carreau_mesh_read(made, mesh_path.c_str()));
    std::int64_t vertices = 0, triangles = 0;
    done(carreau_mesh_count(made, &vertices, &triangles, nullptr, nullptr));
    const auto n = static_cast<std::size_t>(vertices);
    std::vector<double> xyz(3 * n), of_space(6 * n), uv, sizes, metrics;
    std::vector<std::int32_t> corners(3 * static_cast<std::size_t>(triangles));
    done(carreau_mesh_vertices(made, vertices, xyz.data()));
    done(carreau_mesh_triangles(made, triangles, corners.data()));
    done(carreau_mesh_read_metrics(made, sizes_path.c_str(), vertices, of_space.data()));
    const double hmax = largest_size(), least = hmax > 0 ? 1 / (hmax * hmax) : 0;
    bool isotropic = true;
    for (std::size_t i = 0; i < n; ++i) {
      uv.insert(uv.end(), {xyz[3 * i], xyz[3 * i + 1]});
      const double a = of_space[6 * i], b = of_space[6 * i + 1], c = of_space[6 * i + 3];
      const double middle = (a + c) / 2, half = std::hypot((a - c) / 2, b);
      const double high = std::max(middle + half, least), low = std::max(middle - half, least);
      isotropic = isotropic && half <= 1e-12 * middle;
      // The eigenvectors stay: M' = mean I + share (M - middle I).
      const double mean = (high + low) / 2, share = half > 0 ? (high - low) / (2 * half) : 0;
      metrics.insert(metrics.end(), {mean + share * (a - middle), share * b, mean + share * (c - middle)});
      sizes.push_back(1 / std::sqrt(mean));
    }
    carreau_background background{};
    background.struct_size = sizeof background;
    background.dimension = 2;
    background.vertex_count = vertices, background.triangle_count = triangles;
    background.vertices = uv.data(), background.triangles = corners.data();
    background.sizes = isotropic ? sizes.data() : nullptr;
    background.metrics = isotropic ? nullptr : metrics.data();
    require(session_.get(), carreau_set_background(session_.get(), &background));
  }

  /// The defaults of the library are BL2D's, also a largest size of a fifth of the diagonal. Small sizes apply as they are.
  void set_parameters() {
    carreau_session* const session = session_.get();
    constexpr double smallest = 1e-9;
    const double diagonal = diagonal_of(session);
    std::int32_t sized = 0;
    require(session, carreau_plane_has_sizes(session, &sized));
    require(session, carreau_set_integer(session, "hphy_flag", sized != 0 || number_ > 0 ? 2 : 1));
    require(session, carreau_set_real(session, "hphymin", smallest * diagonal));
    require(session, carreau_set_integer(session, "flag", 1));  // edges of curves are in the files
    for (const Setting& setting : env_.settings) {
      // BL2D's own names.
      const std::string name = setting.name == "hmin" || setting.name == "hmax" ? "hphy" + setting.name.substr(1) : setting.name;
      require(session, carreau_set_word(session, name.c_str(), setting.value.c_str()),
              env_.path + ", line " + std::to_string(setting.line) + ": ");
    }
  }

  void write(const std::string& name) {
    carreau_mesh* mesh = nullptr;
    require(session_.get(), carreau_session_mesh(session_.get(), &mesh));
    std::int64_t vertices = 0, triangles = 0;
    require(session_.get(), carreau_mesh_count(mesh, &vertices, &triangles, nullptr, nullptr));
    if (env_.writes_bl2d) require(session_.get(), carreau_mesh_write(mesh, (name + ".bl2d").c_str()));
    require(session_.get(), carreau_mesh_write(mesh, (name + ".mesh").c_str()));
    if (env_.writes_sizes) write_sizes(mesh, vertices, name + ".h");
    std::printf("step %d: %lld vertices, %lld triangles: %s%s.mesh\n", number_, static_cast<long long>(vertices),
                static_cast<long long>(triangles), env_.writes_bl2d ? (name + ".bl2d, ").c_str() : "", name.c_str());
  }

  void write_sizes(carreau_mesh* mesh, std::int64_t vertices, const std::string& path) {
    std::vector<double> sizes(static_cast<std::size_t>(vertices));
    require(session_.get(), carreau_mesh_vertex_sizes(mesh, vertices, sizes.data()));
    const std::string temporary = path + ".tmp";
    std::ofstream file(temporary);
    file.precision(17);
    file << vertices << " 1\n";
    for (const double h : sizes) file << h << '\n';
    file.close();
    if (!file || std::rename(temporary.c_str(), path.c_str()) != 0) {
      std::remove(temporary.c_str());
      throw Failure("'" + path + "' cannot be written");
    }
  }

  const Env& env_;
  int number_;
  SessionHandle session_;
};

}  // namespace

void run(const Env& env) {
  for (const int number : env.steps) Step(env, number).make();
}

}  // namespace bl2d
