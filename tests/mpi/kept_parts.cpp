// SPDX-License-Identifier: BSD-3-Clause
#include "kept_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>

#include "rank_run.h"

namespace mpi_tests {

namespace {

struct FreePart {
  void operator()(carreau_part* part) const { carreau_part_free(part); }
};
using PartHandle = std::unique_ptr<carreau_part, FreePart>;

PartHandle parts_of(Run& run, carreau_status expected = CARREAU_OK) {
  carreau_part* part = nullptr;
  const carreau_status status = carreau_mesh_generate_parts(run.session, world(), &part);
  expect(status == expected, "the status is " + std::to_string(status) + ": " + run.sentence());
  return PartHandle(part);
}

carreau_mesh* mesh_of(const PartHandle& part) {
  carreau_mesh* mesh = nullptr;
  expect(carreau_part_mesh(part.get(), &mesh) == CARREAU_OK, "the part has a mesh");
  return mesh;
}

/// Bytes of a file, and how often each has come.
struct FileBytes {
  std::string bytes;
  std::vector<int> times;
};

std::int32_t put(std::int64_t position, std::int64_t n, const void* bytes, void* user) {
  auto& file = *static_cast<FileBytes*>(user);
  const auto end = static_cast<std::size_t>(position + n);
  if (file.bytes.size() < end) file.bytes.resize(end), file.times.resize(end);
  std::memcpy(file.bytes.data() + position, bytes, static_cast<std::size_t>(n));
  for (auto k = static_cast<std::size_t>(position); k < end; ++k) ++file.times[k];
  return 0;
}

FileBytes file_of(carreau_mesh* mesh) {
  FileBytes file;
  expect(carreau_mesh_encode(mesh, ".meshb", put, &file) == CARREAU_OK, std::string("it is encoded: ") + carreau_mesh_last_error(mesh));
  return file;
}

// The bytes of all parts equal the bytes of one process, and none comes twice.
void same_file(carreau_mesh* alone, carreau_mesh* part) {
  const std::string expected = file_of(alone).bytes;
  FileBytes mine = file_of(part);
  expect(mine.bytes.size() <= expected.size(), "no byte is behind the end");
  mine.bytes.resize(expected.size(), 0), mine.times.resize(expected.size(), 0);
  std::vector<int> times(expected.size());
  std::string all(expected.size(), 0);
  const int n = static_cast<int>(expected.size());
  MPI_Allreduce(mine.times.data(), times.data(), n, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(mine.bytes.data(), all.data(), n, MPI_BYTE, MPI_BOR, MPI_COMM_WORLD);
  expect(std::all_of(times.begin(), times.end(), [](int k) { return k == 1; }), "each byte is of one part");
  expect(all == expected, "the bytes are those of one process");
}

/// The mesh of one process.
struct Whole {
  explicit Whole(carreau_mesh* mesh) {
    std::int64_t n = 0, m = 0;
    carreau_mesh_count(mesh, &n, &m, nullptr, nullptr);
    xyz.resize(static_cast<std::size_t>(n)), triangles.resize(static_cast<std::size_t>(m)), refs.resize(triangles.size());
    vertex_refs.resize(xyz.size());
    // A rank that was late has no face.
    if (n > 0) carreau_mesh_vertices(mesh, n, xyz.front().data()), carreau_mesh_vertex_refs(mesh, n, vertex_refs.data());
    if (m > 0) carreau_mesh_triangles(mesh, m, triangles.front().data()), carreau_mesh_triangle_refs(mesh, m, refs.data());
  }
  std::vector<std::array<double, 3>> xyz;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> refs, vertex_refs;
};

struct Kept : Whole {
  explicit Kept(const PartHandle& part) : Whole(mesh_of(part)) {
    std::int64_t m = 0, n = 0;
    carreau_part_count(part.get(), &own_triangles, &m, &own_vertices, &n);
    expect(static_cast<std::size_t>(m) == triangles.size() && static_cast<std::size_t>(n) == xyz.size(), "counts are those of the mesh");
    number.resize(xyz.size()), row.resize(xyz.size()), owner.resize(xyz.size());
    triangle.resize(triangles.size()), triangle_owner.resize(triangles.size()), layer.resize(triangles.size());
    corners.resize(triangles.size());
    expect(carreau_part_vertices(part.get(), n, number.data(), owner.data(), row.data()) == CARREAU_OK, "numbers of vertices");
    expect(carreau_part_triangles(part.get(), m, triangle.data(), triangle_owner.data(), layer.data(), corners.empty() ? nullptr : corners.front().data()) == CARREAU_OK,
           "numbers of triangles");
    // The mesh of the part agrees.
    std::vector<std::int64_t> same(number.size()), same_triangles(triangle.size());
    carreau_mesh* const mesh = mesh_of(part);
    expect(carreau_mesh_part_vertices(mesh, n, same.data(), nullptr, nullptr) == CARREAU_OK && same == number, "numbers of its mesh");
    expect(carreau_mesh_part_triangles(mesh, m, same_triangles.data(), nullptr) == CARREAU_OK && same_triangles == triangle, "and of its triangles");
    expect(carreau_mesh_part_triangles(mesh, m - 1, same_triangles.data(), nullptr) == CARREAU_ERR_ARGUMENT, "there is no room");
  }
  std::int64_t own_triangles = 0, own_vertices = 0;
  std::vector<std::int64_t> number, row, triangle;
  std::vector<std::int32_t> owner, triangle_owner, layer;
  std::vector<std::array<std::int32_t, 3>> corners;
};

/// Values by number of the whole mesh, which exactly one rank gives; -1 elsewhere before.
std::vector<std::int64_t> of_all(std::vector<std::int64_t> mine, const std::string& what) {
  std::vector<std::int64_t> given(mine.size()), all(mine.size()), times(mine.size());
  for (std::size_t k = 0; k < mine.size(); ++k) given[k] = mine[k] >= 0 ? 1 : 0;
  MPI_Allreduce(given.data(), times.data(), static_cast<int>(mine.size()), MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
  expect(std::all_of(times.begin(), times.end(), [](std::int64_t k) { return k == 1; }), what + ": each is one rank's");
  return all;
}

void check_vertices(const Whole& whole, const Kept& kept) {
  std::vector<std::int64_t> owner(whole.xyz.size(), -1), row(whole.xyz.size(), -1);
  for (std::size_t v = 0; v < static_cast<std::size_t>(kept.own_vertices); ++v) {
    owner[static_cast<std::size_t>(kept.number[v])] = rank, row[static_cast<std::size_t>(kept.number[v])] = kept.row[v];
    expect(kept.owner[v] == rank && (v == 0 || (kept.number[v - 1] < kept.number[v] && kept.row[v - 1] + 1 == kept.row[v])),
           "own vertices ascend, and their rows follow each other");
  }
  owner = of_all(owner, "vertices"), row = of_all(row, "rows");
  std::vector<std::int64_t> sorted = row;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < sorted.size(); ++k) expect(sorted[k] == static_cast<std::int64_t>(k), "rows are numbers from 0");
  for (std::size_t v = 0; v < kept.number.size(); ++v) {
    const auto number = static_cast<std::size_t>(kept.number[v]);
    expect(kept.xyz[v] == whole.xyz[number] && kept.vertex_refs[v] == whole.vertex_refs[number], "vertices are those of one process");
    expect(kept.owner[v] == owner[number] && kept.row[v] == row[number], "all ranks tell the same owner and row");
  }
}

// Own triangles are the triangles of one process, each of one rank, and ghosts are the others that touch them.
void check_triangles(const Whole& whole, const Kept& kept) {
  std::vector<std::int64_t> owner(whole.triangles.size(), -1);
  std::vector<bool> touched(whole.xyz.size(), false);
  std::set<std::int64_t> here;
  for (std::size_t t = 0; t < kept.triangles.size(); ++t) {
    const auto number = static_cast<std::size_t>(kept.triangle[t]);
    const bool own = t < static_cast<std::size_t>(kept.own_triangles);
    expect(kept.refs[t] == whole.refs[number] && kept.corners[t] == kept.triangles[t], "triangles have the reference of their face");
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t v = kept.number[static_cast<std::size_t>(kept.triangles[t][k])];
      expect(v == whole.triangles[number][k], "corners are those of one process");
      if (own) touched[static_cast<std::size_t>(v)] = true;
    }
    if (own) owner[number] = rank;
    expect(own == (kept.triangle_owner[t] == rank) && kept.layer[t] == (own ? 0 : 1), "own triangles come first");
    here.insert(kept.triangle[t]);
  }
  owner = of_all(owner, "triangles");
  expect(here.size() == kept.triangles.size(), "no triangle comes twice");
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const auto& corners = whole.triangles[t];
    const bool touches = std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) { return touched[static_cast<std::size_t>(v)]; });
    expect(here.contains(static_cast<std::int64_t>(t)) == touches, "ghosts are the triangles that touch own ones");
  }
  for (std::size_t t = 0; t < kept.triangle.size(); ++t)
    expect(kept.triangle_owner[t] == owner[static_cast<std::size_t>(kept.triangle[t])], "all ranks tell the same owner");
}

