#include "render/figures/log_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::HasSubstr;
using ::testing::NanSensitiveDoubleEq;

/// Columns of the table: of the shares of contact, of true contact, of the numbers of steps by
/// status.
constexpr std::size_t contact_at = 2 + 2 * log_curve_count;
constexpr std::size_t truth_at = contact_at + 2;
constexpr std::size_t status_at = truth_at + 2;
constexpr std::size_t columns = status_at + 4;

LogTraceStep step_at(std::size_t k) {
  LogTraceStep step;
  step.time = 0.001 * static_cast<double>(k);
  const bool air = k % 1000 >= 700;
  step.value.fill(NAN);
  const std::array values = {air ? 0.1 : 1.2, air ? -0.1 : -1.2, 0.2, -0.3, k == 4321 ? 250.0 : 0.0,
                             air ? 0.0 : 1.0, air ? 0.1 : 0.9,   0.3, 0.4};
  std::copy(values.begin(), values.end(), step.value.begin());
  step.contact = {!air, true};
  step.true_contact = {!air, k % 2 == 0};
  if (k == 1234) step.status = SignalStatus::invalid;
  return step;
}

/// Numbers of a data file; empty lines are left out.
std::vector<std::vector<double>> rows_of(const std::string& table) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, '\t');) {
      rows.back().push_back(cell == "NaN" ? NAN : std::stod(cell));
    }
  }
  return rows;
}

TEST(LogTrace, KeepsEveryStepOfAShortLog) {
  LogTrace trace(500);
  for (std::size_t k = 1000; k < 1500; ++k) trace.add(step_at(k));
  const auto rows = rows_of(trace.table());
  ASSERT_EQ(rows.size(), 500U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), columns);
    const LogTraceStep step = step_at(1000 + i);
    EXPECT_EQ(rows[i][0], step.time);
    EXPECT_EQ(rows[i][1], step.time);
    for (std::size_t c = 0; c < log_curve_count; ++c) {
      EXPECT_THAT(rows[i][2 + 2 * c], NanSensitiveDoubleEq(step.value[c]));
      EXPECT_THAT(rows[i][3 + 2 * c], NanSensitiveDoubleEq(step.value[c]));
    }
    EXPECT_EQ(rows[i][contact_at], step.contact[0] ? 1.0 : 0.0);
    EXPECT_EQ(rows[i][truth_at + 1], (*step.true_contact)[1] ? 1.0 : 0.0);
    EXPECT_EQ(rows[i][status_at + 1], 1000 + i == 1234 ? 1.0 : 0.0);
  }
}

TEST(LogTrace, LosesNoSpikeAndNoStepOfALongLogAtAConstantMemory) {
  LogTrace trace(100);
  constexpr std::size_t steps = 123'457;
  for (std::size_t k = 0; k < steps; ++k) {
    trace.add(step_at(k));
    ASSERT_LE(trace.bins().size(), 100U);
  }
  const auto rows = rows_of(trace.table());
  double highest = 0.0;
  double contact = 0.0;
  double invalid = 0.0;
  double all = 0.0;
  for (const auto& row : rows) {
    const double of_bin =
        row[status_at] + row[status_at + 1] + row[status_at + 2] + row[status_at + 3];
    highest = std::max(highest, row[2 + 2 * 4 + 1]);
    contact += row[contact_at] * of_bin;
    invalid += row[status_at + 1];
    all += of_bin;
  }
  EXPECT_EQ(highest, 250.0);
  EXPECT_EQ(all, steps);
  EXPECT_EQ(invalid, 1.0);
  EXPECT_NEAR(contact, 123 * 700 + 457, 1e-6);
  EXPECT_GT(rows.size(), 49U);
  EXPECT_EQ(rows.back()[1], 0.001 * (steps - 1));
}

TEST(LogTrace, BreaksTheLineAtAGap) {
  LogTrace trace;
  for (std::size_t k = 0; k < 10; ++k) {
    LogTraceStep step = step_at(k);
    if (k >= 5) step.time += 3.0;
    if (k == 5) step.status = SignalStatus::gap;
    trace.add(step);
  }
  const std::string table = trace.table();
  EXPECT_EQ(table.find("\n\n"), table.rfind("\n\n"));
  EXPECT_THAT(table, HasSubstr("\n\n3.005\t"));
}

TEST(LogTrace, LeavesOutMissingValues) {
  LogTrace trace(2);
  for (std::size_t k = 0; k < 40; ++k) {
    LogTraceStep step = step_at(k);
    step.true_contact.reset();
    step.value[0] = NAN;
    if (k != 7) step.value[1] = NAN;
    trace.add(step);
  }
  const auto rows = rows_of(trace.table());
  EXPECT_TRUE(std::isnan(rows[0][2]));
  EXPECT_EQ(rows[0][4], -1.2);
  EXPECT_TRUE(std::isnan(rows[0][truth_at]));
}

TEST(LogFigure, IsDrawnWithItsDataBesideIt) {
  const ScratchFolder folder;
  LogTrace trace;
  for (std::size_t k = 0; k < 3000; ++k) trace.add(step_at(k));
  const Figure figure = draw_log(trace, "it's a log", folder / "log.1");
  EXPECT_EQ(figure.png, folder / "log.1.png");
  EXPECT_EQ(cv::imread(figure.png.string()).rows, 1000);
  const std::string picture = read_file(figure.svg);
  for (const char* text : {"it's a log", "knee (N·m)", "P(switch)", "true", "frozen", "time (s)"}) {
    EXPECT_THAT(picture, HasSubstr(text));
  }
  EXPECT_EQ(read_file(folder / "log.1.dat"), trace.table());
  // Both curves' pixels are there: blue for the left leg, orange for the right one.
  const cv::Mat image = cv::imread(figure.png.string());
  int blue = 0;
  int orange = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const auto& pixel = image.at<cv::Vec3b>(y, x);
      blue += pixel == cv::Vec3b(0xb2, 0x72, 0x00) ? 1 : 0;
      orange += pixel == cv::Vec3b(0x00, 0x5e, 0xd5) ? 1 : 0;
    }
  }
  EXPECT_GT(blue, 5000);
  EXPECT_GT(orange, 5000);
}

TEST(LogFigure, OfOneStepOrWithoutTransitionsOrTruthCanBeDrawn) {
  const ScratchFolder folder;
  LogTrace trace;
  LogTraceStep step = step_at(0);
  step.true_contact.reset();
  step.value[7] = step.value[8] = NAN;
  trace.add(step);
  const std::string picture = read_file(draw_log(trace, "", folder / "one").svg);
  EXPECT_EQ(picture.find("P(switch)"), std::string::npos);
  EXPECT_EQ(picture.find(">true<"), std::string::npos);
  EXPECT_THROW(draw_log(LogTrace(), "", folder / "none"), InputError);
}

}  // namespace
}  // namespace touchdown::render
