
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "manual/manual.hpp"

namespace demecal::inline manual {
namespace {

std::string function_name(const CLI::App& program) {
  std::string name = "_" + program.get_name();
  for (char& letter : name) {
    if (letter == '-') letter = '_';
  }
  return name;
}

/// In single quotes of a shell.
std::string shell_text(const std::string& text) {
  std::string safe = "'";
  for (const char letter : text) safe += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return safe + "'";
}

std::string spaced(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string option_words(const CLI::App& command) {
  std::vector<std::string> words;
  for (const DescribedOption& option : described_options(command)) {
    if (!option.positional) words.insert(words.end(), option.names.begin(), option.names.end());
  }
  return spaced(words);
}

/// Cases of bash that set `choices` behind an option with a fixed set of values.
std::string choice_cases(const CLI::App& command, const std::string& name) {
  std::string cases;
  for (const DescribedOption& option : described_options(command)) {
    if (option.positional || option.choices.empty()) continue;
    for (const std::string& word : option.names) {
      cases += "    " + name + ":" + word + ") choices=" + shell_text(spaced(option.choices)) + " ;;\n";
    }
  }
  return cases;
}

/// A specification of zsh's _arguments: '--out[folder for the results]:TEXT:_files'.
std::string zsh_argument(const DescribedOption& option) {
  std::string description;
  for (const char letter : option.description) {
    if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') description += '\\';
    description += letter;
  }
  const std::string action = option.choices.empty() ? "_files" : "(" + spaced(option.choices) + ")";
  const std::string value = option.value.empty() ? "" : ":" + option.value + ":" + action;
  if (option.positional) return "    " + shell_text(":" + option.names.front() + ":" + action) + " \\\n";
  std::string lines;
  for (const std::string& name : option.names)
    lines += "    " + shell_text(name + "[" + description + "]" + value) + " \\\n";
  return lines;
}

std::string zsh_arguments(const CLI::App& command) {
  std::string lines = "_arguments \\\n";
  for (const DescribedOption& option : described_options(command)) lines += zsh_argument(option);
  return lines + "    && return 0\n";
}

/// In single quotes of fish, in which a backslash escapes.
std::string fish_text(const std::string& text) {
  std::string safe = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') safe += '\\';
    safe += letter;
  }
  return safe + "'";
}

/// Lines of fish that complete the command's options where `condition` holds.
std::string fish_options(const CLI::App& command, const std::string& beginning) {
  std::string lines;
  for (const DescribedOption& option : described_options(command)) {
    if (option.positional && option.choices.empty()) continue;  // names of files, as everywhere
    lines += beginning;
    for (const std::string& name : option.names) {
      if (!option.positional) lines += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (!option.positional && !option.value.empty()) lines += " -r";
    if (!option.choices.empty()) lines += " -f -a " + fish_text(spaced(option.choices));
    lines += " -d " + fish_text(option.description) + "\n";
  }
  return lines;
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  const std::string function = function_name(program);
  std::string cases = choice_cases(program, ""), words;
  for (const CLI::App* command : program.get_subcommands({})) {
    cases += choice_cases(*command, command->get_name());
    words += "    " + command->get_name() + ") options=" + shell_text(option_words(*command)) + " ;;\n";
  }
  const std::string names = spaced(command_names(program));
  return "# bash completion of " + program.get_name() + "\n" + function +
         "() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command= choices= "
         "options=\n" +
         (names.empty() ? std::string() : "  [[ $COMP_CWORD -eq 1 ]] || command=${COMP_WORDS[1]}\n") +
         "  case \"$command:$previous\" in\n" + cases +
         "    *) ;;\n"
         "  esac\n"
         "  case \"$command\" in\n" +
         words + "    *) options=" + shell_text(option_words(program)) +
         " ;;\n"
         "  esac\n"
         "  COMPREPLY=()\n"
         "  if [[ -n $choices ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$choices\" -- \"$current\")\n"
         "  elif [[ $current == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n" +
         (names.empty() ? std::string()
                        : "  elif [[ $COMP_CWORD -eq 1 ]]; then\n"
                          "    mapfile -t COMPREPLY < <(compgen -W " +
                              shell_text(names) + " -- \"$current\")\n") +
         "  fi\n"
         "}\n"
         "complete -o bashdefault -o default -F " +
         function + " " + program.get_name() + "\n";
}

std::string zsh_completion(const CLI::App& program) {
  std::string script = "#compdef " + program.get_name() + "\n";
  if (command_names(program).empty()) return script + zsh_arguments(program);
  script += "if (( CURRENT == 2 )); then\n  local -a commands=(\n";
  for (const CLI::App* command : program.get_subcommands({}))
    script += "    " + shell_text(command->get_name() + ":" + command->get_description()) + "\n";
  script +=
      "  )\n"
      "  _describe command commands\n"
      "  " +
      zsh_arguments(program) +
      "  return\n"
      "fi\n"
      "local command=$words[2]\n"
      "shift words\n"
      "(( CURRENT-- ))\n"
      "case $command in\n";
  for (const CLI::App* command : program.get_subcommands({}))
    script += "  " + command->get_name() + ")\n    " + zsh_arguments(*command) + "    ;;\n";
  return script + "esac\n";
}

std::string fish_completion(const CLI::App& program) {
  const std::string name = program.get_name(), complete = "complete -c " + name;
  std::string script = "# fish completion of " + name + "\n";
  if (command_names(program).empty()) return script + fish_options(program, complete);
  const std::string function = "_" + function_name(program) + "_command_is";
  script += "function " + function +
            "\n"
            "  set -l words (commandline -opc)\n"
            "  test \"$words[2]\" = \"$argv[1]\"\n"
            "end\n";
  const std::string first = complete + " -n '" + function + " \"\"'";
  script += fish_options(program, first);
  for (const CLI::App* command : program.get_subcommands({})) {
    script += first + " -f -a " + command->get_name() + " -d " + fish_text(command->get_description()) + "\n";
    script += fish_options(*command, complete + " -n '" + function + " " + command->get_name() + "'");
  }
  return script;
}

}  // namespace demecal::inline manual
