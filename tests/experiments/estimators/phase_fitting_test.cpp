#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/estimators/fits.hpp"
#include "experiments/signals/reserved_seeds.hpp"

namespace touchdown::experiments {
namespace {

RunSignals run_of_seed(std::uint64_t seed) {
  RunSignals run;
  run.info.scenario = "stairs";
  run.info.simulator = "mujoco";
  run.info.seed = seed;
  run.info.run = 7;
  for (int k = 0; k < 1000; ++k) {
    const bool air = k >= 400 && k < 600;
    Signals s;
    s.time = 0.001 * k;
    s.vertical_acceleration = air ? -9.81 : 0.01 * (k % 7);
    s.leg[0].knee.torque = air ? 0.0 : 1.3;
    s.leg[1].knee.torque = air ? 0.0 : -1.3;
    run.signals.push_back(s);
    for (auto& contact : run.contact) contact.push_back(air ? 0 : 1);
  }
  return run;
}

PhaseFitConfig coarse() {
  PhaseFitConfig config;
  config.torque_noise = {0.0};
  config.acceleration_noise.assign(1, 0.0);
  return config;
}

TEST(PhaseFitting, DrawsItsRunsWithNoReservedSeed) {
  EXPECT_EQ(fit_seed(5), 5U);
  EXPECT_FALSE(is_reserved(fit_seed(first_reserved_seed + 3)));
}

TEST(PhaseFitting, SkipsTheBeginningAndRecordsItsProvenance) {
  const RunSignals run = run_of_seed(3);
  const std::vector<const RunSignals*> runs = {&run};
  const Model model = fit_phases(runs, coarse(), 0.5);
  EXPECT_NEAR(model.phase->seconds[index(Phase::flight)], 0.1, 1e-9);
  EXPECT_EQ(text_of_array(model.arrays.at("provenance"), "provenance"),
            "estimator: phase\nscenarios: stairs\nseconds: 0.500\nseed:run: 3:7\n"
            "simulators: mujoco\n");
}

TEST(PhaseFitting, DetectsTethers) {
  logs::RecordingInfo info;
  EXPECT_FALSE(may_be_held(info));
  info.scenario_yaml = "name: stairs\nterrain: {friction: 1}\n";
  EXPECT_FALSE(may_be_held(info));
  info.scenario_yaml = "name: hang\ntether: {length: 1}\n";
  EXPECT_TRUE(may_be_held(info));
}

TEST(PhaseFitting, RefusesMissingRunsAndMixedRates) {
  EXPECT_THROW(fit_phases({}, coarse(), 0.0), InputError);
  const RunSignals fast = run_of_seed(1);
  RunSignals slow = run_of_seed(2);
  slow.info.control_period_us = 5000;
  EXPECT_THROW(fit_phases(std::vector<const RunSignals*>{&fast, &slow}, coarse(), 0.0), InputError);
}

}  // namespace
}  // namespace touchdown::experiments
