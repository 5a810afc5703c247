// SPDX-License-Identifier: BSD-3-Clause
#include "plain_step.h"

#include <Interface_Check.hxx>
#include <Interface_ParamType.hxx>
#include <StepData_FileRecognizer.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepReaderData.hxx>
#include <StepData_StepReaderTool.hxx>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace carreau_occ {
namespace {

// The name of a list inside an entity, and of an entity without a number, in OpenCASCADE's records.
constexpr const char* untyped = "/* (SUB) */";
constexpr const char* unnumbered = "#0";
constexpr const char* no_name = "''";

constexpr std::streamoff largest_file = 1 << 30;  // bytes: OpenCASCADE counts records and arguments by int
constexpr std::ptrdiff_t max_digits = 9;         // of numbers that int holds
constexpr int deepest = 64;                       // lists in lists
constexpr int max_mending_rounds = 3;            // each reads all records again

enum : unsigned char { blank = 1, digit = 2, capital = 4, letter = 8 };

constexpr std::array<unsigned char, 256> kinds_of_characters() {
  std::array<unsigned char, 256> kinds{};
  for (const unsigned char c : {' ', '\t', '\n', '\r'}) kinds[c] = blank;
  for (unsigned c = '0'; c <= '9'; ++c) kinds[c] = digit;
  for (unsigned c = 'A'; c <= 'Z'; ++c) kinds[c] = capital | letter;
  for (unsigned c = 'a'; c <= 'z'; ++c) kinds[c] = letter;
  kinds['_'] = capital | letter;
  return kinds;
}

constexpr std::array<unsigned char, 256> kinds = kinds_of_characters();

bool is_of(char c, unsigned kind) { return (kinds[static_cast<unsigned char>(c)] & kind) != 0; }

/// The records of a file as OpenCASCADE's parser makes them: lists before their owners, numbered within each entity.
/// Accepts syntax that this parser takes in one way only.
/// A file is not plain where the parser's lexer has more rules: numbers and names that run into each other, lower case,
/// scopes, user's types, binary numbers. It is not plain either where two entities have one number, or where a number
/// that is referred to is missing.
class PlainStep {
 public:
  struct Argument {
    const char* text;
    Interface_ParamType type;
  };
  struct Record {
    const char* ident;
    const char* type;
    std::size_t arguments;
  };

  /// `source` is read by parse() alone.
  explicit PlainStep(const std::string& source)
      : at_(source.c_str()), end_(at_ + source.size()), texts_(new char[source.size() + 1]), free_(texts_.get()) {}

  bool parse();
  [[nodiscard]] Handle(StepData_StepReaderData) data(Resource_FormatType page) const;
  /// Mends attributes by the errors of OpenCASCADE, which are by entity ("#12"). Returns the entities that changed.
  std::set<std::string> mend_attributes(const std::map<std::string, std::vector<std::string>>& errors);

 private:
  [[nodiscard]] bool is_complex(std::size_t record) const;
  void skip_blanks();
  bool skip(char c);
  bool skip(std::string_view word);
  const char* skip_all(unsigned kind, const char* from) const;
  const char* keep(const char* first, const char* last);
  const char* list_name(std::size_t number);

  [[nodiscard]] bool has_each_once() const;
  bool read_header();
  bool read_entities();
  bool read_entity();
  bool read_record(const char* ident);
  bool read_list(const char* ident, const char* type);
  bool read_inner_list(const char* type);
  bool read_argument();
  bool read_number();
  bool read_text();
  bool read_enumeration();
  const char* read_type();
  const char* read_ident();

  bool add(const char* text, Interface_ParamType type) {
    if (text == nullptr) return false;
    open_.push_back({text, type});
    return true;
  }

