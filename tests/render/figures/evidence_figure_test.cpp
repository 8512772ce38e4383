#include <algorithm>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "render/figures/figures.hpp"
#include "tests/render/figures/placed_texts.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::HasSubstr;

/// The evidence of the load at 8 ms is half its compressed value; all other curves are zero.
EvidenceModel of_one_curve() {
  EvidenceModel model;
  for (std::size_t k = 0; k < evidence_knots; ++k) {
    model.curve[3][k] = 0.5F * (-4.0F + 8.0F * static_cast<float>(k) / (evidence_knots - 1));
  }
  for (auto& seen : model.seen) seen = {-1.0F, 1.0F};
  model.seen[3] = {-2.0F, 3.0F};
  return model;
}

/// The compressed value of a load (N): y / (1 + |y| / 4).
double compressed_load(double load) { return load / 5.0 / (1.0 + std::abs(load) / 20.0); }

TEST(CompressedTicks, AreRoundValuesAtTheirPositionsAndStayApart) {
  const auto ticks = compressed_ticks(-2.0, 3.0, 5.0);
  std::vector<double> values;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_NEAR(ticks[i].place, compressed_load(ticks[i].value), 1e-9);
    if (i > 0) {
      EXPECT_GE(ticks[i].place - ticks[i - 1].place, 0.12 * 5.0);
    }
    values.push_back(ticks[i].value);
  }
  EXPECT_THAT(values, testing::ElementsAre(-10.0, 0.0, 10.0, 30.0));
  for (const CompressedTick& tick : compressed_ticks(-3.0, 2.0, 0.0)) {
    EXPECT_NEAR(std::exp(tick.place), tick.value, 1e-9);
  }
  EXPECT_EQ(compressed_ticks(std::log(0.05), std::log(5.0), 0.0).size(), 4U);  // .1, .3, 1, 3
}

TEST(EvidenceFigure, HasItsTextsInsideAndApartOnScreensAndInPrint) {
  const ScratchFolder folder;
  EvidenceModel model = of_one_curve();
  model.seen.fill({-2.0F, 3.0F});
  for (auto& curve : model.curve) curve = model.curve[3];
  for (const FigureFile& file :
       {FigureFile{folder / "screen", {}}, FigureFile{folder / "page", {180.0, false}},
        FigureFile{folder / "column", {88.0, false}}}) {
    expect_texts_inside_and_apart(draw_evidence_figure({"Evidence", model, "Made up."}, file).svg);
  }
}

TEST(EvidenceFigure, DrawsCurvesInTheUnitsOfTheirInputs) {
  const ScratchFolder folder;
  const Figure figure =
      draw_evidence_figure({"Evidence", of_one_curve(), "Made up."}, folder / "evidence");
  EXPECT_TRUE(std::filesystem::exists(figure.png));
  EXPECT_TRUE(std::filesystem::exists(figure.pdf));
  std::istringstream lines(read_file(folder / "evidence.dat"));
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, HasSubstr("nats_8_ms"));
  int seen_by_all = 0;
  double last = 0.0;
  while (std::getline(lines, line) && !line.empty()) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string one; cells >> one;) row.push_back(one);
    ASSERT_EQ(row.size(), 10U);
    const double value = std::stod(row[1]);  // N
    EXPECT_NEAR(std::stod(row[5]), 0.5 * compressed_load(value), 2e-3);
    if (row[2] != "NaN") ++seen_by_all;
    last = value;
  }
  EXPECT_NEAR(last, 60.0, 0.01);
  EXPECT_NEAR(seen_by_all, 96, 2);  // the others end where their training data end
}

TEST(EvidenceFigure, DescribesTheLargestContributionOfEveryChannel) {
  const ScratchFolder folder;
  (void)draw_evidence_figure({"Evidence", of_one_curve(), "Made up."}, folder / "evidence");
  EXPECT_THAT(figure_text(read_file(folder / "evidence.gp")).alt,
              HasSubstr("load 1.50, ground torque 0.00"));
}

TEST(EvidenceFigure, DrawsAModelWithoutTrainingData) {
  const ScratchFolder folder;
  EXPECT_TRUE(
      std::filesystem::exists(draw_evidence_figure({"Nothing", {}, "Flat."}, folder / "flat").svg));
}

}  // namespace
}  // namespace touchdown::render
