#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <span>
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

std::string known_poses_sentence(const CalibratedModel& model, const DataSet& data, std::span<const std::size_t> rows) {
  constexpr std::size_t kMostNamed = 3;
  if (is_calibrated_with(model, data)) return {};
  std::vector<std::string> names;
  for (const std::size_t row : marked_poses(model, data)) {
    const MeasuredPose& pose = data.poses[row];
    if (std::ranges::find(rows, row) != rows.end())
      names.push_back(pose.pose_id.empty() ? fmt::format("line {}", pose.line) : pose.pose_id);
  }
  if (names.empty()) return {};
  const bool all = names.size() <= kMostNamed;
  if (!all) names.resize(kMostNamed);
  return fmt::format("the model was made from some of these very poses ({}{})", fmt::join(names, ", "),
                     all ? "" : ", ...");
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
