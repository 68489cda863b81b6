// The results in a Digital Calibration Certificate, and the pieces that all of it is written with.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "acceptance/certificate.hpp"
#include "certificate/xml.hpp"
#include "report/report.hpp"

namespace demecal::inline certificate {

/// In place of texts that the schema wants and nobody stated.
inline constexpr const char* kNotStated = "not stated";

/// Holds on to the certificate.
class DccResults {
 public:
  explicit DccResults(const Certificate& certificate) : certificate_(certificate) {}

 protected:
  /// What the field `key` states.
  std::string stated(const std::string& key) const;
  /// An element with one text in it.
  void named(const std::string& element, const std::string& text);
  void real(double value, const std::string& unit);
  /// Where there is no value, why.
  void quantity(const std::string& name, std::optional<double> value, const std::string& unit,
                const std::string& why = "not measured");
  void results();

  const Certificate& certificate_;
  XmlDocument xml_;

 private:
  void result(const std::string& name, const std::function<void()>& data);
  void errors(const SetErrors& errors);
  void judgement();
  void uncertainty();
  void list_quantity(const std::string& name, std::optional<double> CertifiedPose::*value);
  void poses();
};

}  // namespace demecal::inline certificate
