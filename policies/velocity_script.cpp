#include "policies/velocity_script.hpp"

#include <algorithm>

#include "core/fields.hpp"

namespace touchdown::policies {

VelocityCommand command_at(const VelocityScript& script, double time) {
  const auto later =
      std::upper_bound(script.begin(), script.end(), time,
                       [](double t, const VelocityCommand& command) { return t < command.time; });
  return later == script.begin() ? VelocityCommand{} : *std::prev(later);
}

void describe(Fields& fields, VelocityCommand& command, const VelocityScript& script) {
  fields("time", command.time, 0.0, 1e6);
  fields("velocity", command.velocity, -3.0, 3.0);
  fields("yaw_rate", command.yaw_rate, -10.0, 10.0);
  fields.finish();
  fields.check(script.size() < 2 || command.time > script[script.size() - 2].time, "time",
               "expected a later time than the command before");
}

}  // namespace touchdown::policies
