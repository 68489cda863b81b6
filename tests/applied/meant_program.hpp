// Programs written for a simulated controller, which knows in what joints it reaches every target.
#pragma once

#include <sstream>

#include "calibrated_cell.hpp"
#include "languages/written_program.hpp"
#include "programs/configuration.hpp"

namespace demecal {

/// A program, and for each of its targets, in the order of the text, the joints that its controller would take.
struct MeantProgram {
  WrittenIn language = WrittenIn::csv;
  std::string text;
  std::vector<JointVector> joints;
  JointVector near{};             ///< that the user gives; empty: none
  Eigen::Isometry3d tool, frame;  ///< as stated, or the described tool and the base
  bool states_tool = false, states_frame = false;
  bool ordinary = true;  ///< its configuration is stated, all is in the measured range and away from singular joints
};

inline constexpr int kDecimals = 9;

inline std::string krl_pose(const Eigen::Isometry3d& pose) {
  std::vector<double> values = in_mm(pose);
  const std::vector<double> angles = abc(pose);
  values.insert(values.end(), angles.begin(), angles.end());
  return named({"X", "Y", "Z", "A", "B", "C"}, values, kDecimals);
}

inline std::string rapid_pose(const Eigen::Isometry3d& pose) {
  return "[" + listed(in_mm(pose), kDecimals) + "],[" + listed(wxyz(pose), kDecimals) + "]";
}

inline std::string ur_pose(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d turn = vector_of(pose.linear());
  return "p[" + listed({pose.translation().data(), 3}, kDecimals) + ", " + listed({turn.data(), 3}, kDecimals) + "]";
}

/// Three letters for the sides on which the arm of cell_arm() has its shoulder, elbow and wrist.
inline std::string configuration_words(const Chain& arm, const JointVector& joints) {
  const auto frame_of = [&](int size) {
    Chain part = arm;
    part.joints.resize(static_cast<std::size_t>(size));
    return forward(part, joints.head(size));
  };
  const Eigen::Isometry3d shoulder = frame_of(1);
  const Eigen::Vector3d elbow = frame_of(2).translation(), wrist = frame_of(4).translation();
  const Eigen::Vector3d upper = elbow - shoulder.translation(), fore = wrist - elbow;
  std::string words = wrist.dot(shoulder.linear().col(0)) > 0.0 ? "F" : "R";
  words += upper.cross(fore).dot(shoulder.linear().col(2)) > 0.0 ? " U" : " D";
  return words + (joints[4] > 0.0 ? " P" : " N");
}

/// Writes one motion after another.
class ProgramWriter {
 public:
  ProgramWriter(WrittenIn language, const CalibratedCell& cell) : cell_(cell) {
    meant.language = language;
    meant.tool = Eigen::Isometry3d(Eigen::Translation3d(cell.nominal.chain.tool_m));
    meant.frame.setIdentity();
  }

  /// The pose that the program writes for the tool at nominal joints.
  Eigen::Isometry3d written_pose(const JointVector& joints) const {
    return meant.frame.inverse() * forward(cell_.nominal.chain, joints) * meant.tool;
  }

