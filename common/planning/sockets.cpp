#include "planning/sockets.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <ranges>
#include <string>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "errors/input_error.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "planning/candidates.hpp"
#include "planning/travel.hpp"

namespace demecal::inline planning {
namespace {

/// A place for one socket, or for a block with two of them.
struct SocketBlock {
  std::vector<Eigen::Vector3d> sockets_m;  ///< base frame
  std::vector<PlannedPose> postures;       ///< `socket` counts within the block
};

constexpr std::size_t kFewestPostures = 8;  ///< of a socket worth placing
constexpr double kAnywhere_m = 1.0;         ///< what is believed of a socket's place beforehand

std::vector<Eigen::Vector3d> sockets_about(const Eigen::Vector3d& middle, const std::optional<double>& length_m) {
  if (!length_m) return {middle};
  Eigen::Vector3d across(-middle.y(), middle.x(), 0.0);
  across = across.norm() > 0.0 ? Eigen::Vector3d(across.normalized()) : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  return {middle - 0.5 * *length_m * across, middle + 0.5 * *length_m * across};
}

/// What `poses` postures of a block tell of the arm, the places of its sockets found beside.
Eigen::MatrixXd information_of_block(const InformationModel& arm, const SocketRoom& room, const SocketBlock& block,
                                     double poses) {
  const auto numbers = static_cast<Eigen::Index>(arm.ids().size());
  const auto places = 3 * static_cast<Eigen::Index>(block.sockets_m.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(numbers + places, numbers + places);
  for (const PlannedPose& pose : block.postures) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, numbers + places);
    rows.leftCols(numbers) = arm.tool_rows(pose);
    rows.middleCols(numbers + 3 * static_cast<Eigen::Index>(*pose.socket), 3).diagonal().setConstant(-1.0);
    information += rows.transpose() * rows;
  }
  information *= poses / (arm.model().noise_m * arm.model().noise_m * static_cast<double>(block.postures.size()));
  information.bottomRightCorner(places, places).diagonal().array() += 1.0 / (kAnywhere_m * kAnywhere_m);
  if (block.sockets_m.size() == 2) {
    const Eigen::Vector3d along = (block.sockets_m[1] - block.sockets_m[0]).normalized() / room.length_sigma_m;
    Eigen::VectorXd row = Eigen::VectorXd::Zero(numbers + places);
    row.segment<3>(numbers) = -along;
    row.segment<3>(numbers + 3) = along;
    information += row * row.transpose();
  }
  const Eigen::MatrixXd of_places = information.bottomRightCorner(places, places);
  const Eigen::MatrixXd shared = information.topRightCorner(numbers, places);
  return information.topLeftCorner(numbers, numbers) - shared * Cholesky(of_places).solve(shared.transpose());
}

class BlockChoice {
 public:
  BlockChoice(std::vector<Eigen::MatrixXd> information, const Eigen::MatrixXd& weight)
      : information_(std::move(information)), weight_(weight) {
    sum_ = Eigen::MatrixXd::Identity(weight.rows(), weight.cols());
  }

  /// The block that leaves least beside those chosen.
  std::size_t best() const {
    std::size_t best = information_.size();
    double least_m2 = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < information_.size(); ++i) {
      if (std::ranges::find(chosen_, i) != chosen_.end()) continue;
      const double left_m2 = weight_.cwiseProduct(inverse(sum_ + information_[i])).sum();
      if (left_m2 >= least_m2) continue;
      least_m2 = left_m2;
      best = i;
    }
    return best;
  }
  void add(std::size_t block) {
    chosen_.push_back(block);
    sum_ += information_[block];
  }
  /// Takes the chosen blocks out one after another and puts the best in.
  void exchange() {
    for (std::size_t place = 0; place < chosen_.size(); ++place) {
      sum_ -= information_[chosen_[place]];
      chosen_[place] = information_.size();  // none
      chosen_[place] = best();
      sum_ += information_[chosen_[place]];
    }
  }
  const std::vector<std::size_t>& blocks() const { return chosen_; }
  /// What the chosen blocks leave: the expected squared error.
  double square_m2() const { return weight_.cwiseProduct(inverse(sum_)).sum(); }

