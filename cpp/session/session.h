// SPDX-License-Identifier: BSD-3-Clause
// A session: a host's geometry, a model, parameters, and the mesh made of them. The only room that knows the order of
// the steps.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "association/match_models.h"
#include "association/refine_mesh.h"
#include "cad/cad.h"
#include "fields/fields.h"
#include "high_order/high_order_mesh.h"
#include "io/mesh_files.h"
#include "measure/mesh_evaluation.h"
#include "mesh/flat_mesh.h"
#include "mesh/quality.h"
#include "mesh/surface_mesh.h"
#include "metric/prescription.h"
#include "model/model.h"
#include "pipeline/mesh_model.h"
#include "pipeline/parts/part_mesh.h"
#include "projection/mesh_entities.h"
#include "projection/projector.h"
#include "session/gluing.h"
#include "session/parameters.h"
#include "size/attractors.h"
#include "size/background.h"
#include "support/monitor.h"
#include "support/ranks/executor.h"
#include "support/ranks/team.h"
#include "surface/layers/layer_curves.h"
#include "surface/layers/layer_figures.h"

namespace carreau {

namespace discrete {
class DiscreteCad;
}
struct PartResults;
class Embedder;
struct GluedModel;
struct KeptMesh;
struct PreparedModel;

/// Independent of any other session; used by one thread at a time.
class Session {
 public:
  /// `monitor` outlives the session.
  explicit Session(Monitor& monitor);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void set_cad(std::shared_ptr<Cad> cad);
  /// Evaluates all faces that are given by triangles (Face::discrete), in place of the Cad of set_cad; nullptr: no such
  /// faces. A DiscreteCad given to set_cad() serves both.
  void set_triangles(std::shared_ptr<const discrete::DiscreteCad> triangles);
  /// Prescribed sizes and metrics, unless hphy_flag = 0: the host's callbacks, and an additional source that is
  /// evaluated after them (a background mesh). The prescriptions of both at a place are intersected. nullptr: none, as
  /// at the start.
  void set_metric_callbacks(std::shared_ptr<PrescriptionSource> source);
  void set_prescription_source(std::shared_ptr<PrescriptionSource> source);
  /// A background mesh as that other source; the parameters background_mesh and background_sol come before it. nullptr:
  /// none.
  void set_background(std::shared_ptr<BackgroundField> background);
  /// Sizes near points, edges and triangles, beside all other sources; clear_attractors() removes all. Throws
  /// InvalidArgument, and changes nothing then.
  void add_attractor(const Attractor& attractor);
  void clear_attractors() noexcept;
  /// Rows of cells along curves in the next meshes; clear_layers() removes all. Throws InvalidArgument, and changes
  /// nothing then.
  void add_layers(CurveLayers layers);
  void clear_layers() noexcept;
  /// Measures of the layers of the last make_mesh(), in the order of add_layers().
  [[nodiscard]] const std::vector<LayerFigures>& layer_figures() const noexcept;
  /// Use of the background mesh in the last make_mesh(); zero when there was none.
  [[nodiscard]] const BackgroundReport& background_report() const noexcept;
  /// Checks the rules of RT-0232 sec. 3.2; throws InvalidModel and keeps the old model when one is broken. If the
  /// parameter failing_faces requires it, leaves out the faces that break a rule.
  void set_model(Model model);
  void load_pardom(const std::string& path);
  /// Processes that make meshes together from now on; nullptr: this one alone, as at the start. All of them must have
  /// equal geometries, models and parameters, and call make_mesh() together; an exception in one process is thrown in
  /// all. Visible differences of curves or of the mesh are errors.
  void set_team(std::shared_ptr<TeamLink> link);
  /// Calls body(executor), which may make meshes, in all processes of the team together: an exception in one of them reaches
  /// all. Without a team in this one alone.
  void together(const std::function<void(const Executor&)>& body) const;
  void clear_model() noexcept;  ///< the mesh made of it stays
  [[nodiscard]] const Model& model() const noexcept;

  Parameters& parameters() noexcept;
  Monitor& monitor() noexcept;

  /// `call inimesh`: supports, sizes, curves, domains, patches, assembly. An earlier mesh is kept when this throws.
  /// References that are zero are found first (gluing); the glued model replaces the model, and is written to
  /// `<source>.new` when the model was read from a file. Faces that are left out are in the mesh, as failed. If the
  /// parameter failing_faces is "leave_out", leaves the faces on which the host fails out of this run, and makes
  /// everything that used them again. DomainError when none is left. Reports progress between `from` and `to`, the
  /// share of this run in a longer one.
  void make_mesh(double from = 0, double to = 1);

