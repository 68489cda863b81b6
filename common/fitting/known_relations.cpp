#include "fitting/known_relations.hpp"

#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace demecal::inline fitting {
namespace {

class RelationCollector {
 public:
  RelationCollector(const ParameterSpace& space, const ModelPoint& point) : space_(space), point_(point) {
    for (int i = 0; i < space.size(); ++i) {
      const ParameterId& id = space.ids()[static_cast<std::size_t>(i)];
      if (id.kind == ParameterId::Kind::contact) columns_[{id.target, id.set}][id.index] = i;
    }
  }

  void add(const KnownDistance& known) {
    const std::vector<PoseSet> sets = sets_with(known.first, known.second);
    for (const PoseSet set : sets) {
      const double sigma = known.sigma_m * std::sqrt(static_cast<double>(sets.size()));
      const Eigen::Vector3d apart = place(known.first, set).frame.translation() -  //
                                    place(known.second, set).frame.translation();
      const Eigen::Vector3d along = apart.stableNormalized();
      Eigen::VectorXd row = Eigen::VectorXd::Zero(space_.size());
      add_shift(row, {known.first, set}, -along / sigma);
      add_shift(row, {known.second, set}, along / sigma);
      push((known.length_m - apart.norm()) / sigma, row);
    }
  }

  void add(const KnownAngle& known) {
    const std::vector<PoseSet> sets = sets_with(known.first, known.second);
    for (const PoseSet set : sets) {
      const double sigma = known.sigma_rad * std::sqrt(static_cast<double>(sets.size()));
      const Eigen::Matrix3d first = place(known.first, set).frame.linear();
      const Eigen::Vector3d other = place(known.second, set).frame.linear().col(2);
      // Square: the normals' product is zero. Parallel: the other lies along neither axis across the first.
      for (const int axis : known.square ? std::vector<int>{2} : std::vector<int>{0, 1}) {
        const Eigen::Vector3d own = first.col(axis);
        Eigen::VectorXd row = Eigen::VectorXd::Zero(space_.size());
        add_turn(row, {known.first, set}, own, other, -1.0 / sigma);
        add_turn(row, {known.second, set}, other, own, -1.0 / sigma);
        push(-own.dot(other) / sigma, row);
      }
    }
  }

  RelationRows rows() const {
    RelationRows all{Eigen::VectorXd(std::ssize(residuals_)), Eigen::MatrixXd(std::ssize(residuals_), space_.size())};
    for (std::size_t i = 0; i < residuals_.size(); ++i) {
      all.residual[static_cast<Eigen::Index>(i)] = residuals_[i];
      all.jacobian.row(static_cast<Eigen::Index>(i)) = jacobian_[i].transpose();
    }
    return all;
  }

 private:
  std::vector<PoseSet> sets_with(const std::string& first, const std::string& second) const {
    std::vector<PoseSet> sets;
    for (const PoseSet set : {PoseSet::calibration, PoseSet::validation, PoseSet::accept})
      if (columns_.contains({first, set}) && columns_.contains({second, set})) sets.push_back(set);
    return sets;
  }

  const ContactPlace& place(const std::string& contact, PoseSet set) const {
    return point_.robot.contacts.at({contact, set});
  }

  void add_shift(Eigen::VectorXd& row, const ContactGroup& group, const Eigen::Vector3d& slope) const {
    const Eigen::Matrix3d& axes = point_.robot.contacts.at(group).frame.linear();
    for (const auto& [motion, column] : columns_.at(group))
      if (motion < 3) row[column] += slope.dot(axes.col(motion));
  }

  /// The product of a direction of the place and a vector that stays.
  void add_turn(Eigen::VectorXd& row, const ContactGroup& group, const Eigen::Vector3d& direction,
                const Eigen::Vector3d& fixed, double factor) const {
    const auto turned = point_.contact_turns.find(group);
    const Eigen::Vector3d turn = turned == point_.contact_turns.end() ? Eigen::Vector3d::Zero() : turned->second;
    for (const auto& [motion, column] : columns_.at(group)) {
      if (motion < 3 || motion == kRadiusMotion) continue;
      row[column] += factor * turn_axis(point_.robot.contacts.at(group), motion, turn).cross(direction).dot(fixed);
    }
  }

  void push(double residual, Eigen::VectorXd row) {
    residuals_.push_back(residual);
    jacobian_.push_back(std::move(row));
  }

  const ParameterSpace& space_;
  const ModelPoint& point_;
  std::map<ContactGroup, std::map<int, int>> columns_;  ///< by motion
  std::vector<double> residuals_;
  std::vector<Eigen::VectorXd> jacobian_;
};

}  // namespace

RelationRows relation_rows(const DataSet& data, const ParameterSpace& space, const ModelPoint& point) {
  if (data.contacts.distances.empty() && data.contacts.angles.empty())
    return {Eigen::VectorXd(0), Eigen::MatrixXd(0, space.size())};
  RelationCollector collector(space, point);
  for (const KnownDistance& known : data.contacts.distances) collector.add(known);
  for (const KnownAngle& known : data.contacts.angles) collector.add(known);
  return collector.rows();
}

}  // namespace demecal::inline fitting
