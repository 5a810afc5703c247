// SPDX-License-Identifier: BSD-3-Clause
#include "io/files.h"

#if !defined(_WIN32)
#include <sys/types.h>
#endif

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "support/error.h"

namespace carreau {

namespace {

namespace fs = std::filesystem;

struct Closer {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

std::string reason(int error) { return std::generic_category().message(error); }

std::string full_path(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  return error || whole.empty() ? path.string() : whole.lexically_normal().string();
}

[[noreturn]] void fail(const fs::path& path, const std::string& verb, const std::string& why) {
  throw FileError("cannot " + verb + " '" + full_path(path) + "': " + why);
}

void check_name(const std::string& path, const std::string& verb) {
  if (path.empty()) throw FileError("cannot " + verb + " a file without a name");
  if (path.find('\0') != std::string::npos) fail(path.substr(0, path.find('\0')), verb, "the name holds a zero byte");
}

/// The file that a chain of symbolic links leads to, so that the rename does not replace the link.
fs::path behind_links(fs::path path) {
  constexpr int longest_chain = 40;  // as the kernel's own limit
  for (int i = 0; i < longest_chain; ++i) {
    std::error_code error;
    if (!fs::is_symlink(path, error) || error) return path;
    const fs::path target = fs::read_symlink(path, error);
    if (error) return path;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

/// std::fseek has a long, of 32 bits on some machines.
int seek(std::FILE* file, std::uint64_t position) {
#if defined(_WIN32)
  return _fseeki64(file, static_cast<long long>(position), SEEK_SET);
#else
  return fseeko(file, static_cast<off_t>(position), SEEK_SET);
#endif
}

struct Temporary {
  fs::path path;
  File file;
};

/// A new file beside `target`. Names are tried in order: one left by a run that was killed is not touched.
Temporary create_beside(const fs::path& target) {
  constexpr int tries = 1000;
  for (int i = 0; i < tries; ++i) {
    fs::path path = target.string() + "." + std::to_string(i) + ".tmp";
    errno = 0;
    File file(std::fopen(path.string().c_str(), "wbx"));
    if (file) return {std::move(path), std::move(file)};
    if (errno != EEXIST) fail(target, "write", reason(errno));
  }
  fail(target, "write", "its folder holds too many temporary files of earlier runs");
}

}  // namespace

bool starts_as_gmf(std::string_view bytes) noexcept {
  const std::string_view start = bytes.substr(0, 4);
  return start == std::string_view("\1\0\0\0", 4) || start == std::string_view("\0\0\0\1", 4);
}

std::string suffix_of(const std::string& path) {
  const std::size_t name = path.find_last_of('/') + 1;  // npos + 1 is 0
  const std::size_t dot = path.find_last_of('.');
  std::string suffix = dot == std::string::npos || dot < name ? "" : path.substr(dot);
  for (char& c : suffix)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return suffix;
}

std::string read_file(const std::string& path, std::size_t limit) {
  check_name(path, "read");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::directory) fail(path, "read", "it is a folder");
  if (status.type() == fs::file_type::character || status.type() == fs::file_type::block)
    fail(path, "read", "it is a device");
  errno = 0;
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) fail(path, "read", reason(errno));
  const auto too_large = [&] { fail(path, "read", "it is larger than " + std::to_string(limit) + " bytes"); };
  std::string content;
  // The announced size is a hint only: files of /proc report 0, others can grow meanwhile.
  if (const auto size = fs::file_size(path, error); !error) {
    if (size > limit) too_large();
    content.reserve(size);
  }
  std::array<char, 65536> block;
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), file.get())) {
    if (got > limit - content.size()) too_large();
    content.append(block.data(), got);
  }
  if (std::ferror(file.get()) != 0) fail(path, "read", reason(errno));
  return content;
}

struct NewFile::State {
  fs::path target, temporary;  // temporary is empty when the target is written directly
  fs::file_status old;
  File file;
  std::uint64_t position = 0;  // of the next byte in `file`

  [[noreturn]] void fail_writing(int code) const { fail(target, "write", reason(code != 0 ? code : EIO)); }
};

NewFile::NewFile(const std::string& path) : state_(std::make_unique<State>()) {
  State& s = *state_;
  check_name(path, "write");
  s.target = behind_links(path);
  std::error_code error;
  s.old = fs::status(s.target, error);
  if (s.old.type() == fs::file_type::directory) fail(s.target, "write", "it is a folder");
  if (fs::exists(s.old) && s.old.type() != fs::file_type::regular) {
    errno = 0;
    s.file.reset(std::fopen(s.target.string().c_str(), "wb"));
    if (!s.file) fail(s.target, "write", reason(errno));
    return;
  }
  Temporary temporary = create_beside(s.target);
  s.temporary = std::move(temporary.path);
  s.file = std::move(temporary.file);
}

NewFile::~NewFile() {
  state_->file.reset();
  std::error_code ignored;
  if (!state_->temporary.empty()) fs::remove(state_->temporary, ignored);
}

void NewFile::write_at(std::uint64_t position, std::string_view bytes) {
  State& s = *state_;
  errno = 0;
  if (position != s.position && seek(s.file.get(), position) != 0)
    s.fail_writing(errno);
  if (std::fwrite(bytes.data(), 1, bytes.size(), s.file.get()) != bytes.size()) s.fail_writing(errno);
  s.position = position + bytes.size();
}

void NewFile::commit() {
  State& s = *state_;
  errno = 0;
  // A full disk is often reported only here.
  if (std::fclose(s.file.release()) != 0) s.fail_writing(errno);
  if (s.temporary.empty()) return;
  std::error_code error;
  if (fs::exists(s.old)) fs::permissions(s.temporary, s.old.permissions(), error);
  fs::rename(s.temporary, s.target, error);
  if (error) fail(s.target, "write", error.message());
  s.temporary.clear();
}

void write_file(const std::string& path, std::string_view content) {
  NewFile file(path);
  file.write_at(0, content);
  file.commit();
}

}  // namespace carreau