// Edges of curves: each is of one part.
void check_edges(carreau_mesh* alone, carreau_mesh* part, const Kept& kept) {
  std::int64_t all = 0, mine = 0, sum = 0;
  carreau_mesh_count(alone, nullptr, nullptr, &all, nullptr);
  carreau_mesh_count(part, nullptr, nullptr, &mine, nullptr);
  MPI_Allreduce(&mine, &sum, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  expect(sum == all, "each edge is of one part");
  using Row = std::array<std::int64_t, 3>;
  const auto rows = [](carreau_mesh* mesh, std::int64_t k, const std::vector<std::int64_t>* number) {
    std::vector<std::array<std::int32_t, 2>> edges(static_cast<std::size_t>(k));
    std::vector<std::int32_t> refs(edges.size());
    if (k > 0) carreau_mesh_edges(mesh, k, edges.front().data()), carreau_mesh_edge_refs(mesh, k, refs.data());
    std::set<Row> found;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      Row row{edges[e][0], edges[e][1], refs[e]};
      for (std::size_t i = 0; i < 2 && number != nullptr; ++i) row[i] = (*number)[static_cast<std::size_t>(edges[e][i])];
      found.insert(row);
    }
    return found;
  };
  const std::set<Row> of_one = rows(alone, all, nullptr), here = rows(part, mine, &kept.number);
  expect(std::includes(of_one.begin(), of_one.end(), here.begin(), here.end()), "edges are those of one process");
}