 private:
  static Eigen::MatrixXd inverse(const Eigen::MatrixXd& information) { return Cholesky(information).inverse(); }

  std::vector<Eigen::MatrixXd> information_;
  const Eigen::MatrixXd& weight_;
  Eigen::MatrixXd sum_;
  std::vector<std::size_t> chosen_;
};

std::vector<PlannedPose> draw_postures(const FeasibleSpace& space, const Eigen::Vector3d& place_m, std::size_t socket,
                                       std::size_t count, RandomStream& random) {
  constexpr std::size_t kTries = 20;  // for each that is wanted
  std::vector<PlannedPose> found;
  for (std::size_t i = 0; i < kTries * count && found.size() < count; ++i) {
    const auto joints = joints_touching(space.robot().chain, space.draw(random), place_m);
    if (!joints) continue;
    PlannedPose pose{*joints, ApproachSigns(joints->size()), socket};
    for (double& sign : pose.approach) sign = random.chance(0.5) ? 1.0 : -1.0;
    if (is_feasible(space, pose)) found.push_back(std::move(pose));
  }
  return found;
}

std::vector<SocketBlock> draw_blocks(const FeasibleSpace& space, std::size_t count, std::size_t postures,
                                     RandomStream random) {
  constexpr std::size_t kPlacesEach = 10;
  std::vector<SocketBlock> blocks;
  const SocketRoom& room = space.cell().sockets;
  for (const PlannedPose& pose : draw_poses(space, kPlacesEach * count, random).poses) {
    if (blocks.size() == count) break;
    SocketBlock block{sockets_about(tool_position(space.robot().chain, pose.joints), room.length_m), {}};
    const bool stands = std::ranges::all_of(
        block.sockets_m, [&](const Eigen::Vector3d& place) { return !room.box || room.box->contains(place); });
    if (!stands) continue;
    bool reached = true;
    for (std::size_t i = 0; i < block.sockets_m.size() && reached; ++i) {
      std::vector<PlannedPose> own = draw_postures(space, block.sockets_m[i], i, postures, random);
      reached = own.size() >= std::min(postures, kFewestPostures);
      std::ranges::move(own, std::back_inserter(block.postures));
    }
    if (reached) blocks.push_back(std::move(block));
  }
  return blocks;
}

BlockChoice chosen_blocks(const InformationModel& arm, const SocketRoom& room, const std::vector<SocketBlock>& blocks,
                          int count, int poses, const Eigen::MatrixXd& weight) {
  constexpr int kRounds = 2;
  const double share = static_cast<double>(poses) / static_cast<double>(count);
  std::vector<Eigen::MatrixXd> information;
  for (const SocketBlock& block : blocks) information.push_back(information_of_block(arm, room, block, share));
  BlockChoice choice(std::move(information), weight);
  for (int i = 0; i < count; ++i) choice.add(choice.best());
  for (int round = 0; round < kRounds; ++round) choice.exchange();
  return choice;
}

/// In turn one of each list, as long as there are any.
std::vector<PlannedPose> in_turn(const std::vector<std::vector<PlannedPose>>& lists) {
  std::vector<PlannedPose> all;
  std::size_t longest = 0;
  for (const std::vector<PlannedPose>& list : lists) longest = std::max(longest, list.size());
  for (std::size_t i = 0; i < longest; ++i)
    for (const std::vector<PlannedPose>& list : lists)
      if (i < list.size()) all.push_back(list[i]);
  return all;
}

