#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "estimator/signals.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The curves of a log's figure, in the order of its columns.
enum class LogCurve : int {
  left_knee,
  right_knee,
  left_wheel,
  right_wheel,
  acceleration,
  p_contact_left,
  p_contact_right,
  p_takeoff,
  p_landing,
  load_left,
  load_right,
};
inline constexpr std::size_t log_curve_count = static_cast<std::size_t>(LogCurve::load_right) + 1;

/// The drawn values of one step of a log.
struct LogTraceStep {
  double time = 0.0;                                ///< s
  std::array<double, log_curve_count> value;        ///< by `LogCurve`; NaN for a missing value
  std::array<bool, 2> contact;                      ///< decision, left and right wheel
  std::optional<std::array<bool, 2>> true_contact;  ///< true contact, likewise
  SignalStatus status = SignalStatus::good;         ///< `degraded` counts as good
};

LogTraceStep log_trace_step(const Signals& signals, const Belief& belief, const Evidence& evidence);

/// A summary of a log of any length for drawing: bins of equally many steps with the lowest and the
/// highest value of each curve, so that no spike is lost. When there are too many bins, neighbours
/// are merged in pairs: memory does not grow with the log.
class LogTrace {
 public:
  struct Bin {
    double begin = 0.0;  ///< s
    double end = 0.0;    ///< time of the last step (s)
    std::size_t steps = 0;
    std::array<double, log_curve_count> low, high;  ///< NaN where no step had a value
    std::array<std::size_t, 2> contact{};           ///< steps with the decision "contact"
    std::array<std::size_t, 2> true_contact{};      ///< steps with true contact
    std::size_t with_truth = 0;
    std::array<std::size_t, 4> status{};  ///< by `SignalStatus`

    explicit Bin(const LogTraceStep& step);
    void merge(const Bin& later);
  };

  explicit LogTrace(std::size_t most_bins = 2000) : most_bins_(most_bins) {}

  /// Adds a step; steps come in the order of the log.
  void add(const LogTraceStep& step);

  const std::vector<Bin>& bins() const { return bins_; }

  /// Tab-separated: begin and end, low and high of each curve, shares of contact (left, right) and
  /// of true contact (NaN without truth), numbers of steps by status. An empty line interrupts
  /// plotted lines before a bin that begins after a gap in time or a step back.
  std::string table() const;

 private:
  std::size_t most_bins_;
  std::size_t steps_per_bin_ = 1;
  std::vector<Bin> bins_;
};

/// Draws a log with an estimator's output over time: torques, vertical acceleration, contact
/// probability, decided contact and the signals' status; loads, takeoff and landing probability
/// where the estimator has them; true contact where it is known. Each curve fills the space between
/// its lowest and highest value. Files as `draw_figure`. Errors: `InputError` for a trace without
/// steps; `Error` as `draw_figure`.
Figure draw_log(const LogTrace& trace, const std::string& title, const std::filesystem::path& stem);

}  // namespace touchdown::render
