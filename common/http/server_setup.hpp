// What the servers of this program have in common: where they listen, and what every answer carries.
#pragma once

#include <httplib.h>

#include <string>

#include "http/access.hpp"

namespace demecal::inline http {

/// Nothing may be fetched from elsewhere, no page may frame this one, and nothing is kept.
const httplib::Headers& strict_headers();

/// Answers with a sentence and ends the connection.
void refuse(httplib::Response& response, int status, const std::string& why);

/// What this machine calls itself; empty where it has no name.
std::string name_of_machine();

/// Binds the server there, to this port alone, and states which one was chosen. Throws InputError where it cannot.
void bind(httplib::Server& server, Endpoint& endpoint);

}  // namespace demecal::inline http
