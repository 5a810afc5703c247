// SPDX-License-Identifier: BSD-3-Clause
// One rank of the tests of libcarreau_mpi: `ranks_program <case> [<folder>]`. Ends with 0 when the claims of the case hold
// on this rank; reports others on the error output.
#include <mpi.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "carreau_mpi.h"
#include "field.h"
#include "kept_parts.h"
#include "large_files.h"
#include "rank_run.h"
#include "waves.h"

namespace {

using namespace mpi_tests;

std::string encoded(carreau_mesh* mesh) {
  std::string bytes;
  const carreau_bytes_fn append = [](std::int64_t, std::int64_t n, const void* part, void* user) -> std::int32_t {
    static_cast<std::string*>(user)->append(static_cast<const char*>(part), static_cast<std::size_t>(n));
    return 0;
  };
  expect(carreau_mesh_encode(mesh, ".meshb", append, &bytes) == CARREAU_OK, "the mesh is encoded");
  std::int64_t n = 0, m = 0;
  carreau_mesh_count(mesh, &n, &m, nullptr, nullptr);
  std::vector<double> values(static_cast<std::size_t>(n) + 6 * static_cast<std::size_t>(m));
  expect(carreau_mesh_vertex_sizes(mesh, n, values.data()) == CARREAU_OK, "sizes are known");
  expect(carreau_mesh_corner_uv(mesh, m, values.data() + n) == CARREAU_OK, "(u, v) are known");
  return bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
}

/// The number of calls of hosts: of the host of one process, and of the hosts of all ranks.
struct Asked {
  std::int64_t alone = 0, together = 0;
};

// The mesh of all ranks is identical to the mesh of one process, with its sizes and parameters, its status and
// sentence.
Asked same(const std::vector<std::string>& settings, Fault fault = Fault::none, int cells = 4) {
  const std::string what = settings.empty() ? "default" : settings.front();
  Run alone(settings, fault, cells), together(settings, fault, cells);
  const carreau_status status = carreau_mesh_generate(alone.session);
  const std::string sentence = alone.sentence();
  expect(carreau_mesh_generate_mpi(together.session, world()) == status, what + ": the same status; " + together.sentence());
  expect(together.sentence() == sentence, what + ": the same sentence; " + together.sentence());
  expect(status == (fault == Fault::none ? CARREAU_OK : CARREAU_ERR_PARTIAL), what + ": " + sentence);
  expect(encoded(alone.mesh()) == encoded(together.mesh()), what + ": the same mesh");
  Asked asked{alone.waves.asked, 0};
  const std::int64_t own = together.waves.asked;
  MPI_Allreduce(&own, &asked.together, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  return asked;
}

void same_meshes() {
  same({});
  same({"threads=2"});
  same({"hgeo_flag=1", "angle_mesh=4"});
  same({"hgeo_flag=1", "gradation=1.2"});
  same({"hgeo_flag=1", "geo_metric=1", "gradation=1.3", "threads=2"});
  same({"patches=independent"});
  same({"element=q1.0"});
  same({"element=p2"});
  same({"shape_trials=1"});
  same({"failing_faces=leave_out"}, Fault::status_inside);
}

// One face of 285 000 triangles, whose pieces are distributed.
std::vector<std::string> one_large_face{"hphydef=0.003"};
// The same inside a boundary that promises a third of that.
void bulge_inside() {
  bulge = 2;
  one_large_face = {"hphydef=0.005"};
}
void same_large_faces() {
  // Each rank evaluates its share of the vertices inside and of 64 one more, and the places of curves and small batches.
  const auto once = [](const Asked& asked) {
    expect(asked.together <= asked.alone + size * asked.alone / 8,
           "points are shared: " + std::to_string(asked.together) + " for " + std::to_string(asked.alone));
  };
  once(same(one_large_face, Fault::none, 1));
  std::vector<std::string> settings = one_large_face;
  settings.insert(settings.end(), {"threads=2", "shape_trials=1"});
  once(same(settings, Fault::none, 1));
}

/// A fault of the last rank is an error of all: these statuses, and these words somewhere in the sentence.
void fails(Fault fault, carreau_status expected, const std::string& words, const std::vector<std::string>& settings = {},
           int cells = 4) {
  const bool last = rank == size - 1;
  Run run(settings, last ? fault : Fault::none, cells);
  const carreau_status status = carreau_mesh_generate_mpi(run.session, world());
  mpi_tests::memory_is_short = false;
  const bool short_of_memory = last && fault == Fault::no_memory && status == CARREAU_ERR_MEMORY;
  expect(short_of_memory || status == expected, "the status is " + std::to_string(status) + ": " + run.sentence());
  expect(run.sentence().find(words) != std::string::npos, "'" + words + "' is in '" + run.sentence() + "'");
  carreau_mesh* mesh = nullptr;
  expect(carreau_session_mesh(run.session, &mesh) == CARREAU_ERR_SEQUENCE, "there is no mesh");
  // Ranks that went wrong once can mesh again.
  run.waves.fault = Fault::none;
  expect(carreau_mesh_generate_mpi(run.session, world()) == CARREAU_OK, "the next run is sound: " + run.sentence());
}

const std::vector<std::string> adapted{"hphydef=0.3", "gradation=2"};

carreau_status adapt(Run& run, Field& field, std::int32_t shape, carreau_adaptation_report* report) {
  field.session = run.session;
  carreau_estimator estimator{};
  estimator.struct_size = sizeof estimator;
  estimator.shape = shape, estimator.tolerance = 0.001, estimator.hmin = 0.01, estimator.hmax = 1;
  carreau_adaptation adaptation{};
  adaptation.struct_size = sizeof adaptation;
  adaptation.estimator = &estimator, adaptation.field = mpi_tests::field_at, adaptation.user = &field, adaptation.iterations = 2;
  return carreau_adapt(run.session, &adaptation, report);
}

std::vector<double> numbers_of(const carreau_adaptation_report& r) {
  return {r.error_max, r.error_rms, r.error_max_before, r.error_rms_before, r.size_min, r.stretch_max,
          static_cast<double>(r.vertices), static_cast<double>(r.triangles), static_cast<double>(r.outside)};
}

// Sizes and metrics at the vertices of the mesh, and the field carried from the mesh before.
std::vector<double> estimated_and_carried(Run& run) {
  std::int64_t n = 0, m = 0, before = 0;
  carreau_mesh_count(run.mesh(), &n, &m, nullptr, nullptr);
  std::vector<double> xyz(3 * static_cast<std::size_t>(n)), values(static_cast<std::size_t>(n));
  carreau_mesh_vertices(run.mesh(), n, xyz.data());
  Field field;
  mpi_tests::field_at(n, xyz.data(), values.data(), &field);
  carreau_estimator estimator{};
  estimator.struct_size = sizeof estimator;
  estimator.shape = CARREAU_ANISOTROPIC, estimator.hmin = 0.01, estimator.hmax = 1;
  std::vector<double> found(7 * static_cast<std::size_t>(n));
  expect(carreau_estimate(run.session, &estimator, n, values.data(), found.data(), found.data() + n) == CARREAU_OK, run.sentence());
  before = n;
  expect(carreau_set_vertex_sizes(run.session, n, found.data()) == CARREAU_OK && carreau_mesh_generate(run.session) == CARREAU_OK,
         run.sentence());
  carreau_mesh_count(run.mesh(), &n, &m, nullptr, nullptr);
  std::vector<double> carried(static_cast<std::size_t>(n));
  std::int64_t outside = 0;
  expect(carreau_transfer(run.session, 1, before, values.data(), n, carried.data(), &outside) == CARREAU_OK, run.sentence());
  found.insert(found.end(), carried.begin(), carried.end());
  found.push_back(static_cast<double>(outside));
  return found;
}

// The meshes and reports of an adaptation equal the results of one process.
void same_adaptation() {
  for (const std::int32_t shape : {CARREAU_ISOTROPIC, CARREAU_ANISOTROPIC}) {
    Run alone(adapted), together(adapted);
    Field of_one, of_all;
    carreau_adaptation_report one{}, all{};
    one.struct_size = all.struct_size = sizeof one;
    expect(adapt(alone, of_one, shape, &one) == CARREAU_OK, alone.sentence());
    expect(carreau_mpi_attach(together.session, world()) == CARREAU_OK, together.sentence());
    expect(adapt(together, of_all, shape, &all) == CARREAU_OK, together.sentence());
    expect(one.triangles > 1000 && one.triangles_before != one.triangles, "the mesh is adapted: " + std::to_string(one.triangles));
    expect(numbers_of(one) == numbers_of(all), "the same report");
    expect(encoded(alone.mesh()) == encoded(together.mesh()), "the same adapted mesh");
    // Each rank's own share of the points, and of 64 one more for each list of points.
    std::int64_t points = 0, calls = 0;
    MPI_Allreduce(&of_all.points, &points, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(&of_all.calls, &calls, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    constexpr int lists = 6;  // values and errors on three meshes
    expect(points >= of_one.points && points <= of_one.points + size * (of_one.points / 64 + lists), "points are shared");
    expect(estimated_and_carried(alone) == estimated_and_carried(together), "the same estimates and fields");
  }
}

// A fault of the last rank's field is an error of all; the previous mesh stays, and the next run is sound.
void adaptation_fails(Fault fault, carreau_status expected, const std::string& words) {
  Run run(adapted);
  expect(carreau_mpi_attach(run.session, world()) == CARREAU_OK, run.sentence());
  expect(carreau_mesh_generate(run.session) == CARREAU_OK, run.sentence());
  const std::string before = encoded(run.mesh());
  const bool last = rank == size - 1;
  Field field;
  field.from = 1;
  if (last) field.fault = fault;
  const carreau_status status = adapt(run, field, CARREAU_ISOTROPIC, nullptr);
  mpi_tests::memory_is_short = false;
  const bool short_of_memory = last && fault == Fault::no_memory && status == CARREAU_ERR_MEMORY;
  expect(short_of_memory || status == expected, "the status is " + std::to_string(status) + ": " + run.sentence());
  expect(run.sentence().find(words) != std::string::npos, "'" + words + "' is in '" + run.sentence() + "'");
  expect(encoded(run.mesh()) == before, "the mesh of before stays");
  field.fault = Fault::none;
  expect(adapt(run, field, CARREAU_ISOTROPIC, nullptr) == CARREAU_OK, "the next adaptation is sound: " + run.sentence());
}

// Values that differ are reported by name.
void other_values() {
  Run run(adapted);
  expect(carreau_mpi_attach(run.session, world()) == CARREAU_OK, run.sentence());
  expect(carreau_mesh_generate(run.session) == CARREAU_OK, run.sentence());
  std::int64_t n = 0, m = 0;
  carreau_mesh_count(run.mesh(), &n, &m, nullptr, nullptr);
  std::vector<double> values(static_cast<std::size_t>(n), rank == size - 1 ? 1 : 0), sizes(values.size());
  carreau_estimator estimator{};
  estimator.struct_size = sizeof estimator;
  estimator.hmin = 0.01, estimator.hmax = 1;
  expect(carreau_estimate(run.session, &estimator, n, values.data(), sizes.data(), nullptr) == CARREAU_ERR_MODEL, run.sentence());
  expect(run.sentence().find("differ on rank " + std::to_string(size - 1)) != std::string::npos, run.sentence());
}

/// Values of all ranks, one behind the other.
template <typename T>
std::vector<T> gathered(const std::vector<T>& mine, MPI_Datatype type) {
  int n = static_cast<int>(mine.size());
  std::vector<int> counts(static_cast<std::size_t>(size)), starts(static_cast<std::size_t>(size), 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<T> all(static_cast<std::size_t>(starts.back() + counts.back()));
  MPI_Allgatherv(mine.data(), n, type, all.data(), counts.data(), starts.data(), type, MPI_COMM_WORLD);
  return all;
}

struct Part {
  Part(carreau_mesh* mesh, int layers) {
    carreau_part* part = nullptr;
    expect(carreau_part_create(mesh, rank, size, layers, &part) == CARREAU_OK, "there is a part");
    std::int64_t triangle_count = 0, vertex_count = 0;
    expect(carreau_part_count(part, &own_triangles, &triangle_count, &own_vertices, &vertex_count) == CARREAU_OK, "counts");
    const auto m = static_cast<std::size_t>(triangle_count), n = static_cast<std::size_t>(vertex_count);
    triangles.resize(m), triangle_owners.resize(m), layer.resize(m), corners.resize(3 * m);
    vertices.resize(n), vertex_owners.resize(n), rows.resize(n);
    expect(carreau_part_triangles(part, triangle_count, triangles.data(), triangle_owners.data(), layer.data(),
                                  corners.data()) == CARREAU_OK, "triangles");
    expect(carreau_part_vertices(part, vertex_count, vertices.data(), vertex_owners.data(), rows.data()) == CARREAU_OK,
           "vertices");
    expect(m == 0 || carreau_part_triangles(part, triangle_count - 1, triangles.data(), nullptr, nullptr, nullptr) ==
                         CARREAU_ERR_ARGUMENT, "an array that is too small is refused");
    carreau_part_free(part);
  }
  std::int64_t own_triangles = 0, own_vertices = 0;
  std::vector<std::int64_t> triangles, vertices, rows;
  std::vector<std::int32_t> triangle_owners, layer, corners, vertex_owners;
};

// Every triangle and vertex has one owner, on which all ranks agree; rows form a distributed vector.
void check_owners(const Part& part, std::int64_t n, std::int64_t m) {
  const std::vector<std::int64_t> own(part.triangles.begin(), part.triangles.begin() + part.own_triangles);
  std::map<std::int64_t, int> times;
  for (const std::int64_t t : gathered(own, MPI_INT64_T)) ++times[t];
  expect(static_cast<std::int64_t>(times.size()) == m, "each triangle has an owner");
  for (const auto& [t, count] : times) expect(count == 1 && t >= 0 && t < m, "a triangle has one owner");
  const std::vector<std::int64_t> counts = gathered(std::vector<std::int64_t>{part.own_triangles}, MPI_INT64_T);
  for (const std::int64_t count : counts) expect(count >= m / size && count <= m / size + 1, "parts are of equal size");
  const std::vector<std::int64_t> vertices = gathered(part.vertices, MPI_INT64_T), rows = gathered(part.rows, MPI_INT64_T);
  const std::vector<std::int32_t> owners = gathered(part.vertex_owners, MPI_INT32_T);
  std::map<std::int64_t, std::pair<std::int64_t, std::int32_t>> known;
  std::map<std::int64_t, std::int32_t> owner_of_row;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto entry = known.emplace(vertices[i], std::pair{rows[i], owners[i]}).first->second;
    expect(entry == std::pair{rows[i], owners[i]}, "all ranks say the same of a vertex");
    owner_of_row[rows[i]] = owners[i];
  }
  expect(static_cast<std::int64_t>(owner_of_row.size()) == n, "each vertex has a row");
  std::int32_t last = 0;
  for (const auto& [row, owner] : owner_of_row) {
    expect(owner >= last, "rows of a rank are consecutive");
    last = owner;
  }
}

// Checks by brute force on the whole mesh.
void check_ghosts(const Part& part, const std::vector<std::int32_t>& triangles, int layers) {
  const std::size_t m = triangles.size() / 3;
  std::map<std::int64_t, std::int32_t> layer;
  for (std::size_t i = 0; i < part.triangles.size(); ++i) layer[part.triangles[i]] = part.layer[i];
  for (std::size_t t = 0; t < m; ++t) {
    const auto found = layer.find(static_cast<std::int64_t>(t));
    const std::int32_t own = found != layer.end() ? found->second : layers + 1;
    std::int32_t nearest = layers + 1;
    for (std::size_t other = 0; other < m && own > 0; ++other) {
      const auto it = layer.find(static_cast<std::int64_t>(other));
      if (it == layer.end()) continue;
      for (std::size_t i = 0; i < 9; ++i)
        if (triangles[3 * t + i / 3] == triangles[3 * other + i % 3]) nearest = std::min(nearest, it->second);
    }
    if (own > 0) expect(own == std::min(nearest + 1, layers + 1) || (own == layers + 1 && nearest >= layers), "a ghost is in its layer");
  }
  for (std::size_t i = 0; i < part.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      expect(part.vertices[static_cast<std::size_t>(part.corners[3 * i + k])] ==
                 triangles[3 * static_cast<std::size_t>(part.triangles[i]) + k], "corners are those of the mesh");
}

void parts() {
  Run run({"hphydef=0.35"});
  expect(carreau_mesh_generate_mpi(run.session, world()) == CARREAU_OK, run.sentence());
  std::int64_t n = 0, m = 0;
  carreau_mesh_count(run.mesh(), &n, &m, nullptr, nullptr);
  std::vector<std::int32_t> triangles(3 * static_cast<std::size_t>(m));
  carreau_mesh_triangles(run.mesh(), m, triangles.data());
  for (const int layers : {0, 1, 2}) {
    const Part part(run.mesh(), layers);
    check_owners(part, n, m);
    check_ghosts(part, triangles, layers);
  }
  carreau_part* none = nullptr;
  expect(carreau_part_create(run.mesh(), size, size, 0, &none) == CARREAU_ERR_ARGUMENT, "a rank that is none is refused");
}

void files(const std::string& folder) {
  Run run;
  expect(carreau_mesh_generate_mpi(run.session, world()) == CARREAU_OK, run.sentence());
  for (const char* name : {"/ranks.meshb", "/ranks.mesh", "/ranks.pvtu"})
    expect(carreau_mpi_write(run.session, world(), (folder + name).c_str()) == CARREAU_OK, run.sentence());
  if (rank == 0)
    for (const char* name : {"/one.meshb", "/one.mesh"})
      expect(carreau_mesh_write(run.mesh(), (folder + name).c_str()) == CARREAU_OK, "one process writes");
  for (const char* name : {"/none/x.meshb", "/none/x.pvtu"}) {
    expect(carreau_mpi_write(run.session, world(), (folder + name).c_str()) == CARREAU_ERR_FILE, "there is no such folder");
    expect(run.sentence().find("/none/x") != std::string::npos, run.sentence());
  }
  expect(carreau_mpi_write(run.session, world(), (folder + "/x.what").c_str()) == CARREAU_ERR_ARGUMENT, "no such suffix");
  Run empty;
  expect(carreau_mpi_write(empty.session, world(), (folder + "/x.meshb").c_str()) == CARREAU_ERR_SEQUENCE, "no mesh");
}

// Files may not be larger than so: to the library it is a full disk.
void full_disk(const std::string& folder) {
  Run run;
  expect(carreau_mesh_generate_mpi(run.session, world()) == CARREAU_OK, run.sentence());
  constexpr rlim_t most = 4096;
  const rlimit limit{most, most};
  std::signal(SIGXFSZ, SIG_IGN);
  expect(setrlimit(RLIMIT_FSIZE, &limit) == 0, "files are limited");
  for (const char* name : {"/x.meshb", "/x.pvtu"}) {
    expect(carreau_mpi_write(run.session, world(), (folder + name).c_str()) == CARREAU_ERR_FILE, "the file is too large");
    expect(run.sentence().find("/x") != std::string::npos, run.sentence());
  }
}

void run_case(const std::string& name, const std::string& folder) {
  if (name.starts_with("bulging_")) {
    bulge_inside();
    run_case(name.substr(8), folder);
  } else if (name == "same")
    same_meshes();
  else if (name == "parts")
    parts();
  else if (name.starts_with("kept_"))
    expect(run_kept_parts(name.substr(5), folder), "there is a case '" + name + "'");
  else if (name == "files")
    files(folder);
  else if (name == "large_files") {
    expect(mpi_tests::all_slices_cover(), "slices cover files");
    expect(mpi_tests::writes_beyond_32_bits(folder + "/large.bin", rank, size), "bytes behind 2^32 are where they belong");
    expect(mpi_tests::sends_in_pieces(rank, size), "what is sent in pieces arrives whole");
  } else if (name == "full_disk")
    full_disk(folder);
  else if (name == "other_curves")
    fails(Fault::other_curves, CARREAU_ERR_MODEL, "on rank " + std::to_string(size - 1));
  else if (name == "other_inside")
    fails(Fault::other_inside, CARREAU_ERR_MODEL, "face 6 differs on rank " + std::to_string(size - 1));
  else if (name == "status")
    fails(Fault::status, CARREAU_ERR_CALLBACK, "42");
  else if (name == "stop")
    fails(Fault::stop, CARREAU_ERR_CANCELLED, "stopped");
  else if (name == "no_memory")
    fails(Fault::no_memory, CARREAU_ERR_LIMIT, "memory");
  else if (name == "large_same")
    same_large_faces();
  else if (name == "large_other_inside")
    fails(Fault::other_inside, CARREAU_ERR_MODEL, "face 1 differs on rank " + std::to_string(size - 1), one_large_face, 1);
  else if (name == "large_status_inside")
    fails(Fault::status_inside, CARREAU_ERR_CALLBACK, "43", one_large_face, 1);
  else if (name == "large_stop")
    fails(Fault::stop, CARREAU_ERR_CANCELLED, "stopped", one_large_face, 1);
  else if (name == "large_no_memory")
    fails(Fault::no_memory, CARREAU_ERR_LIMIT, "memory", one_large_face, 1);
  else if (name == "large_dies")
    fails(Fault::dies, CARREAU_OK, "nobody comes here", one_large_face, 1);
  else if (name == "adapt_same")
    same_adaptation();
  else if (name == "adapt_status")
    adaptation_fails(Fault::status, CARREAU_ERR_CALLBACK, "44");
  else if (name == "adapt_stop")
    adaptation_fails(Fault::stop, CARREAU_ERR_CANCELLED, "stopped");
  else if (name == "adapt_no_memory")
    adaptation_fails(Fault::no_memory, CARREAU_ERR_LIMIT, "memory");
  else if (name == "adapt_other_field")
    adaptation_fails(Fault::other_inside, CARREAU_ERR_MODEL, "differs on rank " + std::to_string(size - 1));
  else if (name == "adapt_other_values")
    other_values();
  else if (name == "adapt_dies")
    adaptation_fails(Fault::dies, CARREAU_OK, "nobody comes here");
  else if (name == "dies")
    fails(Fault::dies, CARREAU_OK, "nobody comes here");
  else
    expect(false, "there is a case '" + name + "'");
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  run_case(argc > 1 ? argv[1] : "", argc > 2 ? argv[2] : "");
  MPI_Finalize();
  return failures == 0 ? 0 : 1;
}