  const char* at_;
  const char* end_;  // where a zero is
  std::unique_ptr<char[]> texts_;
  char* free_;  // each text is followed by a character that belongs to none, so that its final zero has a place
  std::deque<std::string> list_names_;
  std::size_t inner_lists_ = 0;  // of the entity
  int depth_ = 0;
  std::size_t header_ = 0;  // records
  std::vector<Record> records_;
  std::vector<Argument> arguments_;
  std::vector<Argument> open_;  // of lists that are not closed
};

bool PlainStep::parse() {
  if (std::memchr(at_, 0, static_cast<std::size_t>(end_ - at_)) != nullptr) return false;
  return skip("ISO-10303-21;") && skip("HEADER;") && read_header() && skip("DATA;") && read_entities() &&
         skip("END-ISO-10303-21;") && has_each_once();
}

/// Numbers that two entities have, or none that is referred to: how OpenCASCADE counts its complaints of these depends on more than one
/// of them.
bool PlainStep::has_each_once() const {
  const auto number = [](const char* ident) { return std::atoi(ident + 1); };
  std::vector<int> numbers;
  for (const Record& record : records_)
    if (record.ident[0] == '#' && record.ident != unnumbered) numbers.push_back(number(record.ident));
  std::sort(numbers.begin(), numbers.end());
  if (std::adjacent_find(numbers.begin(), numbers.end()) != numbers.end()) return false;
  return std::all_of(arguments_.begin(), arguments_.end(), [&](const Argument& argument) {
    return argument.type != Interface_ParamIdent || std::binary_search(numbers.begin(), numbers.end(), number(argument.text));
  });
}

/// And comments. One that does not end stays, and is no plain syntax anywhere.
void PlainStep::skip_blanks() {
  for (;;) {
    while (is_of(*at_, blank)) ++at_;
    if (at_[0] != '/' || at_[1] != '*') return;
    const char* const close = std::strstr(at_ + 2, "*/");
    if (close == nullptr) return;
    at_ = close + 2;
  }
}

bool PlainStep::skip(char c) {
  skip_blanks();
  if (*at_ != c) return false;
  ++at_;
  return true;
}

bool PlainStep::skip(std::string_view word) {
  skip_blanks();
  if (static_cast<std::size_t>(end_ - at_) < word.size() || std::memcmp(at_, word.data(), word.size()) != 0)
    return false;
  at_ += word.size();
  return true;
}

const char* PlainStep::skip_all(unsigned kind, const char* from) const {
  while (is_of(*from, kind)) ++from;
  return from;
}

const char* PlainStep::keep(const char* first, const char* last) {
  const auto size = static_cast<std::size_t>(last - first);
  char* const kept = free_;
  std::memcpy(kept, first, size);
  kept[size] = 0;
  free_ += size + 1;
  at_ = last;
  return kept;
}

const char* PlainStep::list_name(std::size_t number) {
  while (list_names_.size() < number) {
    std::string& name = list_names_.emplace_back(1, '$');
    name += std::to_string(list_names_.size());
  }
  return list_names_[number - 1].c_str();
}

bool PlainStep::read_header() {
  do
    if (!read_record(unnumbered) || !skip(';')) return false;
  while (!skip("ENDSEC;"));
  header_ = records_.size();
  return true;
}

bool PlainStep::read_entities() {
  do
    if (!read_entity()) return false;
  while (!skip("ENDSEC;"));
  return true;
}

bool PlainStep::read_entity() {
  skip_blanks();
  const char* ident = read_ident();
  if (ident == nullptr) return false;
  while (*at_ == ' ' || *at_ == '\t') ++at_;  // but no end of a line: it would be a reference
  if (*at_ != '=') return false;
  ++at_;
  if (!skip('(')) return read_record(ident) && skip(';');
  do {  // a complex entity
    if (!read_record(ident)) return false;
    ident = unnumbered;
  } while (!skip(')'));
  return skip(';');
}

bool PlainStep::read_record(const char* ident) {
  skip_blanks();
  const char* const type = read_type();
  inner_lists_ = 0;
  return type != nullptr && skip('(') && read_list(ident, type);
}

bool PlainStep::read_list(const char* ident, const char* type) {
  const std::size_t first = open_.size();
  if (!skip(')')) {
    do
      if (!read_argument()) return false;
    while (skip(','));
    if (!skip(')')) return false;
  }
  records_.push_back({ident, type, open_.size() - first});
  const auto own = open_.begin() + static_cast<std::ptrdiff_t>(first);
  arguments_.insert(arguments_.end(), own, open_.end());
  open_.erase(own, open_.end());
  return true;
}

bool PlainStep::read_inner_list(const char* type) {
  if (type == nullptr || !skip('(') || depth_ == deepest) return false;
  ++depth_;
  const char* const name = list_name(++inner_lists_);
  if (!read_list(name, type)) return false;
  --depth_;
  return add(name, Interface_ParamSub);
}

bool PlainStep::read_argument() {
  skip_blanks();
  switch (*at_) {
    case '#':
      return add(read_ident(), Interface_ParamIdent);
    case '\'':
      return read_text();
    case '.':
      return read_enumeration();
    case '$':
      ++at_;
      return add("$", Interface_ParamVoid);
    case '*':
      ++at_;
      return add("*", Interface_ParamMisc);
    case '(':
      return read_inner_list(untyped);
    default:
      return is_of(*at_, letter) ? read_inner_list(read_type()) : read_number();
  }
}

bool PlainStep::read_number() {
  const char* const start = *at_ == '+' || *at_ == '-' ? at_ + 1 : at_;
  const char* last = skip_all(digit, start);
  if (last == start) return false;
  if (*last != '.') return add(keep(at_, last), Interface_ParamInteger);
  last = skip_all(digit, last + 1);
  if (*last == 'E') {
    const char* const power = last[1] == '+' || last[1] == '-' ? last + 2 : last + 1;
    last = skip_all(digit, power);
    if (last == power) return false;
  }
  return add(keep(at_, last), Interface_ParamReal);
}

/// A text ends, for OpenCASCADE, at the first apostrophe that blanks or quotation marks alone separate from a comma or
/// a bracket, whatever its apostrophes are otherwise.
bool PlainStep::read_text() {
  for (const char* mark = std::strchr(at_ + 1, '\''); mark != nullptr; mark = std::strchr(mark + 1, '\'')) {
    const char* const next = mark + 1 + std::strspn(mark + 1, "\" \n\r");
    if (*next == ',' || *next == ')') return add(keep(at_, mark + 1), Interface_ParamText);
  }
  return false;
}

bool PlainStep::read_enumeration() {
  const char* const last = skip_all(capital | digit, at_ + 1);
  if (!is_of(at_[1], capital) || *last != '.') return false;
  return add(keep(at_, last + 1), Interface_ParamEnum);
}

const char* PlainStep::read_type() {
  if (!is_of(*at_, capital)) return nullptr;
  const char* const type = keep(at_, skip_all(capital | digit, at_));
  return std::strcmp(type, "ENDSCOPE") == 0 ? nullptr : type;
}

const char* PlainStep::read_ident() {
  if (*at_ != '#') return nullptr;
  const char* const last = skip_all(digit, at_ + 1);
  const std::ptrdiff_t digits = last - at_ - 1;
  return digits > 0 && digits <= max_digits ? keep(at_, last) : nullptr;
}

Handle(StepData_StepReaderData) PlainStep::data(Resource_FormatType page) const {
  const auto count = [](std::size_t size) { return static_cast<Standard_Integer>(size); };
  const Handle(StepData_StepReaderData) data =
      new StepData_StepReaderData(count(header_), count(records_.size()), count(arguments_.size()), page);
  const Argument* argument = arguments_.data();
  Standard_Integer number = 0;
  for (const Record& record : records_) {
    data->SetRecord(++number, record.ident, record.type, record.arguments > 0 ? 1 : 0);
    for (const Argument* const last = argument + record.arguments; argument != last; ++argument)
      data->AddStepParam(number, argument->text, argument->type);
    data->InitParams(number);
  }
  return data;
}

/// An error of OpenCASCADE about the attributes of an entity.
struct AttributeError {
  std::size_t count = 0;  // that the type has; 0: the error is about one attribute
  std::size_t no_text = 0;  // rank of an attribute that should be a text, from 1; 0: it is about another fault
  std::string type;         // in capitals, where the count is wrong

