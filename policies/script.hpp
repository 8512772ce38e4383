#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/fields.hpp"

namespace touchdown::policies {

/// The command at `time` of a script sorted by time; null before the first one. A command holds
/// from its `time` on.
template <typename Command>
const Command* in_force(const std::vector<Command>& script, double time) {
  const auto later = std::upper_bound(script.begin(), script.end(), time,
                                      [](double t, const Command& one) { return t < one.time; });
  return later == script.begin() ? nullptr : &*std::prev(later);
}

/// Reading: checks that the last command of a script is the latest.
template <typename Command>
void check_order(Fields& fields, const Command& last, const std::vector<Command>& script) {
  fields.finish();
  fields.check(script.size() < 2 || last.time > script[script.size() - 2].time, "time",
               "expected a later time than the command before");
}

}  // namespace touchdown::policies
