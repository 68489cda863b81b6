#include "shown_commands.hpp"

#include <algorithm>
#include <regex>
#include <sstream>

namespace demecal {
namespace {

/// Without a comment and the spaces before it.
std::string command_of(const std::string& line) {
  const std::size_t comment = line.find(" #");
  std::string text = line.substr(0, comment);
  text.erase(text.find_last_not_of(' ') + 1);
  text.erase(0, text.find_first_not_of(' '));
  return text;
}

}  // namespace

const std::vector<std::string>& documents() {
  static const std::vector<std::string> all = {"README.md",          "docs/ARCHITECTURE.md", "docs/CONTRIBUTING.md",
                                               "docs/EVALUATION.md", "docs/FORMATS.md",      "docs/GUIDE.md",
                                               "scripts/README.md",  "configs/dds/README.md"};
  return all;
}

std::vector<ShownCommand> shown_commands(const std::string& document, const std::string& text) {
  const bool fenced = text.find("```") != std::string::npos;
  std::vector<ShownCommand> commands;
  std::istringstream lines(text);
  bool shell = false;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with("```")) {
      shell = line == "```sh";
      continue;
    }
    const bool shown = fenced ? shell : line.starts_with("    ");
    const std::string command = shown ? command_of(line) : "";
    if (!command.empty()) commands.push_back({document, number, command});
  }
  return commands;
}

std::vector<ShownCommand> mentioned_commands(const std::string& document, const std::string& text) {
  static const std::regex span("`((demecal|demecal-worker|scripts/[a-z0-9-]+)( [^`]*)?)`");
  std::vector<ShownCommand> commands;
  for (std::sregex_iterator match(text.begin(), text.end(), span), end; match != end; ++match) {
    const auto line = static_cast<std::size_t>(std::count(text.begin(), text.begin() + match->position(), '\n')) + 1;
    commands.push_back({document, line, std::regex_replace((*match)[1].str(), std::regex("\n *"), " ")});
  }
  return commands;
}

std::vector<std::string> options_of(const ShownCommand& command) {
  static const std::regex option("(^|[ \\[])(--[a-z][a-z0-9-]*)");
  std::vector<std::string> options;
  for (std::sregex_iterator match(command.text.begin(), command.text.end(), option), end; match != end; ++match)
    options.push_back((*match)[2].str());
  return options;
}

}  // namespace demecal
