// The robot languages: how each is recognised, read, written and commented, one row a language.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinematics/chain.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// One stop of a program that is written.
struct ProgrammedStop {
  std::string name;    ///< a letter, then letters and digits
  JointVector joints;  ///< rad or m
  bool waits = false;  ///< until an operator lets the program go on, for something is measured here
};

/// The joints in degrees and mm (to 0.0001), each with its name before it where there are names, separated so.
std::string joints_text(const Chain& arm, const JointVector& joints, std::string_view separator,
                        const std::vector<std::string>& names = {});
/// The same in rad and m, to 1e-8.
std::string joints_text_si(const JointVector& joints, std::string_view separator);

/// "A1", "A2", ... as many as the arm has joints.
std::vector<std::string> numbered_names(std::string_view stem, int count);

/// Whether targets of six joints can be of this arm, all of them revolute.
bool has_six_revolute_joints(const Chain& arm);

/// What correction needs to know of a language. It is defined in the language's own file and listed in languages.cpp;
/// nothing else knows one language from another. Corrected numbers replace the bytes of the old ones.
struct Language {
  std::string_view name;                          ///< for --language and in results; small letters
  std::string_view title;                         ///< as people call it
  std::vector<std::string_view> file_endings{};   ///< in small letters, without the point
  std::vector<std::string_view> signs{};          ///< what only this language's programs hold, in small letters
  std::vector<std::string_view> other_endings{};  ///< endings of another language's, where a text has one of the signs
  std::string_view comment = "#";                 ///< begins a line that is a comment
  std::string_view comment_end{};                 ///< what a comment must end with; empty: the end of its line
  std::size_t longest_comment = 1000;             ///< letters that a comment may have; longer ones take several lines
  std::vector<std::string_view> headers{};  ///< how lines begin, in small letters, that comments must stand behind
  /// Whether a program may be several files, read as one text.
  bool of_several_files = false;
  /// The ending of the file of the same name that usually belongs to a program of this ending: {"src", "dat"}.
  std::vector<std::pair<std::string_view, std::string_view>> companions{};
  /// A function of its input alone. Throws InputError with file, line, column, value and rule where a target is
  /// malformed; what cannot be known it says in Target::frames or Program::uncorrected, and never guesses. The arm says
  /// how many joints a target has, and which of them slide. Letter case, white space, comments, CR LF and a missing
  /// last line break make no difference.
  Program (*read)(const ReaderInput& input) = nullptr;
  /// A program that drives to stops given by joints, each joint on its own, and waits where they say; empty where the
  /// language has no targets of such an arm's joints. None: nothing writes programs in it.
  std::string (*write)(std::span<const ProgrammedStop> stops, const Chain& arm) = nullptr;
};

/// All languages, in the order in which programs are searched for their signs.
std::span<const Language> all_languages();

/// The one of this name in any letter case; null where there is none.
const Language* find_language(std::string_view name, std::span<const Language> among = all_languages());
/// That of a program by its file's ending or, where that is not known, by its signs; null where neither says.
const Language* recognize_language(std::string_view text, const std::string& file,
                                   std::span<const Language> among = all_languages());

/// The file ending of programs that `write` makes.
std::string_view written_ending(const Language& language);

/// Reads the files of a program as one. Targets whose name stands in several of its files are not corrected: which of
/// them a motion means depends on scopes that are not followed.
Program read_program(const Language& language, const ProgramSource& source, const Chain& arm,
                     const ControllerData& controller = {});
Program read_program(const Language& language, std::string_view text, const std::string& file, const Chain& arm);

// The comment by which a corrected program is known, so that none is corrected twice

/// "corrected by demecal VERSION with the model of JOB (data SHA)": the same for the same model.
std::string correction_mark(const std::string& version, const std::string& job, const std::string& data_sha256);

/// The text with the mark as a comment line of its own where the language allows one: behind the first of its headers
/// or, without one, first of all. Line breaks are those of the text.
std::string with_mark(const std::string& text, const Language& language, const std::string& mark);

/// The line (from 1) that holds a mark, in any of the languages.
std::optional<std::size_t> marked_line(std::string_view text, std::span<const Language> among = all_languages());

}  // namespace demecal::inline languages
