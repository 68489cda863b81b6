#include "coordinator/prepared_recordings.hpp"

#include <fmt/format.h>
#include <string>
#include <vector>

#include "coordinator/result_folder.hpp"
#include "data_check/check_data.hpp"
#include "data_files/data_set_file.hpp"
#include "terminal/report_text.hpp"
#include "yaml/files.hpp"

namespace demecal {

ExitCode prepare_recordings(const Recordings& recordings, const RecordedOutput& output) {
  const RecordedContacts found = find_contacts(recordings);
  const DataSet data = recorded_data_set(recordings, found);
  if (!output.json) fmt::print("{}", recorded_table(recordings, found));
  const CheckedData checked{data, check_data(data)};
  if (refuses(checked, output.force)) return ExitCode::contradiction;
  fmt::print(stderr, "{}", to_terminal(data_check_entry(checked.check)));

  const WrittenFile standstills = standstills_file(recordings, found);
  const std::vector<std::string> names{"dataset.yaml", "poses.csv", "robot.yaml", standstills.name};
  make_writable(output.out, names, output.force);
  const FilesBeingWritten written(output.out, names);
  write_data_set(data, output.out, "Prepared from raw measurements: " + recordings.name);
  write_file(output.out + "/" + standstills.name, standstills.text);
  if (output.json)
    fmt::print("{}", recorded_json(recordings, found, names));
  else
    fmt::print("{}: {}\n", output.out, fmt::join(names, ", "));
  return ExitCode::done;
}

}  // namespace demecal
