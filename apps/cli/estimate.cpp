#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/cli/estimate_outputs.hpp"
#include "apps/cli/log_options.hpp"
#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "core/stop.hpp"
#include "core/table.hpp"
#include "experiments/logs/estimator.hpp"
#include "experiments/logs/fit.hpp"
#include "experiments/logs/label_proposal.hpp"
#include "experiments/logs/log_steps.hpp"
#include "experiments/logs/summary.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/results/captions.hpp"
#include "logs/log/annotator.hpp"
#include "logs/log/contact_intervals.hpp"
#include "render/figures/log_figure.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::cli {

namespace {

/// The time interval of the figure (s).
struct DrawnPart {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

struct EstimateFlags {
  std::vector<std::string> logs;
  std::vector<std::string> labels;
  LogOptions log;
  bool strict = false;
  EstimateRequest request;
  DrawnPart drawn;
};

/// The intervals that a person should look at first.
std::string least_sure(std::vector<logs::ContactInterval> intervals) {
  constexpr std::size_t most = 12;
  std::stable_sort(intervals.begin(), intervals.end(),
                   [](const auto& one, const auto& other) { return one.sure < other.sure; });
  const std::size_t shown = std::min(intervals.size(), most);
  TextTable table{{"sure", "from (s)", "to (s)", "left", "right"}, {}};
  for (const logs::ContactInterval& one : std::span(intervals).first(shown)) {
    const auto word = [](bool contact) { return contact ? "contact" : "air"; };
    table.rows.push_back({fmt::format("{:.3f}", one.sure.value_or(1.0)),
                          fmt::format("{:.3f}", one.start), fmt::format("{:.3f}", one.end),
                          word(one.contact[0]), word(one.contact[1])});
  }
  return fmt::format(
      "least sure first{}:\n{}",
      shown < intervals.size() ? fmt::format(", {} of {}", shown, intervals.size()) : "",
      to_text(table));
}

/// Writes labels for a person to correct. Errors: `InputError` for a file of other labels.
std::string propose(const logs::ContactIntervals& labels, const std::string& path,
                    const std::string& log, const LogOptions& options) {
  const std::string proposal = logs::to_csv(labels);
  if (is_there(path) && read_file(path) != proposal) {
    throw InputError(fmt::format(
        "{}: is there already, and differs from this proposal: expected a new file, because a "
        "person may have corrected that one",
        path));
  }
  write_atomically(path, proposal);
  std::string intervals = fmt::format("{:<12} {}, {}\n{}", "proposal", path,
                                      experiments::plural(labels.intervals.size(), "interval"),
                                      least_sure(labels.intervals));
  if (log == "-") return intervals;  // a stream is gone
  const std::string robot = options.robot.empty() ? "" : " --robot " + options.robot;
  const std::string mapping = options.mapping.empty() ? "" : " --mapping " + options.mapping;
  const std::string rest = fmt::format("{} --labels {}{}{}", log, path, robot, mapping);
  return intervals + fmt::format("{:<12} touchdown watch {}\n{:<12} touchdown estimate {}\n",
                                 "next", rest, "then", rest);
}

/// Writes the beliefs about one log: table, annotated log, figure and summary.
class BeliefWriter {
 public:
  /// A null stream means no such output. Streams must outlive this object.
  BeliefWriter(const EstimateStreams& streams, const std::optional<DrawnPart>& drawn,
               bool proposes_labels)
      : proposes_labels_(proposes_labels), csv_(streams.csv), drawn_(drawn) {
    if (streams.mpack != nullptr) annotator_.emplace(*streams.mpack);
    if (streams.mcap != nullptr) bag_.emplace(*streams.mcap);
  }

  /// Call it before the first step, once the log's rate and robot are known. `labels`, which may be
  /// null, must outlive this object.
  void begin(const experiments::LogSteps& log, const logs::ContactIntervals* labels) {
    if (csv_ != nullptr) *csv_ << experiments::belief_columns;
    truth_ = labels;
    threshold_ = scoring::force_threshold(labels_, log.robot_mass());
    summary_.emplace(log.period(), scoring::ScoringConfig{});
    if (proposes_labels_ || truth_ != nullptr) proposal_.emplace(log.period());
    score_.emplace(log.period_us(), labels_, log.robot_mass(), scoring::ScoringConfig{},
                   truth_ != nullptr);
  }

