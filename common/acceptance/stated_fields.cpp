#include <fmt/format.h>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "acceptance/certificate.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/certificate_fields.hpp"
#include "data/data_set.hpp"

namespace demecal::inline acceptance {

bool is_calibrated_with(const CalibratedModel& model, const DataSet& data) {
  const auto is_it = [&data](const Station& station) { return station.sha256 == data.sha256; };
  return data.sha256 == model.data_sha256 || std::ranges::any_of(model.stations, is_it);
}

CertificateFields stated_fields(const CertificateFields& of_data, const CalibratedModel& model, const DataSet& data,
                                std::vector<std::string>& notes) {
  CertificateFields of_model = model.certificate;
  if (is_calibrated_with(model, data)) return merged(of_data, of_model);
  for (const char* const of_the_day : {"certificate_number", "date", "operator", "place", "environment", "remarks"})
    of_model.texts.erase(of_the_day);
  const std::string data_serial = of_data.text("serial_number"), model_serial = of_model.text("serial_number");
  if (!data_serial.empty() && !model_serial.empty() && data_serial != model_serial)
    notes.push_back("The data are of the robot with serial number " + data_serial + ", the model is of that with " +
                    model_serial + ".");
  std::vector<std::string> taken;
  for (const CertificateField& field : kCertificateFields)
    if (of_data.text(field.key).empty() && !of_model.text(field.key).empty()) taken.emplace_back(field.title);
  if (!of_data.instrument_uncertainty_m && of_model.instrument_uncertainty_m)
    taken.emplace_back("Uncertainty of the instrument");
  if (!taken.empty())
    notes.push_back(fmt::format("The data do not state and the model's job does: {}.", fmt::join(taken, ", ")));
  return merged(of_data, of_model);
}

}  // namespace demecal::inline acceptance