void check_quality(carreau_mesh* alone, carreau_mesh* part) {
  carreau_quality one{}, all{};
  one.struct_size = all.struct_size = sizeof one;
  carreau_mesh_quality(alone, &one);
  expect(carreau_mesh_part_quality(part, &all) == CARREAU_OK, "the quality of the whole mesh is known");
  const auto exact = [](const carreau_quality& q) {
    return std::vector<double>{double(q.vertices), double(q.triangles), double(q.edges), double(q.open_edges), q.q1_min, q.q1_p1, q.q1_max,
                               q.q2_min, q.q2_p1, q.q2_max, q.angle_min, q.angle_max, q.edge_min, q.edge_max, q.degree6};
  };
  expect(exact(one) == exact(all), "extremes, percentiles and counts are those of one process");
  const auto sums = [](const carreau_quality& q) { return std::vector<double>{q.q1_mean, q.q2_mean, q.area, q.edge_mean}; };
  constexpr double rounding = 1e-12;
  for (std::size_t k = 0; k < 4; ++k)
    expect(std::abs(sums(one)[k] - sums(all)[k]) <= rounding * sums(one)[k], "means and area are those of one process");
}

void check_faces(carreau_mesh* alone, carreau_mesh* part) {
  std::int64_t faces = 0, of_part = 0;
  carreau_mesh_count(alone, nullptr, nullptr, nullptr, &faces);
  carreau_mesh_count(part, nullptr, nullptr, nullptr, &of_part);
  expect(faces == of_part, "all faces are told");
  for (std::int64_t f = 0; f < faces; ++f) {
    carreau_face one{}, other{};
    one.struct_size = other.struct_size = sizeof one;
    carreau_mesh_face(alone, f, &one);
    const std::string why = one.why;
    carreau_mesh_face(part, f, &other);
    expect(one.ref == other.ref && one.status == other.status && one.triangles == other.triangles && why == other.why, "faces are those of one process");
  }
}

void same(const std::vector<std::string>& settings, Fault fault = Fault::none, int cells = 4) {
  const carreau_status expected = fault == Fault::none ? CARREAU_OK : CARREAU_ERR_PARTIAL;
  Run alone(settings, fault, cells), together(settings, fault, cells);
  expect(carreau_mesh_generate(alone.session) == expected, alone.sentence());
  const std::string sentence = alone.sentence();
  const PartHandle part = parts_of(together, expected);
  expect(together.sentence() == sentence, together.sentence());
  carreau_mesh *one = alone.mesh(), *mine = mesh_of(part);
  const Whole whole(one);
  const Kept kept(part);
  same_file(one, mine);
  check_vertices(whole, kept);
  check_triangles(whole, kept);
  check_edges(one, mine, kept);
  check_quality(one, mine);
  check_faces(one, mine);
}

