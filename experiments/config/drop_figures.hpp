#pragma once

#include <optional>
#include <string>
#include <vector>

#include "noise/grid.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::experiments {

/// One drop of one test run, and how much of the time around it is shown. Drops are counted from 0,
/// as `drops` finds them.
struct DropChoice {
  int run = 0;
  int drop = 0;
  int seed = 0;          ///< of the noise: the realisation that the study hears under this number
  double before = 0.15;  ///< shown before takeoff (s)
  double after = 0.45;   ///< and after it (s)
};

/// What estimators hear and conclude through one drop, drawn for every engine.
struct DetailConfig {
  DropChoice choice = {};
  std::vector<noise::NoiseCell> noise = {{0.25, 1.0}, {1.0, 5.0}};  ///< one column of panels each
  std::vector<std::string> estimators = {};  ///< whose probabilities are shown
};

/// The phase filter's probability of every phase through one drop, drawn for every engine.
struct PosteriorConfig {
  DropChoice choice = {};
  noise::NoiseCell noise = {1.0, 5.0};
};

/// What an experiment has, for a drop to be drawn from.
struct DrawableRuns {
  int test_runs;
  const noise::NoiseGridConfig& noise;
  const std::vector<std::string>& estimators;
};

/// The sections `detail` and `posterior` of an experiment file. Nothing where a section is absent
/// or says `enabled: false`; an empty one means its defaults.
void describe_drop_figures(Fields& parent, std::optional<DetailConfig>& detail,
                           std::optional<PosteriorConfig>& posterior, const DrawableRuns& runs);

}  // namespace touchdown::experiments
