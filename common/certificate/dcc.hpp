// The certificate for machines: PTB's Digital Calibration Certificate, schema 3.2.1, with quantities of SI Format 2.1.
#pragma once

#include <string>

#include "acceptance/certificate.hpp"

namespace demecal::inline certificate {

/// An XML document in UTF-8. The schema forbids empty texts: what nobody stated reads "not stated", a country that
/// nobody stated is ZZ (ISO 3166 leaves it to users), and a date that nobody stated is the document's.
std::string dcc_xml(const Certificate& certificate);

}  // namespace demecal::inline certificate
