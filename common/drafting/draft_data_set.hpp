// A first DATASET.yaml from what was measured, for people to look through.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "tables/guess_columns.hpp"
#include "tables/layout.hpp"
#include "tables/read_table.hpp"

namespace demecal::inline drafting {

/// A table that somebody gives, and what its columns seem to hold.
struct GivenTable {
  std::filesystem::path path;
  RecognisedTable read;
  GuessedColumns columns;
};

/// `joints`: how many the arm has; 0: as many as a table seems to have. `joint_names`: what a URDF calls them. `rails`:
/// so many of them, the first, are rails.
std::vector<GivenTable> read_given_tables(const std::vector<std::filesystem::path>& files, std::size_t joints,
                                          const ToldLayout& told, const std::vector<std::string>& joint_names = {},
                                          std::size_t rails = 0);

/// How many joints that slide stand before the first that turns.
std::size_t leading_rails(const Chain& chain);

/// Whether every table names its points in texts, of which most are the same.
bool most_names_agree(const std::vector<GivenTable>& tables);

/// As the arm's file names its joints; empty where it does not.
std::vector<std::string> joint_names(const Robot& robot);

/// A data set's text, and what it takes for granted, a sentence each.
struct DataSetDraft {
  std::string text;
  std::vector<std::string> assumed;
};

/// One draft for every way in which rows of the tables may belong together, the likeliest first: by name, time, order;
/// a single one where there is one table. Paths are written relative to `folder`; `robot` as it stands. Throws
/// InputError where no table has joints, or none has anything measured.
std::vector<DataSetDraft> draft_data_sets(const std::vector<GivenTable>& tables, const std::filesystem::path& folder,
                                          const std::string& robot, std::size_t joints, const ToldLayout& told,
                                          std::size_t rails = 0);

/// Joints and the positions that a controller shows for them, as people note them down: columns as guess_columns()
/// knows them, mm and deg where headings state no unit. All poses are for calibration, in the base's frame. Throws
/// InputError where the table has no joints or no positions.
DataSet read_pendant_poses(const std::filesystem::path& path, const Robot& robot);

}  // namespace demecal::inline drafting
