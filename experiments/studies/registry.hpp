#pragma once

#include <memory>
#include <vector>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// Every study, in the order of planning, of texts and of their sections in written experiments.
const std::vector<std::unique_ptr<const Study>>& studies();

/// The sections of all studies.
std::vector<StudySection> study_sections();

/// Those that the experiment file asks for.
std::vector<const Study*> requested_studies(const Experiment& experiment);

}  // namespace touchdown::experiments