  void open() {
    switch (meant.language) {
      case WrittenIn::val2:
        text_ << ".PROGRAM t\n";
        if (meant.states_tool) text_ << " TOOL t1\n";
        text_ << ".END\n.LOCATIONS\n";
        if (meant.states_tool) text_ << "t1 " << val2_pose(meant.tool) << "\n";
        break;
      case WrittenIn::krl:
        text_ << "DEF t()\n";
        if (meant.states_tool) text_ << "$TOOL={" << krl_pose(meant.tool) << "}\n";
        if (meant.states_frame) text_ << "$BASE={" << krl_pose(meant.frame) << "}\n";
        break;
      case WrittenIn::rapid:
        text_ << "MODULE m\n PERS tooldata t1:=[TRUE,[" << rapid_pose(meant.tool)
              << "],[1,[0,0,1],[1,0,0,0],0,0,0]];\n";
        text_ << " PERS wobjdata w1:=[FALSE,TRUE,\"\",[" << rapid_pose(meant.frame) << "],[[0,0,0],[1,0,0,0]]];\n";
        text_ << " PROC main()\n";
        break;
      case WrittenIn::urscript:
        text_ << "def t():\n";
        if (meant.states_tool) text_ << " set_tcp(" << ur_pose(meant.tool) << ")\n";
        break;
      case WrittenIn::fanuc_ls:
        text_ << "/PROG  T\n/MN\n";
        break;
      case WrittenIn::yaskawa_jbi:
        text_ << "/JOB\n//POS\n///POSTYPE BASE\n///RECTAN\n";
        break;
      case WrittenIn::kawasaki_as:
        text_ << ".PROGRAM t()\n";
        break;
      case WrittenIn::val3:
        text_ << "<?xml version=\"1.0\"?>\n<Datas>\n";
        if (meant.states_tool)
          text_ << "<Data name=\"t1\" type=\"tool\"><Value" << val3_numbers(meant.tool) << " /></Data>\n";
        if (meant.states_frame)
          text_ << "<Data name=\"f1\" type=\"frame\"><Value" << val3_numbers(meant.frame) << " /></Data>\n";
        break;
      case WrittenIn::csv:
        break;
    }
  }

  void joint_move(const JointVector& joints) {
    const std::vector<double> angles = in_degrees(joints);
    const std::string number = std::to_string(meant.joints.size() + 1);
    switch (meant.language) {
      case WrittenIn::val2:
        text_ << "#p[" << number << "] " << listed(angles, kDecimals, " ") << '\n';
        break;
      case WrittenIn::csv:
        csv_header("q", joints.size());
        text_ << listed(angles, kDecimals) << '\n';
        break;
      case WrittenIn::krl:
        text_ << "PTP {" << named({"A1", "A2", "A3", "A4", "A5", "A6"}, angles, kDecimals) << "}\n";
        break;
      case WrittenIn::rapid:
        text_ << "  MoveAbsJ [[" << listed(angles, kDecimals) << "],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,"
              << tool_name() << ";\n";
        break;
      case WrittenIn::urscript:
        text_ << " movej([" << listed({joints.data(), 6}, kDecimals) << "], a=1)\n";
        break;
      case WrittenIn::fanuc_ls:
        text_ << ":J P[" << number << "] 100% FINE ;\n";
        data_ << fanuc_position(number, "", {"J1", "J2", "J3", "J4", "J5", "J6"}, angles, kDecimals) << '\n';
        break;
      case WrittenIn::yaskawa_jbi:
        break;
      case WrittenIn::kawasaki_as:
        text_ << " JMOVE #PPOINT(" << listed(angles, kDecimals) << ")\n";
        break;
      case WrittenIn::val3:
        text_ << "<Data name=\"j" << number << "\" type=\"jointRx\">"
              << enclosed({"<Value j1=\"", " j2=\"", " j3=\"", " j4=\"", " j5=\"", " j6=\""}, angles, kDecimals, "\"")
              << " /></Data>\n";
        break;
    }
    meant.joints.push_back(joints);
  }

