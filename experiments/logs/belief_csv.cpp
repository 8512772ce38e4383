#include "experiments/logs/belief_csv.hpp"

#include <iterator>

#include <fmt/compile.h>

#include "core/error.hpp"

namespace touchdown::experiments {

BeliefCsv::BeliefCsv(std::ostream& stream) : stream_(stream) {
  fmt::format_to(std::back_inserter(buffer_),
                 "time_s,p_contact_left,p_contact_right,contact_left,contact_right,p_any_wheel,"
                 "p_both_wheels,p_takeoff,p_landing,status\n");
}

void BeliefCsv::write(double time, const recordings::LogBeliefs& beliefs) {
  fmt::format_to(std::back_inserter(buffer_), FMT_COMPILE("{},{},{},{:d},{:d},{},{},{},{},{}\n"),
                 time, beliefs.wheel[0].p_contact, beliefs.wheel[1].p_contact,
                 beliefs.wheel[0].contact, beliefs.wheel[1].contact, beliefs.p_any_wheel,
                 beliefs.p_both_wheels, beliefs.p_takeoff_p_switch, beliefs.p_landing_p_switch,
                 to_text(beliefs.status));
  constexpr std::size_t large = std::size_t{1} << 16U;
  if (buffer_.size() >= large) flush();
}

void BeliefCsv::flush() {
  stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  stream_.flush();
  buffer_.clear();
  if (!stream_) throw Error("the beliefs cannot be written: is the disk full?");
}

}  // namespace touchdown::experiments