void add_sockets(const SocketBlock& block, const SocketRoom& room, PlacedSockets& placed) {
  const bool single = block.sockets_m.size() == 1;
  const std::size_t first = placed.sockets.size();
  const std::string name = "S" + std::to_string(first / block.sockets_m.size() + 1);
  for (std::size_t i = 0; i < block.sockets_m.size(); ++i)
    placed.sockets.push_back({single ? name : name + (i == 0 ? "a" : "b"), block.sockets_m[i]});
  if (single) return;
  placed.lengths.push_back(
      {placed.sockets[first].name, placed.sockets[first + 1].name, *room.length_m, room.length_sigma_m});
}

}  // namespace

WorkCell assumed_cell_of_sockets(const Robot& robot) {
  constexpr double kFromAbove_rad = radians(60.0);
  WorkCell cell = assumed_cell(robot);
  cell.tool_cone = ToolCone{.half_angle_rad = kFromAbove_rad};
  return cell;
}

std::optional<JointVector> joints_touching(const Chain& chain, const JointVector& start,
                                           const Eigen::Vector3d& point_m) {
  constexpr int kSteps = 25;
  constexpr double kReached_m = 1e-5, kLongestStep_rad = 0.5;
  JointVector joints = start;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector3d missing = point_m - tool_position(chain, joints);
    if (missing.norm() < kReached_m) return rounded(chain, joints);
    const Eigen::MatrixXd motions = joint_jacobian(chain, joints, chain.tool_m).topRows<3>();
    Eigen::VectorXd change = least_norm_solution(motions, missing);
    const double largest = change.cwiseAbs().maxCoeff();
    if (largest > kLongestStep_rad) change *= kLongestStep_rad / largest;
    joints += change;
  }
  return {};
}

PlacedSockets place_sockets(const InformationModel& arm, const FeasibleSpace& space, const Workspace& workspace,
                            const SocketRequest& request, RandomStream random) {
  constexpr std::size_t kBlocks = 40, kPostures = 30, kJudging = 60;
  constexpr int kMorePlaces = 2;
  const SocketRoom& room = space.cell().sockets;
  const std::vector<SocketBlock> blocks = draw_blocks(space, kBlocks, kPostures, random);
  const auto places = static_cast<std::size_t>(request.places);
  if (blocks.size() < places + 1)
    throw InputError(
        {space.robot().name, 0}, std::to_string(blocks.size()),
        fmt::format("places were found that a socket may have and the arm reaches in many postures; {} and "
                    "one for accept poses are needed. Widen the cell, or ask for fewer",
                    places));
  PlacedSockets placed;
  const BlockChoice chosen = chosen_blocks(arm, room, blocks, request.places, request.poses, workspace.weight());
  for (const std::size_t block : chosen.blocks()) add_sockets(blocks[block], room, placed);
  placed.model = arm.model();
  placed.model.sockets = placed.sockets;
  placed.model.nominal.contacts.distances = placed.lengths;
  std::size_t judge = random.index(blocks.size());
  while (std::ranges::find(chosen.blocks(), judge) != chosen.blocks().end()) judge = random.index(blocks.size());
  add_sockets(blocks[judge], room, placed);

  const std::size_t fitted = placed.model.sockets.size();
  std::vector<std::vector<PlannedPose>> candidates, validation, accept;
  for (std::size_t i = 0; i < placed.sockets.size(); ++i) {
    const Eigen::Vector3d& place_m = placed.sockets[i].place_m;
    (i < fitted ? validation : accept).push_back(draw_postures(space, place_m, i, kJudging, random));
    if (i >= fitted) continue;
    candidates.push_back(draw_postures(space, place_m, i, request.postures / fitted + 1, random));
  }
  placed.candidates = in_turn(candidates);
  placed.validation = in_turn(validation);
  placed.accept = in_turn(accept);
  const int most = std::min(request.places + kMorePlaces, static_cast<int>(blocks.size()));
  for (int number = 1; number <= most; ++number) {
    const BlockChoice choice = chosen_blocks(arm, room, blocks, number, request.poses, workspace.weight());
    placed.by_places.push_back({number, std::sqrt(choice.square_m2())});
  }
  return placed;
}

}  // namespace demecal::inline planning
