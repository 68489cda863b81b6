#include "urdf/sdf_file.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <ranges>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/drawn_arm.hpp"
#include "urdf/sdf_elements.hpp"
#include "urdf/sdf_frames.hpp"
#include "urdf/xml_values.hpp"

namespace demecal::inline urdf {
namespace {

constexpr int kFirstMinor = 4, kLastMinor = 12;  ///< of version 1

int minor_version(const XmlValues& values, const XmlElement& root) {
  const std::string& version = values.text(root, "version");
  for (int minor = kFirstMinor; minor <= kLastMinor; ++minor) {
    if (version == "1." + std::to_string(minor)) return minor;
  }
  values.fail(root, version,
              "is the version of an SDF; read are 1.4 to 1.12: `gz sdf -p FILE.sdf > NEW.sdf` writes another");
}

[[noreturn]] void refuse_include(const XmlValues& values, const XmlElement& element) {
  values.fail(element, "<include>",
              "is not followed; run `gz sdf -p FILE.sdf > NEW.sdf`, which puts the included model in its place, and "
              "import that");
}

/// The only model, in the file or in a world of it.
const XmlElement& only_model(const XmlValues& values, const XmlElement& root) {
  std::vector<const XmlElement*> models;
  const auto collect = [&](const XmlElement& scope) {
    for (const XmlElement& child : scope.children) {
      if (child.name == "include") refuse_include(values, child);
      if (child.name == "model") models.push_back(&child);
    }
  };
  collect(root);
  for (const XmlElement& child : root.children) {
    if (child.name == "world") collect(child);
  }
  if (models.empty()) values.fail(root, "<sdf>", "has no <model>; one is expected, the arm");
  if (models.size() > 1)
    values.fail(*models[1], values.text(*models[1], "name"), "is a second model; leave only the arm's in the file");
  return *models.front();
}

void refuse_nested(const XmlValues& values, const XmlElement& model) {
  for (const XmlElement& child : model.children) {
    if (child.name == "include") refuse_include(values, child);
    if (child.name != "model") continue;
    values.fail(child, values.text(child, "name"),
                "is a model in a model; put its links and joints into the outer one: <include merge=\"true\"> does it "
                "when `gz sdf -p FILE.sdf > NEW.sdf` is run");
  }
}

/// Limits at the same place hold a joint there: versions without fixed joints state these so.
void hold(UrdfJoint& joint, double value) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d axis = joint.axis.normalized();
  if (joint.type == UrdfType::prismatic) motion.translate(value * axis);
  if (joint.type == UrdfType::revolute) motion.rotate(Eigen::AngleAxisd(value, axis));
  if (value != 0.0) joint.origin = origin_of(pose_of(joint.origin) * motion);
  joint.type = UrdfType::fixed;
}

const Eigen::Vector3d& larger(const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
  return one.cwiseAbs().maxCoeff() < other.cwiseAbs().maxCoeff() ? other : one;
}

class SdfModel {
 public:
  SdfModel(const XmlElement& model, const std::string& file, int minor)
      : values_(file), model_(model), minor_(minor), frames_(file, model.line) {
    urdf_ = {.file = file, .robot = values_.text(model, "name"), .is_sdf = true};
  }

  UrdfFile read() {
    refuse_nested(values_, model_);
    for (const XmlElement& child : model_.children) {
      if (child.name == "link") add_link(child);
      if (child.name == "joint") add_joint(child);
      if (child.name == "frame" && minor_ >= kFirstWithFrames) add_frame(child);
    }
    if (urdf_.links.empty()) values_.fail(model_, "<model>", "has no links");
    const XmlAttribute* canonical = model_.attribute("canonical_link");
    frames_.attach_model_to(canonical == nullptr || canonical->value.empty() ? urdf_.links.front().name
                                                                             : canonical->value);
    frames_.check();
    place_world();
    for (WrittenJoint& written : joints_) connect(written);
    for (const std::string& name : named_) fix_frame(name);
    check_tree(urdf_);
    for (std::size_t i = 0; i < joints_.size(); ++i) part_from_child(joints_[i].frame, i);
    return std::move(urdf_);
  }

 private:
  /// Where it is not said what a pose is relative to, it is `otherwise`.
  SdfFrame frame_of(const XmlElement& element, const std::string& otherwise, const std::string& attached_to) const {
    const SdfPose pose = read_pose(values_, element);
    return {pose.origin, pose.relative_to.empty() ? otherwise : pose.relative_to, attached_to, element.line};
  }

  void add_link(const XmlElement& element) {
    urdf_.links.push_back(read_sdf_link(values_, element));
    frames_.add(urdf_.links.back().name, frame_of(element, kModelFrame, ""));
  }