  /// The mesh of another session on this session's geometry, whose topology is equal (association/carry_mesh.h): `elements` and sizes are of the
  /// other mesh. Replaces the mesh like make_mesh(). Throws InvalidArgument without that mesh, and for meshes across patches and of triangles;
  /// InvalidModel where the topologies differ.
  void carry_mesh(const Session& from, MatchBy by);

  /// Refines mesh() on its surfaces (association/refine_mesh.h), and replaces it. Throws InvalidArgument like carry_mesh(), and LimitError.
  void refine_mesh(const RefineRequest& request);

  /// Makes elements of a higher order over mesh() (high_order/raise_order.h), until the mesh changes. Throws InvalidArgument like carry_mesh().
  const HighOrderMesh& raise_order(int order, NodePlaces places);
  /// Throws InvalidArgument without them.
  [[nodiscard]] const HighOrderMesh& raised() const;
  [[nodiscard]] bool has_raised() const noexcept;
  /// Writes raised() (io/high_order/curved_files.h), by the parameter association with the places of its nodes.
  void write_raised(const std::string& path) const;

  /// Like make_mesh(), by all processes of the team: patches stay in the processes that made them. The parts form the mesh of
  /// make_mesh(), with equal numbers, which no process holds; mesh() does not change. With options that need the whole mesh
  /// (pipeline/parts) each process makes it, which is mesh() then, and takes its share. Throws InvalidArgument without a team.
  [[nodiscard]] PartMesh make_part();

  /// Throws InvalidArgument before the first make_mesh().
  [[nodiscard]] const SurfaceMesh& mesh() const;
  [[nodiscard]] bool has_mesh() const noexcept;
  /// The mesh before mesh(), from which fields are transferred. Throws InvalidArgument before the second make_mesh().
  [[nodiscard]] const SurfaceMesh& previous_mesh() const;
  [[nodiscard]] bool has_previous_mesh() const noexcept;
  /// A copy of the mesh, with the previous mesh and everything that is known about them, for restore().
  [[nodiscard]] std::shared_ptr<const KeptMesh> kept_mesh() const;
  void restore(const KeptMesh& kept);
  /// The face whose (u, v) a node has (local_cells()), as an index in mesh().faces. On a cross-patch mesh it may differ from the face that
  /// lists the node.
  [[nodiscard]] std::size_t uv_face(std::size_t face, std::int32_t node) const;
  /// Size prescribed at each vertex of mesh().
  [[nodiscard]] const std::vector<double>& vertex_sizes() const;
  [[nodiscard]] const CompositeReport& report() const;

  /// The measures of the last make_mesh(), computed at the first call (or by make_mesh() when the parameter measure is
  /// 1). They evaluate the geometry and the sources of that run again; messages summarise them. Throws InvalidArgument
  /// before the first make_mesh(), and the exceptions of callbacks.
  const MeshEvaluation& delivered();
  /// Writes delivered() as JSON.
  void write_delivered(const std::string& path);

  /// The content that `call export` would write with the values of option, refs, flag (RT-0232 sec. 4); `delivered`
  /// adds its values as fields.
  [[nodiscard]] FlatMesh exported(const MeshEvaluation* delivered = nullptr, bool with_fields = true) const;
  /// Writes exported() to a file; format by suffix. A .vtu holds the values of delivered(), if they were computed or
  /// the parameter measure is 1. `.exr`: the fields of all faces, or of the face of onesurf*, in one file.
  void write(const std::string& path);
  /// The bytes of such a file of a mesh.
  std::string encoded(MeshFormat format);

  /// Samples the fields that governed the mesh of each face, and writes them as images (session/fields.h): returns the
  /// names of the files. Samples the mesh's run. Samples the current model, without triangles, if options.raw is set,
  /// if there is no mesh, or if the last make_mesh() has thrown (then with the parameters of that call): the host's
  /// answers, pixel by pixel, show the reason. Asks the geometry from the caller's thread. Throws InvalidArgument,
  /// FileError, Cancelled; the mesh stays.
  std::vector<std::string> write_fields(const std::string& path, const FieldOptions& options);

  /// Model::shown_points of the mesh: exported() has applied it. Throws like mesh().
  [[nodiscard]] const std::map<int, int>& shown_points() const;

