// SPDX-License-Identifier: BSD-3-Clause
// The content of a file: counts, names, colours, places.
#include "handle.h"

using namespace carreau_occ;
using namespace carreau_occ::abi;

namespace {

void give_list(const std::vector<std::int32_t>& list, std::int64_t capacity, std::int32_t* out, std::int64_t* count) {
  if (count != nullptr) *count = static_cast<std::int64_t>(list.size());
  if (capacity == 0) return;
  if (capacity < static_cast<std::int64_t>(list.size()))
    throw Failure(CARREAU_ERR_ARGUMENT, "the array has room for " + std::to_string(capacity) + " rows, there are " +
                                            std::to_string(list.size()));
  std::copy(list.begin(), list.end(), required(out, "the array"));
}

const std::vector<TreeRow>& tree_of(carreau_cad_file& file) {
  if (!file.tree) file.tree = part_tree(file.shape, solids_in(file));
  return *file.tree;
}

}  // namespace

const Solids& carreau_occ::abi::solids_in(carreau_cad_file& file) {
  if (!file.solids) file.solids = solids_of(file.shape);
  return *file.solids;
}

const std::vector<FaceContact>& carreau_occ::abi::contacts_of(carreau_cad_file& file) {
  (void)host_of(file);
  if (!file.contacts) file.contacts = find_face_contacts(file.shape, solids_in(file));
  return *file.contacts;
}

carreau_status carreau_cad_info(carreau_cad_file* file, carreau_cad_content* out_content) {
  return guarded_call(file, [&] {
    const BrepHost& host = host_of(*file);
    carreau_cad_content content{};
    content.faces = host.face_count(), content.edges = host.edge_count(), content.vertices = host.vertex_count();
    content.closed = host.is_closed() ? 1 : 0;
    content.unit = file->shape.unit.c_str();
    content.diagonal = host.diagonal();
    const BrepHost::GlueTolerances tolerances = host.glue_tolerances();
    content.glue_tolerance = tolerances.of_all, content.open_tolerance = tolerances.of_each;
    content.losses = static_cast<int32_t>(file->shape.losses.size());
    content.bent_faces = static_cast<int32_t>(host.bent_faces().size());
    content.left_out = static_cast<int32_t>(file->left_out.size());
    content.references = host.reference_count();
    content.match_tolerance = host.match_tolerance();
    content.notes = file->notes.c_str();
    content.file_unit = file->shape.file_unit.c_str();
    const Solids& solids = solids_in(*file);
    content.small_features = static_cast<int32_t>(file->features.size());
    content.solids = static_cast<int32_t>(solids.names.size());
    content.shared_faces = static_cast<int32_t>(
        std::count_if(solids.of_face.begin(), solids.of_face.end(), [](const auto& sides) { return sides[1] > 0; }));
    content.tree_rows = static_cast<int32_t>(tree_of(*file).size());
    write_struct(content, out_content, "out_content");
  });
}

carreau_status carreau_cad_small_feature_at(carreau_cad_file* file, int64_t index, carreau_cad_small_feature* out_feature) {
  return guarded_call(file, [&] {
    (void)host_of(*file);
    if (index < 0 || static_cast<std::uint64_t>(index) >= file->features.size())
      throw Failure(CARREAU_ERR_ARGUMENT, "there is no small feature of index " + std::to_string(index));
    const SmallFeature& known = file->features[static_cast<std::size_t>(index)];
    file->feature_faces.clear();
    for (const int face : known.faces) file->feature_faces += (file->feature_faces.empty() ? "" : ", ") + std::to_string(face);
    carreau_cad_small_feature feature{};
    feature.kind = known.kind.c_str(), feature.size = known.size;
    std::copy(known.place.begin(), known.place.end(), feature.place);
    feature.removed = known.removed ? 1 : 0;
    feature.faces = file->feature_faces.c_str();
    write_struct(feature, out_feature, "out_feature");
  });
}

const char* carreau_cad_loss(carreau_cad_file* file, int64_t index) {
  if (file == nullptr || index < 0 || static_cast<std::uint64_t>(index) >= file->shape.losses.size()) return nullptr;
  return file->shape.losses[static_cast<std::size_t>(index)].c_str();
}

carreau_status carreau_cad_file_face(carreau_cad_file* file, int32_t number, carreau_cad_face* out_face) {
  return guarded_call(file, [&] {
    const BrepHost& host = host_of(*file);
    check_face(host, number);
    carreau_cad_face face{};
    face.number = number;
    face.rgb = host.face_colour(number);
    face.name = host.face_name(number).c_str();
    face.why = "";
    const Solids& solids = solids_in(*file);
    const std::array<int, 2>& sides = solids.of_face[static_cast<std::size_t>(number - 1)];
    face.solid = sides[0], face.other_solid = sides[1];
    face.solid_name = solids.name(face.solid), face.other_solid_name = solids.name(face.other_solid);
    face.layer = host.face_layer(number).c_str();
    for (const auto& [left_out, why] : file->left_out)
      if (left_out == number) face.why = why.c_str();
    write_struct(face, out_face, "out_face");
  });
}

