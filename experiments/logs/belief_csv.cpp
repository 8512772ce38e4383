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

void BeliefCsv::write(double time, const Belief& belief, const Evidence& evidence) {
  const auto& [left, right] = belief.wheel;
  fmt::format_to(std::back_inserter(buffer_), FMT_COMPILE("{},{},{},{:d},{:d},{},{},{},{},{}\n"),
                 time, left.p_contact, right.p_contact, left.contact, right.contact,
                 belief.p_any_wheel, belief.p_both_wheels, evidence.transition.p_takeoff,
                 evidence.transition.p_landing, to_text(belief.status));
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
