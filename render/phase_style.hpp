#pragma once

#include "estimator/phase.hpp"

namespace touchdown {

/// How a phase is named and coloured in figures ("#rrggbb").
struct PhaseStyle {
  const char* title;
  const char* colour;
};

/// Grey on the ground, orange towards a takeoff, blue in the air, green after a landing; darker the
/// nearer the event.
PhaseStyle style_of(Phase phase);

}  // namespace touchdown
