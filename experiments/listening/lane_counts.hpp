#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "experiments/signals/run_signals.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// Counts how often the lanes of a sweep say contact, while they walk through a run: nothing is
/// kept of the single steps, so that memory does not grow with the number of lanes times steps.
/// Sums are doubles because those are vector code; they are exact below 2^53.
class LaneCounts {
 public:
  LaneCounts(const RunSignals& run, std::size_t lanes, const scoring::ScoringConfig& scoring);

  /// What the lanes say about one wheel at a step: contact where `values` reach the threshold.
  /// Steps must come in order.
  void add(std::size_t wheel, std::size_t step, std::span<const double> values, double threshold) {
    if (step < first_scored_) return;
    while (piece_ + 1 < run_.pieces.size() && step >= run_.pieces[piece_ + 1]) ++piece_;
    const bool truth = run_.contact[wheel][step] != 0;
    Piece& piece = pieces_[piece_];
    ++(truth ? piece.contact : piece.flight);
    double* const sum = (truth ? piece.said_in_contact : piece.said_in_flight).data();
    const double* const value = values.data();
    const std::size_t lanes = values.size();
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::size_t i = 0; i < lanes; ++i) sum[i] += value[i] >= threshold ? 1.0 : 0.0;
  }

  /// By lane, then piece.
  std::vector<scoring::Classification> result() const;

 private:
  struct Piece {
    std::int64_t contact = 0;
    std::int64_t flight = 0;
    std::vector<double> said_in_contact;  ///< by lane, how often contact was said in contact
    std::vector<double> said_in_flight;   ///< likewise in flight
  };

  const RunSignals& run_;
  std::size_t lanes_;
  std::size_t first_scored_;
  std::size_t piece_ = 0;
  std::vector<Piece> pieces_;
};

}  // namespace touchdown::experiments
