// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/built/atlas_input.h"

#include <carreau_atlas.h>
#include <carreau_geometry.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "base/failure.h"
#include "files/mesh_file.h"
#include "files/readable_mesh.h"
#include "inputs/base/built_input.h"
#include "inputs/built/triangles_input.h"

namespace command {
namespace {

struct FreeAtlas {
  void operator()(carreau_atlas* atlas) const noexcept { carreau_atlas_free(atlas); }
};
using AtlasHandle = std::unique_ptr<carreau_atlas, FreeAtlas>;

constexpr double min_even_quality = .5;       // Q2, first percentile: below it charts of neighbours disagree
constexpr double fewest_even_triangles = 3000;  // CAD programs write two for a plane

/// Uneven triangles of a closed surface are meshed evenly before they get charts. Empty where they are even, or cannot
/// be meshed.
MeshArrays even_triangles(const std::string& path, carreau_mesh* given) {
  carreau_quality quality{};
  quality.struct_size = sizeof quality;
  require(given, carreau_mesh_quality(given, &quality));
  if (quality.q2_p1 >= min_even_quality || quality.open_edges > 0 || !(quality.area > 0)) return {};
  const double count = std::max(static_cast<double>(quality.triangles), fewest_even_triangles);
  const SessionHandle session = make_silent_session();
  carreau_triangles_options options{};
  options.struct_size = sizeof options, options.ignore_references = 1;
  carreau_mesh* made = nullptr;
  const bool is_made =
      carreau_load_triangles(session.get(), &options, ReadableMesh(path).path().c_str()) == CARREAU_OK &&
      carreau_set_real(session.get(), "hphydef", std::sqrt(4 / std::sqrt(3.) * quality.area / count)) == CARREAU_OK &&
      carreau_mesh_generate(session.get()) == CARREAU_OK && carreau_session_mesh(session.get(), &made) == CARREAU_OK;
  return is_made ? arrays_of(made) : MeshArrays{};
}

carreau_status build(carreau_atlas* atlas, const MeshArrays& arrays, const AtlasChoice& choice) {
  carreau_atlas_options options{};
  options.struct_size = sizeof options;
  const bool is_cubic = choice.border.find("cubic") != std::string::npos;
  options.border = choice.border.rfind("outer-", 0) == 0 ? (is_cubic ? CARREAU_BORDER_OUTER_CUBIC : CARREAU_BORDER_OUTER_SPLINE)
                                                         : (is_cubic ? CARREAU_BORDER_CUBIC : CARREAU_BORDER_SPLINE);
  options.reach = choice.reach;
  return carreau_atlas_build(atlas, &options, std::ssize(arrays.vertices), arrays.vertices.front().data(),
                             std::ssize(arrays.triangles), arrays.triangles.front().data(), nullptr);
}

AtlasHandle new_atlas() {
  carreau_atlas* made = nullptr;
  if (carreau_atlas_create(&made) != CARREAU_OK) throw Failure("out of memory");
  return AtlasHandle(made);
}

struct BuiltAtlas {
  AtlasHandle atlas;
  std::size_t uneven = 0;  ///< triangles of the file that were meshed evenly first; 0: they were not
};

BuiltAtlas build(const std::string& path, const AtlasChoice& choice) {
  const MeshHandle mesh = read_mesh(path);
  const MeshArrays given = arrays_of(mesh.get());
  if (given.triangles.empty()) throw Failure(path + ": there is no triangle");
  BuiltAtlas built{new_atlas()};
  if (const MeshArrays even = even_triangles(path, mesh.get());
      !even.triangles.empty() && build(built.atlas.get(), even, choice) == CARREAU_OK) {
    built.uneven = given.triangles.size();
    return built;
  }
  built.atlas = new_atlas();
  if (build(built.atlas.get(), given, choice) != CARREAU_OK)
    throw Failure(path + ": " + carreau_atlas_last_error(built.atlas.get()));
  return built;
}

class AtlasInput final : public BuiltInput {
 public:
  AtlasInput(SessionHandle session, const std::string& path, BuiltAtlas built)
      : BuiltInput(std::move(session), path), atlas_(std::move(built.atlas)), uneven_(built.uneven) {}

  carreau_status give_to(carreau_session* session) override { return carreau_add_atlas(session, atlas_.get()); }

  [[nodiscard]] std::string summary() const override {
    carreau_atlas_counts counts{};
    counts.struct_size = sizeof counts;
    carreau_atlas_count(atlas_.get(), &counts);
    const std::string of = uneven_ > 0 ? " made evenly of " + std::to_string(uneven_) : "";
    return "atlas over " + std::to_string(counts.triangles) + " triangles" + of + ", " + ModelInput::summary();
  }
  [[nodiscard]] bool closed() const override { return true; }
  [[nodiscard]] double ends_tolerance() const override { return 1e-9 * diagonal(); }
  [[nodiscard]] bool has_arbitrary_borders() const override { return true; }

 private:
  [[nodiscard]] std::string kind(std::int32_t) const override { return "chart"; }

  AtlasHandle atlas_;
  std::size_t uneven_;
};

}  // namespace

std::unique_ptr<CadInput> open_atlas(const std::string& path, const AtlasChoice& choice) {
  if (!is_triangles(path))
    throw Failure(
        "--surface atlas goes with a mesh of triangles (.off, .obj, .ply, .stl, .mesh, .vtu, .msh), not with '" + path +
        "'.");
  BuiltAtlas built = build(path, choice);
  SessionHandle session = make_silent_session();
  require(session.get(), carreau_add_atlas(session.get(), built.atlas.get()));
  return std::make_unique<AtlasInput>(std::move(session), path, std::move(built));
}

}  // namespace command
