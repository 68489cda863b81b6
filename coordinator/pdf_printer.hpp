// Pages as PDF, by a printer that happens to be installed: weasyprint or a browser without a window.
#pragma once

#include <optional>
#include <string>

namespace demecal {

/// The path of a program of PATH that can print pages; nothing where there is none.
std::optional<std::string> find_printer();

/// What the printer makes of the page of that file; nothing where it fails or takes longer than a minute.
std::optional<std::string> printed(const std::string& printer, const std::string& page_file);

}  // namespace demecal
