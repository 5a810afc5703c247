// SPDX-License-Identifier: BSD-3-Clause
// The records of a STEP file, without a schema.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace command {

/// The content of a file. Throws Failure when it is empty or cannot be read.
std::string bytes_of_step(const std::string& path);

/// The records of the data section: text between '=' and ';' by number.
class StepRecords {
 public:
  StepRecords(std::string path, std::string text);
  StepRecords(const StepRecords&) = delete;  // records refer to the text
  StepRecords& operator=(const StepRecords&) = delete;

  struct Record {
    std::string_view type, arguments;  ///< a complex entity has no type
  };
  [[nodiscard]] const std::map<int, Record>& all() const { return records_; }

  /// Throws Failure with the file and the record.
  [[noreturn]] void fail(int number, const std::string& why) const;
  /// The record to which record `from` refers. Fails when it is missing.
  [[nodiscard]] const Record& at(int number, int from) const;
  /// An attribute, from 0. Fails when it is missing.
  [[nodiscard]] std::string_view argument(int number, const Record& record, std::size_t rank) const;
  /// The members of a list, each of which refers to a record.
  [[nodiscard]] static std::vector<int> references(std::string_view list);
  /// All numbers of a list, whatever its inner brackets.
  [[nodiscard]] std::vector<double> numbers(std::string_view list, int from) const;

  /// The arguments of a record, or the members of a list without its brackets.
  static std::vector<std::string_view> split(std::string_view list);
  /// A list without its brackets; empty when it has none.
  static std::string_view inside(std::string_view list);
  static std::string_view trimmed(std::string_view s);
  /// The number of `#number`; 0: it is no reference.
  static int reference(std::string_view s);
  /// A simple entity as it is, or the part of a complex entity that has this type; without a type if there is no such
  /// part.
  static Record part(const Record& record, std::string_view type);

 private:
  void find();
  /// The end of the record that begins here.
  std::size_t take(std::size_t at);

  std::string path_, text_;
  std::map<int, Record> records_;
};

}  // namespace command