  /// Adds one step of `reader` and the estimator's belief after it.
  void add(const logs::LogReader& reader, const experiments::LogStep& step,
           const ContactEstimator& estimator, const Belief& belief) {
    const double time = step.signals.time;
    summary_->add(time, belief);
    if (proposal_) proposal_->add(time, belief);
    score_->add(step.normal_force, step.truth, belief);
    if (bag_) bag_->write(reader.stamp(), belief);
    if (csv_ == nullptr && !annotator_ && !drawn_) return;
    const Evidence evidence = estimator.evidence();
    if (csv_ != nullptr) {
      experiments::write_csv(*csv_, time, reader.stamp(), belief, evidence);
      require_written();
    }
    if (annotator_) {
      annotator_->copy(reader.skipped());
      annotator_->annotate(reader.record(), belief, evidence);
    }
    if (drawn_ && time >= drawn_->from && time <= drawn_->to) {
      draw(step, belief, evidence);
    }
  }

  /// Writes the buffered lines of the table. Errors: `Error` when its stream fails.
  void flush() {
    if (csv_ == nullptr) return;
    csv_->flush();
    require_written();
  }

  /// Call it at the end of the log, with the number of findings about it. Returns the summary.
  std::string finish(const logs::LogReader& reader, const experiments::LogSteps& log,
                     std::size_t findings) {
    flush();
    if (annotator_) annotator_->copy(reader.skipped());
    if (bag_) bag_->finish();
    const std::optional<scoring::RobotScore> score = score_->finish();
    return summary_->text(score, reader.start_time(), findings) +
           (score ? label_line(log.labelled_share()) : "") + score_->load_text();
  }

  std::int64_t steps() const { return summary_->steps(); }
  std::int64_t valid_steps() const { return summary_->valid_steps(); }
  double duration() const { return summary_->duration(); }
  const render::LogTrace& trace() const { return trace_; }
  std::optional<experiments::LabelProposal> take_proposal() {
    if (!proposes_labels_) return std::nullopt;
    return std::move(proposal_);
  }

 private:
  /// What the truth of a score is.
  std::string label_line(double labelled_share) const {
    constexpr double all = 0.9995;
    if (truth_ == nullptr) {
      return fmt::format(
          "{:<12} contact is a normal force above {} N, {:g} of the weight, over {:g} ms\n",
          "labels", readable(threshold_, 2), labels_.share, 1e3 * labels_.window);
    }
    std::string text;
    if (labelled_share < all) {
      text = fmt::format("{:<12} cover {:.1f} % of the steps: the others are not scored\n",
                         "labels", 100.0 * labelled_share);
    }
    if (proposal_->has_all(*truth_)) {
      text += fmt::format(
          "{:<12} are this estimator's own decisions, as --propose wrote them: the score is no "
          "test before a person has corrected them\n",
          "labels");
    }
    return text;
  }

  void require_written() const {
    if (!*csv_) throw Error("the beliefs cannot be written: is the disk full?");
  }

  void draw(const experiments::LogStep& step, const Belief& belief, const Evidence& evidence) {
    render::LogTraceStep drawn = render::log_trace_step(step.signals, belief, evidence);
    if (step.normal_force) {
      drawn.true_contact = {(*step.normal_force)[0] > threshold_,
                            (*step.normal_force)[1] > threshold_};
    }
    trace_.add(drawn);
  }

