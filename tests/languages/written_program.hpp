// Programs of every language, written from joints or tool poses, with what people leave between them.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <span>
#include <sstream>

#include "data/text.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/random_arm.hpp"
#include "kinematics/units.hpp"
#include "languages/named_languages.hpp"

namespace demecal {

/// Numbers with so many decimals, separated so.
inline std::string listed(std::span<const double> values, int decimals, const std::string& separator = ", ") {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals);
  for (std::size_t i = 0; i < values.size(); ++i) text << (i > 0 ? separator : "") << values[i];
  return text.str();
}

/// "A1 1.0, A2 2.0": every number behind its name.
inline std::string named(const std::vector<std::string>& names, const std::vector<double>& values, int decimals) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += (i > 0 ? ", " : "") + names[i] + ' ' + listed({&values[i], 1}, decimals);
  }
  return text;
}

inline std::vector<double> in_degrees(const JointVector& joints) {
  std::vector<double> values;
  for (const double angle : joints) values.push_back(degrees(angle));
  return values;
}

inline std::vector<double> in_mm(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d point = 1e3 * pose.translation();
  return {point.x(), point.y(), point.z()};
}

/// KUKA's A, B, C in degrees.
inline std::vector<double> abc(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d angles = pose.linear().eulerAngles(2, 1, 0);
  return {degrees(angles.x()), degrees(angles.y()), degrees(angles.z())};
}

inline std::vector<double> wxyz(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond turn(pose.linear());
  return {turn.w(), turn.x(), turn.y(), turn.z()};
}

/// Every number between the text before it and the text behind it.
inline std::string enclosed(const std::vector<std::string>& before, const std::vector<double>& values, int decimals,
                            const std::string& behind) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) text += before[i] + listed({&values[i], 1}, decimals) + behind;
  return text;
}

/// FANUC's position of so many deg and mm.
inline std::string fanuc_position(const std::string& number, const std::string& words,
                                  const std::vector<std::string>& names, const std::vector<double>& values,
                                  int decimals) {
  std::string text = "P[" + number + "]{\n   GP1:\n\tUF : 0," + words;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool length = names[i] == "X" || names[i] == "Y" || names[i] == "Z";
    text +=
        (i == 0 ? "\n\t" : ",\t") + names[i] + " =  " + listed({&values[i], 1}, decimals) + (length ? "  mm" : " deg");
  }
  return text + "\n   GP2:\n\tUF : 0, UT : 2,\n\tJ1=   100.000  mm\n};";
}

/// x, y, z in mm and three angles in degrees.
inline std::vector<double> six_numbers(const Eigen::Isometry3d& pose, const Eigen::Vector3d& angles_rad) {
  std::vector<double> values = in_mm(pose);
  for (const double angle : angles_rad) values.push_back(degrees(angle));
  return values;
}
/// W, P, R of FANUC and Rx, Ry, Rz of Yaskawa, rad.
inline Eigen::Vector3d about_fixed_xyz(const Eigen::Isometry3d& pose) {
  return pose.linear().eulerAngles(2, 1, 0).reverse();
}

/// One target's text in its language; `index` makes its name.
inline std::string joints_line(WrittenIn language, const JointVector& joints, int index, int decimals) {
  const std::vector<double> angles = in_degrees(joints);
  const std::string number = std::to_string(index);
  switch (language) {
    case WrittenIn::val2:
      return "#cp[" + number + "]  " + listed(angles, decimals, " ");
    case WrittenIn::csv:
      return number + ", " + listed(angles, decimals) + ",a note";
    case WrittenIn::krl:
      return "DECL E6AXIS XP" + number + "={" + named({"A1", "A2", "A3", "A4", "A5", "A6"}, angles, decimals) +
             ",E1 0.0}";
    case WrittenIn::rapid:
      return "CONST jointtarget jp" + number + ":=[[" + listed(angles, decimals) +
             "],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];";
    case WrittenIn::urscript:
      return "movej([" + listed({joints.data(), 6}, decimals) + "], a=1.4, v=0.5)";
    case WrittenIn::fanuc_ls:
      return fanuc_position(number, "", {"J1", "J2", "J3", "J4", "J5", "J6"}, angles, decimals);
    case WrittenIn::yaskawa_jbi:
      return "C0000" + number + "=1000,-2000,3000,0,5000,-6000";
    case WrittenIn::kawasaki_as:
      return "#p" + number + "  " + listed(angles, decimals, "  ");
    case WrittenIn::val3:
      return "      <Value key=\"" + number + '"' +
             enclosed({" j1=\"", " j2=\"", " j3=\"", " j4=\"", " j5=\"", " j6=\""}, angles, decimals, "\"") + " />";
  }
  return "";
}

