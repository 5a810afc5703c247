#include "io/files.h"

#include <array>
#include <cerrno>
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

/// Writes all and closes. Zero, or the errno of what failed.
int write_and_close(File file, std::string_view content) {
  errno = 0;
  if (std::fwrite(content.data(), 1, content.size(), file.get()) != content.size()) return errno != 0 ? errno : EIO;
  // A full disk is often reported only here.
  if (std::fclose(file.release()) != 0) return errno != 0 ? errno : EIO;
  return 0;
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
    File file(std::fopen(path.c_str(), "wbx"));
    if (file) return {std::move(path), std::move(file)};
    if (errno != EEXIST) fail(target, "write", reason(errno));
  }
  fail(target, "write", "its folder holds too many temporary files of earlier runs");
}

}  // namespace

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
  // The announced size is a hint only: files of /proc say 0, others can grow meanwhile.
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

void write_file(const std::string& path, std::string_view content) {
  check_name(path, "write");
  const fs::path target = behind_links(path);
  std::error_code error;
  const fs::file_status old = fs::status(target, error);
  if (old.type() == fs::file_type::directory) fail(target, "write", "it is a folder");
  if (fs::exists(old) && old.type() != fs::file_type::regular) {
    errno = 0;
    File file(std::fopen(target.c_str(), "wb"));
    if (!file) fail(target, "write", reason(errno));
    if (const int code = write_and_close(std::move(file), content); code != 0) fail(target, "write", reason(code));
    return;
  }
  Temporary temporary = create_beside(target);
  const auto give_up = [&](const std::string& why) {
    std::error_code ignored;
    fs::remove(temporary.path, ignored);
    fail(target, "write", why);
  };
  if (const int code = write_and_close(std::move(temporary.file), content); code != 0) give_up(reason(code));
  if (fs::exists(old)) fs::permissions(temporary.path, old.permissions(), error);
  fs::rename(temporary.path, target, error);
  if (error) give_up(error.message());
}

}  // namespace carreau
