// SPDX-License-Identifier: BSD-3-Clause
#include "io/model/pardom.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/files.h"
#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

/// A number of the file, for messages: "typc of curve 3 of surface 2". Ranks from 1, 0: none.
struct Item {
  const char* name;
  int surface = 0, curve = 0, point = 0;
};

/// Begins a comment that only we read: the layout has no word for parts of curves.
constexpr std::string_view part_words = "! part of curve";

std::string described(const Item& item) {
  std::string text = item.name;
  if (item.curve > 0) text += " of curve " + std::to_string(item.curve);
  if (item.point > 0) text += " of point " + std::to_string(item.point);
  if (item.surface > 0) text += " of surface " + std::to_string(item.surface);
  return text;
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

bool looks_like_integer(std::string_view word) {
  if (!word.empty() && (word[0] == '+' || word[0] == '-')) word.remove_prefix(1);
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The numbers of the text in order, and their places.
class PardomReader {
 public:
  PardomReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Model read();
  /// Line of the first text that is neither read nor a comment; 0: none.
  [[nodiscard]] int line_of_rest() const;

 private:
  [[noreturn]] void fail(const std::string& sentence, int line) const {
    throw FileError({.file = name_, .line = line}, sentence);
  }
  [[noreturn]] void fail(const std::string& sentence) const { fail(sentence, line_); }

  void skip_blanks();
  std::string_view word();
  std::string_view expected_word(const Item& item);
  int integer(const Item& item);
  double real(const Item& item);
  int count(const Item& item, const char* things, std::size_t words_each);
  Face face(int rank);
  FaceCurve curve(int surface, int rank);
  void read_part(FaceCurve& curve, int surface, int rank);
  FacePoint point(int surface, int rank);

  std::string_view text_;
  const std::string& name_;
  std::size_t pos_ = 0;
  int line_ = 1;  ///< of the last word
  int next_line_ = 1;
  bool any_word_ = false;
};

/// Blanks, comments, and at most one comma.
void PardomReader::skip_blanks() {
  int commas = 0;
  for (; pos_ < text_.size(); ++pos_) {
    const char c = text_[pos_];
    if (c == '!') pos_ = std::min(text_.find_first_of("\r\n", pos_), text_.size());
    if (pos_ == text_.size()) return;
    if (text_[pos_] == ',') {
      // In list-directed Fortran input a missing value would be left as it was; here it has no meaning.
      if (++commas > 1 || !any_word_) fail("a value is missing before a comma", next_line_);
    } else if (!is_space(text_[pos_])) {
      return;
    }
    if (text_[pos_] == '\n') ++next_line_;
  }
}

/// Empty at the end of the text.
std::string_view PardomReader::word() {
  skip_blanks();
  const std::size_t begin = pos_;
  while (pos_ < text_.size() && !is_space(text_[pos_]) && text_[pos_] != ',' && text_[pos_] != '!') ++pos_;
  if (pos_ > begin) {
    line_ = next_line_;
    any_word_ = true;
  }
  return text_.substr(begin, pos_ - begin);
}

std::string_view PardomReader::expected_word(const Item& item) {
  const std::string_view found = word();
  if (found.empty()) fail("the file ends where " + described(item) + " was expected");
  return found;
}

int PardomReader::integer(const Item& item) {
  const std::string_view found = expected_word(item);
  int value = 0;
  if (!parse_number(found, value))
    fail(described(item) +
         (looks_like_integer(found) ? " is too large for an integer: " : " should be an integer, not ") + shown(found));
  return value;
}

double PardomReader::real(const Item& item) {
  const std::string_view found = expected_word(item);
  double value = 0;
  if (!parse_number(found, value)) fail(described(item) + " should be a number, not " + shown(found));
  if (!std::isfinite(value)) fail(described(item) + " is not finite: " + shown(found));
  return value;
}

/// A count of things that take at least `words_each` numbers each.
int PardomReader::count(const Item& item, const char* things, std::size_t words_each) {
  const int n = integer(item);
  if (n < 0) fail(described(item) + " is negative: " + std::to_string(n));
  // A number takes two characters, its separator included; the last one needs none. A plausible count is accepted, so
  // that the error of a truncated file names its end.
  constexpr int plausible = 1000;
  const std::size_t room = (text_.size() - pos_ + 1) / (2 * words_each);
  if (n > plausible && static_cast<std::size_t>(n) > room)
    fail(described(item) + " is " + std::to_string(n) + ", but the rest of the file has room for at most " +
         std::to_string(room) + " " + things);
  return n;
}

/// Reads the comment of pardom_text() behind a curve that is a part of a host's curve: its rank there, and the ends of
/// the part.
void PardomReader::read_part(FaceCurve& curve, int surface, int rank) {
  const std::size_t comment = text_.find_first_not_of(" \t", pos_);
  if (comment == text_.npos || !text_.substr(comment).starts_with(part_words)) return;
  pos_ = comment + part_words.size();
  const std::size_t end = std::min(text_.find_first_of("\r\n", pos_), text_.size());
  curve.part_of = integer({"the rank of the whole curve", surface, rank});
  curve.part_a = real({"the start of the part", surface, rank});
  curve.part_b = real({"the end of the part", surface, rank});
  if (pos_ > end || curve.part_of < 1 || !(curve.part_a < curve.part_b))
    fail(described({"the part", surface, rank}) +
         " should be the rank of a curve, from 1, and two parameters, the smaller first, on one line");
}

FaceCurve PardomReader::curve(int surface, int rank) {
  FaceCurve curve;
  const int type = integer({"typc", surface, rank});
  curve.line = line_;
  if (type != 1 && type != 2)
    fail(described({"typc", surface, rank}) + " should be 1 (boundary) or 2 (internal), not " + std::to_string(type));
  curve.type = static_cast<CurveType>(type);
  curve.ref = integer({"refc", surface, rank});
  curve.end1 = integer({"refp1", surface, rank});
  curve.end2 = integer({"refp2", surface, rank});
  read_part(curve, surface, rank);
  return curve;
}

FacePoint PardomReader::point(int surface, int rank) {
  FacePoint point;
  point.ref = integer({"refp", surface, 0, rank});
  point.line = line_;
  point.uv.x() = real({"u", surface, 0, rank});
  point.uv.y() = real({"v", surface, 0, rank});
  return point;
}

Face PardomReader::face(int rank) {
  Face face;
  face.ref = integer({"refs", rank});
  face.line = line_;
  face.orientation = integer({"orientation", rank});
  const int orientation_line = line_;
  const int nc = count({"nc", rank}, "curves", 4);
  if (nc == 0) fail("surface " + std::to_string(rank) + " has no curve: nc is 0");
  if (const std::int64_t ic = std::abs(std::int64_t{face.orientation}); ic > nc)
    fail("orientation of surface " + std::to_string(rank) + " is " + std::to_string(face.orientation) +
             ", but its absolute value should be the rank of a curve, from 1 to " + std::to_string(nc) +
             ", or 0 for a wire",
         orientation_line);
  for (int i = 1; i <= nc; ++i) face.curves.push_back(curve(rank, i));
  const int np = count({"np", rank}, "points", 3);
  for (int i = 1; i <= np; ++i) face.points.push_back(point(rank, i));
  return face;
}

Model PardomReader::read() {
  Model model;
  model.source = name_;
  // A surface has at least refs, orientation, nc, one curve and np.
  const int ns = count({"ns"}, "surfaces", 8);
  if (ns == 0) fail("the file describes no surface: ns is 0");
  for (int i = 1; i <= ns; ++i) model.faces.push_back(face(i));
  return model;
}

int PardomReader::line_of_rest() const {
  int line = next_line_;
  for (std::size_t at = pos_; at < text_.size(); ++at) {
    if (text_[at] == '!') at = std::min(text_.find_first_of("\r\n", at), text_.size());
    if (at == text_.size()) break;
    if (!is_space(text_[at])) return line;
    if (text_[at] == '\n') ++line;
  }
  return 0;
}

}  // namespace

Model read_pardom_text(std::string_view text, const std::string& name, int* line_of_rest) {
  PardomReader reader(without_byte_order_mark(text), name);
  Model model = reader.read();
  if (line_of_rest != nullptr) *line_of_rest = reader.line_of_rest();
  return model;
}

Model read_pardom(const std::string& path, int* line_of_rest) {
  constexpr std::size_t limit = std::size_t{1} << 28;
  return read_pardom_text(read_file(path, limit), path, line_of_rest);
}

namespace {

std::string part_comment(const FaceCurve& curve) {
  if (curve.part_of == 0) return {};
  return " " + std::string(part_words) + " " + std::to_string(curve.part_of) + " " + format_number(curve.part_a) + " " +
         format_number(curve.part_b);
}

}  // namespace

std::string pardom_text(const Model& model) {
  std::string text;
  const auto line = [&text](std::initializer_list<int> numbers, const char* comment) {
    const char* separator = "";
    for (const int number : numbers) {
      text += separator;
      text += std::to_string(number);
      separator = " ";
    }
    text += comment;
    text += '\n';
  };
  const auto size = [](const auto& list) { return static_cast<int>(list.size()); };
  line({size(model.faces)}, " ! ns (number of surfaces)");
  for (const Face& face : model.faces) {
    if (&face != &model.faces.front()) text += '\n';
    line({face.ref}, " ! refs (reference of the surface)");
    line({face.orientation}, " ! orientation");
    line({size(face.curves)}, " ! nc (number of curves)");
    const char* comment = " ! typc refc refp1 refp2";
    for (const FaceCurve& curve : face.curves) {
      const std::string part = part_comment(curve);
      line({static_cast<int>(curve.type), curve.ref, curve.end1, curve.end2}, part.empty() ? comment : part.c_str());
      if (part.empty()) comment = "";
    }
    line({size(face.points)}, " ! np (number of internal points)");
    comment = " ! refp u v\n";
    for (const FacePoint& point : face.points) {
      if (!is_finite(point.uv))
        throw InvalidArgument({.face = face.ref, .point = point.ref, .uv = point.uv},
                              "a point that is not finite cannot be written to a file");
      text += std::to_string(point.ref) + ' ' + format_number(point.uv.x()) + ' ' + format_number(point.uv.y()) + comment;
      comment = "\n";
    }
  }
  return text;
}

}  // namespace carreau
