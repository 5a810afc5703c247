// SPDX-License-Identifier: BSD-3-Clause
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <random>
#include <sstream>

#include "faults.h"
#include "changes/shape_changes.h"
#include "natural_bounds.h"
#include "shape_file.h"
#include "translator.h"
#include "changes/units.h"

namespace carreau_occ {

namespace {

enum class Format { unknown, step, iges, brep };

Format format_by_suffix(const std::string& path) {
  const std::size_t dot = path.find_last_of('.');
  if (dot == std::string::npos) return Format::unknown;
  std::string suffix = path.substr(dot + 1);
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix == "step" || suffix == "stp") return Format::step;
  if (suffix == "iges" || suffix == "igs") return Format::iges;
  if (suffix == "brep" || suffix == "brp") return Format::brep;
  return Format::unknown;
}

constexpr std::size_t head_size = 4096;

std::string head_of(std::ifstream& file) {
  std::string head(head_size, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

bool is_binary_brep(std::string_view head) { return head.find("Open CASCADE Topology") != std::string_view::npos; }

Format format_by_content(std::string_view head) {
  const auto has = [head](std::string_view text) { return head.find(text) != std::string_view::npos; };
  if (has("ISO-10303-21")) return Format::step;
  if (has("DBRep_DrawableShape") || has("CASCADE Topology")) return Format::brep;
  // Column 73 of the first line is S (start section).
  if (head.size() > 73 && head[72] == 'S') return Format::iges;
  return Format::unknown;
}

/// OpenCASCADE writes its findings to std::cout, through its messengers and, for BREP files, directly. This removes
/// them.
class Silence {
 public:
  Silence() : printers_(Message::DefaultMessenger()->Printers()), buffer_(std::cout.rdbuf(nullptr)) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~Silence() {
    Message::DefaultMessenger()->ChangePrinters() = printers_;
    std::cout.rdbuf(buffer_);  // clears errors of writing without a buffer
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  Message_SequenceOfPrinters printers_;
  std::streambuf* buffer_;
};

/// Hands on the progress of a translation.
class Indicator final : public Message_ProgressIndicator {
 public:
  explicit Indicator(const ReadingProgress& progress) : progress_(progress) {}
  Standard_Boolean UserBreak() override { return stopped_; }
  void Show(const Message_ProgressScope&, Standard_Boolean) override {
    if (progress_ && !stopped_ && !progress_(GetPosition())) stopped_ = true;
  }
  [[nodiscard]] bool stopped() const noexcept { return stopped_; }

 private:
  const ReadingProgress& progress_;
  std::atomic<bool> stopped_{false};
};

// OpenCASCADE's reader of BREP files looks for words without end behind the end of the file. It also goes on with the
// previous value when a number is unreadable.
void read_brep(std::istream& stream, const std::string& name, const Message_ProgressRange& progress, ShapeFile& file) {
  const bool binary = is_binary_brep([&stream] {
    std::string head(head_size, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    stream.clear();
    stream.seekg(0);
    return head;
  }());
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  const BRep_Builder builder;
  try {
    if (binary)
      BinTools::Read(file.shape, stream, progress);
    else
      BRepTools::Read(file.shape, stream, builder, progress);
  } catch (const std::ios_base::failure&) {
    refuse(name, "is not a readable BREP file: it is cut off, or a number in it is unreadable");
  }
  // Here only: other formats give the bounds of each face, and a face with unreadable bounds is not the whole surface.
  if (!file.shape.IsNull()) add_natural_bounds(file.shape);
}

void read_as(Format format, const std::string& path, const Message_ProgressRange& progress, ShapeFile& file) {
  if (format == Format::step) return step_translator()(path, progress, file);
  if (format == Format::iges) return iges_translator()(path, progress, file);
  std::ifstream stream(path, std::ios::binary);
  read_brep(stream, path, progress, file);
}

using Read = std::function<void(const Message_ProgressRange&, ShapeFile&)>;

ShapeFile read_by(const Read& read, const std::string& name, const ReadingProgress& progress, const Lengths& lengths) {
  const Silence silence;
  ShapeFile file;
  const Handle(Indicator) indicator = new Indicator(progress);
  try {
    guarded([&] { read(indicator->Start(), file); });
    if (!file.shape.IsNull()) guarded([&] { change_lengths(file, lengths.unit, lengths.scale); });
  } catch (const Standard_Failure& failure) {
    refuse(name, std::string("OpenCASCADE cannot read it: ") + failure.GetMessageString());
  } catch (const UnknownUnit& error) {
    refuse(name, error.what());
  }
  if (indicator->stopped()) refuse(name, "was not read to its end: the host stopped the call");
  return file;
}

bool is_empty(const ShapeFile& file) { return file.shape.IsNull() || !TopExp_Explorer(file.shape, TopAbs_EDGE).More(); }

[[noreturn]] void refuse_empty(const std::string& name, const ShapeFile& file) {
  refuse(name, std::string("holds no face and no edge") +
                   (file.losses.empty() ? "" : " that can be read (" + file.losses.front() + ")"));
}

const char* a_format(Format format) {
  return format == Format::step ? "a STEP" : format == Format::iges ? "an IGES" : "a BREP";
}

/// Bytes in a file of their own, since OpenCASCADE's readers of STEP and IGES open theirs by its path.
class BytesFile {
 public:
  explicit BytesFile(std::string_view bytes) {
    std::random_device random;
    for (int trial = 0; trial < 100 && path_.empty(); ++trial) {
      const std::filesystem::path path =
          std::filesystem::temp_directory_path() / ("carreau-" + std::to_string(random()) + std::to_string(random()));
      // "x": a file that another process made in the meantime is not opened.
      const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.string().c_str(), "wbx"), &std::fclose);
      if (!file) continue;
      path_ = path.string();
      if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size() || std::fflush(file.get()) != 0)
        throw std::runtime_error("the folder of temporary files, " + path.parent_path().string() + ", has no room");
    }
    if (path_.empty()) throw std::runtime_error("no file can be made in the folder of temporary files");
  }
  ~BytesFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  BytesFile(const BytesFile&) = delete;
  BytesFile& operator=(const BytesFile&) = delete;
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  std::string path_;
};

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
  return text;
}

Format format_by_name(const std::string& name) {
  return name == "step" ? Format::step : name == "iges" ? Format::iges : name == "brep" ? Format::brep : Format::unknown;
}

ShapeFile read_bytes(Format format, std::string_view bytes, const std::string& name, const ReadingProgress& progress,
                     const Lengths& lengths) {
  if (format == Format::brep) {
    std::istringstream stream{std::string(bytes)};
    return read_by([&](const Message_ProgressRange& range, ShapeFile& file) { read_brep(stream, name, range, file); }, name,
                   progress, lengths);
  }
  const BytesFile copy(bytes);
  try {
    ShapeFile file = read_by([&](const Message_ProgressRange& range,
                                 ShapeFile& into) { read_as(format, copy.path(), range, into); },
                             name, progress, lengths);
    for (std::vector<std::string>* sentences : {&file.losses, &file.notes})
      for (std::string& sentence : *sentences) sentence = replaced(sentence, copy.path(), name);
    return file;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(replaced(error.what(), copy.path(), name));
  }
}

}  // namespace

