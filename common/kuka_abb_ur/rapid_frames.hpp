// ABB RAPID: tools and work objects, and the motions that name them with their targets.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "kuka_abb_ur/rapid_statements.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {

/// tooldata and wobjdata that the program declares as numbers and assigns nowhere else; tool0 is the flange, wobj0 the
/// base. Every Move instruction takes its tool and \WObj to the targets that it names or holds.
class RapidFrames {
 public:
  RapidFrames(const ProgramText& text, const ControllerData& controller);

  /// Completes a target that was read, by its name and place.
  void complete(Target& target) const;
  bool has_motions() const { return !held_.empty(); }

 private:
  std::vector<TargetUse> uses_of(const std::string& name) const;
  void read_declaration(const std::string& type, std::size_t at);
  void read_move(std::size_t begin, const std::string& word, std::size_t end);
  std::optional<NearPlace> near_place(std::size_t name, std::size_t name_end) const;
  void read_header(std::size_t end);
  void forget_assigned(const std::string& word, std::size_t begin, std::size_t end);
  /// Of a tool that the motion at `begin` names.
  KnownFrame known_tool(const std::string& written, std::size_t begin) const;
  KnownFrame known_object(const std::string& written, std::size_t begin) const;
  bool is_hidden(const std::string& name, std::size_t begin) const;

  const ProgramText& text_;
  const ControllerData& controller_;
  std::vector<TextRange> displaced_;
  std::map<std::string, KnownFrame> tools_, frames_;
  std::map<std::string, std::size_t> local_to_;  ///< names that are LOCAL, and to which file
  std::set<std::size_t> declared_;               ///< where the names of declarations stand
  std::set<std::string> changed_;                ///< names that are given anything when the program runs
  /// Procedures that may change the tool or work object that they are handed.
  std::set<std::string> changers_{"mtooltcpcalib", "mtoolrotcalib", "stooltcpcalib", "stoolrotcalib", "getsysdata",
                                  "strtoval",      "readanybin",    "rmqgetmsgdata", "unpackrawbytes"};
  std::map<std::string, std::vector<TargetUse>> uses_;
  struct Held {
    std::size_t begin, end;  ///< of a motion's targets
    TargetUse use;
  };
  std::vector<Held> held_;
};

}  // namespace demecal::inline kuka_abb_ur
