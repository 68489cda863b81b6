
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "manual/manual.hpp"

namespace demecal::inline manual {
namespace {

/// Text as roff takes it: backslashes and hyphens as themselves, no line that begins with a control character.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '\\') {
      escaped += "\\(rs";
    } else if (letter == '-') {
      escaped += "\\-";
    } else if ((letter == '.' || letter == '\'') && (escaped.empty() || escaped.back() == '\n')) {
      escaped += std::string("\\&") + letter;
    } else {
      escaped += letter;
    }
  }
  return escaped;
}

/// "demecal: finds out ..." is the description of the program of that name.
std::string without_name(const std::string& description, const std::string& name) {
  const std::string beginning = name + ": ";
  return description.starts_with(beginning) ? description.substr(beginning.size()) : description;
}

std::string word_list(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string upper_case(std::string text) {
  for (char& letter : text) {
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  }
  return text;
}

std::string in_synopsis(const DescribedOption& option) {
  const std::string text = option.positional
                               ? "\\fI" + roff(upper_case(option.names.front())) + "\\fR"
                               : "\\fB" + roff(option.names.back()) + "\\fR \\fI" + roff(option.value) + "\\fR";
  return option.required ? text : "[" + text + "]";
}

/// What there is to say of a value beside its description, as further sentences.
std::string value_facts(const DescribedOption& option) {
  std::string facts;
  if (!option.choices.empty()) facts += "; one of " + word_list(option.choices, ", ");
  if (!option.rule.empty()) facts += "; " + option.rule;
  if (!option.standard.empty()) facts += "; default " + option.standard;
  if (!option.environment.empty()) facts += "; the environment variable " + option.environment + " sets the default";
  if (!option.excluded.empty()) facts += "; not with " + word_list(option.excluded, ", ");
  return facts;
}

std::string option_entry(const DescribedOption& option) {
  std::string names;
  for (const std::string& name : option.names) {
    names += (names.empty() ? "" : ", ") + std::string(option.positional ? "\\fI" : "\\fB") +
             roff(option.positional ? upper_case(name) : name) + "\\fR";
  }
  if (!option.positional && !option.value.empty()) names += " \\fI" + roff(option.value) + "\\fR";
  return ".TP\n" + names + "\n" + roff(option.description + value_facts(option)) + "\n";
}

std::string usage(const CLI::App& command, const std::string& words) {
  std::string text = "\\fB" + roff(words) + "\\fR";
  bool more = false;
  for (const DescribedOption& option : described_options(command)) {
    if (option.positional || option.required) {
      text += " " + in_synopsis(option);
    } else {
      more = true;
    }
  }
  if (!command_names(command).empty()) text += " \\fICOMMAND\\fR";
  return text + (more ? " [\\fIOPTION\\fR]...\n" : "\n");
}

std::string synopsis(const CLI::App& command, const std::string& words) {
  return ".SH SYNOPSIS\n" + usage(command, words);
}

/// The commands of a command, which have no pages of their own.
std::string inner_commands(const CLI::App& outer, const std::string& words) {
  std::string text;
  for (const CLI::App* command : outer.get_subcommands({})) {
    text += ".SS " + roff(words + " " + command->get_name()) + "\n" + roff(command->get_description()) + ".\n.PP\n" +
            usage(*command, words + " " + command->get_name());
    for (const DescribedOption& option : described_options(*command)) text += option_entry(option);
  }
  return text.empty() ? text : ".SH COMMANDS\n" + text;
}

std::string commands_section(const CLI::App& program) {
  std::string text;
  for (const CLI::App* command : program.get_subcommands({})) {
    text += ".TP\n\\fB" + roff(program.get_name() + "-" + command->get_name()) + "\\fR(1)\n" +
            roff(command->get_description()) + "\n";
  }
  return text.empty() ? text : ".SH COMMANDS\n" + text;
}

}  // namespace

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::string manual_page(const CLI::App& program, const std::string& command, const std::string& exit_status) {
  const CLI::App* described = command.empty() ? &program : nullptr;
  for (const CLI::App* one : program.get_subcommands({})) {
    if (one->get_name() == command) described = one;
  }
  if (described == nullptr) return "";
  const std::string name = command.empty() ? program.get_name() : program.get_name() + "-" + command;
  const std::string words = command.empty() ? name : program.get_name() + " " + command;
  std::string page = ".TH " + roff(upper_case(name)) + " 1 \"\" \"demecal " DEMECAL_VERSION "\" \"User commands\"\n";
  page += ".SH NAME\n" + roff(name) + " \\- " + roff(without_name(described->get_description(), name)) + "\n";
  page += synopsis(*described, words);
  page += command.empty() ? commands_section(program) : inner_commands(*described, words);
  page += ".SH OPTIONS\n";
  for (const DescribedOption& option : described_options(*described)) page += option_entry(option);
  page += ".SH EXIT STATUS\n" + roff(exit_status) + "\n.SH SEE ALSO\n";
  if (command.empty()) {
    page += roff(program.get_name() == "demecal" ? "demecal-worker" : "demecal") + "(1)\n";
  } else {
    page += roff(program.get_name()) + "(1)\n";
  }
  return page;
}

void add_manual(CLI::App& program, const std::string& exit_status,
                const std::function<void(const std::string&)>& print) {
  const CLI::App* app = &program;
  const auto manual = [app, exit_status, print](const std::string& command) {
    const std::string page = manual_page(*app, command == app->get_name() ? "" : command, exit_status);
    if (page.empty()) throw CLI::ValidationError("--manual", "there is no command " + command);
    print(page);
    throw CLI::Success();
  };
  const auto completion = [app, print](const std::string& shell) {
    print(shell == "bash" ? bash_completion(*app) : shell == "zsh" ? zsh_completion(*app) : fish_completion(*app));
    throw CLI::Success();
  };
  program.add_option_function<std::string>("--manual", manual, "print the manual page of a command")
      ->group("")
      ->trigger_on_parse();
  program.add_option_function<std::string>("--completion", completion, "print a script that completes commands")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->group("")
      ->trigger_on_parse();
}

}  // namespace demecal::inline manual
