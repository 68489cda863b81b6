// The certificate as a page to print and sign.
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

}  // namespace demecal::inline certificate
