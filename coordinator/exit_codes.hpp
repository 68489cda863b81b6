// What the programs' exit codes mean to scripts.
#pragma once

namespace demecal {

enum class ExitCode : int {
  done = 0,
  wrong_arguments = 10,
  bad_input = 11,      ///< a file is missing, unreadable or invalid
  contradiction = 12,  ///< the data and the robot's description contradict each other
  no_worker = 20,
  run_failed = 21,
  interrupted = 130  ///< what was reached is saved and named
};

}  // namespace demecal
