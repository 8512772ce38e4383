#pragma once

#include "core/fields.hpp"
#include "experiments/config/experiment.hpp"

namespace touchdown::experiments {

/// Describes the section `video`: the run that is plotted and filmed.
void describe(Fields& fields, VideoConfig& video, const Experiment& experiment);

/// Describes the sections `detail` and `posterior`: figures of one drop.
void describe_drop_figures(Fields& fields, Experiment& experiment);

}  // namespace touchdown::experiments
