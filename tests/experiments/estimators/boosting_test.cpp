#include "experiments/estimators/boosting.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/signals/run_signals.hpp"
#include "tests/experiments/synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

TEST(GradientBoostingEntry, KeepsItsTreesToTheBitInAFile) {
  const ScratchFolder folder;
  const EstimatorEntry entry = gradient_boosting_entry();
  EXPECT_TRUE(entry.is_upper_bound);
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const FittedModel fitted = entry.fit(entry, {.whole = {&run}});
  write_fitted_model(fitted, folder.path() / "m.npz");
  const FittedModel read = read_fitted_model(ModelKind::parameters, folder.path() / "m.npz");
  EXPECT_EQ(read.parameters->parameters, fitted.parameters->parameters);
  const RunSignals other = synthetic_run(3, 1500);
  const auto p_contact_of = [&](const FittedModel& model) {
    return predict(*entry.make(entry, {.model = &model}), other, noise_run(other, {}), {})[1]
        .p_contact;
  };
  EXPECT_EQ(p_contact_of(read), p_contact_of(fitted));
}

TEST(GradientBoostingEntry, RefusesInvalidTrees) {
  const EstimatorEntry entry = gradient_boosting_entry();
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const FittedModel fitted = entry.fit(entry, {.whole = {&run}});
  const auto refused = [&](const char* name, const auto& change) {
    recordings::ParameterModelFile file = *fitted.parameters;
    change(file.parameters.at(name));
    const FittedModel model = {.parameters =
                                   std::make_shared<recordings::ParameterModelFile>(file)};
    EXPECT_THROW(entry.make(entry, {.model = &model}), InputError) << name;
  };
  refused("leaf", [](std::vector<double>& values) { values.pop_back(); });
  refused("feature", [](std::vector<double>& values) { values[0] = 1e9; });
  refused("feature", [](std::vector<double>& values) { values[0] = -1.0; });
  refused("depth", [](std::vector<double>& values) { values[0] = 1e300; });
  refused("trees", [](std::vector<double>& values) { values[0] = -5.0; });
  refused("threshold", [](std::vector<double>& values) { values[3] = 1e300; });
}

}  // namespace
}  // namespace touchdown::experiments
