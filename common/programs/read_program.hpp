// Robot programs of several languages: text in, targets and where they stand out.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "programs/program.hpp"

namespace demecal {

// Every reader is a function of the text alone, and throws InputError with file, line, column, value and rule where a
// target is malformed. `arm` says how many joints a target has, and which of them slide. Letter case, white space,
// comments, CR LF and a missing last line break make no difference.

/// VAL II (thesis 6.1.1, Appendix C): all points between .LOCATIONS and .END, of any number of programs. `#name[i]` is
/// a precision point: a number per joint, in degrees (mm). Other names are transformation points: nine numbers of
/// rotation, the axes x, y, z of the tool one after the other, and three of translation: in sixteenths of a mm where
/// all are whole and the axes are not of length 1, in mm otherwise.
Program read_val2(std::string_view text, const std::string& file, const Chain& arm);

/// A table with a header: columns q1_deg .. (or joint1_deg, j1_rad, theta1_deg, a1_deg; _mm or _m where a joint
/// slides), or x_mm, y_mm, z_mm (or _m) with or without qw, qx, qy, qz; joints where there are both. s1 .., payload_kg,
/// temperature_celsius and time_s are a target's circumstances. Commas, semicolons or tabs separate.
Program read_csv_targets(std::string_view text, const std::string& file, const Chain& arm);

/// KUKA KRL: AXIS, E6AXIS, POS and E6POS, declared or in motion commands; neither frames nor relative motions.
Program read_krl(std::string_view text, const std::string& file, const Chain& arm);

/// ABB RAPID: robtarget and jointtarget, declared (arrays too) or in motion commands.
Program read_rapid(std::string_view text, const std::string& file, const Chain& arm);

/// Universal Robots URScript: what movej, movel, movep, movec, servoj and servoc are sent to, as p[...] or [...], there
/// or in the variable they name, and inside get_inverse_kin().
Program read_urscript(std::string_view text, const std::string& file, const Chain& arm);

Program read_program(Language language, std::string_view text, const std::string& file, const Chain& arm);

/// The language of a program by its file's ending or, where that is not known, by its words; nothing where neither
/// says.
std::optional<Language> language_of(std::string_view text, const std::string& file);
/// "val2", "csv", "krl", "rapid", "urscript"; nothing for any other word.
std::optional<Language> language_named(std::string_view word);
std::string_view word_of(Language language);

}  // namespace demecal
