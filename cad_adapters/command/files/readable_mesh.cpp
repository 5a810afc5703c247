// SPDX-License-Identifier: BSD-3-Clause
#include "files/readable_mesh.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/failure.h"
#include "base/text_file.h"
#include "files/med_file.h"

namespace command {

ReadableMesh::ReadableMesh(const std::string& path) : path_(path) {
  if (suffix_of(path) != ".med") return;
  const std::string text = med_as_gmsh(path);
  std::error_code error;
  folder_ = (std::filesystem::temp_directory_path(error) / "carreau-XXXXXX").string();
  if (error || mkdtemp(folder_.data()) == nullptr)
    throw Failure("'" + path + "' cannot be translated: " + (error ? error.message() : std::strerror(errno)) + ".");
  file_ = folder_ + "/translated.msh2";
  try {
    write_text(file_, text);
  } catch (...) {
    std::filesystem::remove_all(folder_, error);
    throw;
  }
}

ReadableMesh::~ReadableMesh() {
  std::error_code error;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, error);
}

std::string ReadableMesh::in_terms_of_file(std::string sentence) const {
  const std::size_t at = file_.empty() ? std::string::npos : sentence.find(file_);
  return at == std::string::npos ? sentence : sentence.replace(at, file_.size(), path_);
}

}  // namespace command