void same_parts() {
  same({"hphydef=0.2"});
  same({"hphydef=0.2", "threads=2", "flag=1"});
  same({"hphydef=0.4", "hgeo_flag=1", "angle_mesh=8", "crossing_rounds=3"});
  same({"hphydef=0.2", "failing_faces=leave_out"}, Fault::status_inside);
  same({"hphydef=1"});
  for (const char* setting : {"element=p2", "gradation=1.3"})
    same({"hphydef=0.4", "hgeo_flag=1", setting});
}

// A previous mesh stays, and the session can mesh whole.
void refusals() {
  Run run({"hphydef=0.4"});
  expect(carreau_mesh_generate(run.session) == CARREAU_OK, run.sentence());
  const std::string before = file_of(run.mesh()).bytes;
  (void)parts_of(run);
  expect(file_of(run.mesh()).bytes == before, "the mesh of before stays");
  carreau_mesh* none = nullptr;
  expect(carreau_mesh_generate_part(run.session, run.mesh()) == CARREAU_ERR_ARGUMENT, "the mesh of a session is no part");
  expect(carreau_mesh_create(&none) == CARREAU_OK && carreau_mesh_generate_part(run.session, none) == CARREAU_ERR_ARGUMENT, "there is no team");
  carreau_part_counts counts{};
  counts.struct_size = sizeof counts;
  expect(carreau_mesh_part_count(none, &counts) == CARREAU_ERR_SEQUENCE, "it is no part");
  carreau_mesh_free(none);
}

void fails(Fault fault, carreau_status expected, const std::string& words) {
  const bool last = rank == size - 1;
  Run run({"hphydef=0.2"}, last ? fault : Fault::none);
  carreau_part* part = nullptr;
  const carreau_status status = carreau_mesh_generate_parts(run.session, world(), &part);
  memory_is_short = false;
  const bool short_of_memory = last && fault == Fault::no_memory && status == CARREAU_ERR_MEMORY;
  expect(short_of_memory || status == expected, "the status is " + std::to_string(status) + ": " + run.sentence());
  expect(run.sentence().find(words) != std::string::npos, "'" + words + "' is in '" + run.sentence() + "'");
  expect(part == nullptr, "there is no part");
  run.waves.fault = Fault::none;
  (void)parts_of(run);
}

void files(const std::string& folder) {
  Run run({"hphydef=0.2"}), alone({"hphydef=0.2"});
  const PartHandle part = parts_of(run);
  for (const char* name : {"/ranks.meshb", "/ranks.pvtu"})
    expect(carreau_part_write(run.session, part.get(), world(), (folder + name).c_str()) == CARREAU_OK, run.sentence());
  expect(carreau_part_write(run.session, part.get(), world(), (folder + "/none/x.meshb").c_str()) == CARREAU_ERR_FILE, run.sentence());
  expect(carreau_part_write(run.session, part.get(), world(), (folder + "/x.mesh").c_str()) == CARREAU_ERR_ARGUMENT, run.sentence());
  expect(carreau_mesh_generate(alone.session) == CARREAU_OK, alone.sentence());
  if (rank == 0) expect(carreau_mesh_write(alone.mesh(), (folder + "/one.meshb").c_str()) == CARREAU_OK, "one process writes");
}

}  // namespace

bool run_kept_parts(const std::string& name, const std::string& folder) {
  if (name == "same")
    same_parts();
  else if (name == "refusals")
    refusals();
  else if (name == "status")
    fails(Fault::status, CARREAU_ERR_CALLBACK, "42");
  else if (name == "stop")
    fails(Fault::stop, CARREAU_ERR_CANCELLED, "stopped");
  else if (name == "no_memory")
    fails(Fault::no_memory, CARREAU_ERR_LIMIT, "memory");
  else if (name == "other_inside")
    fails(Fault::other_inside, CARREAU_ERR_MODEL, "face 6 differs on rank " + std::to_string(size - 1));
  else if (name == "dies")
    fails(Fault::dies, CARREAU_OK, "nobody comes here");
  else if (name == "files")
    files(folder);
  else
    return false;
  return true;
}

}  // namespace mpi_tests
