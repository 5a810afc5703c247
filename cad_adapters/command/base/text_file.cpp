// SPDX-License-Identifier: BSD-3-Clause
#include "base/text_file.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/failure.h"

namespace command {

std::string read_text(const std::string& path) {
  const auto refuse = [&](const std::string& why) { throw Failure("'" + path + "' cannot be read: " + why + "."); };
  constexpr std::size_t limit = 64 << 20;
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) refuse(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) refuse("it is not an ordinary file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) refuse(std::strerror(errno));
  std::string text;
  char block[65536];
  while (const std::size_t got = std::fread(block, 1, sizeof block, file.get())) {
    text.append(block, got);
    if (text.size() > limit) refuse("it is larger than 64 MB");
  }
  if (std::ferror(file.get()) != 0) refuse(std::strerror(errno));
  return text;
}

void write_text(const std::string& path, const std::string& text) {
  const auto refuse = [&] { throw Failure("'" + path + "' cannot be written: " + std::strerror(errno) + "."); };
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) refuse();
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written) refuse();
}

std::string suffix_of(const std::string& path) {
  const std::string name = path.substr(path.find_last_of('/') + 1);
  const std::size_t dot = name.find_last_of('.');
  if (dot == std::string::npos) return "";
  std::string suffix = name.substr(dot);
  for (char& c : suffix) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return suffix;
}

}  // namespace command
