// A value in a YAML file that knows where it stands, read strictly.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "errors/input_error.hpp"

namespace demecal {

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
  const YamlNode& of_version(const std::string& kind, int version) const;
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
  bool truth() const;

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

}  // namespace demecal
