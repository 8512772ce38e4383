#pragma once

#include <array>
#include <vector>

#include "estimator/evidence/fit.hpp"
#include "tests/estimator/decision/lifted_run.hpp"

namespace touchdown::test {

/// A short fit that suffices to distinguish standing from lifted wheels. No passes at a lower rate:
/// one step in five gives little information on loads that jump within a step.
constexpr EvidenceFitConfig brief_fit(bool with_pairs) {
  EvidenceFitConfig config;
  config.descent.passes = 8;
  config.descent.rows = 80'000;
  config.descent.share_slow = 0.0;
  config.descent.batch = 256;
  config.descent.epochs = 24;
  config.with_pairs = with_pairs;
  return config;
}

/// Curves fitted to a robot that stands, lifts its wheels and falls.
inline const EvidenceModel& lifted_curves(bool with_pairs = true) {
  static const std::array<EvidenceModel, 2> models = [] {
    const CarriedRun run = lifted_run(4, 1);
    const std::vector<LabelledRun> runs = {run.view()};
    return std::array{fit_evidence_model(runs, {}, brief_fit(false)),
                      fit_evidence_model(runs, {}, brief_fit(true))};
  }();
  return models[with_pairs ? 1 : 0];
}

}  // namespace touchdown::test