/// RAPID's quadrants of joints 1, 4 and 6.
inline std::string configuration(const JointVector& joints) {
  std::string text;
  for (const int joint : {0, 3, 5})
    text += std::to_string(static_cast<int>(std::floor(2.0 * joints[joint] / std::numbers::pi))) + ',';
  return text + '0';
}

/// KUKA's T: a bit for every joint below zero.
inline std::string turns(const JointVector& joints) {
  int bits = 0;
  for (int joint = 0; joint < 6; ++joint) bits |= joints[joint] < 0.0 ? 1 << joint : 0;
  return std::to_string(bits);
}

/// The tool's pose, reached with these joints.
inline std::string pose_line(WrittenIn language, const Eigen::Isometry3d& pose, const JointVector& joints, int index,
                             int decimals) {
  const std::vector<double> point = in_mm(pose);
  const std::string number = std::to_string(index);
  switch (language) {
    case WrittenIn::val2: {
      const Eigen::Matrix3d axes = pose.linear();
      return "mcp[" + number + "] " + listed({axes.data(), 9}, decimals, " ") + ' ' + listed(point, decimals, " ");
    }
    case WrittenIn::csv:
      return number + ", " + listed(point, decimals) + ", " + listed(wxyz(pose), decimals) + ",a note";
    case WrittenIn::krl: {
      std::vector<double> values = point;
      const std::vector<double> angles = abc(pose);
      values.insert(values.end(), angles.begin(), angles.end());
      return "DECL E6POS XP" + number + "={" + named({"X", "Y", "Z", "A", "B", "C"}, values, decimals) + ",S 2,T " +
             turns(joints) + ",E1 0.0}";
    }
    case WrittenIn::rapid:
      return "MoveL [[" + listed(point, decimals) + "],[" + listed(wxyz(pose), decimals) + "],[" +
             configuration(joints) + "],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]],v200,fine,t_test;";
    case WrittenIn::urscript: {
      const Eigen::Vector3d turn = vector_of(pose.linear());
      return "movel(p[" + listed({pose.translation().data(), 3}, decimals) + ", " + listed({turn.data(), 3}, decimals) +
             "], a=1.2, v=0.25)";
    }
    case WrittenIn::fanuc_ls:
      return fanuc_position(number, "", {"X", "Y", "Z", "W", "P", "R"}, six_numbers(pose, about_fixed_xyz(pose)),
                            decimals);
    case WrittenIn::yaskawa_jbi:
      return "C0000" + number + '=' + listed(six_numbers(pose, about_fixed_xyz(pose)), decimals, ",");
    case WrittenIn::kawasaki_as:
      return "p" + number + "   " + listed(six_numbers(pose, pose.linear().eulerAngles(2, 1, 2)), decimals, "   ") +
             "   1.5";
    case WrittenIn::val3:
      return "      <Value key=\"" + number + '"' +
             enclosed({" x=\"", " y=\"", " z=\"", " rx=\"", " ry=\"", " rz=\""},
                      six_numbers(pose, pose.linear().eulerAngles(0, 1, 2)), decimals, "\"") +
             " fatherId=\"world[0]\" />";
  }
  return "";
}

/// A motion to each of the first nine targets, the number between the two texts.
inline std::string motions(const std::string& before, const std::string& behind) {
  std::string text;
  for (int target = 1; target <= 9; ++target) text += before + std::to_string(target) + behind;
  return text;
}

