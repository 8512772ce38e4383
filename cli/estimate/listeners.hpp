#pragma once

#include <limits>
#include <optional>
#include <ostream>
#include <string>

#include "experiments/logs/belief_csv.hpp"
#include "experiments/logs/listener.hpp"
#include "experiments/logs/summary.hpp"
#include "recordings/log/annotator.hpp"
#include "render/curves/log_trace.hpp"
#include "scoring/score_stream.hpp"

namespace touchdown::cli {

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
  void begin(const experiments::LogListener& log);

  /// One step, and what `estimator` made of it. `reader` is where it comes from.
  void listen(const recordings::LogReader& reader, const experiments::LogStep& step,
              const ContactEstimator& estimator, const Belief& belief);

  /// Writes what is collected of the table.
  void flush();

  /// The log is over: returns the summary.
  std::string finish(const recordings::LogReader& reader);

  std::int64_t steps() const { return summary_->steps(); }
  const render::LogTrace& trace() const { return trace_; }

 private:
  void draw(const experiments::LogStep& step, const Belief& belief,
            const recordings::LogBeliefs& beliefs);

  scoring::LabelConfig labels_;
  std::optional<experiments::BeliefCsv> csv_;
  std::optional<recordings::LogAnnotator> annotator_;
  std::optional<DrawnPart> drawn_;
  std::optional<experiments::LogSummary> summary_;
  std::optional<scoring::ScoreStream> score_;
  render::LogTrace trace_;
};

}  // namespace touchdown::cli
