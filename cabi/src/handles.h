// SPDX-License-Identifier: BSD-3-Clause
// The content of the opaque handles of carreau.h.
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cad/cad.h"
#include "carreau.h"
#include "geometry/discrete/discrete_cad.h"
#include "geometry/discrete/side_by_side.h"
#include "geometry/molecule/molecule.h"
#include "mesh/flat_mesh.h"
#include "model/model.h"
#include "pipeline/parts/part_mesh.h"
#include "session/session.h"
#include "support/monitor.h"
#include "variable/remesh.h"

namespace carreau::abi {

/// Sentence and place of the last error of a handle.
struct ErrorSlot {
  std::string sentence;
  Where where;

  void clear() noexcept {
    sentence.clear();
    where = Where{};
  }
  void keep(const char* text, const Where& place) {
    sentence = text;
    where = place;
  }
};

/// Hands messages and progress to the callbacks of the host.
class HostMonitor final : public Monitor {
 public:
  explicit HostMonitor(const Parameters* const* parameters) : parameters_(parameters) {}

  void set_message_callback(carreau_message_fn callback, void* user) noexcept {
    message_ = callback, message_user_ = user;
  }
  void set_progress_callback(carreau_progress_fn callback, void* user) noexcept {
    progress_ = callback, progress_user_ = user;
  }

  void message(Level level, std::string_view text) override {
    if (hears(level)) message_(std::int32_t(level), std::string(text).c_str(), message_user_);
  }
  [[nodiscard]] bool hears(Level level) const override {
    return message_ != nullptr && int(level) <= (*parameters_)->integer("verb");
  }
  /// Begins a call that reports its own progress.
  void begin_run() {
    clear_stop();
    reached_ = 0;
  }
  /// Reported progress never decreases when a part of a run is repeated, or comes in another order.
  void progress(Phase phase, int entity, double fraction) override {
    if (phase == Phase::idle && fraction < 1) return;  // a part has ended, the run has not
    reached_ = fraction = std::max(reached_, fraction);
    if (progress_ != nullptr && progress_(std::int32_t(phase), entity, fraction, progress_user_) != 0) request_stop();
  }

 private:
  const Parameters* const* parameters_;  // of the session, which is made after its monitor
  carreau_message_fn message_ = nullptr;
  void* message_user_ = nullptr;
  carreau_progress_fn progress_ = nullptr;
  void* progress_user_ = nullptr;
  double reached_ = 0;
};

/// Fields of a mesh that carreau_remesh has made, row by row.
struct RemeshedFields {
  std::vector<double> nodal, elements, damage;
  std::int32_t nodal_components = 0, element_components = 0;
};

}  // namespace carreau::abi

struct carreau_mesh {
  explicit carreau_mesh(carreau_session* owner) : session(owner) {}

  std::atomic<bool>& busy_flag() noexcept;

  carreau_session* session;  // nullptr: the mesh is `flat`
  carreau::FlatMesh flat;
  std::shared_ptr<const carreau::HighOrderMesh> curved = {};  // elements of a file of which `flat` has those of order 2; null: `flat` has all
  struct FaceOfFile {
    carreau::FlatFace face;
    std::int64_t triangles = 0;
  };
  std::vector<FaceOfFile> flat_faces;  // ascending references: of triangles of `flat`, and of faces that it describes
  bool filled = false;                 // of `flat`
  std::vector<double> corner_uv;       // of `flat`, 6 a triangle, or empty
  std::optional<carreau::abi::RemeshedFields> remeshed = {};  // of `flat`
  std::optional<carreau::PartMesh> part = {};  // without its mesh, which is `flat`: of a mesh in parts
  std::string text;                    // returned to the caller, who may look at it until the next call
  carreau::abi::ErrorSlot error;
  std::atomic<bool> busy{false};
};

namespace carreau::abi {

/// A geometry of a session beside the host's own.
struct AddedGeometry {
  int kind = 0;  // CARREAU_GEOMETRY_...
  std::shared_ptr<Cad> cad;
  GeometryRange range;
  std::vector<int> curves = {};  // by face: their number, as the geometry was added
};

/// Callbacks in the form that the engine calls. Throws InvalidArgument.
std::shared_ptr<Cad> cad_of(const carreau_cad* callbacks, const Monitor& monitor);

/// Between carreau_geometry_begin and carreau_geometry_end: the model of the geometry is the draft of the session.
struct BegunGeometry {
  std::shared_ptr<Cad> cad;
  Model outer_draft;
  bool outer_changed = false;
};

}  // namespace carreau::abi

struct carreau_session {
  carreau_session() : monitor(&parameters), session(monitor), parameters(&session.parameters()), mesh(this) {}

  std::atomic<bool>& busy_flag() noexcept { return busy; }

  /// The model as the caller sees it.
  [[nodiscard]] const carreau::Model& model() const noexcept { return draft_changed ? draft : session.model(); }
  /// The model, to be changed.
  carreau::Model& edited_model() {
    if (!draft_changed) draft = session.model(), draft_changed = true;
    return draft;
  }
  /// Gives the changed model to the session.
  void commit_model() {
    refuse_begun();
    if (!draft_changed) return;
    session.set_model(draft);
    draft = {}, draft_changed = false;
  }

  /// Throws when carreau_geometry_begin has no end yet.
  void refuse_begun() const;
  /// Puts a geometry behind the geometries of the session. Its model has references from 1.
  void add_geometry(int kind, std::shared_ptr<carreau::Cad> cad, carreau::Model part);
  /// Adds a surface given as triangles, beside the previous ones.
  void add_triangles(std::shared_ptr<const carreau::discrete::DiscreteSurface> surface, carreau::BuiltGeometry built);
  /// Throws when the session has a plane domain.
  void refuse_plane() const;
  /// The faces are gone, and with them all geometries but the host's own.
  void drop_geometries();
  /// `host` and `added` have changed.
  void update_cad();

  carreau::abi::HostMonitor monitor;
  carreau::Session session;
  const carreau::Parameters* parameters;
  bool has_cad = false;
  std::shared_ptr<carreau::Cad> host;  // the callbacks of carreau_set_cad or carreau_set_cad_m
  std::vector<carreau::abi::AddedGeometry> added;
  std::vector<carreau::discrete::PlacedSurface> surfaces;           // given as triangles, in the order of adding
  std::vector<carreau::FlatMesh> periodic_files;                    // their files with periodic pairs, without elements
  std::shared_ptr<const carreau::discrete::DiscreteCad> triangles;  // all of them; null: there are none
  std::optional<carreau::abi::BegunGeometry> begun;
  bool plane_has_sizes = false;  // of the last plane domain
  std::optional<carreau::molecule::MoleculeSummary> molecule = {};  // the last one
  carreau::Model draft;  // changed since the session got its model
  bool draft_changed = false;
  carreau_mesh mesh;
  std::string text;  // returned to the caller, who may look at it until the next call
  carreau::abi::ErrorSlot error;
  std::atomic<bool> busy{false};
};

inline std::atomic<bool>& carreau_mesh::busy_flag() noexcept { return session != nullptr ? session->busy : busy; }
