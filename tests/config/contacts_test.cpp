// What DATASET.yaml says of contacts is read, written back, and refused where it makes no sense; rows may be measured
// by what they touch alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "../errors/complaint.hpp"
#include "data/stated_radius.hpp"
#include "data_files/data_set_file.hpp"
#include "kinematics/forward.hpp"
#include "prediction/measurement.hpp"
#include "preparation/touched_places.hpp"
#include "sample_files.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kTouching = R"yaml(demecal_dataset: 1
name: touching
robot: robot.yaml
poses: poses.csv
columns: {joints: [q1_deg, q2_mm], contact: contact, set: set, pose: pose_id}
)yaml";

const std::string kTouches = R"csv(pose_id,set,contact,q1_deg,q2_mm
P1,calibration,a,10,20
P2,calibration,b,-80,100
P3,accept,plate,-40,100
P4,accept,ball,-45,100
)csv";

class ContactFiles : public ::testing::Test {
 protected:
  ContactFiles() { folder_.write("robot.yaml", kRobotText); }

  DataSet load(const std::string& more, const std::string& poses = kTouches) {
    folder_.write("poses.csv", poses);
    return load_data_set(folder_.write("dataset.yaml", kTouching + more));
  }

  TemporaryFolder folder_;
};

TEST_F(ContactFiles, AreReadAndWrittenBack) {
  const DataSet data = load(R"yaml(contacts:
  kinds: {plate: plane, ball: sphere}
  radii_mm: {ball: 12.7}
  flatness_mm: {plate: 0.2}
  distances: [{between: [a, ball], mm: 50, sigma_mm: 0.05}]
)yaml");
  EXPECT_EQ(data.poses[0].contact, "a");
  EXPECT_FALSE(data.poses[0].position_m);
  EXPECT_EQ(data.poses[2].contact_kind, ContactKind::plane);
  EXPECT_EQ(rows_of(data.poses[0]).total(), 3);
  EXPECT_EQ(rows_of(data.poses[2]).total(), 1);
  ASSERT_EQ(data.contacts.distances.size(), 2u);
  EXPECT_DOUBLE_EQ(data.contacts.distances[1].length_m, 0.05);
  EXPECT_DOUBLE_EQ(data.contacts.distances[1].sigma_m, 5e-5);
  const TemporaryFolder written;
  const DataSet back = load_data_set(write_data_set(data, written.path(), "again"));
  EXPECT_EQ(back.poses[3].contact, "ball");
  EXPECT_EQ(back.poses[3].contact_kind, ContactKind::sphere);
  EXPECT_EQ(back.contacts.distances[1].second, "ball");
  EXPECT_NEAR(back.contacts.form_of("plate").flatness_m, 2e-4, 1e-15);
  EXPECT_DOUBLE_EQ(back.poses[2].contact_weight, data.poses[2].contact_weight);
  EXPECT_LT(data.poses[2].contact_weight, data.poses[0].contact_weight);
}

TEST_F(ContactFiles, RadiiAreKnownAsWellAsIsStated) {
  const std::string radius = "contacts:\n  kinds: {ball: sphere}\n  radii_mm: {ball: 12.7}\n";
  for (const auto& [stated, sigma_m] : std::map<std::string, double>{{"", kRadiusDeviation_m},
                                                                     {"  radii_sigma_mm: {ball: 0.01}\n", 1e-5},
                                                                     {"  radii_sigma_mm: {ball: 0}\n", 0.0}}) {
    DataSet data = load(radius + stated);
    for (int times = 0; times < 2; ++times) {
      const KnownDistance* const known = stated_radius(data.contacts, "ball");
      ASSERT_EQ(known == nullptr, sigma_m == 0.0) << stated;
      EXPECT_EQ(data.contacts.form_of("ball").radius_m.has_value(), sigma_m == 0.0) << "free where it is not exact";
      EXPECT_NEAR(known ? known->length_m : *data.contacts.form_of("ball").radius_m, 0.0127, 1e-15);
      EXPECT_NEAR(known ? known->sigma_m : 0.0, sigma_m, 1e-15);
      const TemporaryFolder written;
      data = load_data_set(write_data_set(data, written.path(), "again"));
    }
  }
  EXPECT_THAT(complaint([&] { load("contacts: {radii_sigma_mm: {a: 0.1}}\n"); }), HasSubstr("has no radius"));
  EXPECT_THAT(complaint([&] { load(radius + "  radii_sigma_mm: {ball: -1}\n"); }), HasSubstr("-1"));
}

