// The poses that touch contacts, where they have these, and how far off each is, whatever the place leans on it.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {

class TouchedContacts {
 public:
  using Groups = std::map<ContactGroup, std::vector<std::size_t>>;

  /// `robot` predicts the tool. Poses from where a contact moved are a group of their own.
  TouchedContacts(const DataSet& data, const CorrectedRobot& robot, const std::vector<MovedContact>& moved);

  /// Of all poses, those left out too.
  const Groups& groups() const { return groups_; }
  const DataSet& data() const { return data_; }
  ContactKind kind_of(const ContactGroup& group) const { return data_.contacts.form_of(group.contact).kind; }

  /// The contact as sentences name it.
  static std::string name_of(const ContactGroup& group);

  void leave_out(std::size_t pose) { left_out_.insert(pose); }
  /// Those of the group that are not left out, `without` neither.
  std::vector<std::size_t> kept(const ContactGroup& group, std::optional<std::size_t> without = std::nullopt) const;

  /// Where the kept poses have the contact; of points the median along each axis, which few cannot move.
  ContactPlace place(const ContactGroup& group, std::optional<std::size_t> without = std::nullopt) const;
  double distance_m(const ContactPlace& place, std::size_t pose) const;
  /// How far a kept pose is from where the others have the contact.
  double distance_m(const ContactGroup& group, std::size_t pose) const { return distance_m(place(group, pose), pose); }

  /// How far each kept pose is off its contact, over how much more or less than its own error this shows: all then
  /// scatter alike, however few they are and however far out on a plane. Less by what its surface is uneven by. 0 of
  /// poses whose errors hardly show.
  std::vector<double> errors_m(const ContactGroup& group, std::optional<std::size_t> without = std::nullopt) const;

  /// Errors beyond this are no noise, judged by all that are kept.
  double far_m() const;

 private:
  std::vector<Touch> touches_at(const std::vector<std::size_t>& poses) const;
  ContactPlace place_of(const ContactGroup& group, const std::vector<std::size_t>& poses) const;

  const DataSet& data_;
  Groups groups_;
  std::vector<Touch> touches_;
  std::set<std::size_t> left_out_;
};

/// Planes whose calibration touches scatter about them (rms) by three times as much and more as those of the other
/// contacts do (median), as errors_m() has it. `robot` predicts the tool.
std::vector<Finding> find_uneven_planes(const TouchedContacts& touched, const CorrectedRobot& robot);

}  // namespace demecal::inline data_check
