// The cells of a study are the jobs that a user would have written by hand, and faults are named where they were made.
#include "config/job_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_files.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<GridCell> cells_of(const std::vector<std::string>& options) {
  const TemporaryFolder folder;
  std::vector<GridAxis> axes;
  for (const std::string& option : options) axes.push_back(read_axis(option));
  return grid_cells(folder.write("job.yaml", kJobText), axes);
}

TEST(StudyGrid, HasTheJobAloneWithoutAxes) {
  const TemporaryFolder folder;
  const auto job_file = folder.write("job.yaml", kJobText);
  const std::vector<GridCell> cells = grid_cells(job_file, {});
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_EQ(cells.front().job.gp, load_job(job_file).gp);
  EXPECT_EQ(cells.front().job.data_files, load_job(job_file).data_files);
  EXPECT_EQ(cells.front().job.name, "job");
}

TEST(StudyGrid, TurnsTheLastAxisFastest) {
  const std::vector<GridCell> cells = cells_of({"gp.population_size=100,300", "islands.per_joint=1,2,4"});
  ASSERT_EQ(cells.size(), 6U);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int sizes[] = {100, 300};
    const std::uint32_t demes[] = {1, 2, 4};
    EXPECT_EQ(cells[i].job.gp.population_size, sizes[i / 3]);
    EXPECT_EQ(cells[i].job.islands.per_joint, demes[i % 3]);
    EXPECT_EQ(cells[i].job.seed, 7U);
  }
  EXPECT_THAT(cells[4].values, ElementsAre("300", "2"));
}

struct Edit {
  const char* option;
  const char* from;  ///< in the sample job
  const char* to;    ///< the same by hand
};

TEST(StudyGrid, GivesTheJobOfTheFileEditedByHand) {
  const TemporaryFolder folder;
  for (const Edit& edit :
       {Edit{"gp.tournament_size=9", "tournament_size: 4", "tournament_size: 9"},
        Edit{"gp.constants_range=[0,3]", "[-2, 2.5]", "[0, 3]"},
        Edit{"gp.functions=['+','*',COS]", "['+', '-', '*', '%', SIN, SQRTp]", "['+', '*', COS]"},
        Edit{"gp.constants=baldwin", "crossover_rate: 0.7", "crossover_rate: 0.7\n  constants: baldwin"},
        Edit{"islands.topology=none", "topology: full", "topology: none"},
        Edit{"distal.rounds=5", "rounds: 3", "rounds: 5"}, Edit{"method=direct", "method: distal", "method: direct"}}) {
    const std::string by_hand = changed(kJobText, edit.from, edit.to);
    const Job expected = load_job(folder.write("job.yaml", by_hand));
    const std::vector<GridCell> cells = cells_of({edit.option});
    ASSERT_EQ(cells.size(), 1U) << edit.option;
    const Job& job = cells.front().job;
    EXPECT_EQ(job.gp, expected.gp) << edit.option;
    EXPECT_EQ(job.islands.topology, expected.islands.topology) << edit.option;
    EXPECT_EQ(job.islands.per_joint, expected.islands.per_joint) << edit.option;
    EXPECT_EQ(job.distal.rounds, expected.distal.rounds) << edit.option;
    EXPECT_EQ(job.method, expected.method) << edit.option;
  }
}

TEST(StudyGrid, MakesTheMapsThatTheJobLacks) {
  const TemporaryFolder folder;
  const auto job_file = folder.write("job.yaml", "demecal_job: 1\ndata: dataset.yaml\n");
  const std::vector<GridCell> cells =
      grid_cells(job_file, {read_axis("gp.population_size=50"), read_axis("islands.migrants=49")});
  EXPECT_EQ(cells.front().job.gp.population_size, 50);
  EXPECT_EQ(cells.front().job.islands.migrants, 49U);
}