  scoring::LabelConfig labels_;
  const logs::ContactIntervals* truth_ = nullptr;  ///< of a file
  double threshold_ = 0.0;                         ///< of the log's own truth (N)
  bool proposes_labels_;
  std::ostream* csv_;
  std::optional<experiments::BeliefBag> bag_;
  std::optional<logs::LogAnnotator> annotator_;
  std::optional<DrawnPart> drawn_;
  std::optional<experiments::LogSummary> summary_;
  std::optional<experiments::LogScore> score_;
  std::optional<experiments::LabelProposal> proposal_;  ///< also to compare labels with
  render::LogTrace trace_;
};

std::string model_line(const experiments::LogEstimator& chosen, const experiments::LogSteps& log) {
  const std::string text = chosen.model_text();
  if (text.empty()) return {};
  const bool is_fitted = experiments::was_fitted_to(chosen.model, log);
  return fmt::format("{:<12} {}{}\n", "model", text,
                     is_fitted ? "; it was fitted to this log, so that its score is no test" : "");
}

std::string gravity_line(const experiments::LogSteps& log) {
  if (log.upside_down() == 0) return {};
  return fmt::format(
      "{:<12} at {} steps the IMU's orientation contradicts gravity: is it upside down, or a "
      "quaternion of another order than w x y z?\n",
      "imu", log.upside_down());
}

/// A simulated run that failed: its scores are not those of a robot that drives.
std::string outcome_line(const logs::RecordingInfo& info, double duration) {
  if (!info.outcome || !experiments::is_failure(*info.outcome)) return {};
  return fmt::format("{:<12} {} after {:.3f} s: studies do not score such runs\n", "run",
                     scenarios::outcome_text(*info.outcome), duration);
}

/// The result about one log.
struct Evaluation {
  std::string summary;
  std::vector<std::string> findings;  ///< what is implausible about the log
};

/// Errors: `Error` for a log without a step with usable signals: no belief is about it.
void require_valid_steps(const logs::LogReader& reader, const BeliefWriter& writer,
                         const std::vector<std::string>& findings) {
  if (writer.valid_steps() > 0 || writer.steps() == 0) return;
  throw Error(fmt::format("{}: none of its {} steps has usable signals{}", reader.name(),
                          writer.steps(),
                          findings.empty() ? "" : fmt::format(": {}", findings.front())));
}

/// Runs the estimator over the log.
Evaluation evaluate(logs::LogReader& reader, const experiments::LogEstimator& chosen,
                    const logs::ContactIntervals* labels, BeliefWriter& writer,
                    const CliSession& session) {
  experiments::LogSteps log(reader, labels, chosen.request.robot);
  const std::unique_ptr<ContactEstimator> estimator = chosen.make(log.sample_rate(), log.info());
  writer.begin(log, labels);
  try {
    while (const experiments::LogStep* step = log.next()) {
      writer.add(reader, *step, *estimator, estimator->update(step->signals));
    }
  } catch (const InputError&) {
    writer.flush();  // the beliefs of a live stream before the error
    throw;
  }
  if (!*session.stop) log.require_labels_within();
  std::vector<std::string> findings = log.findings();
  const std::string summary = writer.finish(reader, log, findings.size());
  return {fmt::format("{}: {} steps, {} s at {:.6g} Hz, {}\n", reader.name(), writer.steps(),
                      fixed(writer.duration(), 3), log.sample_rate(), chosen.entry.title) +
              outcome_line(log.info(), writer.duration()) + summary + gravity_line(log) +
              model_line(chosen, log),
          std::move(findings)};
}

/// Prints to standard output, or to standard error if the table goes to standard output.
void print_text(const EstimateOutputs& outputs, const std::string& text) {
  if (outputs.prints_csv()) {
    print_message(text);
  } else {
    print("{}", text);
  }
}

/// Returns the number of findings.
std::size_t estimate_log(const std::string& path, const logs::ContactIntervals* labels,
                         const experiments::LogEstimator& estimator, const EstimateFlags& flags,
                         const EstimateOutputs& outputs, const CliSession& session) {
  std::string summary;
  std::size_t findings = 0;
  std::optional<experiments::LabelProposal> proposal;
  write_outputs(outputs, [&](const EstimateStreams& streams) {
    BeliefWriter writer(streams,
                        flags.request.figure.empty() ? std::nullopt : std::optional(flags.drawn),
                        !outputs.proposal.empty());
    const bool live = path == "-";
    // A reader of a live stream gets every line before the program waits for the next record.
    const auto before_read = [&] {
      if (outputs.prints_csv()) writer.flush();
    };
    logs::LogReader reader =
        open_log(path, flags.log, session,
                 {.with_bytes = streams.mpack != nullptr, .before_read = before_read});
    const Evaluation evaluation = evaluate(reader, estimator, labels, writer, session);
    summary = evaluation.summary;
    findings = evaluation.findings.size();
    proposal = writer.take_proposal();
    if (!live) end_if(session.stop);
    print_warnings(reader.warnings());
    require_valid_steps(reader, writer, evaluation.findings);
    print_findings(reader.name(), evaluation.findings);
    if (!outputs.figure.empty()) {
      if (writer.trace().bins().empty()) {
        throw InputError("--figure: there is no step between --from and --to");
      }
      const render::Figure figure = render::draw_log(
          writer.trace(), fmt::format("{}, {}", reader.name(), estimator.entry.title),
          outputs.figure);
      summary += fmt::format("{:<12} {}\n", "figure", figure.png.string());
    }
  });
  if (!outputs.csv.empty() && !outputs.prints_csv()) {
    summary += fmt::format("{:<12} {}\n", "beliefs", outputs.csv.string());
  }
  if (!outputs.mcap.empty()) summary += fmt::format("{:<12} {}\n", "bag", outputs.mcap.string());
  if (!outputs.mpack.empty()) summary += fmt::format("{:<12} {}\n", "log", outputs.mpack.string());
  if (proposal) {
    summary += propose(proposal->finish(), outputs.proposal.string(), path, flags.log);
  }
  print_text(outputs, summary);
  return findings;
}

/// Errors: `InputError` for a part of the figure that is none, or without a figure.
void check_drawn(const DrawnPart& drawn, const std::string& figure) {
  if (figure.empty() && (std::isfinite(drawn.from) || std::isfinite(drawn.to))) {
    throw InputError("--from and --to are the part that --figure shows: expected --figure");
  }
  if (drawn.to < drawn.from) {
    throw InputError(fmt::format("--to: {} s is before --from, {} s", drawn.to, drawn.from));
  }
}

void estimate(const EstimateFlags& flags, const CliSession& session) {
  check_drawn(flags.drawn, flags.request.figure);
  const experiments::LogEstimator estimator = estimator_for(flags.log);
  const std::vector<EstimateOutputs> outputs =
      estimate_outputs(flags.logs, flags.log, flags.labels, flags.request);
  const std::vector<logs::ContactIntervals> labels =
      logs::read_contact_intervals(flags.labels, flags.logs.size());
  std::size_t findings = 0;
  for (std::size_t i = 0; i < flags.logs.size(); ++i) {
    if (i > 0) print_text(outputs[i], "\n");
    findings += estimate_log(flags.logs[i], labels.empty() ? nullptr : &labels[i], estimator, flags,
                             outputs[i], session);
  }
  if (flags.strict) require_no_findings(findings);
}

}  // namespace

void add_estimate(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "estimate",
      "touchdown estimate robot.mpack\n"
      "touchdown estimate robot.mpack --model model.npz -o beliefs.csv --figure beliefs.png\n"
      "… | touchdown estimate - --model model.npz\n"
      "touchdown estimate rosbag2_2026_03_01/ --mapping robot.yaml --model model.npz\n"
      "touchdown estimate robot.mpack --propose labels.csv\n\n"
      "Estimates from Upkie's logs which wheels are in contact. With - it reads a live\n"
      "stream from standard input and prints one line per record. With --mapping it reads\n"
      "another robot's logs: ROS 2 bags, CSV or NumPy arrays. Signals that are not plausible\n"
      "(`touchdown check`) are named above the result.");
  const auto flags = std::make_shared<EstimateFlags>();
  verb.option("log", &flags->logs,
              "Logs in Upkie's layout, or in another one with --mapping; - is standard input")
      .value_name("LOG")
      .required();
  verb.option("--labels", &flags->labels,
              "Ground truth for intervals of each LOG, in the order of the logs: rows "
              "start,end,contact or start,end,left,right. Only these intervals are scored")
      .value_name("FILE.csv");
  add_log_options(verb, flags->log);
  verb.flag("--strict", &flags->strict,
            "Exit with code 1 if the signals of a log are not plausible");
  verb.option(
          "-o,--output", &flags->request.outputs,
          "Beliefs as FILE.csv, as a ROS 2 bag FILE.mcap to play beside the log's, or the log "
          "with\nbeliefs in it as FILE.mpack, or all; - prints the table. With several logs, each "
          "file's\nname begins with the log's name, behind its folder's if logs have equal names")
      .value_name("FILE")
      .one_at_a_time();
  verb.option("--figure", &flags->request.figure, "Figure of signals and beliefs over time")
      .value_name("FILE.png");
  verb.option("--propose", &flags->request.proposal,
              "Labels for a person to correct: the decisions, as rows "
              "start,end,left,right,sure")
      .value_name("FILE.csv");
  verb.option("--from", &flags->drawn.from, "Start of the figure in the log's time (s)");
  verb.option("--to", &flags->drawn.to, "End of the figure in the log's time (s)");
  verb.action([flags, &session] { estimate(*flags, session); });
}

}  // namespace touchdown::cli
