#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/resources.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/logs/fit.hpp"
#include "logs/log/recording_file.hpp"
#include "logs/model_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::HasSubstr;

class Prior : public InFolder {};

TEST_F(Prior, AndFitHaveTheWeightedMean) {
  logs::write_recording(test::synthetic_log(3.0), folder_ / "a.mpack");
  const std::string fit = "fit a.mpack --set smoothness=1e-3 ";
  folder_.output_of(fit + "-o own.npz");
  const std::string text =
      folder_.output_of(fit + "-o mine.npz --prior models/evidence_curves.npz");
  const auto number_after = [&](const std::string& key) {
    return std::stod(text.substr(text.find(key) + key.size()));
  };
  const double air = 0.5e-3 * number_after("no contact");
  const auto curves_in = [](const std::filesystem::path& file) {
    return *experiments::evidence_in(load_model(file));
  };
  const EvidenceModel own = curves_in(folder_ / "own.npz").usual;
  const EvidenceCurveSets mine = curves_in(folder_ / "mine.npz");
  const EvidenceModel prior =
      *curves_in(find_resource("models/evidence_curves.npz")).without_targets;
  EXPECT_FALSE(mine.without_targets) << "the logs were fitted without targets";
  const double weight = air / (air + experiments::prior_seconds);
  for (std::size_t i = 0; i < decision_inputs; ++i) {
    for (std::size_t k = 0; k < evidence_knots; ++k) {
      ASSERT_NEAR(mine.usual.curve[i][k],
                  weight * own.curve[i][k] + (1.0 - weight) * prior.curve[i][k], 1e-5);
    }
  }
  EXPECT_THAT(text, HasSubstr(fmt::format("these logs   {:.0f} % of the model", 100.0 * weight)));
}

TEST_F(Prior, OfAnotherKindIsRefused) {
  logs::write_recording(test::synthetic_log(3.0), folder_ / "a.mpack");
  folder_.output_of("fit a.mpack -o robust.npz --estimator robust");
  folder_.output_of("fit a.mpack -o curves.npz");
  const std::string fit = "fit a.mpack -o m.npz ";
  folder_.expect_refusals(
      {{fit + "--prior robust.npz", {"robust.npz: expected a model of evidence_curves", "robust"}},
       {fit + "--estimator robust --prior models/evidence_curves.npz",
        {"expected --estimator evidence_curves", "found robust"}},
       {fit + "--servo-load --prior curves.npz",
        {"curves.npz: evidence curves: expected curves with targets", "found only curves without"}},
       {"fit a.mpack -o curves.npz --prior curves.npz", {"curves.npz"}}});
  EXPECT_FALSE(folder_.has("m.npz"));
}

}  // namespace
}  // namespace touchdown::cli
