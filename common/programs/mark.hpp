// The comment by which a corrected program is known, so that none is corrected twice.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "programs/program.hpp"

namespace demecal {

/// "corrected by demecal VERSION with the model of JOB (data SHA)": the same for the same model.
std::string mark_of(const std::string& version, const std::string& job, const std::string& data_sha256);

/// The text with the mark as a comment line of its own where the language allows one: first of all in URScript and CSV,
/// behind the header of the module or program elsewhere. Line breaks are those of the text.
std::string with_mark(const std::string& text, Language language, const std::string& mark);

/// The line (from 1) that holds a mark, in any language.
std::optional<std::size_t> marked_line(std::string_view text);

}  // namespace demecal
