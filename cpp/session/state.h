// SPDX-License-Identifier: BSD-3-Clause
// The content of a session.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "embedding/embedder.h"
#include "mesh/quality.h"
#include "session/gluing.h"
#include "session/meshed.h"
#include "session/session.h"
#include "support/ranks/team.h"

namespace carreau {

/// A model whose references are known.
struct GluedModel {
  Model model;
  ModelSupports supports;
  std::vector<std::string> remarks;
};

/// With the options of its mesh.
struct PreparedModel {
  Model model;
  ModelSupports supports;
  Topology topology;
  CompositeOptions options;
  std::shared_ptr<BackgroundField> background;
};

/// Everything that belongs to the mesh of a session.
struct KeptMesh {
  CompositeResult result;
  std::shared_ptr<const PartResults> parts;
  Meshed meshed;
  SurfaceMesh previous;
  bool has_previous = false;
  Parameters parameters;
  BackgroundReport background_report;
  std::vector<LayerFigures> layer_figures;
  std::optional<MeshEvaluation> delivered;
  std::vector<Interface> interfaces;
  std::vector<WholeFace> whole_faces;
};

struct Session::State {
  explicit State(Monitor& m) : monitor(m) {}

  Monitor& monitor;
  std::shared_ptr<Cad> host, cad;  // the geometry, without and with embedded curves
  EmbeddedCurves embedded;
  std::unique_ptr<Embedder> embedder;  // of `host` and the model; null: it is to be made
  std::shared_ptr<const discrete::DiscreteCad> triangles;
  std::shared_ptr<PrescriptionSource> metric_callbacks, prescription_source;
  std::shared_ptr<PrescriptionSource> uniform_parameters;  // of parameter_size; null: it is 0
  std::shared_ptr<BackgroundField> background;
  std::shared_ptr<Attractors> attractors;  // null: none
  std::vector<CurveLayers> layers;
  std::vector<LayerFigures> layer_figures;  // of `result`
  std::shared_ptr<TeamLink> team_link;
  std::unique_ptr<Team> team;  // of team_link; null: this process is alone
  bool is_together = false;    // in a run of the team
  BackgroundReport background_report;
  SurfaceMesh previous;
  bool has_previous = false;
  Model model;
  GlueReport glued;  // in `model`
  bool model_from_file = false;
  bool model_from_env = false;  // read by `call inimesh`: the next one reads its own
  Parameters parameters;
  CompositeResult result;
  std::shared_ptr<const PartResults> parts;  // of `result`; null: it is of one kind
  Meshed meshed;
  bool has_mesh = false;
  std::optional<HighOrderMesh> raised;  // over `result`
  std::unique_ptr<Projector> projector;  // of the geometry and the model; null: it is to be made
  Parameters meshed_parameters, tried_parameters;  // of `result`, and of the last make_mesh()
  bool last_failed = false;                        // the last make_mesh() has thrown
  std::optional<MeshEvaluation> delivered;         // of `result`
  std::vector<Interface> interfaces;               // of `result`
  std::vector<WholeFace> whole_faces;              // of `result`
  std::optional<QualitySummary> shapes, quality;   // of `result`, after the first call: without edges, and all

  /// Puts the embedded curves beside the host's.
  void update_cad();
  /// The geometry or the model has changed.
  void forget_trees() noexcept { projector.reset(), embedder.reset(); }

  /// The host first.
  [[nodiscard]] std::vector<PrescriptionSource*> sources(BackgroundField* of_this_run);

  /// Finds missing references and, if required, curves that are one.
  void glue_model(Model& known, ModelSupports& supports, Cad& whole_cad, std::vector<std::string>& remarks);

  /// Faces that were left out of gluing stay as they are, and only the host's own reasons to leave them out are kept.
  void keep_glued(const Model& part, const GlueReport& found);

  void check_model(const Model& candidate) const;
};

/// Files that parameters name take precedence over the host's background mesh. Throws InvalidArgument if one of two is
/// named.
std::shared_ptr<BackgroundField> background_of_run(const Parameters& parameters, bool one_plane,
                                                   const std::shared_ptr<BackgroundField>& set);

/// Replaces the references of points by the references that results show.
inline void show_points(const Model& model, std::vector<std::int32_t>& refs) {
  for (std::int32_t& ref : refs)
    if (const auto found = model.shown_points.find(ref); found != model.shown_points.end()) ref = found->second;
}

}  // namespace carreau
