// DEPART of VAL II and AS: a motion to a place before the location that the arm stands at, against the tool's z axis.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline staubli_kawasaki {

/// Told of the statements of programs in the order of the text.
class Departures {
 public:
  /// The motion at `begin` goes to the location of this key, which the program calls `name`, and ends there.
  void arrive(std::size_t begin, const std::string& key, const std::string& name) { at_ = {begin, key, name}; }
  /// Where the arm stands, or its tool, is that of no location from here.
  void end() { at_ = {}; }
  /// The statement at `begin` is such a motion; its distance stands in [argument, end). Whether it is one.
  bool read(const ProgramText& text, std::size_t begin, std::size_t argument, std::size_t end);

  /// Gives the locations that `way` leads straight from to a departure the motion to the place near them, in `uses` by
  /// their keys, and says in `program` of the others that they go to no location.
  void take(const ProgramText& text, const FrameFlow& way, std::map<std::string, std::vector<TargetUse>>& uses,
            Program& program) const;

 private:
  struct Place {
    std::size_t motion = 0;
    std::string key{}, name{};  ///< empty: it is no location's
  };
  struct Departure {
    std::size_t begin;
    std::string word;
    Place from;
    std::optional<double> distance_mm;
  };
  Place at_{};
  std::vector<Departure> departures_{};
};

}  // namespace demecal::inline staubli_kawasaki
