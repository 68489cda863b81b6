// The commands that documents show, taken from their text.
#pragma once

#include <string>
#include <vector>

namespace demecal {

struct ShownCommand {
  std::string document;  ///< path in the repository
  std::size_t line = 0;
  std::string text;  ///< without the comment behind it
};

/// The documents that people are led to.
const std::vector<std::string>& documents();

/// The lines of blocks of shell commands: fenced ones, and what is indented by four spaces in documents without any
/// fence.
std::vector<ShownCommand> shown_commands(const std::string& document, const std::string& text);

/// Commands in running text: `demecal ...`, `demecal-worker ...` and `scripts/...` between backquotes.
std::vector<ShownCommand> mentioned_commands(const std::string& document, const std::string& text);

/// The words of a command that begin with two dashes, without what stands behind an equals sign.
std::vector<std::string> options_of(const ShownCommand& command);

}  // namespace demecal
