// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/failed_faces.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/failure.h"
#include "base/lengths.h"
#include "base/output_files.h"
#include "files/session_handle.h"

namespace command {
namespace {

[[noreturn]] void refuse(const std::string& folder, const char* why) {
  throw Failure("--dump-failed: the folder '" + folder + "' cannot be used: " + why + ".");
}

/// The curves of a face in its parameter plane as a mesh of Medit of dimension 2, sampled; "": nothing is known.
std::string domain_text(const CadInput& input, std::int32_t face) {
  constexpr int samples = 64;  // of each curve: for the eye
  std::string vertices, edges;
  int n = 0, m = 0, ic = 0;
  std::vector<std::array<std::int32_t, 3>> curves;  // face, rank, reference
  for (const std::int32_t part : input.parts(face)) {
    ic = 0;
    for (const std::int32_t ref : input.curves(part)) curves.push_back({part, ++ic, input.whole_curve(ref)});
  }
  for (const auto& [part, rank, ref] : curves) {
    bool before = false;
    for (int i = 0; i <= samples; ++i) {
      double u = 0, v = 0;
      const bool known = input.on_curve(part, rank, static_cast<double>(i) / samples, u, v);
      if (known) {
        vertices += number_text(u, 17) + " " + number_text(v, 17) + " 0\n";
        ++n;
        if (before) edges += std::to_string(n - 1) + " " + std::to_string(n) + " " + std::to_string(ref) + "\n", ++m;
      }
      before = known;
    }
  }
  if (m == 0) return "";
  return "MeshVersionFormatted 2\nDimension 2\nVertices " + std::to_string(n) + "\n" + vertices + "Edges " +
         std::to_string(m) + "\n" + edges + "End\n";
}

std::string fields_name(const std::string& path, std::int32_t face, std::int32_t part) {
  return path + (part != face ? "_part_" + std::to_string(part) : "") + ".exr";
}

/// Restores the parameters of exports, whatever happens.
class ExportKept {
 public:
  explicit ExportKept(carreau_session* session) : session_(session) {
    const char* option = "";
    require(session, carreau_get_text(session, "option", &option));
    option_ = option;
    require(session, carreau_get_integer(session, "refs", &refs_));
  }
  ~ExportKept() {
    carreau_set_text(session_, "option", option_.c_str());
    carreau_set_integer(session_, "refs", refs_);
  }
  ExportKept(const ExportKept&) = delete;
  ExportKept& operator=(const ExportKept&) = delete;

 private:
  carreau_session* session_;
  std::string option_;
  std::int32_t refs_ = 0;
};

}  // namespace

FailedFaces::FailedFaces(std::string folder) : folder_(std::move(folder)) {
  if (folder_.empty()) return;
  while (folder_.size() > 1 && folder_.back() == '/') folder_.pop_back();
  struct stat status {};
  if (stat(folder_.c_str(), &status) != 0) {
    if (mkdir(folder_.c_str(), 0777) != 0) refuse(folder_, std::strerror(errno));
  } else if (!S_ISDIR(status.st_mode)) {
    refuse(folder_, "it is not a folder");
  }
  if (access(folder_.c_str(), W_OK | X_OK) != 0) refuse(folder_, std::strerror(errno));
}

std::string FailedFaces::stem(std::int32_t ref, const std::string& name) const {
  constexpr std::size_t longest = 60;  // of a name within the name of a file
  std::string text = folder_ + "/face_" + std::to_string(ref);
  if (!name.empty()) text += '_';
  for (const char c : name.substr(0, longest)) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-';
    text += plain ? c : '_';
  }
  return text;
}

void FailedFaces::write_fields(carreau_session* session, std::int32_t face, bool raw, const std::string& path) {
  carreau_exr_options fields{};
  fields.struct_size = sizeof fields;
  fields.longest = 512;
  fields.face = face;
  fields.raw = raw ? 1 : 0;
  OutputFiles({path}, {".exr"}).write([&](const std::vector<std::string>& hidden) {
    if (carreau_write_exr(session, hidden.front().c_str(), &fields) == CARREAU_OK) return;
    throw Failure(carreau_last_error(session));
  });
  files_.push_back(path);
}

void FailedFaces::dump_without_mesh(carreau_session* session, const CadInput& input, std::int32_t face,
                                    Progress& progress) {
  if (folder_.empty()) return;
  const std::string path = stem(face, input.face_name(face));
  if (const std::string text = domain_text(input, face); !text.empty()) {
    OutputFiles({path + ".mesh"}, {".mesh"}).write([&](const std::vector<std::string>& hidden) {
      std::ofstream file(hidden.front(), std::ios::binary);
      file << text;
      file.close();
      if (!file) throw Failure("'" + path + ".mesh' cannot be written: " + std::strerror(errno) + ".");
    });
    files_.push_back(path + ".mesh");
  }
  try {
    for (const std::int32_t part : input.parts(face)) write_fields(session, part, true, fields_name(path, face, part));
  } catch (const Failure& failure) {
    // An invalid model has no fields.
    progress.warning("face " + std::to_string(face) + " has no fields to dump: " + failure.what());
  }
}

// False: the mesher has left the face out.
bool FailedFaces::dump_meshed(carreau_session* session, carreau_mesh* mesh, const CadInput& input,
                              const FaceResult& face) {
  const ExportKept kept(session);
  const std::string path = stem(face.ref, face.name);
  require(session, carreau_set_text(session, "option", "onesurf2d"));
  require(session, carreau_set_integer(session, "refs", face.ref));
  bool known = true;
  const auto write = [&](const std::vector<std::string>& hidden) {
    const carreau_status status = carreau_mesh_write(mesh, hidden.front().c_str());
    known = status != CARREAU_ERR_ARGUMENT;
    require(mesh, status);
  };
  try {
    OutputFiles({path + ".mesh"}, {".mesh"}).write(write);
  } catch (const Failure&) {
    if (known) throw;
    return false;
  }
  files_.push_back(path + ".mesh");
  for (const std::int32_t part : input.parts(face.ref))
    write_fields(session, part, false, fields_name(path, face.ref, part));
  return true;
}

void FailedFaces::dump_of_mesh(carreau_session* session, carreau_mesh* mesh, const CadInput& input,
                               const std::vector<FaceResult>& faces, Progress& progress) {
  if (folder_.empty()) return;
  for (const FaceResult& face : faces)
    if (face.status == CARREAU_FACE_FAILED && !dump_meshed(session, mesh, input, face))
      dump_without_mesh(session, input, face.ref, progress);
}

}  // namespace command
