// The style sheet of the report's page.
#pragma once

#include <string_view>

namespace demecal {

/// CSS for light and dark screens and for paper.
std::string_view page_style();

}  // namespace demecal
