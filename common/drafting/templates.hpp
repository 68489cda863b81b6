// Commented files to begin with: every kind of file that a person writes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace demecal::inline drafting {

enum class TemplateKind { robot, dataset, job, scenario, preparation };

/// A file of that kind with every key (of scenarios the common ones), its unit and its default in comments; filled in
/// as far as the files `given` tell: tables of poses or readings, robot programs, ROBOT.yaml, DATASET.yaml. It can be
/// read as it stands where the files that it names are there. Paths in it are relative to `folder`. Throws InputError
/// where a given file is of no use or malformed.
std::string template_text(TemplateKind kind, const std::vector<std::filesystem::path>& given,
                          const std::filesystem::path& folder);

/// A calibration job for the data set of that name.
std::string first_job_text(const std::string& data_set);

/// The ROBOT.yaml of an arm imported from a URDF or an SDF, with what was assumed as comments. Paths are as in its
/// arguments. A URDF is named in it, so that it can be written anew with calibrated origins; an SDF is not.
struct ImportRequest {
  std::string file;                      ///< the URDF or SDF
  std::optional<std::string> base, tip;  ///< links
  std::string beside;                    ///< the file that the text will stand in
};
struct ImportedRobot {
  std::string text;
  std::vector<std::string> notes;
  std::string base{}, tip{};  ///< the links that the arm begins and ends at
};
ImportedRobot import_urdf(const ImportRequest& request);

}  // namespace demecal::inline drafting
