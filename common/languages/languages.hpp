// The table of robot languages, and what is done alike with programs of each.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "kinematics/chain.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

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

/// Throws InputError where a text that was read as a program of this language holds no motion, no point and no line
/// that such programs begin with: it is none.
void require_program(const Language& language, const ProgramSource& source, const Program& program);

// The comment by which a corrected program is known, so that none is corrected twice

/// "corrected by demecal VERSION with the model of JOB (data SHA)": the same for the same model.
std::string correction_mark(const std::string& version, const std::string& job, const std::string& data_sha256);

/// The text with the mark as a comment line of its own where the language allows one: behind the first of its headers
/// or, without one, first of all. Line breaks are those of the text.
std::string with_mark(const std::string& text, const Language& language, const std::string& mark);

/// The line (from 1) that holds a mark, in any of the languages.
std::optional<std::size_t> marked_line(std::string_view text, std::span<const Language> among = all_languages());

}  // namespace demecal::inline languages
