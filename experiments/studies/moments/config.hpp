#pragma once

#include "experiments/config/study_sections.hpp"

namespace touchdown::experiments {

/// The key `moments`: tables of torques next to the real robot's (docs/explanation/realism.md).
struct MomentsConfig {};

/// The key. `false` is the same as no key.
StudySection moments_section();

}  // namespace touchdown::experiments
