// Where corrected programs are written: which files may be overwritten, and by what those are known that are as demecal
// wrote them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "parsed_programs/language.hpp"
#include "parsed_programs/program_text.hpp"
#include "programs/correct_program.hpp"

namespace demecal {

/// The text with a mark (see with_mark()) that ends with a hash of all the rest, by which is_as_written() knows it.
std::string with_sealed_mark(const std::string& text, const Language& language, const std::string& mark);
/// Whether the text has such a mark and nothing of it was changed since.
bool is_as_written(std::string_view text);

/// Throws unless `out` may be written: never a file of the program itself, by whatever name; of other files those that
/// are as this command wrote them, or any with --force. `original` is what is corrected there.
void require_writable(const std::filesystem::path& out, const ProgramFile& original,
                      const std::vector<ProgramFile>& program, bool force);

/// Writes the files of the program, those that changed with a mark.
void write_corrected(const ProgramSource& source, const CorrectedProgram& corrected, const Language& language,
                     const std::string& mark, const std::vector<std::filesystem::path>& places);

/// The files in the folders of the program that may describe its application.
std::vector<ProgramFile> applications_beside(const ProgramSource& source, const Language& language);

}  // namespace demecal
