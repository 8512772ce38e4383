#include "policies/crouching.hpp"

#include <algorithm>
#include <iterator>

#include "core/fields.hpp"

namespace touchdown::policies {

const CrouchCommand* crouch_at(const CrouchScript& script, double time) {
  const auto later =
      std::upper_bound(script.begin(), script.end(), time,
                       [](double t, const CrouchCommand& command) { return t < command.time; });
  return later == script.begin() ? nullptr : &*std::prev(later);
}

void describe(Fields& fields, CrouchCommand& command, const CrouchScript& script) {
  fields("time", command.time, 0.0, 1e6);
  fields.require("hip", command.hip, -1.26, 1.26);
  fields("rate", command.rate, 1e-3, 100.0);
  fields.finish();
  fields.check(script.size() < 2 || command.time > script[script.size() - 2].time, "time",
               "expected a later time than the command before");
}

}  // namespace touchdown::policies
