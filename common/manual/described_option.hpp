// One option or positional argument of a command line, as manual pages and completions speak of it.
#pragma once

#include <CLI/CLI.hpp>
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

}  // namespace demecal::inline manual
