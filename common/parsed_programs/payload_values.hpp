// Kilograms that a program's statements and declarations of loads hold. `code` is the program in small letters, without
// lines that are comments.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace demecal::inline parsed_programs {

/// The number, 0 or more, that stands at or behind blanks at `at` as an argument of its own; nothing where something
/// else does, an expression among it.
std::optional<double> number_argument(std::string_view code, std::size_t at);

/// The name that begins at or behind blanks at `at`, with the number in brackets that may follow it: "load_data[1]".
std::string_view load_name(std::string_view code, std::size_t at);

/// The mass of the load of this name, where the only place that gives it numbers is `sign` and a list that begins with
/// `opening`: {"=", "{m "} or {":=", "["}. Nothing where it is given otherwise, several times or not at all.
std::optional<double> declared_load_kg(std::string_view code, std::string_view name, std::string_view sign,
                                       std::string_view opening);

}  // namespace demecal::inline parsed_programs
