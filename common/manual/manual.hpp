// Manual pages and shell completion of a program, written from the definition of its command line, option by option.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace demecal::inline manual {

struct DescribedOption {
  std::vector<std::string> names;  ///< with their dashes; of a positional argument its one name
  std::string value;               ///< "TEXT", "INT"; empty: a flag
  std::string description;
  std::string rule;                  ///< what its value must be: "1 to 256", "not negative"; empty: anything
  std::vector<std::string> choices;  ///< the values it may have; empty: see `rule`
  std::string standard;              ///< its value where none is given; empty: none
  std::string environment;           ///< the variable that gives a value where none is given
  std::vector<std::string> excluded;
  bool positional = false, required = false;
};

/// The options of a command that its help lists, positional arguments first.
std::vector<DescribedOption> described_options(const CLI::App& command);

/// The names of a program's commands, in the order of its help; none where it has none.
std::vector<std::string> command_names(const CLI::App& program);

/// The manual page (roff, section 1) of `command`, or of the program itself where that is empty; no such command: an
/// empty text. `exit_status` is a sentence on exit codes. The page has no date, so that it depends on nothing else.
std::string manual_page(const CLI::App& program, const std::string& command, const std::string& exit_status);

/// A script that completes commands, options and the values of options with a fixed set of them; elsewhere names of
/// files.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);
std::string fish_completion(const CLI::App& program);

/// Adds --manual [COMMAND] and --completion SHELL, which --help does not list: each gives its text to `print`, and
/// parsing ends as it does after --help. The program's name must be set.
void add_manual(CLI::App& program, const std::string& exit_status,
                const std::function<void(const std::string&)>& print);

}  // namespace demecal::inline manual