  explicit AttributeError(const std::string& error) {
    if (const std::string number = behind("Count of Parameters is not ", error); !number.empty()) {
      count = std::strtoul(number.c_str(), nullptr, 10);
      type = behind(" for ", error);
      std::transform(type.begin(), type.end(), type.begin(),
                     [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    } else if (error.find("not a quoted String") != std::string::npos) {
      no_text = std::strtoul(behind("Parameter n0.", error).c_str(), nullptr, 10);
    }
  }

 private:
  static std::string behind(std::string_view words, const std::string& error) {
    const std::size_t at = error.find(words);
    return at == std::string::npos ? "" : error.substr(at + words.size());
  }
};

/// A missing name comes first in its entity; attributes behind the last known one are of another schema.
bool mend(std::vector<PlainStep::Argument>& arguments, const AttributeError& error) {
  if (error.no_text > 0) {
    if (error.no_text > arguments.size()) return false;
    PlainStep::Argument& argument = arguments[error.no_text - 1];
    if (argument.type != Interface_ParamVoid && argument.type != Interface_ParamMisc) return false;
    argument = {no_name, Interface_ParamText};
    return true;
  }
  if (arguments.size() > error.count) {
    arguments.resize(error.count);
    return true;
  }
  if (arguments.size() + 1 != error.count || (!arguments.empty() && arguments.front().type == Interface_ParamText))
    return false;
  arguments.insert(arguments.begin(), {no_name, Interface_ParamText});
  return true;
}

std::set<std::string> PlainStep::mend_attributes(const std::map<std::string, std::vector<std::string>>& errors) {
  std::set<std::string> mended;
  std::vector<Argument> all;
  const std::vector<std::string>* own = nullptr;  // errors of the entity
  const char* entity = nullptr;
  const Argument* from = arguments_.data();
  for (std::size_t r = 0; r < records_.size(); ++r) {
    Record& record = records_[r];
    std::vector<Argument> arguments(from, from + record.arguments);
    from += record.arguments;
    const bool outer = record.ident[0] == '#', begins = outer && record.ident != unnumbered;
    if (begins) {
      const auto found = errors.find(record.ident);
      own = found != errors.end() ? &found->second : nullptr;
      entity = record.ident;
    }
    for (std::size_t e = 0; outer && own != nullptr && e < own->size(); ++e) {
      const AttributeError error((*own)[e]);
      const bool complex = !begins || is_complex(r);
      const bool meant = !complex || record.type == error.type ||
                         (error.no_text > 0 && std::string_view("REPRESENTATION_ITEM") == record.type);
      if (meant && (error.count > 0 || error.no_text > 0) && mend(arguments, error)) mended.insert(entity);
    }
    record.arguments = arguments.size();
    all.insert(all.end(), arguments.begin(), arguments.end());
  }
  arguments_ = std::move(all);
  return mended;
}

/// The record is the first of an entity of several types.
bool PlainStep::is_complex(std::size_t record) const {
  do ++record;
  while (record < records_.size() && records_[record].ident[0] != '#');
  return record < records_.size() && records_[record].ident == unnumbered;
}

/// Empty: it cannot be read, or is too large.
std::string text_of(Standard_CString path) {
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : 0;
  if (size <= 0 || size > largest_file) return {};
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  return stream.read(text.data(), size) ? text : std::string();
}

Handle(StepData_StepModel) model_of(const PlainStep& plain, const Handle(StepData_Protocol) & protocol) {
  const Handle(StepData_StepModel) model = new StepData_StepModel;
  const Handle(StepData_StepReaderData) data = plain.data(model->SourceCodePage());
  StepData_StepReaderTool tool(data, protocol);
  tool.SetErrorHandle(Standard_True);
  tool.PrepareHeader(Handle(StepData_FileRecognizer)());
  tool.Prepare(Handle(StepData_FileRecognizer)());
  tool.LoadModel(model);
  if (model->Protocol().IsNull()) model->SetProtocol(protocol);
  tool.Clear();
  return model;
}

/// Errors of a model by entity.
std::map<std::string, std::vector<std::string>> errors_of(const StepData_StepModel& model) {
  std::map<std::string, std::vector<std::string>> errors;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(Interface_Check) check = model.Check(i, Standard_True);
    if (check->NbFails() == 0) continue;
    std::string ident(1, '#');
    ident += std::to_string(model.IdentLabel(model.Value(i)));
    for (int k = 1; k <= check->NbFails(); ++k) errors[ident].emplace_back(check->CFail(k));
  }
  return errors;
}

}  // namespace

bool PlainStepLibrary::read_plain(Standard_CString path, Handle(Interface_InterfaceModel) & model,
                                  const Handle(Interface_Protocol) & protocol, std::vector<std::string>* mended) {
  const Handle(StepData_Protocol) step = Handle(StepData_Protocol)::DownCast(protocol);
  const std::string text = text_of(path);
  PlainStep plain(text);
  if (step.IsNull() || !plain.parse()) return false;
  Handle(StepData_StepModel) read = model_of(plain, step);
  // A reader stops at the first unreadable attribute: each repair reveals the next one.
  std::set<std::string> all;
  for (int round = 0; mended != nullptr && round < max_mending_rounds; ++round) {
    const std::set<std::string> now = plain.mend_attributes(errors_of(*read));
    if (now.empty()) break;
    all.insert(now.begin(), now.end());
    read = model_of(plain, step);
  }
  if (mended != nullptr) mended->assign(all.begin(), all.end());
  model = read;
  return true;
}

Standard_Integer PlainStepLibrary::ReadFile(Standard_CString path, Handle(Interface_InterfaceModel) & model,
                                            const Handle(Interface_Protocol) & protocol) const {
  return read_plain(path, model, protocol, &mended_) ? 0 : StepSelect_WorkLibrary::ReadFile(path, model, protocol);
}

std::string PlainStepLibrary::note() const {
  constexpr std::size_t max_listed = 5;
  if (mended_.empty()) return "";
  std::string list;
  for (std::size_t i = 0; i < mended_.size() && i < max_listed; ++i) list += (i > 0 ? ", " : "") + mended_[i];
  return "the names or counts of attributes of " + std::to_string(mended_.size()) +
         (mended_.size() == 1 ? " entity are wrong and were repaired: " : " entities are wrong and were repaired: ") + list +
         (mended_.size() > max_listed ? ", ..." : "");
}

}  // namespace carreau_occ
