// What whoever signs a certificate should know, in sentences.
#pragma once

#include <string>
#include <vector>

#include "acceptance/certificate.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"

namespace demecal::inline acceptance {

/// As beyond_radii_sentence() of poses, of those that the certificate judges. Empty where they keep to their radii.
std::string beyond_radii_sentence(const Certificate& certificate);

/// Of a certificate whose figures are there: what limits them, and what was noted beforehand (run.notes).
std::vector<std::string> remarks_on(const Certificate& certificate, const CalibratedModel& model, const DataSet& data,
                                    const CertifiedRun& run);

}  // namespace demecal::inline acceptance