  void add_frame(const XmlElement& element) {
    const std::string& name = values_.text(element, "name");
    const XmlAttribute* stated = element.attribute("attached_to");
    const std::string attached = stated == nullptr || stated->value.empty() ? kModelFrame : stated->value;
    frames_.add(name, frame_of(element, attached, attached));
    named_.push_back(name);
  }

  void add_joint(const XmlElement& element) {
    WrittenJoint written = read_sdf_joint(values_, element, minor_);
    const std::string& child = written.joint.child;
    frames_.add(written.frame, frame_of(element, child, child));
    joints_.push_back(std::move(written));
  }

  /// The world as a frame of the model, where a joint stands on it.
  void place_world() {
    const auto on_world =
        std::ranges::find(joints_, kWorldFrame, [](const WrittenJoint& one) { return one.joint.parent; });
    if (on_world == joints_.end()) return;
    const SdfPose pose = read_pose(values_, model_);
    if (!pose.relative_to.empty() && pose.relative_to != kWorldFrame) {
      values_.fail(model_, pose.relative_to,
                   "is a frame of the world, of which none is read; state the model's pose in the world itself");
    }
    const XmlAttribute* placed = model_.attribute("placement_frame");
    const std::string frame = placed == nullptr || placed->value.empty() ? kModelFrame : placed->value;
    frames_.require(frame, model_.line);
    frames_.add(kWorldFrame,
                {.origin = origin_of(pose_of(pose.origin).inverse()), .relative_to = frame, .line = model_.line});
    urdf_.links.push_back({.name = kWorldFrame, .mass = std::nullopt, .line = model_.line});
  }

  /// The joint between the links that its ends are attached to, as if it led straight to its child.
  void connect(WrittenJoint& written) {
    UrdfJoint joint = written.joint;
    for (const std::string& name : {joint.parent, written.axis_in}) frames_.require(name, joint.line);
    joint.parent = frames_.link_of(joint.parent);
    joint.child = frames_.link_of(joint.child);
    if (joint.type == UrdfType::fixed) written.frame = joint.child;  // where it is fixed makes no difference
    joint.origin = frames_.origin_in(joint.parent, written.frame);
    for (const std::string& name : {joint.child, written.frame})
      joint.written_rpy = larger(joint.written_rpy, frames_.frame(name).origin.rpy_rad);
    joint.axis = written.axis;
    if (written.axis_in != written.frame)
      joint.axis = pose_of(frames_.origin_in(written.frame, written.axis_in)).linear() * written.axis;
    if (written.held) hold(joint, *written.held);
    urdf_.joints.push_back(std::move(joint));
  }

  void fix_frame(const std::string& name) {
    const SdfFrame& frame = frames_.frame(name);
    const bool on_another = std::ranges::find(named_, frame.attached_to) != named_.end();
    UrdfJoint joint;
    joint.name = name;
    joint.line = frame.line;
    joint.parent = on_another ? frame.attached_to : frames_.link_of(name);
    joint.child = name;
    joint.origin = frames_.origin_in(joint.parent, name);
    urdf_.links.push_back({.name = name, .mass = std::nullopt, .line = frame.line});
    urdf_.joints.push_back(std::move(joint));
  }

  /// Where a joint's frame is not that of its child, the joint leads to the former, and the latter is fixed to it.
  void part_from_child(const std::string& frame, std::size_t which) {
    UrdfJoint fixed;
    fixed.origin = frames_.origin_in(frame, urdf_.joints[which].child);
    if (fixed.origin == Origin{}) return;
    fixed.line = urdf_.joints[which].line;
    fixed.parent = frame;
    fixed.name = fixed.child = std::exchange(urdf_.joints[which].child, frame);
    urdf_.links.push_back({.name = frame, .mass = std::nullopt, .line = fixed.line});
    urdf_.joints.push_back(std::move(fixed));
  }

  XmlValues values_;
  const XmlElement& model_;
  int minor_;
  SdfFrames frames_;
  UrdfFile urdf_;
  std::vector<WrittenJoint> joints_;
  std::vector<std::string> named_;  ///< frames that are neither a link's nor a joint's
};

}  // namespace

UrdfFile parse_sdf(const XmlElement& root, const std::string& file) {
  const XmlValues values(file);
  values.refuse_xacro(root);
  const int minor = minor_version(values, root);
  return SdfModel(only_model(values, root), file, minor).read();
}

UrdfFile parse_urdf_or_sdf(const std::string& text, const std::string& file) {
  const XmlElement root = parse_xml(text, file);
  return root.name == "sdf" ? parse_sdf(root, file) : parse_urdf(root, file);
}

}  // namespace demecal::inline urdf
