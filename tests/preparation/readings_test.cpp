// Readings as counts, cord lengths and coordinates are the same points; several of a pose are averaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "preparation/readings.hpp"
#include "random_measurements.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

CordInstrument cords() {
  CordInstrument instrument;
  instrument.corners = *cord_corners({1.2, 1.0, 0.9});
  instrument.top_cords_m = {0.101, 0.102, 0.103};
  instrument.counts_per_m = Eigen::Vector3d(20000, 20100, 19900);
  instrument.zero_counts = {5, -70, 100};
  return instrument;
}

std::string row(const Eigen::Vector3d& values) {
  return number_text(values[0]) + "," + number_text(values[1]) + "," + number_text(values[2]) + "\n";
}

std::string complaint(const std::string& text, const std::optional<CordInstrument>& instrument) {
  try {
    read_readings(table_of(text), instrument);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Readings, AreTheSamePointsInCountsLengthsAndCoordinates) {
  RandomStream stream{63, 1};
  const CordInstrument instrument = cords();
  std::string counts = "a_counts,b_counts,c_counts\n", lengths = "a_mm,b_mm,c_mm\n", points = "x_mm,y_mm,z_mm\n";
  std::vector<Eigen::Vector3d> truth;
  for (int i = 0; i < 50; ++i) {
    truth.emplace_back(stream.real(-1, 1), stream.real(-1, 1), stream.real(0.3, 1.5));
    const Eigen::Vector3d out = cord_lengths(instrument.corners, truth.back()) - instrument.top_cords_m;
    counts += row(out.cwiseProduct(*instrument.counts_per_m) + instrument.zero_counts);
    lengths += row(1e3 * out);
    points += row(1e3 * truth.back());
  }
  for (const std::string& text : {counts, lengths, points}) {
    const Readings readings = read_readings(table_of(text), instrument);
    ASSERT_EQ(readings.rows.size(), truth.size());
    EXPECT_FALSE(readings.named);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_LT((readings.rows[i].point_m - truth[i]).norm(), 1e-11);
      EXPECT_EQ(readings.rows[i].line, i + 2);
    }
  }
}

TEST(Readings, OfOnePoseAreAveragedWithTheirSpread) {
  RandomStream stream{63, 2};
  Readings readings{"readings.csv", {}, true};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < 7; ++i) {
    readings.rows.push_back({"1", random_point(stream, 1.0), Eigen::Vector3d(0.3, 0.2, 0.1), i});
    sum += readings.rows.back().point_m;
    rows.push_back(i);
  }
  const AveragedReading mean = average(readings, rows);
  double squares = 0.0;
  for (const InstrumentReading& reading : readings.rows) squares += (reading.point_m - sum / 7.0).squaredNorm();
  EXPECT_TRUE(mean.point_m.isApprox(sum / 7.0, 1e-14));
  EXPECT_NEAR(*mean.spread_m(), std::sqrt(squares / 6.0), 1e-14);
  EXPECT_TRUE(mean.standard_error_m->isApprox(Eigen::Vector3d(0.3, 0.2, 0.1) / std::sqrt(7.0), 1e-14));
  EXPECT_FALSE(average(readings, {3}).spread_m());
  EXPECT_EQ(average(readings, {3}).point_m, readings.rows[3].point_m);
}

TEST(Readings, MayBeNamedAsPrecisionPointsAre) {
  const std::string rows = "pose,x_mm,y_mm,z_mm\n# a comment, this\n#cp[1],1,2,3\r\n#cp[2],4,5,6\n";
  const Readings readings = read_readings(table_of(with_marked_names(rows, "readings.csv")), {});
  ASSERT_EQ(readings.rows.size(), 2u);
  EXPECT_EQ(readings.rows[0].pose, "#cp[1]");
  EXPECT_EQ(readings.rows[1].line, 4u);
  const std::string plain = "pose,x_mm,y_mm,z_mm\n# a, comment\ncp[1],1,2,3\n";
  EXPECT_EQ(with_marked_names(plain, "readings.csv"), plain);
  try {
    with_marked_names(plain + "#cp[2],4,5,6\n", "readings.csv");
    ADD_FAILURE() << "rows that may have been taken out are read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("readings.csv:4: begins with # as comments do, and other rows do not"));
  }
}

TEST(Readings, NameTheirFaults) {
  const auto with = std::optional(cords());
  auto uncounted = cords();
  uncounted.counts_per_m.reset();
  EXPECT_THAT(complaint("x_mm,y_mm\n1,2\n", {}), HasSubstr("readings.csv:1: 'z_mm': is no column"));
  EXPECT_THAT(complaint("q,w\n1,2\n", {}), HasSubstr("readings.csv:1: the header has none of the columns"));
  EXPECT_THAT(complaint("x_mm,y_mm,z_mm,a_mm\n1,2,3,4\n", {}), HasSubstr("stands beside a_mm"));
  EXPECT_THAT(complaint("x_mm,y_mm,z_mm\n1,,3\n", {}), HasSubstr("readings.csv:2: column y_mm is empty"));
  EXPECT_THAT(complaint("x_mm,y_mm,z_mm\n1,nan,3\n", {}),
              HasSubstr("readings.csv:2: 'nan': column y_mm must be a fin"));
  EXPECT_THAT(complaint("pose,x_mm,y_mm,z_mm\n,1,2,3\n", {}), HasSubstr("column pose is empty"));
  EXPECT_THAT(complaint("a_mm,b_mm,c_mm\n800,800,800\n", {}), HasSubstr("describes no instrument.cords"));
  EXPECT_THAT(complaint("a_counts,b_counts,c_counts\n1,2,3\n", uncounted), HasSubstr("no instrument.cords.encoders"));
  EXPECT_THAT(complaint("a_mm,b_mm,c_mm\n800,800,800\n100,100,100\n", with),
              HasSubstr("readings.csv:3: cords of 201, 202 and 203 mm do not meet"));
  EXPECT_THAT(complaint("a_mm,b_mm,c_mm\n800,-800,800\n", with),
              HasSubstr("readings.csv:2: '-800': column b_mm makes a cord of -698 mm"));
}

}  // namespace
}  // namespace demecal
