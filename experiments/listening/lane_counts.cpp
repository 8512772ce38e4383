#include "experiments/listening/lane_counts.hpp"

#include "scoring/score.hpp"

namespace touchdown::experiments {

LaneCounts::LaneCounts(const RunSignals& run, std::size_t lanes,
                       const scoring::ScoringConfig& scoring)
    : run_(run),
      lanes_(lanes),
      first_scored_(scoring::first_scored_step(run.info.control_period_us, scoring)),
      pieces_(run.pieces.size()) {
  for (Piece& piece : pieces_) {
    piece.said_in_contact.assign(lanes, 0.0);
    piece.said_in_flight.assign(lanes, 0.0);
  }
}

std::vector<scoring::Classification> LaneCounts::result() const {
  std::vector<scoring::Classification> counts;
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

}  // namespace touchdown::experiments
