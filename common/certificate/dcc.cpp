#include "acceptance/certificate.hpp"
#include "acceptance/iso9283.hpp"
#include "acceptance/verdict.hpp"
#include "certificate/documents.hpp"
#include "data/certificate_fields.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "certificate/dcc_results.hpp"
#include "certificate/xml.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline certificate {
namespace {

class DccWriter : private DccResults {
 public:
  using DccResults::DccResults;

  std::string document() {
    xml_.open("dcc:digitalCalibrationCertificate");
    xml_.attribute("xmlns:dcc", "https://ptb.de/dcc");
    xml_.attribute("xmlns:si", "https://ptb.de/si");
    xml_.attribute("schemaVersion", "3.2.1");
    xml_.element("dcc:administrativeData", [&] { administrative_data(); });
    xml_.element("dcc:measurementResults",
                 [&] { xml_.element("dcc:measurementResult", [&] { measurement_result(); }); });
    xml_.close();
    return xml_.text();
  }

 private:
  void administrative_data() {
    xml_.element("dcc:dccSoftware", [&] { software(); });
    xml_.element("dcc:coreData", [&] { core_data(); });
    xml_.element("dcc:items", [&] { xml_.element("dcc:item", [&] { item(); }); });
    xml_.element("dcc:calibrationLaboratory", [&] { contact("dcc:contact", "laboratory", "laboratory_address"); });
    xml_.element("dcc:respPersons", [&] {
      xml_.element("dcc:respPerson", [&] {
        xml_.element("dcc:person", [&] { named("dcc:name", stated("operator")); });
        xml_.leaf("dcc:role", "operator");
        xml_.leaf("dcc:mainSigner", "true");
      });
    });
    contact("dcc:customer", "customer", "customer_address");
    xml_.element("dcc:statements", [&] { statements(); });
  }

  void software() {
    xml_.element("dcc:software", [&] {
      named("dcc:name", "demecal");
      xml_.leaf("dcc:release", certificate_.version);
      xml_.leaf("dcc:type", "application");
    });
  }

  void core_data() {
    const std::string country = certificate_.fields.text("country"), number = stated("certificate_number");
    xml_.leaf("dcc:countryCodeISO3166_1", country.empty() ? "ZZ" : country);
    xml_.leaf("dcc:usedLangCodeISO639_1", "en");
    xml_.leaf("dcc:mandatoryLangCodeISO639_1", "en");
    xml_.leaf("dcc:uniqueIdentifier", number != kNotStated ? number : generated_identifier());
    xml_.element("dcc:identifications", [&] {
      identification("other", certificate_.data_sha256, "SHA-256 of the data");
      identification("other", certificate_.model_sha256, "SHA-256 of the model");
    });
    xml_.leaf("dcc:beginPerformanceDate", certificate_.measured_on);
    xml_.leaf("dcc:endPerformanceDate", certificate_.measured_on);
    xml_.leaf("dcc:performanceLocation", "other");
    xml_.leaf("dcc:issueDate", certificate_.issued_on);
  }

  std::string generated_identifier() const {
    return "demecal-" + certificate_.issued_on + "-" + certificate_.data_sha256.substr(0, 12) + "-" +
           certificate_.model_sha256.substr(0, 12);
  }

  void identification(const std::string& issuer, const std::string& value, const std::string& name) {
    xml_.element("dcc:identification", [&] {
      xml_.leaf("dcc:issuer", issuer);
      xml_.leaf("dcc:value", xml_text(value).empty() ? kNotStated : value);
      named("dcc:name", name);
    });
  }

  void item() {
    named("dcc:name", xml_text(certificate_.robot));
    if (const std::string maker = certificate_.fields.text("manufacturer"); !maker.empty())
      xml_.element("dcc:manufacturer", [&] { named("dcc:name", xml_text(maker)); });
    xml_.element("dcc:identifications",
                 [&] { identification("manufacturer", stated("serial_number"), "serial number"); });
  }

  void contact(const std::string& element, const std::string& who, const std::string& where) {
    xml_.element(element, [&] {
      named("dcc:name", stated(who));
      xml_.element("dcc:location", [&] { named("dcc:further", stated(where)); });
    });
  }

  void statement(const std::string& name, const std::string& declaration, const char* norm, const char* conformity) {
    xml_.element("dcc:statement", [&] {
      named("dcc:name", name);
      if (norm != nullptr) xml_.leaf("dcc:norm", norm);
      named("dcc:declaration", xml_text(declaration));
      if (conformity != nullptr) xml_.leaf("dcc:conformity", conformity);
    });
  }

  void statements() {
    const Conformity verdict = certificate_.judgement.verdict;
    const char* const conformity = verdict == Conformity::conformity       ? "pass"
                                   : verdict == Conformity::non_conformity ? "fail"
                                                                           : nullptr;
    statement(to_string(verdict), verdict_sentence(certificate_), "ISO 14253-1", conformity);
    if (const std::string remedy = remedy_sentence(certificate_); !remedy.empty())
      statement("what would decide", remedy, nullptr, nullptr);
    for (const std::string& remark : certificate_.remarks) statement("remark", remark, nullptr, nullptr);
    for (const std::string& title : certificate_.missing)
      statement("missing", title + ": not stated", nullptr, nullptr);
    statement("place", stated("place"), nullptr, nullptr);
    if (const std::string more = certificate_.fields.text("remarks"); !more.empty())
      statement("remark of the operator", more, nullptr, nullptr);
  }

  void measurement_result() {
    named("dcc:name", "accuracy of the calibrated robot: " + certificate_.words.quantity);
    xml_.element("dcc:usedMethods", [&] {
      xml_.element("dcc:usedMethod", [&] {
        named("dcc:name", "performance criteria of manipulating industrial robots");
        named("dcc:description", not_implemented());
        xml_.leaf("dcc:norm", "ISO 9283:1998");
      });
    });
    xml_.element("dcc:usedSoftware", [&] { software(); });
    xml_.element("dcc:measuringEquipments", [&] { xml_.element("dcc:measuringEquipment", [&] { equipment(); }); });
    xml_.element("dcc:influenceConditions", [&] { influence_conditions(); });
    xml_.element("dcc:results", [&] { results(); });
  }

  void equipment() {
    named("dcc:name", stated("instrument"));
    named("dcc:description", "calibration: " + stated("instrument_calibration"));
    xml_.element("dcc:identifications",
                 [&] { identification("manufacturer", stated("instrument_serial_number"), "serial number"); });
    if (!certificate_.fields.instrument_uncertainty_m) return;
    xml_.element("dcc:measuringEquipmentQuantities", [&] {
      xml_.element("dcc:measuringEquipmentQuantity", [&] {
        named("dcc:name", "expanded uncertainty of a position (k = 2), as stated");
        real(millimetres(*certificate_.fields.instrument_uncertainty_m), "mm");
      });
    });
  }

  void influence_conditions() {
    influence("environment", [&] { named("dcc:text", stated("environment")); });
    for (const Condition& one : certificate_.conditions) {
      influence(one.name, [&] {
        if (!one.lower || !one.upper) {
          named("dcc:text", "not recorded");
          return;
        }
        quantity("least", *one.lower, one.unit);
        quantity("largest", *one.upper, one.unit);
      });
    }
  }

  void influence(const std::string& name, const std::function<void()>& data) {
    xml_.element("dcc:influenceCondition", [&] {
      named("dcc:name", name);
      xml_.element("dcc:data", data);
    });
  }
};

}  // namespace

std::string dcc_xml(const Certificate& certificate) {
  return DccWriter(certificate).document();
}

}  // namespace demecal::inline certificate
