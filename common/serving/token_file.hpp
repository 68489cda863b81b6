// The file that says which users there are, and by which tokens they show who they are.
#pragma once

#include <map>
#include <string>

namespace demecal::inline serving {

/// Tokens by users, from lines `NAME TOKEN`; empty lines and those that begin with # say nothing. Throws InputError
/// with file and line, and never with a token, where a name or token is none or stands twice, or where there is no
/// user.
std::map<std::string, std::string> parse_tokens(const std::string& text, const std::string& file);

}  // namespace demecal::inline serving
