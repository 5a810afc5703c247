// SPDX-License-Identifier: BSD-3-Clause
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <algorithm>
#include <atomic>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "faults.h"
#include "natural_bounds.h"
#include "shape_file.h"
#include "translator.h"

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

Format format_by_content(std::ifstream& file) {
  std::string head(4096, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  if (head.find("ISO-10303-21") != std::string::npos) return Format::step;
  if (head.find("DBRep_DrawableShape") != std::string::npos || head.find("CASCADE Topology") != std::string::npos)
    return Format::brep;
  // Column 73 of the first line says S (start section).
  if (head.size() > 73 && head[72] == 'S') return Format::iges;
  return Format::unknown;
}

/// OpenCASCADE writes to std::cout what it meets, through its messengers and, where it reads BREP files, by itself;
/// nobody asked for that.
class Silence {
 public:
  Silence() : printers_(Message::DefaultMessenger()->Printers()), buffer_(std::cout.rdbuf(nullptr)) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~Silence() {
    Message::DefaultMessenger()->ChangePrinters() = printers_;
    std::cout.rdbuf(buffer_);  // clears what went wrong without one
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  Message_SequenceOfPrinters printers_;
  std::streambuf* buffer_;
};

/// Hands on how far a translation is.
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

// OpenCASCADE's reader of BREP files looks for words without end when there is nothing left to read; and it goes on
// with what it had when a number is none.
void read_brep(const std::string& path, const Handle(Indicator) & indicator, ShapeFile& file) {
  std::ifstream stream(path, std::ios::binary);
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  const BRep_Builder builder;
  try {
    BRepTools::Read(file.shape, stream, builder, indicator->Start());
  } catch (const std::ios_base::failure&) {
    refuse(path, "is not a readable BREP file: it is cut off, or a number in it is none");
  }
  // Here only: other formats say the bounds of each face, and one whose bounds could not be read is not the whole.
  if (!file.shape.IsNull()) add_natural_bounds(file.shape);
}

void read_as(Format format, const std::string& path, const Handle(Indicator) & indicator, ShapeFile& file) {
  if (format == Format::step)
    step_translator()(path, indicator->Start(), file);
  else if (format == Format::iges)
    iges_translator()(path, indicator->Start(), file);
  else
    read_brep(path, indicator, file);
}

}  // namespace

ShapeFile read_shape(const std::string& path, const ReadingProgress& progress) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, "cannot be opened");
  if (std::filesystem::is_directory(path)) refuse(path, "is a folder");
  const Format content = format_by_content(stream);
  stream.close();
  Format format = format_by_suffix(path);
  if (format == Format::unknown) format = content;
  if (format == Format::unknown) refuse(path, "is no STEP, IGES or BREP file");
  if (content != format) {
    const char* expected = format == Format::step ? "a STEP" : format == Format::iges ? "an IGES" : "a BREP";
    refuse(path, std::string("is not what its suffix says: it does not begin like ") + expected + " file");
  }
  const Silence silence;
  ShapeFile file;
  const Handle(Indicator) indicator = new Indicator(progress);
  try {
    guarded([&] { read_as(format, path, indicator, file); });
  } catch (const Standard_Failure& failure) {
    refuse(path, std::string("OpenCASCADE cannot read it: ") + failure.GetMessageString());
  }
  if (indicator->stopped()) refuse(path, "was not read to its end: it was asked to stop");
  if (file.shape.IsNull() || !TopExp_Explorer(file.shape, TopAbs_EDGE).More()) {
    if (format == Format::step) refuse_tessellated(path);
    refuse(path, std::string("holds no face and no edge") +
                     (file.losses.empty() ? "" : " that can be read (" + file.losses.front() + ")"));
  }
  return file;
}

}  // namespace carreau_occ
