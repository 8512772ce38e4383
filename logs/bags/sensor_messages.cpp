#include "logs/bags/sensor_messages.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/bags/cdr.hpp"

namespace touchdown::logs {

namespace {

void read_numbers(CdrReader& reader, std::vector<double>& values) {
  values.resize(reader.count(sizeof(double)));
  for (double& value : values) value = reader.take<double>();
}

MessageStamp read_header(CdrReader& reader) {
  MessageStamp stamp;
  stamp.sec = reader.take<std::int32_t>();
  stamp.nanosec = reader.take<std::uint32_t>();
  if (stamp.nanosec >= 1'000'000'000) {
    throw InputError(fmt::format("a stamp has {} nanoseconds", stamp.nanosec));
  }
  (void)reader.text();  // frame_id
  return stamp;
}

void check_size(const std::vector<double>& values, const JointState& state, const char* what) {
  if (values.empty() || state.name.empty() || values.size() == state.name.size()) return;
  throw InputError(
      fmt::format("{} has {} values for {} names", what, values.size(), state.name.size()));
}

/// Numbers with their covariance behind them.
template <std::size_t N>
void read_vector(CdrReader& reader, std::array<double, N>& values) {
  for (double& value : values) value = reader.take<double>();
  const double first = reader.take<double>();
  for (int i = 1; i < 9; ++i) (void)reader.take<double>();
  if (first == -1.0) values.fill(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void decode(std::string_view payload, JointState& state) {
  CdrReader reader(payload);
  state.stamp = read_header(reader);
  state.name.resize(reader.count(sizeof(std::uint32_t)));
  for (std::string_view& name : state.name) name = reader.text();
  for (auto* values : {&state.position, &state.velocity, &state.effort}) {
    read_numbers(reader, *values);
  }
  check_size(state.position, state, "position");
  check_size(state.velocity, state, "velocity");
  check_size(state.effort, state, "effort");
}

void decode(std::string_view payload, ImuState& state) {
  CdrReader reader(payload);
  state.stamp = read_header(reader);
  read_vector(reader, state.orientation);
  const auto is_zero = [](double x) { return x == 0.0; };
  if (std::all_of(state.orientation.begin(), state.orientation.end(), is_zero)) {
    state.orientation.fill(std::numeric_limits<double>::quiet_NaN());
  }
  read_vector(reader, state.angular_velocity);
  read_vector(reader, state.linear_acceleration);
}

}  // namespace touchdown::logs