  /// To a pose, along a line or not, its configuration stated where the language does.
  void pose_move(const JointVector& joints, bool line) {
    const Eigen::Isometry3d pose = written_pose(joints);
    switch (meant.language) {
      case WrittenIn::val2:
        text_ << "p[" << meant.joints.size() + 1 << "] " << val2_pose(pose) << '\n';
        break;
      case WrittenIn::csv:
        csv_header("x", 0);
        text_ << listed(in_mm(pose), kDecimals) << ", " << listed(wxyz(pose), kDecimals) << '\n';
        break;
      case WrittenIn::krl:
        text_ << (line ? "LIN" : "PTP") << " {E6POS: " << krl_pose(pose) << ",S 2,T " << turns(joints) << "}\n";
        break;
      case WrittenIn::rapid:
        text_ << (line ? "  MoveL [" : "  MoveJ [") << rapid_pose(pose) << ","
              << "[" + configuration(joints) + "]"
              << ",[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine," << tool_name() << (meant.states_frame ? "\\WObj:=w1" : "")
              << ";\n";
        break;
      case WrittenIn::urscript:
        text_ << (line ? " movel(" : " movej(") << ur_pose(pose) << ", a=1)\n";
        break;
      case WrittenIn::fanuc_ls:
        text_ << (line ? ":L P[" : ":J P[") << meant.joints.size() + 1 << "] 100% FINE ;\n";
        data_ << fanuc_position(std::to_string(meant.joints.size() + 1),
                                " CONFIG : '" + configuration_words(cell_.nominal.chain, joints) + ", 0, 0, 0',",
                                {"X", "Y", "Z", "W", "P", "R"}, six_numbers(pose, about_fixed_xyz(pose)), kDecimals)
              << '\n';
        break;
      case WrittenIn::yaskawa_jbi:
        text_ << "///RCONF " << configuration_words(cell_.nominal.chain, joints) << "\nC" << meant.joints.size() + 1
              << '=' << listed(six_numbers(pose, about_fixed_xyz(pose)), kDecimals, ",") << '\n';
        data_ << (line ? "MOVL C" : "MOVJ C") << meant.joints.size() + 1 << '\n';
        break;
      case WrittenIn::kawasaki_as:
        text_ << (line ? " LMOVE TRANS(" : " JMOVE TRANS(")
              << listed(six_numbers(pose, pose.linear().eulerAngles(2, 1, 2)), kDecimals) << ")\n";
        break;
      case WrittenIn::val3:
        text_ << "<Data name=\"p" << meant.joints.size() + 1 << "\" type=\"pointRx\"><Value" << val3_numbers(pose)
              << (meant.states_frame ? " fatherId=\"f1[0]\"" : "") << val3_words(joints) << " /></Data>\n";
        break;
    }
    meant.joints.push_back(joints);
  }

  MeantProgram finished() {
    if (meant.language == WrittenIn::val2) text_ << ".END\n";
    if (meant.language == WrittenIn::krl) text_ << "END\n";
    if (meant.language == WrittenIn::rapid) text_ << " ENDPROC\nENDMODULE\n";
    if (meant.language == WrittenIn::urscript) text_ << "end\n";
    if (meant.language == WrittenIn::fanuc_ls) text_ << "/POS\n" << data_.str() << "/END\n";
    if (meant.language == WrittenIn::yaskawa_jbi) text_ << "//INST\nNOP\n" << data_.str() << "END\n";
    if (meant.language == WrittenIn::kawasaki_as) text_ << ".END\n";
    if (meant.language == WrittenIn::val3) text_ << "</Datas>\n";
    meant.text = text_.str();
    return meant;
  }

  MeantProgram meant;

 private:
  static std::string val2_pose(const Eigen::Isometry3d& pose) {
    const Eigen::Matrix3d axes = pose.linear();
    return listed({axes.data(), 9}, kDecimals, " ") + ' ' + listed(in_mm(pose), kDecimals, " ");
  }

  std::string tool_name() const { return "t1"; }

  static std::string val3_numbers(const Eigen::Isometry3d& pose) {
    return enclosed({" x=\"", " y=\"", " z=\"", " rx=\"", " ry=\"", " rz=\""},
                    six_numbers(pose, pose.linear().eulerAngles(0, 1, 2)), kDecimals, "\"");
  }

  std::string val3_words(const JointVector& joints) const {
    const std::string words = configuration_words(cell_.nominal.chain, joints);
    return std::string(" shoulder=\"") + words[0] + "\" elbow=\"" + words[2] + "\" wrist=\"" + words[4] + '"';
  }

  void csv_header(const std::string& kind, Eigen::Index joints) {
    if (!meant.joints.empty()) return;
    if (kind == "x") text_ << "x_mm,y_mm,z_mm,qw,qx,qy,qz\n";
    for (Eigen::Index i = 0; i < joints; ++i) text_ << (i > 0 ? "," : "") << 'q' << i + 1 << "_deg";
    if (kind == "q") text_ << '\n';
  }

  const CalibratedCell& cell_;
  std::ostringstream text_, data_;
};

}  // namespace demecal