const char* carreau_cad_entity_name(carreau_cad_file* file, int32_t dimension, int32_t number) {
  const char* name = "";
  guarded_call(file, [&] {
    const BrepHost& host = host_of(*file);
    if (dimension == 2 && number >= 1 && number <= host.face_count()) name = host.face_name(number).c_str();
    if (const Solids& solids = solids_in(*file); dimension == 3 && number >= 1 && static_cast<std::size_t>(number) <= solids.names.size())
      name = solids.name(number);
    if (dimension != 0 && dimension != 1) return;
    const auto found = host.names(dimension).find(number);
    if (found != host.names(dimension).end()) name = found->second.c_str();
  });
  return name;
}

carreau_status carreau_cad_tree_at(carreau_cad_file* file, int64_t index, carreau_cad_tree_row* out_row) {
  return guarded_call(file, [&] {
    (void)host_of(*file);
    const TreeRow& known = at(tree_of(*file), index, "row");
    carreau_cad_tree_row row{};
    row.kind = known.kind.c_str(), row.name = known.name.c_str(), row.layer = known.layer.c_str();
    row.depth = known.depth, row.number = known.number, row.rgb = known.rgb, row.faces = known.faces;
    write_struct(row, out_row, "out_row");
  });
}

carreau_status carreau_cad_count_contacts(carreau_cad_file* file, int64_t* out_count) {
  return guarded_call(file, [&] { *required(out_count, "out_count") = static_cast<int64_t>(contacts_of(*file).size()); });
}

carreau_status carreau_cad_contact_at(carreau_cad_file* file, int64_t index, carreau_cad_contact* out_contact) {
  return guarded_call(file, [&] {
    const FaceContact& known = at(contacts_of(*file), index, "contact");
    carreau_cad_contact contact{};
    std::copy(known.solids.begin(), known.solids.end(), contact.solids);
    std::copy(known.faces.begin(), known.faces.end(), contact.faces);
    contact.pairs = known.pairs, contact.area = known.area;
    std::copy(known.place.begin(), known.place.end(), contact.place);
    write_struct(contact, out_contact, "out_contact");
  });
}

carreau_status carreau_cad_point(const carreau_cad_file* file, int32_t face, double u, double v, double out_xyz[3],
                                 double out_uv[2]) {
  if (file == nullptr || !file->host || out_xyz == nullptr || face < 1 ||
      face > file->host->reference_count() + file->host->wire_count())
    return CARREAU_ERR_ARGUMENT;
  double xyz[3], uv[2];
  if (!file->host->locate(face, u, v, xyz, uv)) return CARREAU_ERR_CALLBACK;
  std::copy(xyz, xyz + 3, out_xyz);
  if (out_uv != nullptr) std::copy(uv, uv + 2, out_uv);
  return CARREAU_OK;
}

carreau_status carreau_cad_curve_point(const carreau_cad_file* file, int32_t face, int32_t ic, double share,
                                       double out_uv[2]) {
  if (file == nullptr || !file->host || out_uv == nullptr || face < 1 || face > file->host->reference_count() ||
      ic < 1 || ic > file->host->curve_count(face))
    return CARREAU_ERR_ARGUMENT;
  double uv[2];
  if (!file->host->on_curve(face, ic, share, uv)) return CARREAU_ERR_CALLBACK;
  std::copy(uv, uv + 2, out_uv);
  return CARREAU_OK;
}

carreau_status carreau_cad_curves(carreau_cad_file* file, int32_t face, int64_t capacity, int32_t out_edges[],
                                  int64_t* out_count) {
  return guarded_call(file, [&] { give_list(host_of(*file).curves(face), capacity, out_edges, out_count); });
}

carreau_status carreau_cad_parts(carreau_cad_file* file, int32_t face, int64_t capacity, int32_t out_refs[],
                                 int64_t* out_count) {
  return guarded_call(file, [&] {
    check_face(host_of(*file), face);
    const std::vector<int> parts = host_of(*file).parts(face);
    give_list({parts.begin(), parts.end()}, capacity, out_refs, out_count);
  });
}

int32_t carreau_cad_whole_face(const carreau_cad_file* file, int32_t ref) {
  return file != nullptr && file->host ? file->host->whole_face(ref) : ref;
}

int32_t carreau_cad_whole_edge(const carreau_cad_file* file, int32_t ref) {
  return file != nullptr && file->host ? file->host->whole_edge(ref) : ref;
}
