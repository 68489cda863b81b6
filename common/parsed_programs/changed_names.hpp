// Names of points that a program changes while it runs, or uses otherwise than to move to them: their numbers in the
// text are not those that the robot is sent to.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline parsed_programs {

/// Every reader finds the statements that write names in its language. Letter case makes no difference. A name may have
/// indices behind it, in brackets or braces; where they are no numbers, any element may be meant.
class ChangedNames {
 public:
  /// `text` must outlive this.
  explicit ChangedNames(const ProgramText& text) : text_(text) {}

  /// The statement at `offset` of the text gives the name, or a part of it, another value.
  void changed(std::string_view name, std::size_t offset);
  /// The same, with where the arm stands when it runs: what a program that was run holds then, to be measured.
  void recorded(std::string_view name, std::size_t offset);
  /// The statement at `offset` moves to it, shifted by what sensors say when it runs; `by`: how it states that.
  void guided(std::string_view name, std::size_t offset, const std::string& by);
  /// The statement at `offset` hands the name on, or computes with it.
  void used(std::string_view name, std::size_t offset);

  /// Why the name does not hold the numbers that the text gives it; empty: it does.
  std::string why(std::string_view name) const;
  /// What guided() says of a target.
  std::string guided_sentence(std::size_t offset, const std::string& by) const;
  /// Says so of the targets.
  void mark(std::vector<Target>& targets) const;

 private:
  /// By name, then by indices.
  using Sentences = std::map<std::string, std::map<std::string, std::string>>;
  static std::string find(const Sentences& sentences, std::string_view name);
  void add(std::string_view name, const std::string& sentence, bool records);
  std::string line_of(std::size_t offset) const;

  const ProgramText& text_;
  Sentences sentences_, besides_recording_;
};

}  // namespace demecal::inline parsed_programs
