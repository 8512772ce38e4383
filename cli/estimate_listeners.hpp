#pragma once

#include <limits>
#include <optional>
#include <ostream>
#include <string>

#include "experiments/belief_csv.hpp"
#include "experiments/log_listener.hpp"
#include "experiments/log_summary.hpp"
#include "experiments/score_stream.hpp"
#include "recordings/log_annotator.hpp"
#include "render/log_trace.hpp"

namespace touchdown {

/// Which part of a log is drawn (s).
struct DrawnPart {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// All that becomes of the beliefs about one log: table, annotated log, figure, summary.
class EstimateListeners {
 public:
  /// Null for what is not wanted; streams must outlive this.
  EstimateListeners(std::ostream* csv, std::ostream* mpack, const std::optional<DrawnPart>& drawn);

  /// Before the first step, once the log's rate is known.
  void begin(const LogListener& log);

  /// One step, and what `estimator` made of it. `reader` is where it comes from.
  void hear(const LogReader& reader, const LogStep& step, const ContactEstimator& estimator,
            const Belief& belief);

  /// Writes what is collected of the table.
  void flush();

  /// The log is over: returns the summary.
  std::string finish(const LogReader& reader);

  std::int64_t steps() const { return summary_->steps(); }
  const LogTrace& trace() const { return trace_; }

 private:
  void draw(const LogStep& step, const Belief& belief, const LogBeliefs& beliefs);

  LabelConfig labels_;
  std::optional<BeliefCsv> csv_;
  std::optional<LogAnnotator> annotator_;
  std::optional<DrawnPart> drawn_;
  std::optional<LogSummary> summary_;
  std::optional<ScoreStream> score_;
  LogTrace trace_;
};

}  // namespace touchdown
