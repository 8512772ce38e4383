#include "scoring/sample_unit.hpp"

#include "core/fields.hpp"

namespace touchdown::scoring {

namespace {

const std::vector<std::string> unit_names = {"run", "drop"};

}  // namespace

const std::string& to_text(SampleUnit unit) { return unit_names[static_cast<std::size_t>(unit)]; }

void describe(Fields& fields, IntervalConfig& intervals) {
  fields.choose("over", unit_names, intervals.over);
  fields("resamples", intervals.bootstrap.resamples, 10, 1'000'000);
  fields("level", intervals.bootstrap.level, 0.5, 0.999);
  fields("seed", intervals.bootstrap.seed);
}

}  // namespace touchdown::scoring