/// What stands before and behind the targets: languages that state tools state that of elbow_arm().
inline std::string opening(WrittenIn language, bool of_poses) {
  switch (language) {
    case WrittenIn::val2:
      return ".PROGRAM t1\n  FOR l = 1 TO 30 ; a comment with #cp[1] 1 2 3\n  MOVE #cp[l]\n  END\n.END\n.LOCATIONS\n";
    case WrittenIn::csv:
      return of_poses ? "# a comment\nid, x_mm, y_mm, z_mm, qw, qx, qy, qz, note\n"
                      : "id, q1_deg, q2_deg, q3_deg, q4_deg, q5_deg, q6_deg, note\n";
    case WrittenIn::krl:
      return "&ACCESS RVP\nDEFDAT points ; {A1 1, A2 2}\n$BASE={X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\n";
    case WrittenIn::rapid:
      return "%%%\n VERSION:1\n%%%\nMODULE m ! [[1,2,3],[1,0,0,0]]\n"
             " PERS tooldata t_test:=[TRUE,[[150,2,56],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n";
    case WrittenIn::urscript:
      return "def prog(): # movej([1,2,3,4,5,6])\n  set_tcp(p[0.15,0.002,0.056,0.0,0.0,0.0])\n";
    case WrittenIn::fanuc_ls:
      return "/PROG  T\n/ATTR\nCOMMENT\t\t= \"P[1]{J1=1 deg}\";\n/MN\n   1:  !J P[1] 100% FINE INC ;\n" +
             motions("   :" + std::string(of_poses ? "L" : "J") + " P[", "] 100% FINE    ;\n") + "/POS\n";
    case WrittenIn::yaskawa_jbi:
      return "/JOB\n//NAME T\n//POS\n///NPOS 9,0,0,0,0,0\n" +
             std::string(of_poses ? "///POSTYPE BASE\n///RECTAN\n" : "///POSTYPE PULSE\n///PULSE\n");
    case WrittenIn::kawasaki_as:
      return ".PROGRAM t()\n  ; JMOVE #p1\n" + motions(of_poses ? "  LMOVE p" : "  JMOVE #p", "\n") +
             (of_poses ? ".END\n.TRANS\n" : ".END\n.JOINTS\n");
    case WrittenIn::val3:
      return "<?xml version=\"1.0\" encoding=\"utf-8\" ?>\n<Database>\n  <Datas>\n    <!-- <Value key=\"0\" j1=\"2\" "
             "/> "
             "-->\n    <Data name=\"p\" access=\"public\" xsi:type=\"array\" type=\"" +
             std::string(of_poses ? "pointRx" : "jointRx") + "\" size=\"9\">\n";
  }
  return "";
}

inline std::string closing(WrittenIn language) {
  switch (language) {
    case WrittenIn::val2:
      return ".END\n.PROGRAM t2\n.END";
    case WrittenIn::krl:
      return "ENDDAT";
    case WrittenIn::rapid:
      return "ENDMODULE";
    case WrittenIn::urscript:
      return "end";
    case WrittenIn::fanuc_ls:
      return "/END";
    case WrittenIn::yaskawa_jbi:
      return "//INST\n///DATE 2024/01/01 12:00\nNOP\n'MOVL C00001\n" + motions("MOVL C0000", " V=50.0\n") + "END";
    case WrittenIn::kawasaki_as:
      return ".END";
    case WrittenIn::val3:
      return "    </Data>\n  </Datas>\n</Database>";
    case WrittenIn::csv:
      break;
  }
  return "";
}

/// A whole program; `line` writes one target from its index.
template <typename Line>
std::string written(WrittenIn language, bool of_poses, int targets, const Line& line, const std::string& line_break) {
  std::string lines = opening(language, of_poses);
  for (int i = 1; i <= targets; ++i) lines += line(i) + '\n';
  lines += closing(language);
  std::string text;
  for (const char letter : lines) text += letter == '\n' ? line_break : std::string(1, letter);
  return text;
}

/// The text with every number that is a target's taken out: what correction must keep.
inline std::string without_cells(const std::string& text, const Program& program) {
  std::string rest = text;
  for (auto target = program.targets.rbegin(); target != program.targets.rend(); ++target) {
    std::vector<Cell> cells = target->joints;
    cells.insert(cells.end(), target->position.begin(), target->position.end());
    if (target->form != OrientationForm::columns) {
      cells.insert(cells.end(), target->orientation.begin(), target->orientation.end());
    }
    for (auto cell = cells.rbegin(); cell != cells.rend(); ++cell) rest.erase(cell->begin, cell->size);
  }
  return rest;
}

}  // namespace demecal
