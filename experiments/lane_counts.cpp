#include "experiments/lane_counts.hpp"

#include "experiments/score.hpp"

namespace touchdown {

LaneCounts::LaneCounts(const HeardRun& run, std::size_t lanes, const ScoringConfig& scoring)
    : run_(run),
      lanes_(lanes),
      first_scored_(first_scored_step(run.info.control_period_us, scoring)),
      pieces_(run.pieces.size()) {
  for (Piece& piece : pieces_) {
    piece.said_in_contact.assign(lanes, 0.0);
    piece.said_in_flight.assign(lanes, 0.0);
  }
}

std::vector<Classification> LaneCounts::result() const {
  std::vector<Classification> counts;
  counts.reserve(lanes_ * pieces_.size());
  for (std::size_t lane = 0; lane < lanes_; ++lane) {
    for (const Piece& piece : pieces_) {
      const auto in_contact = static_cast<std::int64_t>(piece.said_in_contact[lane]);
      const auto in_flight = static_cast<std::int64_t>(piece.said_in_flight[lane]);
      counts.push_back({.contact_as_contact = in_contact,
                        .contact_as_flight = piece.contact - in_contact,
                        .flight_as_contact = in_flight,
                        .flight_as_flight = piece.flight - in_flight});
    }
  }
  return counts;
}

}  // namespace touchdown
