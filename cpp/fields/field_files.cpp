// SPDX-License-Identifier: BSD-3-Clause
#include "fields/field_files.h"

#include <algorithm>
#include <deque>
#include <optional>

#include "fields/field_samples.h"
#include "io/element_words.h"
#include "io/files.h"
#include "support/error.h"
#include "support/infinity.h"
#include "fields/part_monitor.h"

namespace carreau {

namespace {

class FieldWriter {
 public:
  FieldWriter(const FieldRun& run, const FieldOptions& options, Cad& cad, Monitor& monitor)
      : run_(run), options_(options), cad_(cad), monitor_(monitor) {
    try {
      rules_.emplace(run.model, run.topology, cad, run.size);
      if ((options.groups & field_governs) != 0) origin_rules_.emplace(run.model, run.topology, cad, run.size);
    } catch (const InvalidArgument& error) {
      // Contradicting parameters are the reason for the missing mesh; the geometry can still be shown.
      if (run.result != nullptr) throw;
      monitor.message(Level::warning, std::string("the fields have no sizes: ") + error.what());
    }
    std::uint32_t triangle = 0;
    for (std::size_t f = 0; f < run.model.faces.size(); ++f) {
      first_triangle_.push_back(triangle);
      if (const FaceMesh* mesh = mesh_of(f)) triangle += static_cast<std::uint32_t>(mesh->triangles.size());
      if (run.model.faces[f].is_wire()) continue;
      if (options.face == 0 || run.model.faces[f].ref == options.face) faces_.push_back(f);
    }
    if (faces_.empty())
      throw InvalidArgument("there is no face of the reference " + std::to_string(options.face) +
                            ", whose fields are to be written");
  }

  std::vector<std::string> write(const std::string& path) {
    std::vector<std::string> files;
    as_png_ = suffix_of(path) == ".png";
    if (as_png_) options_.groups = field_preview;
    if (as_png_ && options_.multi_part && faces_.size() > 1)
      throw InvalidArgument("a .png file holds one face: '" + path + "' cannot have all of them");
    if (options_.multi_part || options_.face != 0) {
      field_file_of_face(path, 0);  // checks the suffix
      write_file(path, faces_);
      return {path};
    }
    for (const std::size_t f : faces_) {
      begun_ = files.size();
      files.push_back(field_file_of_face(path, run_.model.faces[f].ref));
      write_file(files.back(), {&f, 1});
    }
    return files;
  }

 private:
  [[nodiscard]] const FaceMesh* mesh_of(std::size_t f) const {
    return run_.result != nullptr ? &run_.result->mesh.faces[f] : nullptr;
  }
  [[nodiscard]] const FaceInterfaces& interfaces_of(std::size_t f) const {
    static const FaceInterfaces none;
    return run_.result != nullptr ? run_.result->interfaces[f] : none;
  }

  /// The gradation that the mesh obeys.
  [[nodiscard]] SizeLimits limits() const {
    return {.field = run_.result != nullptr ? run_.result->graded.get() : nullptr};
  }

  void write_file(const std::string& path, std::span<const std::size_t> faces) {
    std::deque<FieldSource> sources;
    std::deque<FaceMetric> prescribed;
    std::deque<SizeOrigins> origins;
    std::deque<FieldImage> images;
    std::deque<PartMonitor> part_of_run;
    std::vector<ExrPart> parts;
    for (const std::size_t f : faces) {
      sources.push_back(source_of(f));
      if (rules_) {
        prescribed.emplace_back(static_cast<int>(f), *rules_, interfaces_of(f), monitor_, limits());
        sources.back().prescribed = &prescribed.back();
      }
      if (origin_rules_) {
        origins.emplace_back(static_cast<int>(f), *origin_rules_, interfaces_of(f), limits().field != nullptr,
                             monitor_);
        sources.back().origins = &origins.back();
      }
      const auto all = static_cast<double>(faces_.size()), before = static_cast<double>(begun_ + images.size());
      part_of_run.emplace_back(monitor_, before / all, (before + 1) / all);
      images.emplace_back(
          sources.back(), options_, [this] { return deviations(); }, cad_, part_of_run.back());
      parts.push_back(images.back().part());
    }
    if (as_png_) {
      carreau::write_file(path, images.front().png());
      return report(path, sources.front().ref, images.front());
    }
    ExrWriter writer(path, parts, options_.file);
    for (std::size_t i = 0; i < faces.size(); ++i) writer.write_part(static_cast<int>(i), images[i].pixels());
    writer.commit();
    for (std::size_t i = 0; i < faces.size(); ++i) report(path, sources[i].ref, images[i]);
  }