  /// Names of curves, points and solids of the mesh. Throws like mesh().
  [[nodiscard]] const EntityNames& names() const;
  /// Faces of the mesh as the caller knows them, parts made whole. Throws like mesh().
  [[nodiscard]] const std::vector<WholeFace>& whole_faces() const;
  /// Shapes and lengths, measured at the first call. Throws like mesh().
  [[nodiscard]] const QualitySummary& quality() const;
  /// Pairs of triangles that cross as meshing has found them; it may not have looked, or kept the first ones only.
  [[nodiscard]] const std::vector<TriangleIntersection>& crossings() const;
  /// True if these are all pairs, or at least `limit`. report() has their number. Throws like mesh().
  [[nodiscard]] bool knows_crossings(std::size_t limit) const;
  /// The curves of the mesh in space. Throws like mesh().
  [[nodiscard]] const std::vector<Interface>& interfaces() const;
  /// Geometric supports of the curves of the last make_mesh(), for the option smo3d.
  [[nodiscard]] const ModelSupports& supports() const;

  /// Evaluates the geometry at places, and projects points to it (Projector). Trees are made once for a geometry and model, and
  /// again after a run. Throw InvalidArgument without them and for curves and points whose references are not known yet.
  void evaluate_places(int dimension, int ref, unsigned want, std::span<const Vec2> parameters, std::span<SurfaceJet> out);
  /// The entity of each node of mesh() (entities_of_nodes), and by curve of mesh() the parameters of its vertices on the host's curve `ic` of
  /// a face, where they are known. Throw like mesh().
  [[nodiscard]] std::vector<MeshEntity> node_entities() const;
  [[nodiscard]] std::vector<CurveParameters> curve_parameters() const;
  std::map<int, std::string> project(int dimension, int ref, std::span<const Vec3> x, std::span<ProjectedPoint> out);
  /// Embeds a point or a polyline of space in the faces of the model (Embedder), within the parameter embed_tolerance; returns the reference
  /// that results name. `name`: of the point or curve; may be empty. Finds the references of the model first. Throws like project(), and
  /// embeds nothing then.
  int embed_point(const Vec3& x, const std::string& name);
  int embed_polyline(std::span<const Vec3> points, const std::string& name);
  /// Embeds the curves of wires that lie on faces, and removes these wires; a warning names each other wire. Returns their number.
  int embed_wires();

  /// Runs all actions of a blsurf.env until `call exit` or the end of the file (RT-0232 sec. 3.3). `<pref>.pardom` is
  /// read and `<pref>.mesh` written beside the env file; a model given by set_model() or load_pardom() is used instead
  /// of that file. Parameters have their defaults at the start, after each call and at the end, also when this throws
  /// (but not when the file cannot be read): FileError or InvalidArgument with file and line, and the exceptions of
  /// make_mesh() and write().
  void run_env(const std::string& path);

  /// Sets the parameters that a blsurf.env has before its first action, and runs no action; relative names of
  /// background meshes refer to its folder. Parameters that it does not name keep their values; all do when this
  /// throws: FileError or InvalidArgument with file and line.
  void read_env(const std::string& path);

 private:
  Projector& projector(int dimension);
  Embedder& embedder();
  void find_model_references();
  int keep_embedded(int dimension, int ref, const std::string& name);
  [[nodiscard]] const QualitySummary& shapes() const;
  void make_mesh_alone(double from, double to, PartMesh* part);
  void make_mesh_of(Model& known, Monitor& run, PartMesh* part);
  /// Finds supports, references and the topology of `known`, which loses the faces that the host fails on if required.
  GluedModel glue(Model& known, Cad& whole_cad);
  PreparedModel prepare(Model& known, Cad& whole_cad);
  PartMesh part_of(const Model& model, CompositeResult result);
  PartMesh part_of_mesh();
  void make_discrete_mesh(const Model& model, Cad& cad, Monitor& making, Monitor& measuring, Monitor& run);
  void keep_result(Model model, ModelSupports supports, Topology topology, CompositeOptions options,
                   CompositeResult result, std::shared_ptr<const PartResults> parts,
                   const std::shared_ptr<BackgroundField>& background, Monitor& measuring);
  /// The refined mesh of the same model.
  void keep_refined(CompositeResult result, Monitor& measuring);
  FlatMesh exported_as(MeshFormat format);
  /// `association` keeps the data that the options refer to.
  [[nodiscard]] MeshFileOptions file_options(MeshFormat format, MeshAssociation& association) const;
  [[nodiscard]] MeshAssociation associate_nodes() const;
  std::vector<std::string> write_fields_of_mesh(const std::string& path, FieldOptions options);
  std::vector<std::string> write_fields_of_model(const std::string& path, FieldOptions options);
  [[nodiscard]] bool has_model_from_host() const noexcept;
  void load_pardom_of_env(const std::string& path);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carreau
