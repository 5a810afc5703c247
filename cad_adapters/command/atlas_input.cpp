// SPDX-License-Identifier: BSD-3-Clause
#include "atlas_input.h"

#include <carreau_atlas.h>

#include <iterator>
#include <memory>

#include "built_input.h"
#include "failure.h"
#include "mesh_file.h"
#include "triangles_input.h"

namespace command {
namespace {

struct FreeAtlas {
  void operator()(carreau_atlas* atlas) const noexcept { carreau_atlas_free(atlas); }
};
using AtlasHandle = std::unique_ptr<carreau_atlas, FreeAtlas>;

AtlasHandle build(const std::string& path) {
  const MeshHandle mesh = read_mesh(path);
  const MeshArrays arrays = arrays_of(mesh.get());
  carreau_atlas* made = nullptr;
  if (carreau_atlas_create(&made) != CARREAU_OK) throw Failure("out of memory");
  AtlasHandle atlas(made);
  if (arrays.triangles.empty()) throw Failure(path + ": there is no triangle");
  if (carreau_atlas_build(made, nullptr, std::ssize(arrays.vertices), arrays.vertices.front().data(),
                          std::ssize(arrays.triangles), arrays.triangles.front().data(), nullptr) != CARREAU_OK)
    throw Failure(path + ": " + carreau_atlas_last_error(made));
  return atlas;
}

class AtlasInput final : public BuiltInput {
 public:
  AtlasInput(SessionHandle session, const std::string& path, AtlasHandle atlas)
      : BuiltInput(std::move(session), path), atlas_(std::move(atlas)) {}

  carreau_status give_to(carreau_session* session) override { return carreau_add_atlas(session, atlas_.get()); }

  [[nodiscard]] std::string summary() const override {
    carreau_atlas_counts counts{};
    counts.struct_size = sizeof counts;
    carreau_atlas_count(atlas_.get(), &counts);
    return "atlas over " + std::to_string(counts.triangles) + " triangles, " + ModelInput::summary();
  }
  [[nodiscard]] bool closed() const override { return true; }
  [[nodiscard]] double ends_tolerance() const override { return 1e-9 * diagonal(); }

 private:
  [[nodiscard]] std::string kind(std::int32_t) const override { return "chart"; }

  AtlasHandle atlas_;
};

}  // namespace

std::unique_ptr<CadInput> open_atlas(const std::string& path) {
  if (!is_triangles(path))
    throw Failure(
        "--surface atlas goes with a mesh of triangles (.off, .obj, .ply, .stl, .mesh, .vtu, .msh), not with '" + path +
        "'.");
  AtlasHandle atlas = build(path);
  SessionHandle session = make_silent_session();
  require(session.get(), carreau_add_atlas(session.get(), atlas.get()));
  return std::make_unique<AtlasInput>(std::move(session), path, std::move(atlas));
}

}  // namespace command
