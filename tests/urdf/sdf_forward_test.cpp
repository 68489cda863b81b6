// Arms from SDFs stand where products of exponentials about axes in the model's frame have them, however their poses
// are stated, and where the same arm's URDF has them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <vector>

#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "random/random_stream.hpp"
#include "small_sdf.hpp"

namespace demecal {
namespace {

std::string numbers_text(const std::vector<double>& numbers) {
  std::ostringstream text;
  text.precision(17);
  for (const double number : numbers) text << number << ' ';
  return text.str();
}

std::string pose_text(const Eigen::Isometry3d& pose, RandomStream& stream, bool new_format) {
  const Eigen::Vector3d& t = pose.translation();
  const std::string xyz = numbers_text({t.x(), t.y(), t.z()});
  if (new_format && stream.chance(0.3)) {
    const Eigen::Quaterniond q(pose.linear());
    return " rotation_format=\"quat_xyzw\">" + xyz + numbers_text({q.x(), q.y(), q.z(), q.w()});
  }
  const bool in_degrees = new_format && stream.chance(0.3);
  Eigen::Vector3d ypr = pose.linear().eulerAngles(2, 1, 0);
  if (in_degrees) ypr *= 180.0 / std::numbers::pi;
  return (in_degrees ? " degrees=\"true\">" : ">") + xyz + numbers_text({ypr[2], ypr[1], ypr[0]});
}

/// One element as it will be written: links, then joints, then frames.
struct Element {
  std::string name, usual;   ///< the frame that its pose is in where nothing is said
  Eigen::Isometry3d pose{};  ///< in the model's frame
  std::string xml{};         ///< its <pose>
};

struct RandomModel {
  std::vector<Element> elements;
  std::vector<Eigen::Vector3d> axes;  ///< of the joints, in the model's frame
  std::vector<bool> slides;
  std::string text;

  const Eigen::Isometry3d& pose(const std::string& name) const {
    return std::ranges::find(elements, name, &Element::name)->pose;
  }
};

/// Poses stated in elements that were drawn before, so that none is stated in itself.
void write_poses(RandomModel& model, int minor, RandomStream& stream) {
  std::vector<std::string> stated{"__model__"};
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < model.elements.size(); ++i)
    order.insert(order.begin() + static_cast<std::ptrdiff_t>(stream.index(order.size() + 1)), i);
  for (const std::size_t i : order) {
    Element& element = model.elements[i];
    const bool usual_is_known = std::ranges::find(stated, element.usual) != stated.end();
    const bool said = minor >= 7 && (!usual_is_known || stream.chance(0.6));
    const std::string base = said ? stated[stream.index(stated.size())] : element.usual;
    const Eigen::Isometry3d in = base == "__model__" ? Eigen::Isometry3d::Identity() : model.pose(base);
    element.xml = "<pose" + (said ? " relative_to=\"" + base + "\"" : "") +
                  pose_text(in.inverse() * element.pose, stream, minor >= 9) + "</pose>";
    stated.push_back(element.name);
  }
}

std::string axis_text(const RandomModel& model, std::size_t joint, int minor, RandomStream& stream) {
  const std::string own = "j" + std::to_string(joint + 1);
  std::string in = own;
  if (minor >= 7 && stream.chance(0.6)) in = model.elements[stream.index(model.elements.size())].name;
  if (minor < 7 && (minor == 4 || stream.chance(0.5))) in = "__model__";
  const Eigen::Vector3d& axis = model.axes[joint];
  const Eigen::Vector3d seen = in == "__model__" ? axis : model.pose(in).linear().transpose() * axis;
  const bool said = minor >= 7 && in != own;
  return "<axis><xyz" + (said ? " expressed_in=\"" + in + "\"" : "") + ">" +
         numbers_text({seen.x(), seen.y(), seen.z()}) + "</xyz>" +
         (in == "__model__" && minor > 4 ? "<use_parent_model_frame>true</use_parent_model_frame>" : "") +
         "<limit><lower>-1</lower><upper>1</upper></limit></axis>";
}

/// Links l0, l1 ... in a row, frames f0 ... attached to any, and a frame `end` on the last.
RandomModel random_model(RandomStream& stream, int joints, int minor) {
  RandomModel model;
  const auto name = [](const char* letter, int i) { return letter + std::to_string(i); };
  for (int i = 0; i <= joints; ++i) model.elements.push_back({name("l", i), "__model__", random_place(stream)});
  for (int i = 1; i <= joints; ++i) {
    const bool as_child = stream.chance(0.3);
    model.elements.push_back({name("j", i), name("l", i), as_child ? model.pose(name("l", i)) : random_place(stream)});
    model.axes.push_back(random_place(stream).linear().col(0));
    model.slides.push_back(stream.chance(0.3));
  }
  std::vector<std::string> attached;
  for (int i = 0; minor >= 7 && i < 4; ++i) {
    attached.push_back(i == 3 ? name("l", joints) : model.elements[stream.index(model.elements.size())].name);
    model.elements.push_back({i == 3 ? "end" : name("f", i), attached.back(), random_place(stream)});
  }
  write_poses(model, minor, stream);
  std::string xml;
  for (const Element& element : model.elements) {
    const std::size_t number = element.name == "end" ? 3 : std::stoul(element.name.substr(1));
    if (element.name[0] == 'l') xml += sdf_link(element.name, element.xml);
    if (element.name[0] == 'j')
      xml +=
          sdf_joint(element.name, model.slides[number - 1] ? "prismatic" : "revolute", "l" + std::to_string(number - 1),
                    "l" + std::to_string(number), element.xml + axis_text(model, number - 1, minor, stream));
    if (element.name[0] == 'f' || element.name == "end")
      xml +=
          "<frame name=\"" + element.name + "\" attached_to=\"" + attached[number] + "\">" + element.xml + "</frame>\n";
  }
  model.text = sdf_xml(xml, "1." + std::to_string(minor));
  return model;
}

Eigen::Isometry3d product_of_exponentials(const RandomModel& model, const std::string& tip, const JointVector& q) {
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  for (int i = 0; i < q.size(); ++i) {
    const auto joint = static_cast<std::size_t>(i);
    const Eigen::Vector3d at = model.pose("j" + std::to_string(i + 1)).translation();
    if (model.slides[joint]) {
      moved = moved * Eigen::Translation3d(q[i] * model.axes[joint]);
    } else {
      moved = moved * Eigen::Translation3d(at) * Eigen::AngleAxisd(q[i], model.axes[joint]) * Eigen::Translation3d(-at);
    }
  }
  return model.pose("l0").inverse() * moved * model.pose(tip);
}

/// The flange of an arm as it is drawn.
Eigen::Isometry3d drawn_pose(const DrawnArm& arm, const JointVector& q) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int i = 0; i < q.size(); ++i) {
    const DrawnJoint& joint = arm.joints[static_cast<std::size_t>(i)];
    pose = pose * pose_of(joint.origin);
    if (joint.row.type == JointType::prismatic) pose.translate(q[i] * joint.axis);
    if (joint.row.type == JointType::revolute) pose.rotate(Eigen::AngleAxisd(q[i], joint.axis));
  }
  return pose * pose_of(arm.flange);
}

