#pragma once

#include <vector>

#include "estimator/evidence/fit.hpp"
#include "tests/estimator/decision/lifted_run.hpp"

namespace touchdown::test {

/// A short fit that suffices to distinguish standing from lifted wheels. No passes at a lower rate:
/// one step in five gives little information on loads that jump within a step.
constexpr EvidenceFitConfig brief_fit() {
  EvidenceFitConfig config;
  config.descent.passes = 8;
  config.descent.rows = 80'000;
  config.descent.share_slow = 0.0;
  config.descent.batch = 256;
  config.descent.epochs = 24;
  config.descent.class_exponent = -0.5;  // as in the fit of the network
  return config;
}

/// Curves fitted to a robot that stands, lifts its wheels and falls.
inline const EvidenceModel& lifted_curves() {
  static const EvidenceModel model = [] {
    const CarriedRun run = lifted_run(4, 1);
    return fit_evidence_model(std::vector<LabelledRun>{run.view()}, {}, brief_fit());
  }();
  return model;
}

}  // namespace touchdown::test
