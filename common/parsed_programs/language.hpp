// What a robot language is: how its programs are recognised, read, written and commented.
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

namespace demecal::inline parsed_programs {

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

/// Whether targets of six joints can be of this arm, all of them revolute, so many rails before them and no positioner.
bool has_six_revolute_joints(const Chain& arm, int rails = 0);

/// The arm without its rails, and the joints of a stop in two: those of the rails, and those of the arm on them.
struct CarriedStop {
  Chain arm;
  JointVector rails, joints;
};
/// Of an arm of six joints that turn on rails (sliding joints before those) or none; nothing of another.
std::optional<CarriedStop> carried_stop(const Chain& arm, const JointVector& joints);
/// Where the rails stand, in mm (to 0.0001).
std::vector<std::string> rail_texts(const CarriedStop& stop);

/// How lines begin that tell the controller what the arm carries.
struct PayloadWords {
  std::string_view begin;  ///< in small letters: a word and the sign behind it, or a blank where an argument follows
  /// What it carries by the argument at `at` of the program in small letters, without lines that are comments; nothing
  /// where that is not told. None: the argument is a number by which the controller keeps it.
  std::optional<double> (*kg)(std::string_view code, std::size_t at) = nullptr;
};

/// What correction needs to know of a language. It is defined in the language's own file and listed there or by its
/// family; nothing else knows one language from another. Corrected numbers replace the bytes of the old ones.
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
  /// How lines begin, in small letters, that stand in programs of this language also where these have neither a motion
  /// nor a point.
  std::vector<std::string_view> openings{};
  std::vector<PayloadWords> payload_statements{};
  /// Whether a program may be several files, read as one text.
  bool of_several_files = false;
  /// The ending of the file of the same name that usually belongs to a program of this ending: {"src", "dat"}.
  std::vector<std::pair<std::string_view, std::string_view>> companions{};
  /// The ending of files that describe an application of such programs and lie beside them:
  /// ControllerData::applications.
  std::string_view application_ending{};
  /// A function of its input alone. Throws InputError with file, line, column, value and rule where a target is
  /// malformed; what cannot be known it says in Target::frames or Program::uncorrected, and never guesses. The arm says
  /// how many joints a target has, and which of them slide. Letter case, white space, comments, CR LF and a missing
  /// last line break make no difference.
  Program (*read)(const ReaderInput& input) = nullptr;
  /// A program that drives to stops given by joints, each joint on its own, and waits where they say; empty where the
  /// language has no targets of such an arm's joints. None: nothing writes programs in it.
  std::string (*write)(std::span<const ProgrammedStop> stops, const Chain& arm) = nullptr;
  /// Where programs are two files, of the second: the file's ending, and what it holds beside that which is written.
  std::string_view written_beside{};
  std::string (*write_beside)(std::span<const ProgrammedStop> stops) = nullptr;
};

}  // namespace demecal::inline parsed_programs
