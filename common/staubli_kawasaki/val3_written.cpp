#include <span>
#include <string>

#include "kinematics/chain.hpp"
#include "parsed_programs/language.hpp"
#include "staubli_kawasaki/val3_program.hpp"

namespace demecal::inline staubli_kawasaki {
namespace {

std::string xml_of(const std::string& root, const std::string& kind, const std::string& inside) {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<" + root +
         " xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xmlns=\"http://www.staubli.com/robotics/VAL3/" +
         kind + "/2\">\n" + inside + "</" + root + ">\n";
}

std::string data_of(const std::string& name, const std::string& type, const std::string& value) {
  return "<Data name=\"" + name + "\" access=\"private\" xsi:type=\"array\" type=\"" + type +
         "\" size=\"1\">\n  <Value key=\"0\" " + value + " />\n</Data>\n";
}

/// j1="..." to j6="..."
std::string joint_attributes(const Chain& arm, const JointVector& joints) {
  std::string text = joints_text(arm, joints, "\" ", {"j1=", "j2=", "j3=", "j4=", "j5=", "j6="});
  for (std::size_t at = 0; (at = text.find("= ", at)) != std::string::npos;) text.replace(at, 2, "=\"");
  return text + '"';
}

}  // namespace

std::string val3_written_data(std::span<const ProgrammedStop> stops, const Chain& arm) {
  if (!has_six_revolute_joints(arm)) return {};
  std::string text = "<Datas>\n";
  for (const ProgrammedStop& stop : stops) text += data_of(stop.name, "jointRx", joint_attributes(arm, stop.joints));
  text += data_of("mSlow", "mdesc",
                  "accel=\"100\" vel=\"20\" decel=\"100\" tmax=\"99999\" rmax=\"99999\" blend=\"off\" leave=\"0\" "
                  "reach=\"0\"");
  return xml_of("Database", "Data", text + "</Datas>\n");
}

std::string val3_written_program(std::span<const ProgrammedStop> stops) {
  std::string code = "begin\n  userPage()\n";
  for (const ProgrammedStop& stop : stops) {
    code += "  movej(" + stop.name + ", flange, mSlow)\n  waitEndMove()\n";
    if (stop.waits) code += "  putln(\"" + stop.name + ": measure, then press a key\")\n  nKey=get()\n";
  }
  return xml_of("Programs", "Program",
                "<Program name=\"program\" access=\"public\">\n"
                "<Locals>\n  <Local name=\"nKey\" type=\"num\" xsi:type=\"array\" size=\"1\" />\n</Locals>\n"
                "<Code><![CDATA[\n" +
                    code + "end\n]]></Code>\n</Program>\n");
}

}  // namespace demecal::inline staubli_kawasaki
