// What a certificate states and no measurement shows: for whom, with what, by whom, when and where.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

namespace demecal::inline data {

struct CertificateField {
  const char* key;    ///< under `certificate:`
  const char* title;  ///< for people
  bool expected;      ///< a certificate without it says that it is missing
};

inline constexpr std::array<CertificateField, 17> kCertificateFields{
    {{"certificate_number", "Certificate number", true},
     {"customer", "Customer", true},
     {"customer_address", "Address of the customer", false},
     {"laboratory", "Calibration laboratory", true},
     {"laboratory_address", "Address of the laboratory", false},
     {"country", "Country of the laboratory (ISO 3166-1, two letters)", false},
     {"robot", "Robot", false},
     {"manufacturer", "Manufacturer of the robot", false},
     {"serial_number", "Serial number of the robot", true},
     {"instrument", "Measuring instrument", true},
     {"instrument_serial_number", "Serial number of the instrument", false},
     {"instrument_calibration", "Calibration of the instrument", true},
     {"operator", "Operator", true},
     {"date", "Date of measurement", true},
     {"place", "Place", true},
     {"environment", "Environment", true},
     {"remarks", "Remarks", false}}};

struct CertificateFields {
  std::map<std::string, std::string> texts{};        ///< by key; none is empty
  std::optional<double> instrument_uncertainty_m{};  ///< expanded, k = 2, of a measured position

  /// Empty where it is not stated.
  std::string text(const std::string& key) const {
    const auto found = texts.find(key);
    return found == texts.end() ? std::string() : found->second;
  }
  bool empty() const { return texts.empty() && !instrument_uncertainty_m; }

  bool operator==(const CertificateFields&) const = default;
};

/// `above` where it states a field, `below` elsewhere.
inline CertificateFields merged(CertificateFields above, const CertificateFields& below) {
  above.texts.insert(below.texts.begin(), below.texts.end());
  if (!above.instrument_uncertainty_m) above.instrument_uncertainty_m = below.instrument_uncertainty_m;
  return above;
}

}  // namespace demecal::inline data
