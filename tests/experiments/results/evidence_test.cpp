#include <cmath>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "estimator/evidence/curves.hpp"
#include "estimator/models/parameters.hpp"
#include "experiments/results/result_files.hpp"
#include "tests/estimator/evidence/random_curves.hpp"

namespace touchdown::experiments {
namespace {

FittedModel fitted_model_of(const EvidenceCurveSets& model) {
  return {{.arrays = arrays_of(parameters_of(model), "evidence_curves")}};
}

TEST(EvidenceTable, HasEveryCurveOverTheRangeOfItsRows) {
  EvidenceModel model = test::random_curves(1);
  model.seen[3] = {-0.1F, 2.0F};
  const Table table = evidence_table({{"mujoco", {{"evidence_curves", fitted_model_of(model)}}}});
  std::size_t rows = 0;
  for (const TableRow& row : table.all()) {
    if (row.text("channel") != "load" || row.text("scale_ms") != "8") continue;
    ++rows;
    EXPECT_EQ(row.text("unit"), "N");
    const double load = row.number("value");
    EXPECT_GE(load, -0.513);
    EXPECT_LE(load, 20.001);
    DecisionInputs inputs{};
    inputs[3] = static_cast<float>(load / 5.0 / (1.0 + std::abs(load) / 20.0));
    EvidenceModel alone;
    alone.curve[3] = model.curve[3];
    EXPECT_NEAR(row.number("evidence_nats"), static_cast<double>(evidence_logit(alone, inputs)),
                1e-4);
  }
  EXPECT_EQ(rows, 10U);  // 0, 0.25, … 2 and the lower end
  EXPECT_EQ(table.all().back().text("channel"), "acceleration_noise");
  EXPECT_NEAR(table.all().back().number("value"), std::exp(2.5), 1e-3);
}

TEST(EvidenceTable, NamesTheSetOfCurves) {
  const EvidenceModel with = test::random_curve_sets(2).usual;
  const EvidenceModel without = test::random_curves(3);
  for (const EvidenceCurveSets& sets :
       {EvidenceCurveSets(with, without), EvidenceCurveSets(with), EvidenceCurveSets(without)}) {
    const Table table =
        evidence_table({{"bullet", {{"evidence_curves_quiet", fitted_model_of(sets)}}}});
    std::map<std::string, std::set<std::string>> channels;
    for (const TableRow& row : table.all()) {
      channels[row.text("targets")].insert(row.text("channel"));
    }
    const bool has_with = !sets.usual.servo_curve.empty();
    EXPECT_EQ(channels.contains("with"), has_with);
    EXPECT_EQ(channels.contains("without"), !has_with || sets.without_targets.has_value());
    for (const auto& [targets, named] : channels) {
      EXPECT_EQ(named.contains("servo_load"), targets == "with");
      EXPECT_TRUE(named.contains("load")) << targets;
    }
  }
}

TEST(EvidenceTable, IsEmptyWithoutCurves) {
  EXPECT_TRUE(evidence_table({}).rows.empty());
  EXPECT_TRUE(evidence_table({{"mujoco", {{"hmm", {}}}}}).rows.empty());
}

}  // namespace
}  // namespace touchdown::experiments
