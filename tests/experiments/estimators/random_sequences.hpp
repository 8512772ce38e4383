#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/contact_estimator.hpp"

namespace touchdown::experiments {

/// A member of `Signals` by its number in `SignalIndex`.
inline double& member_of(Signals& signals, std::size_t index) {
  if (index < 18) {
    LegSignals& leg = signals.leg[index / 9];
    JointSignals& joint = index % 9 < 3 ? leg.hip : index % 9 < 6 ? leg.knee : leg.wheel;
    return index % 3 == 0 ? joint.position : index % 3 == 1 ? joint.velocity : joint.torque;
  }
  const auto axis = static_cast<Eigen::Index>((index - 18) % 3);
  if (index < 21) return signals.linear_acceleration[axis];
  if (index < 24) return signals.angular_velocity[axis];
  return index == 24 ? signals.vertical_acceleration : signals.ground_velocity_command;
}

/// The documented bound of each member, written down again.
inline double bound_of(std::size_t index) {
  if (index < 18) {
    if (index % 3 == 1) return 1e3;
    if (index % 3 == 2) return 1e4;
    return index % 9 == 6 ? 1e9 : 1e3;
  }
  return index < 21 || index == 24 ? 1e4 : 1e3;
}

/// Whether two beliefs are the same to the bit.
inline bool is_same(const Belief& a, const Belief& b) {
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    if (a.wheel[wheel].p_contact != b.wheel[wheel].p_contact) return false;
    if (a.wheel[wheel].contact != b.wheel[wheel].contact) return false;
  }
  return a.p_any_wheel == b.p_any_wheel && a.p_both_wheels == b.p_both_wheels &&
         a.status == b.status && a.unusable == b.unusable;
}

/// Feeds an estimator sequences of records with random faults, beside two twins. One gets NaN for
/// every value beyond its bound, the other gets the same records without faults. Deterministic.
class RandomSequences {
 public:
  /// `make`: makes the same estimator at every call. `run`: a labelled run without faults at 1 kHz,
  /// repeated for as long as needed. `most_different`: the share of steps in which the beliefs of
  /// the estimator and of the undisturbed twin may differ after a recovery.
  template <typename Make>
  RandomSequences(Make make, std::vector<Signals> run, std::uint64_t seed,
                  double most_different = 0.02)
      : estimator_(make()),
        missing_(make()),
        undisturbed_(make()),
        run_(std::move(run)),
        random_(seed),
        most_different_(most_different) {
    restart();
  }

  /// The undisturbed twin starts anew where the estimator meets a gap in time, for estimators that
  /// take every n-th record from there on.
  void restart_twin_at_gaps() { restarts_twin_ = true; }

  /// The first sequences disturb one signal after the other, the others a few at random. One in
  /// `sequences_to_recovery` ends with a second of good records, after which the estimator must
  /// agree with its undisturbed twin. Stops at the first failure.
  void expect_probabilities(std::size_t sequences, const std::string& name, bool recovers = true) {
    constexpr std::size_t sequences_to_recovery = 25;
    const int failures_before = failures();
    for (std::size_t i = 0; i < sequences; ++i) {
      const bool recovery = recovers && i % sequences_to_recovery == 0;
      SCOPED_TRACE(name + ", sequence " + std::to_string(i));
      if (recovery) {
        restart();
        for (std::size_t k = 0; k < 500; ++k) good_step();
      }
      faulty_sequence(members_of(i), recovery);
      if (recovery) expect_recovery();
      if (failures() > failures_before) return;
    }
  }

 private:
  enum class Kind : int { constant, alternating, random };

  static int failures() {
    return ::testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
  }

