// The contacts of recordings of joints: where the arm stood, which of the places where its tool then was are one, and
// what people should look at in them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "errors/input_error.hpp"
#include "preparation/joint_log.hpp"
#include "preparation/results.hpp"
#include "preparation/touched_places.hpp"

namespace demecal::inline preparation {

/// Recordings of one arm that touched points, and what is known of these.
struct Recordings {
  std::string name;
  std::string file;  ///< the preparation file, as named to the user; empty: there is none
  Robot robot;
  std::vector<JointLog> logs;  ///< one at least
  StandingRule standing;
  std::optional<double> gap_m{};     ///< between places that are one and those that are not
  std::vector<std::string> names{};  ///< of the contacts, in the order in which they are first touched
  std::size_t names_line = 0;        ///< in the file
  std::vector<KnownDistance> distances{};
  std::vector<std::size_t> distance_lines{};  ///< where each stands
  std::vector<std::string> assumed{};         ///< of how the logs are written; a sentence each
};

/// What a standstill turned out to be.
enum class Standing {
  touches,           ///< a pose of the data set
  too_short,         ///< less than the least time, or than three rows
  moving,            ///< the tool went on while it stood
  alone,             ///< no others, or fewer than make a contact, in its place
  one_posture,       ///< others in its place, all with the same joints: a waiting point
  between_contacts,  ///< nearly as near to another contact
  far_out            ///< far from its contact beside the others there
};
inline constexpr std::size_t kStandings = 7;
std::string_view to_string(Standing standing);

struct JudgedStandstill {
  Standstill at;
  Standing standing = Standing::alone;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();  ///< of the tool point taken, base frame, by the nominal arm
  double moved_m = 0.0;                               ///< of that while it stood
  std::optional<std::size_t> contact{};               ///< its own, or else the nearest
  double from_contact_m = 0.0;                        ///< from the mean of that contact's other poses
};

struct RecordedContact {
  std::string name;
  std::size_t poses = 0;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();  ///< mean of its poses'
  double scatter_m = 0.0;                             ///< root mean square distance from it
  std::optional<double> nearest_m{};                  ///< to the next contact
};

struct RecordedContacts {
  std::vector<LogNoise> noise;                ///< by log
  Eigen::Vector3d tool_m;                     ///< flange frame: by which most standstills agree
  std::vector<JudgedStandstill> standstills;  ///< by log, in their order
  std::vector<RecordedContact> contacts;      ///< in the order in which they are first touched
  std::vector<std::string> notes;             ///< what a person should look at; a sentence each
};

/// Throws InputError where the logs have no two contacts' worth of standstills, where joints are outside the arm's
/// limits, and where names or distances are not of the contacts found.
RecordedContacts find_contacts(const Recordings& recordings);

/// The poses that touch, named P1 onwards. Those of logs without a set are divided: of every contact with seven poses
/// or more 30 % validate, drawn with seed 1.
DataSet recorded_data_set(const Recordings& recordings, const RecordedContacts& found);

/// For a terminal; at most 100 columns but for the notes.
std::string recorded_table(const Recordings& recordings, const RecordedContacts& found);
/// One JSON object on one line, as docs/FORMATS.md says.
std::string recorded_json(const Recordings& recordings, const RecordedContacts& found,
                          const std::vector<std::string>& files);
/// "standstills.csv".
WrittenFile standstills_file(const Recordings& recordings, const RecordedContacts& found);

/// Throws InputError where names are not as many as the contacts, or a distance is between others.
void check_names(const Recordings& recordings, const RecordedContacts& found);

/// Where the grouping may be wrong, and where the tool point seems to be; `contact_of_group` has the contact that each
/// group became, if it became one.
std::vector<std::string> grouping_notes(const Recordings& recordings, const RecordedContacts& found,
                                        const PlaceGroups& groups,
                                        const std::vector<std::optional<std::size_t>>& contact_of_group);

}  // namespace demecal::inline preparation
