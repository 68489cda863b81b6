// A YAML file as nodes that know where they stand, read strictly.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "yaml/files.hpp"

namespace demecal::inline yaml {

/// A key that its map may not have, beside those that it may: tests ask readers in this way what they accept.
class UnknownKey : public InputError {
 public:
  UnknownKey(const InputError& fault, std::vector<std::string> allowed)
      : InputError(fault), allowed_(std::move(allowed)) {}

  const std::vector<std::string>& allowed() const { return allowed_; }

 private:
  std::vector<std::string> allowed_;
};

/// A scalar, list or map of a YAML file. Every accessor throws InputError with file, line, value and "KEY RULE" where
/// the value is not what is asked for. Made by read_yaml().
struct YamlNode {
  enum class Kind { nothing, scalar, list, map };

  std::string file;
  std::size_t line = 0;  ///< of its key, or of itself in a list; from 1
  std::string key;       ///< the way to it, list items counted from 1: "joints[2].a_mm"; empty for the whole file
  std::string name;      ///< its own key in a map; empty elsewhere
  Kind kind = Kind::nothing;
  std::string scalar;   ///< its text, where it is a scalar
  bool quoted = false;  ///< a scalar in quotes is text, not a number
  std::vector<YamlNode> children;

  /// Throws InputError at this node: the value shown, then its key and the rule, such as "must be positive".
  [[noreturn]] void fail(const std::string& value, const std::string& rule) const;
  [[noreturn]] void fail(const std::string& rule) const { fail(scalar, rule); }

  // of a map
  /// This node, a map with no keys but these; throws UnknownKey, which names the nearest, where it has another.
  const YamlNode& with_keys(std::initializer_list<std::string_view> allowed) const;
  const YamlNode& with_keys(std::span<const std::string> allowed) const;
  /// This node, a file of the kind that the key "demecal_KIND: VERSION" declares.
  const YamlNode& with_version(const std::string& kind, int version) const;
  const YamlNode* find(std::string_view child) const;
  const YamlNode& at(std::string_view child) const;

  // of a list
  const std::vector<YamlNode>& list() const;
  const std::vector<YamlNode>& list(std::size_t size) const;

  // of a scalar
  const std::string& text() const;
  double number() const;
  double number(double lower, double upper) const;
  double positive() const;
  double non_negative() const;
  std::int64_t whole_number(std::int64_t lower, std::int64_t upper) const;
  std::uint64_t seed() const;  ///< any whole number from 0 to 2^64 - 1
  bool boolean() const;

  // of a list of numbers
  std::vector<double> numbers() const;
  Eigen::Vector2d vector2() const;
  Eigen::Vector3d vector3() const;
  std::pair<double, double> range() const;  ///< [lower, upper], lower below upper

  /// The value whose word this scalar is.
  template <typename Value>
  Value one_of(std::initializer_list<std::pair<std::string_view, Value>> choices) const {
    for (const auto& [word, value] : choices) {
      if (kind == Kind::scalar && scalar == word) return value;
    }
    std::vector<std::string> words;
    for (const auto& choice : choices) words.emplace_back(choice.first);
    fail_choice(words);
  }

  /// Throws InputError that names the words allowed and the nearest of them.
  [[noreturn]] void fail_choice(std::span<const std::string> words) const;
};

/// The one document of the file. Throws InputError where the file cannot be read, is no YAML, is empty, holds several
/// documents, or a map has a key twice.
YamlNode read_yaml(const std::filesystem::path& path);

/// The same for text already read; `file` names it in errors.
YamlNode parse_yaml(const std::string& text, const std::string& file);

/// What `read` makes of the path that the node names, relative to the node's file. Throws InputError at the node where
/// there is no such file.
template <typename Read>
auto read_named(const YamlNode& node, const Read& read) {
  const std::filesystem::path path = resolve(node.file, node.text());
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) node.fail(path.string(), "names a file that does not exist");
  return read(path);
}

/// The joint, from 0, that the map's `key` names from 1.
int joint_at(const YamlNode& map, std::string_view key, const Chain& chain);

/// "STEM_deg", "STEM_rad", "STEM_mm" and "STEM_m" for every stem: what a map may hold for any joint.
std::vector<std::string> keys_with_units(const std::vector<std::string>& stems);

/// A value with its unit: where it stands, and how it becomes rad or m.
struct MeasuredNode {
  const YamlNode* node;
  double (*to_inside)(double);

  double number() const { return to_inside(node->number()); }
};

/// The value of `stem` in the map, in a unit that fits the joint; nothing where it is missing. Throws InputError where
/// it is given in two units or in one that does not fit.
std::optional<MeasuredNode> find_measured(const YamlNode& map, const std::string& stem, JointType joint);

/// Its number, rad or m; throws InputError where it is missing.
double measured_at(const YamlNode& map, const std::string& stem, JointType joint);
/// The same, 0 where it is missing.
double measured_or_zero(const YamlNode& map, const std::string& stem, JointType joint);

}  // namespace demecal::inline yaml