  void restart() {
    estimator_->reset();
    missing_->reset();
    undisturbed_->reset();
  }

  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }

  /// A value that no sensor reports (always NaN or beyond the bound), or an ugly one within.
  double ugly_value(std::size_t index, bool only_faults) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const double bound = bound_of(index);
    const std::array<double, 10> faults = {
        1e308, 1e39, 1e20, inf, nan, 3.5e38, 1e16, std::nextafter(bound, inf), 2.0 * bound, 1e10};
    const std::array<double, 8> within = {
        5e-324, 1e-310, 1e-39, 0.0, bound, std::nextafter(bound, 0.0), 0.5 * bound, 1.0};
    const double value =
        only_faults || below(2) == 0 ? faults[below(faults.size())] : within[below(within.size())];
    return below(2) == 0 ? value : -value;
  }

  Signals next_good() {
    Signals signals = run_[step_ % run_.size()];
    signals.time = 0.001 * static_cast<double>(step_);
    ++step_;
    return signals;
  }

  /// Updates the estimator and the twin that gets NaN.
  Belief update(const Signals& signals) {
    history_.push_back(signals);
    if (history_.size() > quarter_second) history_.pop_front();
    const Belief belief = estimator_->update(signals);
    for (const double p : {belief.wheel[0].p_contact, belief.wheel[1].p_contact, belief.p_any_wheel,
                           belief.p_both_wheels}) {
      EXPECT_TRUE(p >= 0.0 && p <= 1.0) << p << " at step " << step_;
    }
    Signals missing = signals;
    for (std::size_t i = 0; i < signal_count; ++i) {
      double& value = member_of(missing, i);
      if (!(std::abs(value) <= bound_of(i))) value = std::numeric_limits<double>::quiet_NaN();
    }
    EXPECT_TRUE(is_same(belief, missing_->update(missing))) << "at step " << step_;
    return belief;
  }

  std::array<Belief, 2> good_step() {
    const Signals signals = next_good();
    const Belief belief = update(signals);
    if (restarts_twin_ && belief.status == SignalStatus::gap) undisturbed_->reset();
    return {belief, undisturbed_->update(signals)};
  }

  /// The signals that a sequence disturbs.
  std::vector<std::size_t> members_of(std::size_t sequence) {
    if (sequence < signal_count) return {sequence};
    std::vector<std::size_t> members(below(4) == 0 ? signal_count : 1 + below(3));
    for (std::size_t i = 0; i < members.size(); ++i) {
      members[i] = members.size() == signal_count ? i : below(signal_count);
    }
    return members;
  }

  void faulty_sequence(const std::vector<std::size_t>& members, bool only_faults) {
    const auto kind = static_cast<Kind>(below(3));
    std::vector<double> values;
    for (const std::size_t member : members) values.push_back(ugly_value(member, only_faults));
    const std::size_t length = 1 + below(20);
    const bool is_interrupted = below(3) == 0;
    const bool time_is_broken = below(8) == 0;
    for (std::size_t k = 0; k < length; ++k) {
      if (is_interrupted && k % 3 == 2) {
        good_step();
        continue;
      }
      Signals signals = next_good();
      undisturbed_->update(signals);
      for (std::size_t i = 0; i < members.size(); ++i) {
        if (kind == Kind::random) values[i] = ugly_value(members[i], only_faults);
        if (kind == Kind::alternating) values[i] = -values[i];
        member_of(signals, members[i]) = values[i];
      }
      if (time_is_broken) signals.time = ugly_value(0, true);
      const Belief belief = update(signals);
      expect_named(belief, signals);
    }
    for (std::size_t k = 0; k < 5; ++k) good_step();
  }

  /// Whether a member has repeated itself for a quarter of a second. Faults between two looks at it
  /// go unnoticed.
  bool has_stopped(std::size_t member) {
    std::size_t equal = 0;
    for (std::size_t k = 1; k < history_.size(); ++k) {
      equal += member_of(history_[k], member) == member_of(history_[k - 1], member) ? 1 : 0;
    }
    return equal > 7 * quarter_second / 10;
  }

  /// The belief names the first member that is NaN, beyond its bound, or has stopped.
  void expect_named(const Belief& belief, Signals& signals) {
    int first = -1;
    for (std::size_t i = 0; i < signal_count && first < 0; ++i) {
      if (!(std::abs(member_of(signals, i)) <= bound_of(i))) first = static_cast<int>(i);
    }
    const auto named = static_cast<std::size_t>(belief.unusable);
    if (named < signal_count && static_cast<int>(named) != first && has_stopped(named)) return;
    EXPECT_EQ(static_cast<int>(belief.unusable), first);
  }

  /// From one second after the last fault on, both beliefs agree. A change may come a few steps
  /// earlier or later.
  void expect_recovery() {
    for (std::size_t k = 0; k < 1000; ++k) good_step();
    constexpr std::size_t steps = 500;
    constexpr std::size_t shift = 4;
    std::vector<Belief> own;
    std::vector<Belief> twin;
    for (std::size_t k = 0; k < steps; ++k) {
      const std::array<Belief, 2> beliefs = good_step();
      own.push_back(beliefs[0]);
      twin.push_back(beliefs[1]);
    }
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      const auto is_close = [&](std::size_t k, std::size_t other) {
        const WheelBelief& one = own[k].wheel[wheel];
        const WheelBelief& two = twin[other].wheel[wheel];
        return std::abs(one.p_contact - two.p_contact) < 0.1 && one.contact == two.contact;
      };
      std::size_t different = 0;
      for (std::size_t k = shift; k + shift < steps; ++k) {
        bool same = false;
        for (std::size_t other = k - shift; other <= k + shift; ++other) {
          same = same || is_close(k, other);
        }
        different += same ? 0 : 1;
      }
      EXPECT_LE(static_cast<double>(different), most_different_ * steps)
          << "wheel " << wheel << ", of " << steps << " steps";
    }
  }

  std::unique_ptr<ContactEstimator> estimator_;
  std::unique_ptr<ContactEstimator> missing_;
  std::unique_ptr<ContactEstimator> undisturbed_;
  std::vector<Signals> run_;
  static constexpr std::size_t quarter_second = 250;  ///< steps
  std::deque<Signals> history_;
  std::mt19937_64 random_;
  double most_different_;
  bool restarts_twin_ = false;
  std::size_t step_ = 0;
};

}  // namespace touchdown::experiments
