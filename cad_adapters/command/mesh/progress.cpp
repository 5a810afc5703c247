// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/progress.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>

#include "base/heap.h"
#include "base/signals.h"
#include "base/terminal.h"
#include "inputs/base/cad_input.h"

namespace command {
namespace {

constexpr int bar_width = 30;
constexpr std::chrono::milliseconds redraw{100};
constexpr std::chrono::seconds between_lines{1};
constexpr std::int32_t phase_reading = -2;  // not one of the library's

const char* phase_name(std::int32_t phase) {
  switch (phase) {
    case phase_reading:
      return "reading";
    case CARREAU_PHASE_MODEL:
      return "gluing";
    case CARREAU_PHASE_CURVES:
      return "cutting curves";
    case CARREAU_PHASE_PATCHES:
      return "meshing faces";
    case CARREAU_PHASE_ASSEMBLY:
      return "joining faces";
    case CARREAU_PHASE_WRITING:
      return "writing";
    case CARREAU_PHASE_MEASURE:
      return "measuring";
    case CARREAU_PHASE_GRADATION:
      return "grading sizes";
    default:
      return "at work";
  }
}

std::string entity_name(std::int32_t phase, std::int32_t entity) {
  if (entity == 0) return "";
  if (phase == CARREAU_PHASE_CURVES) return ", curve " + std::to_string(entity);
  if (phase == CARREAU_PHASE_PATCHES) return ", face " + std::to_string(entity);
  return "";
}

constexpr int most_alike = 4;

/// Without its numbers, signs and exponents.
std::string kind_of(const std::string& text) {
  std::string kind;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool in_number = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    if (!in_number) {
      kind += text[i];
      continue;
    }
    while (i + 1 < text.size() && std::strchr("0123456789.eE+-", text[i + 1]) != nullptr) ++i;
    kind += '#';
  }
  return kind;
}

}  // namespace

Progress::Progress(bool quiet)
    : quiet_(quiet), terminal_(is_terminal()), colours_(shows_colours()), drawn_(Clock::now()) {}
Progress::~Progress() {
  tell_of_others();
  clear();
}

void Progress::listen_to(carreau_session* session, const CadInput& input) {
  input_ = &input;
  if (quiet_) carreau_set_integer(session, "verb", CARREAU_LEVEL_WARNING);  // messages that are not shown are not computed
  carreau_set_message_callback(session, on_message, this);
  carreau_set_progress_callback(session, on_progress, this);
}

void Progress::clear() {
  if (bar_) std::fputs("\r\033[K", stderr);
  bar_ = false;
  bar_is_shown(false);
}

void Progress::line(const std::string& text) {
  if (quiet_) return;
  tell_of_others();
  clear();
  std::fprintf(stderr, "%s\n", text.c_str());
}

void Progress::attention(const char* word, const std::vector<std::string>& lines) {
  if (quiet_ || lines.empty()) return;
  clear();
  print_marked(word, colour::red, lines.front().c_str());
  for (std::size_t k = 1; k < lines.size(); ++k) std::fprintf(stderr, "%s\n", lines[k].c_str());
}

void Progress::warning(const std::string& text) {
  warnings_.push_back(text);
  if (quiet_) return;
  if (++shown_[kind_of(text)] > most_alike) {
    ++held_back_;
    return;
  }
  clear();
  print_marked("warning", colour::yellow, text.c_str());
}

// Prints the count before any other line, so that it stands below the warnings.
void Progress::tell_of_others() {
  if (held_back_ == 0 || quiet_) return;
  clear();
  const std::string others = std::to_string(held_back_) + " more like " + (held_back_ == 1 ? "it" : "these");
  print_marked("warning", colour::yellow, others.c_str());
  held_back_ = 0;
}

void Progress::error(const std::string& text) {
  tell_of_others();
  clear();
  print_marked("error", colour::red, text.c_str());
}

void Progress::on_message(std::int32_t level, const char* sentence, void* user) {
  auto& self = *static_cast<Progress*>(user);
  const std::string text = in_terms_of_file(*self.input_, sentence);
  if (level <= CARREAU_LEVEL_ERROR)
    self.error(text);
  else if (level <= CARREAU_LEVEL_WARNING)
    self.warning(text);
  else
    self.line(text);
}

void Progress::part(double from, double to) { from_ = from, to_ = to; }

void Progress::reading(double fraction) {
  const auto now = Clock::now();
  if (!terminal_ && now - drawn_ < between_lines) return;
  if (!terminal_) drawn_ = now;
  show(phase_reading, 0, fraction);
}

std::int32_t Progress::on_progress(std::int32_t phase, std::int32_t entity, double fraction, void* user) {
  if (phase == CARREAU_PHASE_ASSEMBLY) give_back_heap();
  auto& self = *static_cast<Progress*>(user);
  const bool of_curve = phase == CARREAU_PHASE_CURVES;
  self.show(phase, of_curve ? self.input_->whole_curve(entity) : self.input_->whole_face(entity), fraction);
  return 0;
}

void Progress::show(std::int32_t phase, std::int32_t entity, double fraction) {
  if (quiet_ || phase == CARREAU_PHASE_IDLE) return;
  if (phase != phase_) tell_of_others();
  reached_ = std::max(reached_, from_ + (to_ - from_) * std::clamp(fraction, 0.0, 1.0));
  const int percent = static_cast<int>(100 * reached_ + 1e-9);
  if (!terminal_) {
    // Files are written image by image, each from 0 to 100 %: a log needs to know only that it has begun.
    const bool of_files = phase == CARREAU_PHASE_WRITING || phase == CARREAU_PHASE_MEASURE;
    const bool ends = percent == 100 && tenth_ < 10;
    if (phase == phase_ && !ends && (of_files || percent / 10 == tenth_)) return;
    tenth_ = percent / 10, phase_ = phase;
    std::fprintf(stderr, "%3d %% of the run: %s%s\n", percent, phase_name(phase), entity_name(phase, entity).c_str());
    return;
  }
  const auto now = Clock::now();
  if (bar_ && phase == phase_ && now - drawn_ < redraw) return;
  drawn_ = now, phase_ = phase, bar_ = true;
  bar_is_shown(true);
  std::string bar(static_cast<std::size_t>(bar_width * percent / 100), '#');
  bar.resize(bar_width, '.');
  std::fprintf(stderr, "\r\033[K[%s%s%s] %3d %% of the run: %s%s", colours_ ? colour::green : "", bar.c_str(),
               colours_ ? colour::plain : "", percent, phase_name(phase), entity_name(phase, entity).c_str());
  std::fflush(stderr);
}

}  // namespace command
