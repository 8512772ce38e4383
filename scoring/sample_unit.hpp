#pragma once

#include <string>

#include "scoring/bootstrap.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::scoring {

/// What a bootstrap interval takes as its sample.
enum class SampleUnit : int { run, drop };

/// "run", "drop".
const std::string& to_text(SampleUnit unit);

struct IntervalConfig {
  SampleUnit over = SampleUnit::run;
  BootstrapConfig bootstrap;
};

void describe(Fields& fields, IntervalConfig& intervals);

}  // namespace touchdown::scoring
