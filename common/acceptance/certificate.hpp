// The document of an acceptance: all that the certificate states, in whichever form it is written.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "acceptance/iso9283.hpp"
#include "acceptance/verdict.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/certificate_fields.hpp"
#include "data/data_set.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/evaluation.hpp"
#include "report/report.hpp"

namespace demecal::inline acceptance {

/// What the calibration cannot know of itself.
struct CertifiedRun {
  CertificateFields fields;
  double tolerance_m = 0.0;
  std::string today;                 ///< YYYY-MM-DD, of the run
  std::string model_sha256;          ///< of the bytes of the model file
  bool refit_base = false;           ///< base and tool are fitted to the poses that are not judged first
  bool sets_stated = true;           ///< the data say which set every pose is of; otherwise that was drawn
  std::vector<std::string> notes{};  ///< what was found of data and fields beforehand, sentences: they become remarks
};

/// A quantity of the conditions under which was measured, over the judged poses.
struct Condition {
  std::string name;
  std::optional<double> lower, upper;  ///< none: not recorded
  std::string unit;
};

struct CertifiedPose {
  std::string id, target;
  std::size_t measurements = 0;
  std::optional<double> before_mm{}, after_mm{}, uncertainty_mm{};  ///< AP before and after; radius of 95 % at the pose
  bool beyond = false;                                              ///< the tolerance
  std::string approach{};                                           ///< as of AttainedPose
  std::optional<double> single_mm{};                                ///< 95 % of its measurements err by no more; after
  std::optional<double> payload_kg{}, temperature_celsius{};        ///< of the first of its measurements
};

/// What the picture shows, in the frame of the measurements, m.
struct CertifiedView {
  std::vector<Eigen::Vector3d> arm{};                          ///< joint by joint to the tool, at one of the poses
  std::vector<std::pair<Eigen::Vector3d, double>> points_m{};  ///< judged, with the error there
};

/// What is judged, as the certificate names it: positions that an instrument saw, unless poses only touch something.
struct JudgedWords {
  std::string quantity = "position error", poses = "poses", of_one = "AP";
};
inline const JudgedWords kJudgedLengths{"error of lengths between touched points", "pairs of poses", "length error"};

struct Certificate {
  CertificateFields fields;
  std::vector<std::string> missing{};     ///< titles of fields that are expected and not stated
  std::string robot, job, model_version;  ///< of the model; `robot` as stated, or as its file names it
  std::string version;                    ///< of this program
  std::string data_name, data_sha256, model_sha256, model_data_sha256;
  std::string measured_on, issued_on;  ///< YYYY-MM-DD
  bool date_is_of_run = false;         ///< nobody stated when was measured
  std::string judged_set;              ///< "accept", "validation", "calibration"
  std::size_t judged_rows = 0;
  JudgedWords words{};
  std::vector<Condition> conditions;
  SetErrors before{}, after{};  ///< over the judged rows
  std::string before_words{};
  std::vector<Characteristic> characteristics{};
  Judgement judgement{};
  std::optional<std::size_t> poses_to_decide{};  ///< in all, where it is undecided and a number of them would
  std::vector<CertifiedPose> poses{};            ///< the largest error first
  std::optional<UncertaintyEntry> uncertainty{};
  std::vector<std::string> remarks{};  ///< what whoever signs should know
  CertifiedView view{};
};

/// Frames' origins from the base over every joint to the flange and the tool, in the frame of the measurements, m.
std::vector<Eigen::Vector3d> arm_points(const CorrectedRobot& robot, const MeasuredPose& pose);

/// The poses judged: accept poses; without any validation poses, and so on.
std::vector<std::size_t> judged_poses(const DataSet& data);

/// So many poses tell base and tool.
inline constexpr std::size_t kFewestPlacingPoses = 4;
/// Poses that are not judged, by which the arm can be placed: calibration poses or, where those are judged or too few,
/// validation poses. None where there are too few of either.
std::vector<std::size_t> placing_poses(const DataSet& data);

/// The robot with base and tool fitted to placing_poses() or, where there are none, to the judged ones. Throws
/// InputError where they cannot be fitted.
CorrectedRobot refitted(const DataSet& data, const DeclaredModel& base_and_tool, const CorrectedRobot& robot);

/// Whether the data are those that the model was calibrated with, or one of the stations of these.
bool is_calibrated_with(const CalibratedModel& model, const DataSet& data);

/// "the model was made from some of these very poses (P1, P7, ...)": of these rows of other data; empty where it is not
/// known of any.
std::string known_poses_sentence(const CalibratedModel& model, const DataSet& data, std::span<const std::size_t> rows);

/// What a certificate of `data` states: `of_data`, and what the model's job stated beside. Of other data than the
/// model's own nothing that belongs to the day of a measurement is taken from there; what is taken is noted.
CertificateFields stated_fields(const CertificateFields& of_data, const CalibratedModel& model, const DataSet& data,
                                std::vector<std::string>& notes);

/// Judges the positions that were measured or, where the judged poses only touch something, the known lengths between
/// what they touch; of data other than the model's own that state no sets, all poses, unless some of them have to tell
/// base and tool (run.refit_base). Throws InputError where the data hold no pose with an error to judge, and where base
/// and tool are to be fitted and there are no poses for that.
Certificate make_certificate(const CalibratedModel& model, const DataSet& data, const CertifiedRun& run);

/// "proved within 0.2 mm ..." in one sentence for whoever reads only one.
std::string verdict_sentence(const Certificate& certificate);
/// What more would decide; empty where it is decided.
std::string remedy_sentence(const Certificate& certificate);

/// One JSON object on one line with `demecal_certificate: 1`.
std::string to_json(const Certificate& certificate);

}  // namespace demecal::inline acceptance