  void report(const std::string& path, int ref, const FieldImage& image) const {
    monitor_.message(Level::detail, "face " + std::to_string(ref) + ": fields of " +
                                        std::to_string(image.grid().width) + " x " +
                                        std::to_string(image.grid().height) + " pixels are in '" + path + "'");
    if (image.failures() > 0)
      monitor_.message(Level::warning, "the geometry fails at " + std::to_string(image.failures()) +
                                           " pixels of the fields of face " + std::to_string(ref) +
                                           "; first: " + image.first_failure());
  }

  FieldSource source_of(std::size_t f) {
    const Face& face = run_.model.faces[f];
    FieldSource source;
    source.ref = face.ref;
    if (const PlaneDomain& plane = interfaces_of(f).plane; !plane.edges.empty())
      source.shape = shape_of(plane);
    else
      source.shape = shape_of(face,
                              run_.supports != nullptr ? std::span<const CurveSupport>(run_.supports->of_face[f])
                                                       : std::span<const CurveSupport>(),
                              cad_, monitor_);
    if (const FaceMesh* mesh = mesh_of(f)) {
      if (!mesh->triangles.empty()) source.mesh = mesh;
      source.first_triangle = first_triangle_[f];
      source.vertex_size = run_.result->vertex_size;
      if (run_.result->spaces[f]) source.space = &*run_.result->spaces[f];
    }
    source.attributes = attributes_of(f, source);
    return source;
  }

  [[nodiscard]] std::vector<ExrAttribute> attributes_of(std::size_t f, const FieldSource& source) const {
    std::vector<ExrAttribute> attributes;
    const auto add = [&](const std::string& name, const auto& value) { attributes.push_back({name, value}); };
    const FaceMesh* mesh = mesh_of(f);
    add("face.status", std::string(mesh != nullptr ? word_of(mesh->status) : "not meshed"));
    if (mesh != nullptr && !mesh->why.empty()) add("face.why", mesh->why);
    if (source.shape.gap > 0) add("domain.gap", source.shape.gap);
    if (run_.diag > 0) add("diag", run_.diag);
    attributes.insert(attributes.end(), run_.parameters.begin(), run_.parameters.end());
    return attributes;
  }

  FieldDeviations deviations() {
    if (evaluation_ == nullptr && !unknown_) try {
        evaluation_ = &run_.delivered();
      } catch (const CallbackError& error) {
        unknown_ = true;
        monitor_.message(Level::warning, std::string("the deviations are not known: ") + error.what());
      }
    if (unknown_) return {};
    return {(*evaluation_)[EvaluationKind::deviation].values, (*evaluation_)[EvaluationKind::angle].values};
  }

  const FieldRun& run_;
  FieldOptions options_;
  Cad& cad_;
  Monitor& monitor_;
  std::optional<SizeRules> rules_;
  std::optional<OriginRules> origin_rules_;
  std::vector<std::size_t> faces_;             // to be written
  std::vector<std::uint32_t> first_triangle_;  // by face
  const MeshEvaluation* evaluation_ = nullptr;
  bool as_png_ = false;
  std::size_t begun_ = 0;  // faces of earlier files
  bool unknown_ = false;   // the host failed while it was measured
};

}  // namespace

double diag_of_curves(const Model& model, Cad& cad, Monitor& monitor) {
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Face& face : model.faces) {
    const std::vector<Vec2> uv = shape_of(face, {}, cad, monitor).lines.vertices;
    std::vector<SurfaceJet> jets(uv.size());
    std::vector<Metric2> ignored(uv.size());
    FieldSampler(face.ref, want_position, nullptr, cad, monitor).sample(uv, jets, ignored);
    for (const SurfaceJet& jet : jets) {
      if (!is_finite(jet.s)) continue;
      low = low.cwiseMin(jet.s);
      high = high.cwiseMax(jet.s);
    }
  }
  return low.x() <= high.x() ? norm(high - low) : 0;
}

std::vector<std::string> write_fields(const FieldRun& run, const std::string& path, const FieldOptions& options,
                                      Cad& cad, Monitor& monitor) {
  check_field_options(options);
  return FieldWriter(run, options, cad, monitor).write(path);
}

}  // namespace carreau