TEST(SdfArm, OfRandomPosesStandsWhereItsScrewAxesPutIt) {
  RandomStream stream{1831};
  for (int which = 0; which < 300; ++which) {
    const int joints = 1 + static_cast<int>(stream.index(7)), minor = 4 + static_cast<int>(stream.index(9));
    const RandomModel model = random_model(stream, joints, minor);
    SCOPED_TRACE(model.text);
    const std::string tip = minor >= 7 && stream.chance(0.5) ? "end" : "l" + std::to_string(joints);
    const UrdfFile sdf = parse_urdf_or_sdf(model.text, "arm.sdf");
    const UrdfArm arm = arm_between(sdf, "l0", tip);
    ASSERT_EQ(arm.joints.size(), static_cast<std::size_t>(joints));
    const Chain chain = equivalent_chain(arm.drawing).chain;
    for (int i = 0; i < 20; ++i) {
      const JointVector q = random_change(stream, joints, 3.0);
      const Eigen::Isometry3d expected = product_of_exponentials(model, tip, q);
      ASSERT_LT((drawn_pose(arm.drawing, q).matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-12);
      ASSERT_LT((forward(chain, q).matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
}

/// The model of a URDF with all links in the frame of its root link, as converters write them.
std::string sdf_of(const UrdfFile& urdf, RandomStream& stream) {
  std::map<std::string, Eigen::Isometry3d> poses;
  const auto pose_in_root = [&](const std::string& link) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (const UrdfJoint* joint = urdf.joint_to(link); joint != nullptr; joint = urdf.joint_to(joint->parent))
      pose = pose_of(joint->origin) * pose;
    return pose;
  };
  std::string xml;
  for (const UrdfLink& link : urdf.links) {
    std::string inside = "<pose" + pose_text(pose_in_root(link.name), stream, true) + "</pose>";
    if (link.mass) {
      const Eigen::Vector3d& c = link.mass->centre_m;
      inside += "<inertial><mass>" + numbers_text({link.mass->mass_kg}) + "</mass><pose>" +
                numbers_text({c.x(), c.y(), c.z(), 0.0, 0.0, 0.0}) + "</pose>";
      if (link.inertia_kgm2) {
        const auto [xx, xy, xz, yy, yz, zz] = matrix_elements(*link.inertia_kgm2);
        const auto element = [](const std::string& name, double value) {
          return '<' + name + '>' + numbers_text({value}) + "</" + name + '>';
        };
        inside += "<inertia>" + element("ixx", xx) + element("ixy", xy) + element("ixz", xz) + element("iyy", yy) +
                  element("iyz", yz) + element("izz", zz) + "</inertia>";
      }
      inside += "</inertial>";
    }
    xml += link.name == "world" ? "" : sdf_link(link.name, inside);
  }
  for (const UrdfJoint& joint : urdf.joints) {
    std::string inside = "<axis><xyz>" + numbers_text({joint.axis.x(), joint.axis.y(), joint.axis.z()}) + "</xyz>";
    if (joint.lower < joint.upper)
      inside += "<limit><lower>" + numbers_text({joint.lower}) + "</lower><upper>" + numbers_text({joint.upper}) +
                "</upper></limit>";
    if (joint.mimics) inside += "<mimic joint=\"" + *joint.mimics + "\"/>";
    xml += sdf_joint(joint.name, std::string(to_string(joint.type)), joint.parent, joint.child, inside + "</axis>");
  }
  return sdf_xml(xml, "1.11");
}

void expect_same_arm(const UrdfArm& sdf, const UrdfArm& urdf) {
  EXPECT_EQ(sdf.base, urdf.base);
  EXPECT_EQ(sdf.tip, urdf.tip);
  ASSERT_EQ(sdf.drawing.joints.size(), urdf.drawing.joints.size());
  const auto near = [](const Origin& one, const Origin& other) {
    return (pose_of(one).matrix() - pose_of(other).matrix()).cwiseAbs().maxCoeff() < 1e-9;
  };
  for (std::size_t i = 0; i < sdf.drawing.joints.size(); ++i) {
    const DrawnJoint &one = sdf.drawing.joints[i], &other = urdf.drawing.joints[i];
    EXPECT_EQ(one.name, other.name);
    EXPECT_TRUE(near(one.origin, other.origin)) << one.name;
    EXPECT_EQ(one.axis, other.axis) << one.name;
    EXPECT_EQ(one.row.type, other.row.type) << one.name;
    EXPECT_EQ(one.row.endless, other.row.endless) << one.name;
    EXPECT_EQ(one.row.lower, other.row.lower) << one.name;
    EXPECT_EQ(one.row.upper, other.row.upper) << one.name;
  }
  EXPECT_TRUE(near(sdf.drawing.flange, urdf.drawing.flange));
  ASSERT_EQ(sdf.masses.size(), urdf.masses.size());
  for (std::size_t i = 0; i < sdf.masses.size(); ++i) {
    EXPECT_NEAR(sdf.masses[i].mass_kg, urdf.masses[i].mass_kg, 1e-9);
    EXPECT_LT((sdf.masses[i].centre_m - urdf.masses[i].centre_m).norm(), 1e-9);
  }
  ASSERT_EQ(sdf.inertias.size(), urdf.inertias.size());
  for (std::size_t i = 0; i < sdf.inertias.size(); ++i) {
    ASSERT_EQ(sdf.inertias[i].has_value(), urdf.inertias[i].has_value());
    if (!sdf.inertias[i]) continue;
    EXPECT_LT((*sdf.inertias[i] - *urdf.inertias[i]).norm(), 1e-9 * (1.0 + urdf.inertias[i]->norm()));
  }
}

TEST(SdfArm, OfEveryPublicUrdfIsTheSameArm) {
  const std::filesystem::path folder = std::filesystem::path(DEMECAL_SOURCE_DIR) / "../shared/data/urdf";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs " << folder;
  RandomStream stream{1832};
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".urdf") continue;
    SCOPED_TRACE(entry.path().filename());
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const bool two_ends = entry.path().filename() == "iiwa14_no_collision.urdf";
    const std::optional<std::string> tip = two_ends ? std::optional("iiwa_link_ee") : std::nullopt;
    const UrdfFile urdf = parse_urdf(text.str(), "arm.urdf");
    const UrdfFile sdf = parse_urdf_or_sdf(sdf_of(urdf, stream), "arm.sdf");
    expect_same_arm(arm_between(sdf, std::nullopt, tip), arm_between(urdf, std::nullopt, tip));
    ++files;
  }
  EXPECT_GE(files, 20);
}

}  // namespace
}  // namespace demecal