ShapeFile read_shape(const std::string& path, const ReadingProgress& progress, const Lengths& lengths) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, "cannot be opened");
  if (std::filesystem::is_directory(path)) refuse(path, "is a folder");
  const Format content = format_by_content(head_of(stream));
  stream.close();
  Format format = format_by_suffix(path);
  if (format == Format::unknown) format = content;
  if (format == Format::unknown) refuse(path, "is not a STEP, IGES or BREP file");
  if (content != format)
    refuse(path, std::string("does not fit its suffix: it does not begin like ") + a_format(format) + " file");
  ShapeFile file = read_by([&](const Message_ProgressRange& range, ShapeFile& into) { read_as(format, path, range, into); },
                           path, progress, lengths);
  if (!is_empty(file)) return file;
  if (format == Format::step) refuse_tessellated(path);
  refuse_empty(path, file);
}

ShapeFile read_shape(std::string_view bytes, const std::string& format, const std::string& name,
                     const ReadingProgress& progress, const Lengths& lengths) {
  const Format content = format_by_content(bytes.substr(0, head_size));
  const Format given = format_by_name(format);
  if (given == Format::unknown && !format.empty())
    refuse(name, "the format is '" + format + "', which is not step, iges or brep");
  if (content == Format::unknown) refuse(name, "the bytes are not a STEP, IGES or BREP file");
  if (given != Format::unknown && given != content)
    refuse(name, std::string("the bytes do not begin like ") + a_format(given) + " file");
  ShapeFile file = read_bytes(content, bytes, name, progress, lengths);
  if (is_empty(file)) refuse_empty(name, file);
  return file;
}

std::vector<SmallFeature> remove_features(ShapeFile& file, double size, const ReadingProgress& progress) {
  const Silence silence;
  const Handle(Indicator) indicator = new Indicator(progress);
  ShapeFile changed = file;
  std::vector<SmallFeature> features;
  try {
    const ShapeChanges& changes = shape_changes();
    guarded([&] { features = changes.remove_small_features(changed, size, indicator->Start()); });
    if (!indicator->stopped()) file = std::move(changed);
  } catch (const Standard_Failure& failure) {
    file.losses.push_back(std::string("no small feature is removed: OpenCASCADE: ") + failure.GetMessageString());
  }
  if (indicator->stopped()) throw std::runtime_error("small features are not removed: the host stopped the call");
  return features;
}

void imprint_parts(ShapeFile& file, double tolerance, const ReadingProgress& progress) {
  const Silence silence;
  const Handle(Indicator) indicator = new Indicator(progress);
  try {
    const ShapeChanges& changes = shape_changes();
    guarded([&] { changes.imprint(file, tolerance, indicator->Start()); });
  } catch (const Standard_Failure& failure) {
    file.losses.push_back(std::string("the parts are not imprinted: OpenCASCADE: ") + failure.GetMessageString());
  }
  if (indicator->stopped()) throw std::runtime_error("the parts are not imprinted: the host stopped the call");
}

void mirror_shape(ShapeFile& file, const MirrorPlane& plane) {
  const Silence silence;
  ShapeFile changed = file;
  try {
    const ShapeChanges& changes = shape_changes();
    guarded([&] { changes.mirror(changed, plane); });
  } catch (const Standard_Failure& failure) {
    throw std::runtime_error(std::string("the body cannot be cut by the mirror plane or completed at it: OpenCASCADE: ") + failure.GetMessageString());
  }
  file = std::move(changed);
}

}  // namespace carreau_occ
