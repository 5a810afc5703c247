// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/sizes_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "base/failure.h"
#include "base/lengths.h"
#include "base/suggestions.h"
#include "base/text_file.h"
#include "mesh/near.h"

namespace command {
namespace {

using Json = nlohmann::ordered_json;

/// "parse error at line 3, column 5: ..." without the library's prefix.
std::string without_prefix(const std::string& sentence) {
  const std::size_t end = sentence.find("] ");
  return end == std::string::npos ? sentence : sentence.substr(end + 2);
}

class SizesReader {
 public:
  explicit SizesReader(MeshOptions& options) : options_(options), path_(options.sizes.path) {}

  void run() {
    const Json content = parsed();
    if (!content.is_object()) fail("", "an object {...} of sizes is required");
    const MeshOptions typed = options_;
    const std::vector<std::pair<std::string, std::function<void(const Json&)>>> keys = {
        {"size", [&](const Json& v) { give_length("size", v, options_.size); }},
        {"min", [&](const Json& v) { give_length("min", v, options_.minimum); }},
        {"max", [&](const Json& v) { give_length("max", v, options_.maximum); }},
        {"chord", [&](const Json& v) { give_length("chord", v, options_.chord); }},
        {"size-map", [&](const Json& v) { give_text("size-map", v, options_.size_map); }},
        {"angle", [&](const Json& v) { give_angle("angle", v, number_in("angle", v, 0.01, 89), typed); }},
        {"segments-per-circle",
         [&](const Json& v) { give_angle("segments-per-circle", v, 180 / number_in("segments-per-circle", v, 3, 10000), typed); }},
        {"gradation",
         [&](const Json& v) {
           const double ratio = number_in("gradation", v, 0, 1e9);
           if (ratio > 0 && ratio < 1) fail("gradation", "a ratio is 0, or at least 1");
           if (!typed.gradation) options_.gradation = ratio;
         }},
        {"anisotropic",
         [&](const Json& v) {
           const double ratio = number_in("anisotropic", v, 1, 1e9);
           if (typed.anisotropy == 0) options_.anisotropy = ratio;
         }},
        {"face-size", [&](const Json& v) { options_.sizes.faces = give_rules("face-size", v, options_.face_sizes); }},
        {"size-on", [&](const Json& v) { options_.sizes.entities = give_rules("size-on", v, options_.sizes_on); }},
        {"near", [&](const Json& v) { give_near(v); }},
    };
    std::vector<std::string> names;
    for (const auto& [name, read] : keys) names.push_back(name);
    for (const auto& [key, value] : content.items()) {
      const std::string& wanted = key;
      const auto found = std::find_if(keys.begin(), keys.end(), [&](const auto& each) { return each.first == wanted; });
      if (found == keys.end()) throw Failure("'" + path_ + "': there is no key '" + key + "'" + did_you_mean(key, names));
      found->second(value);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& why) const {
    throw Failure("'" + path_ + "'" + (key.empty() ? "" : ", key '" + key + "'") + ": " + why + ".");
  }

  /// Rejects keys that an object has twice.
  Json parsed() const {
    std::vector<std::set<std::string>> open;
    const auto look = [&](int, Json::parse_event_t event, Json& value) {
      if (event == Json::parse_event_t::object_start) open.emplace_back();
      if (event == Json::parse_event_t::object_end && !open.empty()) open.pop_back();
      if (event == Json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
        fail(value.get<std::string>(), "the key occurs twice");
      return true;
    };
    try {
      return Json::parse(read_text(path_), look);
    } catch (const Json::exception& error) {
      throw Failure("'" + path_ + "': " + without_prefix(error.what()) + ".");
    }
  }

  /// A length as the command line has it: 0.5 or "2%".
  std::string length_in(const std::string& key, const Json& value) const {
    if (!value.is_number() && !value.is_string()) fail(key, "a length is a number, or a text such as \"2%\"");
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    (void)parse_length(text, "'" + path_ + "', key '" + key + "'");
    return text;
  }
  double number_in(const std::string& key, const Json& value, double low, double high) const {
    if (!value.is_number() || !(value.get<double>() >= low) || !(value.get<double>() <= high))
      fail(key, "a number from " + Json(low).dump() + " to " + Json(high).dump() + " is required, not " + value.dump());
    return value.get<double>();
  }

  void give_length(const std::string& key, const Json& value, std::string& option) const {
    const std::string text = length_in(key, value);
    if (option.empty()) option = text;
  }
  void give_text(const std::string& key, const Json& value, std::string& option) const {
    if (!value.is_string() || value.get<std::string>().empty()) fail(key, "a text is required");
    if (option.empty()) option = value.get<std::string>();
  }
  void give_angle(const std::string& key, const Json&, double degrees, const MeshOptions& typed) {
    if (std::exchange(has_angle_, true)) fail(key, "'angle' and 'segments-per-circle' exclude each other");
    if (typed.angle == 0) options_.angle = degrees;
  }

  /// Puts the rules of an object {"entities": length} before the rules of the command line. Returns their number.
  std::size_t give_rules(const std::string& key, const Json& value, std::vector<std::string>& rules) const {
    if (!value.is_object()) fail(key, "an object is required, as in {\"face:3\": 0.1}");
    std::vector<std::string> read;
    for (const auto& [entities, length] : value.items()) read.push_back(entities + "=" + length_in(key + "' '" + entities, length));
    rules.insert(rules.begin(), read.begin(), read.end());
    return read.size();
  }

  void give_near(const Json& value) {
    constexpr const char* example = "a size and a reach are required, as in {\"face:3\": {\"size\": 0.1, \"reach\": 2}}";
    if (!value.is_object()) fail("near", example);
    std::vector<std::string> read;
    for (const auto& [entities, sizes] : value.items()) {
      const std::string key = "near' '" + entities;
      if (!sizes.is_object() || sizes.size() != 2 || !sizes.contains("size") || !sizes.contains("reach")) fail(key, example);
      read.push_back(entities + "=" + length_in(key + "' 'size", sizes["size"]) + ":" + length_in(key + "' 'reach", sizes["reach"]));
    }
    options_.near.insert(options_.near.begin(), read.begin(), read.end());
    options_.sizes.near = read.size();
  }

  MeshOptions& options_;
  const std::string& path_;
  bool has_angle_ = false;
};

}  // namespace

void read_sizes(MeshOptions& options) {
  if (!options.sizes.path.empty()) SizesReader(options).run();
}

std::string name_of_rule(const SizesFile& file, const std::string& option, bool is_in_file) {
  return is_in_file ? "'" + file.path + "', key '" + option.substr(2) + "'" : option;
}

}  // namespace command