TEST_F(ContactFiles, ThatNoPoseTouchesAreRefused) {
  EXPECT_THAT(complaint([&] { load("contacts: {distances: [{between: [a, balls], mm: 50, sigma_mm: 1}]}\n"); }),
              AllOf(HasSubstr("balls"), HasSubstr("is no contact of the poses; the nearest is 'ball'")));
  EXPECT_THAT(complaint([&] { load("contacts: {kinds: {c: plane}}\n"); }), HasSubstr("is no contact of the poses"));
}

TEST_F(ContactFiles, HaveOnlyWhatTheirKindHas) {
  EXPECT_THAT(complaint([&] { load("contacts: {radii_mm: {a: 5}}\n"); }), HasSubstr("only spheres have a radius"));
  EXPECT_THAT(complaint([&] { load("contacts: {flatness_mm: {a: 0.1}}\n"); }),
              HasSubstr("only planes have a flatness"));
  EXPECT_THAT(complaint([&] {
                load("contacts: {kinds: {plate: line}, distances: [{between: [a, plate], mm: 5, sigma_mm: 1}]}\n");
              }),
              HasSubstr("distances are between points, centres of spheres and planes"));
  EXPECT_NO_THROW(load("contacts: {kinds: {plate: plane}, distances: [{between: [a, plate], mm: 5, sigma_mm: 1}]}\n"));
  EXPECT_THAT(complaint([&] { load("contacts: {parallel: [{between: [a, b], sigma_deg: 1}]}\n"); }),
              HasSubstr("only planes and lines have a direction"));
}

TEST_F(ContactFiles, OfAGridAreAsFarApartAsItsPlacesAre) {
  DataSet data = load("contacts: {grids: [{places_mm: {a: [0, 0], b: [30, 40], ball: [0, 0, 10]}, sigma_mm: 0.02}]}\n");
  for (int times = 0; times < 2; ++times) {
    ASSERT_EQ(data.contacts.distances.size(), 3u);
    EXPECT_EQ(data.contacts.distances[0].key(), times == 0 ? "contacts.grids" : "contacts.distances");
    EXPECT_EQ(data.contacts.distances[0].first + data.contacts.distances[0].second, "ab");
    EXPECT_NEAR(data.contacts.distances[0].length_m, 0.05, 1e-15);
    EXPECT_NEAR(data.contacts.distances[1].length_m, 0.01, 1e-15);
    EXPECT_NEAR(data.contacts.distances[2].sigma_m, std::sqrt(3.0) * 2e-5, 1e-15);
    const TemporaryFolder written;
    data = load_data_set(write_data_set(data, written.path(), "again"));
  }
  const auto refused = [&](const std::string& grid) {
    return complaint([&] { load("contacts: {kinds: {plate: plane}, grids: [{" + grid + ", sigma_mm: 0.02}]}\n"); });
  };
  EXPECT_THAT(refused("places_mm: {a: [0, 0]}"), HasSubstr("fewer than two contacts"));
  EXPECT_THAT(refused("places_mm: {a: [0, 0], b: [0, 0]}"), HasSubstr("is where a is"));
  EXPECT_THAT(refused("places_mm: {a: [0, 0], plate: [9, 0]}"), HasSubstr("a grid is of points"));
  EXPECT_THAT(refused("places_mm: {a: [0, 0], balls: [9, 0]}"), HasSubstr("the nearest is 'ball'"));
  EXPECT_THAT(refused("places_mm: {a: [0], b: [9, 0]}"), HasSubstr("places_mm.a"));
}

TEST_F(ContactFiles, OfARowThatMeasuresNothingElseMustBeNamed) {
  EXPECT_THAT(complaint([&] { load("", "pose_id,set,contact,q1_deg,q2_mm\nP1,calibration,,10,20\n"); }),
              HasSubstr("every row names what the tool touches"));
}

