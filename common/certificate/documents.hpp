// The certificate as a page to print and sign, and for machines: PTB's Digital Calibration Certificate, schema 3.2.1,
// with quantities of SI Format 2.1.
#pragma once

#include <string>

#include "acceptance/certificate.hpp"

namespace demecal::inline certificate {

/// A self-contained HTML page without scripts, laid out for paper: page numbers, a place for signatures, no colour that
/// a meaning depends on. Fields that nobody stated are left blank, and named.
std::string certificate_html(const Certificate& certificate);

/// The arm and the measured positions in two views (from above and from the side), points coloured by their error. SVG;
/// empty where no position was measured.
std::string volume_picture(const CertifiedView& view, double tolerance_m);

/// An XML document in UTF-8. The schema forbids empty texts: what nobody stated reads "not stated", a country that
/// nobody stated is ZZ (ISO 3166 leaves it to users), and a date that nobody stated is the document's.
std::string dcc_xml(const Certificate& certificate);

/// The document with a place at its end for a signature by an RSA key (SHA-256) over all of it, which a signer fills in
/// with the certificate of the key.
std::string with_empty_signature(std::string xml);

}  // namespace demecal::inline certificate
