#include "fitting/base_search.hpp"

#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "fitting/base_candidates.hpp"
#include "fitting/least_squares.hpp"

namespace demecal {
namespace {

/// What base and tool alone usually leave; only the ratio between the kinds matters here.
constexpr double kLeft_m = 1e-3, kLeft_rad = 2e-3;
constexpr int kFirstIterations = 10;

/// At most `count` of the poses, spread over all: multiples of a stride that shares no divisor with their number, so
/// that targets measured in turn all occur.
std::vector<std::size_t> spread(std::span<const std::size_t> poses, std::size_t count) {
  if (poses.size() <= count) return {poses.begin(), poses.end()};
  auto stride = static_cast<std::size_t>(static_cast<double>(poses.size()) / std::numbers::phi);
  while (std::gcd(stride, poses.size()) != 1) ++stride;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(poses[(i * stride) % poses.size()]);
  return chosen;
}

/// Every tool turned as the measured orientations have it on average, given the base.
void turn_tools(CorrectedRobot& robot, const DataSet& data, const std::vector<Observation>& observations) {
  std::map<std::string, Eigen::Matrix3d> sums;
  for (const Observation& observation : observations) {
    const MeasuredPose& pose = data.poses[observation.pose];
    if (!pose.orientation) continue;
    const Eigen::Matrix3d flange =
        robot.sensor_from_base.linear() * forward(robot.chain, observation.corrected).linear();
    const Eigen::Matrix3d tool = flange.transpose() * pose.orientation->toRotationMatrix();
    sums.try_emplace(pose.target, Eigen::Matrix3d::Zero()).first->second += tool;
  }
  for (const auto& [target, sum] : sums) robot.tools.at(target).linear() = nearest_rotation(sum);
}

/// Without a tool to turn, measured orientations may be off by any fixed rotation: then only positions lead.
RowScales search_scales(const RowCounts& count, bool tool) {
  const bool lead = tool || count[kPosition] + count[kDistance] == 0;
  return {kLeft_m, lead ? kLeft_rad : 0.0, kLeft_m};
}

class Search {
 public:
  Search(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
         const CorrectedRobot& start, const FitOptions& options)
      : data_(data),
        start_(start),
        tool_(declared.tool),
        ids_(free_parameters(data, {.registration = declared.registration, .tool = declared.tool}, options)),
        observations_(observe(data, spread(poses, static_cast<std::size_t>(options.start_poses)), start)),
        scales_(search_scales(count_rows(data, observations_), tool_)) {}

  CorrectedRobot best_of(const std::vector<Eigen::Isometry3d>& bases) const {
    Placed best{start_};
    for (const Eigen::Isometry3d& base : bases) {
      Placed placed = refined(standing_at(base), kFirstIterations);
      if (placed.cost < best.cost) best = std::move(placed);
    }
    return refined(best.robot, 10 * kFirstIterations).robot;
  }

  const std::vector<Observation>& observations() const { return observations_; }

 private:
  struct Placed {
    CorrectedRobot robot;
    double cost = std::numeric_limits<double>::infinity();
  };

  CorrectedRobot standing_at(const Eigen::Isometry3d& base) const {
    CorrectedRobot robot = start_;
    robot.sensor_from_base = base;
    if (tool_) turn_tools(robot, data_, observations_);
    return robot;
  }

  Placed refined(const CorrectedRobot& robot, int iterations) const {
    const ParameterSpace space(robot, ids_);
    const LeastSquares problem{.data = data_,
                               .space = space,
                               .observations = observations_,
                               .scales = scales_,
                               .basis = Eigen::MatrixXd::Identity(space.size(), space.size()),
                               .prior = no_prior(space.size()),
                               .robust = false,
                               .max_iterations = iterations};
    const Minimum minimum = minimise(problem, Eigen::VectorXd::Zero(space.size()));
    return {space.at(minimum.change).robot, minimum.cost};
  }

  const DataSet& data_;
  const CorrectedRobot& start_;
  bool tool_;
  std::vector<ParameterId> ids_;
  std::vector<Observation> observations_;
  RowScales scales_;
};

}  // namespace

CorrectedRobot place(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                     const CorrectedRobot& start, const FitOptions& options) {
  if (options.starts == 0 || !(declared.registration || declared.tool)) return start;
  CorrectedRobot without_effects = start;
  without_effects.effects.clear();
  const Search search(data, poses, declared, without_effects, options);
  std::vector<Eigen::Isometry3d> bases{start.sensor_from_base};
  if (declared.registration && data.frame == Frame::sensor) {
    const auto others = base_candidates(data, search.observations(), without_effects, options.starts);
    bases.insert(bases.end(), others.begin(), others.end());
  }
  CorrectedRobot placed = search.best_of(bases);
  placed.effects = start.effects;
  return placed;
}

}  // namespace demecal