TEST(RealContacts, LoadAsTheyAre) {
  for (const char* robot : {"panda-1", "panda-4"}) {
    const std::string file =
        std::string(DEMECAL_SOURCE_DIR) + "/../shared/data/panda-sockets/" + robot + "/dataset.yaml";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "the measured robots are not on this machine: " << file;
    const DataSet data = load_data_set(file);
    EXPECT_EQ(data.contacts.distances.size(), 3u);
    EXPECT_GT(poses_of(data, PoseSet::accept).size(), 50u);
    EXPECT_FALSE(has_instrument(data));
  }
}

TEST_F(ContactFiles, WiresFromUnknownAnchorsAreContactsEachInARowOfItsOwn) {
  folder_.write("poses.csv", "pose_id,q1_deg,q2_mm,l1_mm,l2_mm\nP1,10,20,900,800\nP2,-80,100,700,600\n");
  const std::string text =
      "demecal_dataset: 1\nrobot: robot.yaml\nposes: poses.csv\ncolumns: {joints: [q1_deg, q2_mm], distances: [l1_mm, "
      "l2_mm], pose: pose_id}\nanchors_mm: unknown\nsplit: {validation_fraction: 0.5}\n";
  const DataSet data = load_data_set(folder_.write(
      "dataset.yaml", text + "contacts: {distances: [{between: [anchor 1, anchor 2], mm: 500, sigma_mm: 1}]}\n"));
  ASSERT_EQ(data.poses.size(), 4u);
  EXPECT_EQ(data.poses[1].contact, "anchor 2");
  EXPECT_EQ(data.poses[1].pose_id, "P1 wire 2");
  EXPECT_DOUBLE_EQ(data.poses[1].contact_length_m, 0.8);
  EXPECT_EQ(data.poses[0].set, data.poses[1].set);
  EXPECT_EQ(data.contacts.distances.size(), 3u);
  DataSet zeroed =
      load_data_set(folder_.write("dataset.yaml", text + "contacts: {radii_sigma_mm: {anchor 1: 0.2, anchor 2: 0}}\n"));
  EXPECT_DOUBLE_EQ(stated_radius(zeroed.contacts, "anchor 1")->sigma_m, 2e-4);
  EXPECT_EQ(zeroed.contacts.form_of("anchor 2").radius_m, 0.0) << "its length is exact";
  EXPECT_THAT(
      complaint([&] { load_data_set(folder_.write("dataset.yaml", text + "contacts: {kinds: {anchor 1: plane}}\n")); }),
      HasSubstr("is where a wire ends"));
}

TEST(RealContacts, AreToldApartByWhereTheNominalArmHasThem) {
  for (const char* robot : {"panda-1", "panda-4"}) {
    const std::string file =
        std::string(DEMECAL_SOURCE_DIR) + "/../shared/data/panda-sockets/" + robot + "/dataset.yaml";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "the measured robots are not on this machine: " << file;
    const DataSet data = load_data_set(file);
    const Chain& arm = data.robot.chain;
    std::vector<Eigen::Isometry3d> flanges;
    for (const MeasuredPose& pose : data.poses) flanges.push_back(forward(arm, pose.joints));
    const Eigen::Vector3d tool_m = common_tool_point(flanges, arm.tool_m);
    EXPECT_GT((tool_m - arm.tool_m).norm(), 0.05);  // their robot file knows the ball to some cm
    std::vector<Eigen::Vector3d> places_m;
    for (const Eigen::Isometry3d& flange : flanges) places_m.push_back(flange * tool_m);
    const PlaceGroups groups = group_places(places_m, {});
    std::map<std::string, std::size_t> numbers;
    for (std::size_t i = 0; i < data.poses.size(); ++i) {
      const auto number = numbers.emplace(data.poses[i].contact, numbers.size()).first->second;
      EXPECT_EQ(groups.group_of[i], number) << robot << ", " << data.poses[i].pose_id;
    }
    EXPECT_EQ(groups.groups, 6u);
  }
}

}  // namespace
}  // namespace demecal