TEST(StudyGrid, IsReadFromAFileAsFromOptions) {
  const TemporaryFolder folder;
  const auto grid = folder.write("grid.yaml",
                                 "# a grid\ndemecal_grid: 1\ngp:\n  population_size: [100, 300]\n"
                                 "  constants_range: [[0, 1], [-1, 1]]\nmethod: [direct, distal]\n");
  const auto job_file = folder.write("job.yaml", kJobText);
  const std::vector<GridCell> by_file = grid_cells(job_file, load_grid(grid));
  const std::vector<GridCell> by_options =
      cells_of({"gp.population_size=100,300", "gp.constants_range=[0, 1],[-1, 1]", "method=direct,distal"});
  ASSERT_EQ(by_file.size(), 8U);
  ASSERT_EQ(by_options.size(), 8U);
  for (std::size_t i = 0; i < by_file.size(); ++i) {
    EXPECT_EQ(by_file[i].values, by_options[i].values);
    EXPECT_EQ(by_file[i].job.gp, by_options[i].job.gp);
    EXPECT_EQ(by_file[i].job.method, by_options[i].job.method);
  }
}

TEST(StudyGrid, NamesOptionValueAndRule) {
  EXPECT_THAT(complaint([] { read_axis("gp.population_size"); }), HasSubstr("must be KEY=VALUE,VALUE"));
  EXPECT_THAT(complaint([] { read_axis("data=a.yaml"); }), HasSubstr("'data': is nothing that a study varies"));
  EXPECT_THAT(complaint([] { read_axis("gp.=1"); }), HasSubstr("is nothing that a study varies"));
  EXPECT_THAT(complaint([] { read_axis("gp.population_size="); }), HasSubstr("must list the values"));
  EXPECT_THAT(complaint([] { read_axis("gp.population_size=3,4,3"); }),
              HasSubstr("'3': gp.population_size[3] stands twice"));
  EXPECT_THAT(complaint([] { read_axis("gp.population_size=[3"); }), HasSubstr("is not valid YAML"));
  EXPECT_THAT(complaint([] { read_axis("gp.seed_models=[a.yaml]"); }), HasSubstr("only a grid file"));
}

TEST(StudyGrid, NamesWhatMakesACellNoValidJob) {
  const std::string said = complaint([] { cells_of({"islands.per_joint=1,2", "gp.crossover_rate=0.5,1.5"}); });
  EXPECT_THAT(said, StartsWith("--set gp.crossover_rate=0.5,1.5: '1.5': gp.crossover_rate must lie within 0 to 1"));
  EXPECT_THAT(said, HasSubstr("(in the cell with islands.per_joint 1, gp.crossover_rate 1.5)"));
  EXPECT_THAT(
      complaint([] { cells_of({"gp.populaton_size=10"}); }),
      HasSubstr("--set gp.populaton_size=10: 'populaton_size': is no key of gp; the nearest is 'population_size'"));
  EXPECT_THAT(complaint([] { cells_of({"gp.max_tree_depth=8,5"}); }), HasSubstr("gp.max_tree_depth 5"));
  EXPECT_THAT(complaint([] { cells_of({"method=direct", "method=distal"}); }), HasSubstr("'method': is varied twice"));
}

TEST(StudyGrid, NamesTheLineOfTheGridFile) {
  const TemporaryFolder folder;
  const auto job_file = folder.write("job.yaml", kJobText);
  const auto grid = folder.write("grid.yaml", "demecal_grid: 1\ngp:\n  population_size:\n    - 100\n    - many\n");
  EXPECT_THAT(complaint([&] { grid_cells(job_file, load_grid(grid)); }),
              StartsWith(grid.string() + ":5: 'many': gp.population_size must be a whole number"));
  const auto scalar = folder.write("scalar.yaml", "demecal_grid: 1\ngp: {population_size: 100}\n");
  EXPECT_THAT(complaint([&] { load_grid(scalar); }), HasSubstr("gp.population_size must be a list"));
  const auto unknown = folder.write("unknown.yaml", "demecal_grid: 1\ngb: {population_size: [100]}\n");
  EXPECT_THAT(complaint([&] { load_grid(unknown); }), HasSubstr("the nearest is 'gp'"));
}

TEST(StudyGrid, HasAnEnd) {
  const std::string values = "1,2,3,4,5,6,7,8,9,10,11";
  EXPECT_THAT(complaint([&] {
                cells_of({"islands.per_joint=" + values, "islands.migrants=" + values, "gp.tournament_size=" + values,
                          "gp.invalid_attempts=" + values});
              }),
              HasSubstr("makes more than 10000 cells"));
}

}  // namespace
}  // namespace demecal
