#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/estimate/outputs.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/progress.hpp"
#include "experiments/logs/belief_csv.hpp"
#include "experiments/logs/estimator.hpp"
#include "experiments/logs/log_steps.hpp"
#include "experiments/logs/log_score.hpp"
#include "experiments/logs/summary.hpp"
#include "recordings/log/annotator.hpp"
#include "recordings/log/byte_source.hpp"
#include "render/curves/log_figure.hpp"

namespace touchdown::cli {

namespace {

/// Which part of a log is drawn (s).
struct DrawnPart {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

struct EstimateFlags {
  std::vector<std::string> logs;
  std::vector<std::string> labels;
  std::string model;
  std::string estimator;
  std::string robot;
  bool transfer = false;
  std::vector<std::string> hyperparameters;
  std::vector<std::string> outputs;
  std::string figure;
  DrawnPart drawn;
};

/// All that becomes of the beliefs about one log: table, annotated log, figure, summary.
class Listeners {
 public:
  /// Null for what is not wanted; streams must outlive this.
  Listeners(std::ostream* csv, std::ostream* mpack, const std::optional<DrawnPart>& drawn)
      : drawn_(drawn) {
    if (csv != nullptr) csv_.emplace(*csv);
    if (mpack != nullptr) annotator_.emplace(*mpack);
  }

  /// Before the first step, once the log's rate is known.
  void begin(const experiments::LogSteps& log, bool labelled) {
    summary_.emplace(log.period(), scoring::ScoringConfig{});
    score_.emplace(log.period_us(), labels_, scoring::ScoringConfig{}, labelled);
  }

  /// One step, and what was made of it. `reader` is where it comes from.
  void evaluate(const recordings::LogReader& reader, const experiments::LogStep& step,
              const ContactEstimator& estimator, const Belief& belief) {
    const double time = step.signals.time;
    summary_->add(time, belief);
    score_->add(step, belief);
    if (!csv_ && !annotator_ && !drawn_) return;
    const Evidence evidence = estimator.evidence();
    if (csv_) csv_->write(time, belief, evidence);
    if (annotator_) {
      annotator_->copy(reader.skipped());
      annotator_->annotate(reader.record(), belief, evidence);
    }
    if (drawn_ && time >= drawn_->from && time <= drawn_->to) {
      draw(step, belief, evidence.transition);
    }
  }

  /// Writes what is collected of the table.
  void flush() {
    if (csv_) csv_->flush();
  }

  /// The log is over: returns the summary.
  std::string finish(const recordings::LogReader& reader) {
    flush();
    if (annotator_) annotator_->copy(reader.skipped());
    return summary_->text(score_->finish(), reader.start_time());
  }

  std::int64_t steps() const { return summary_->steps(); }
  const render::LogTrace& trace() const { return trace_; }

 private:
  void draw(const experiments::LogStep& step, const Belief& belief,
            const Evidence::Transition& transition) {
    render::LogTraceStep drawn =
        render::log_trace_step(step.signals, belief, transition.p_takeoff, transition.p_landing);
    if (step.normal_force) {
      drawn.touches = {(*step.normal_force)[0] > labels_.force_threshold,
                       (*step.normal_force)[1] > labels_.force_threshold};
    }
    trace_.add(drawn);
  }

  scoring::LabelConfig labels_;
  std::optional<experiments::BeliefCsv> csv_;
  std::optional<recordings::LogAnnotator> annotator_;
  std::optional<DrawnPart> drawn_;
  std::optional<experiments::LogSummary> summary_;
  std::optional<experiments::LogScore> score_;
  render::LogTrace trace_;
};

std::string model_line(const experiments::LogEstimator& chosen) {
  const std::string text = chosen.model_text();
  return text.empty() ? "" : fmt::format("{:<12} {}\n", "model", text);
}

std::string gravity_line(const experiments::LogSteps& log) {
  if (log.upside_down() == 0) return {};
  return fmt::format(
      "{:<12} at {} steps the IMU's orientation contradicts gravity: is it upside down, or a "
      "quaternion of another order than w x y z?\n",
      "imu", log.upside_down());
}

/// Runs over the log and returns the summary.
std::string evaluate(recordings::LogReader& reader, const experiments::LogEstimator& chosen,
                   const recordings::ContactIntervals* labels, Listeners& listeners) {
  experiments::LogSteps log(reader, labels);
  const std::unique_ptr<ContactEstimator> estimator = chosen.make(log.sample_rate(), reader.info());
  listeners.begin(log, labels != nullptr);
  try {
    while (const experiments::LogStep* step = log.next()) {
      listeners.evaluate(reader, *step, *estimator, estimator->update(step->signals));
    }
  } catch (const InputError&) {
    listeners.flush();  // what a live stream said before it broke
    throw;
  }
  const std::string summary = listeners.finish(reader);
  return fmt::format("{}: {} steps, {:.3f} s at {:.6g} Hz, {}\n", reader.name(), listeners.steps(),
                     static_cast<double>(listeners.steps()) * log.period(), log.sample_rate(),
                     chosen.entry.title) +
         summary + gravity_line(log) + model_line(chosen);
}

/// Where the table does not go.
void say(const EstimateOutputs& outputs, const std::string& text) {
  if (outputs.prints_csv()) {
    tell(text);
  } else {
    fmt::print("{}", text);
  }
}

void estimate_log(const std::string& path, const recordings::ContactIntervals* labels,
                  const experiments::LogEstimator& estimator, const EstimateFlags& flags,
                  const EstimateOutputs& outputs, const CliSession& session) {
  std::string summary;
  write_outputs(outputs, [&](std::ostream* csv, std::ostream* mpack) {
    Listeners listeners(csv, mpack,
                        flags.figure.empty() ? std::nullopt : std::optional(flags.drawn));
    const bool live = path == "-";
    // Whoever watches a live stream sees every line before the program waits for the next one.
    const recordings::ByteSource source =
        [&, bytes = recordings::file_source(path, session.stop)](std::span<char> buffer) {
          if (outputs.prints_csv()) listeners.flush();
          return bytes(buffer);
        };
    recordings::LogReader reader(source, live ? "standard input" : path);
    summary = evaluate(reader, estimator, labels, listeners);
    if (*session.stop && !live) throw Stopped("stopped; nothing was written");
    for (const std::string& warning : reader.warnings()) {
      tell(fmt::format("touchdown: {}\n", warning));
    }
    if (!outputs.figure.empty()) {
      if (listeners.trace().bins().empty()) {
        throw InputError("--figure: there is no step between --from and --to");
      }
      const render::Figure figure = render::draw_log(
          listeners.trace(), fmt::format("{}, {}", reader.name(), estimator.entry.title),
          outputs.figure);
      summary += fmt::format("{:<12} {}\n", "figure", figure.png.string());
    }
  });
  if (!outputs.csv.empty() && !outputs.prints_csv()) {
    summary += fmt::format("{:<12} {}\n", "beliefs", outputs.csv.string());
  }
  if (!outputs.mpack.empty()) summary += fmt::format("{:<12} {}\n", "log", outputs.mpack.string());
  say(outputs, summary);
}

void estimate(const EstimateFlags& flags, const CliSession& session) {
  const experiments::LogEstimator estimator = experiments::log_estimator(
      {flags.estimator, flags.model, experiments::robot_called(flags.robot), flags.transfer,
       experiments::hyperparameters_of(flags.hyperparameters)});
  const std::vector<EstimateOutputs> outputs =
      estimate_outputs(flags.logs, flags.model, flags.labels, flags.outputs, flags.figure);
  const std::vector<recordings::ContactIntervals> labels =
      recordings::read_contact_intervals(flags.labels, flags.logs.size());
  for (std::size_t i = 0; i < flags.logs.size(); ++i) {
    if (i > 0) say(outputs[i], "\n");
    estimate_log(flags.logs[i], labels.empty() ? nullptr : &labels[i], estimator, flags, outputs[i],
                 session);
  }
}

}  // namespace

void add_estimate(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "estimate",
      "touchdown estimate robot.mpack --model model.npz -o beliefs.csv --figure beliefs.png\n"
      "… | touchdown estimate - --model model.npz\n\n"
      "Listens to Upkie's logs and says which wheels touched the ground. With - it listens to a\n"
      "live stream and prints as it goes.");
  const auto flags = std::make_shared<EstimateFlags>();
  verb.option("log", &flags->logs, "Logs; - is standard input").value_name("LOG").required();
  verb.option("--labels", &flags->labels,
              "The truth about stretches of each LOG, in the logs' order: start,end,contact or "
              "start,end,left,right. The score is of these stretches")
      .value_name("FILE.csv");
  verb.option("--model", &flags->model, "What `touchdown fit` wrote").value_name("FILE.npz");
  verb.option("--estimator", &flags->estimator,
              "Any that `touchdown list` shows (default: whom the model was fitted for)");
  verb.option(
          "--robot", &flags->robot,
          "Whose logs they are (default: as a simulated log says): not the model's is an error.\n"
          "Its file tells estimators that compute loads about its legs (default: the model's)")
      .value_name("NAME|FILE");
  verb.option("--set", &flags->hyperparameters,
              "Run the estimator with another constant than its model says, for example\n"
              "leave_below=0.25")
      .value_name("NAME=NUMBER")
      .one_at_a_time();
  verb.flag("--transfer", &flags->transfer,
            "Use a model at another rate or on another robot than it was fitted for");
  verb.option("-o,--output", &flags->outputs,
              "Beliefs as FILE.csv, or the log with beliefs in it as FILE.mpack, or both; - "
              "prints the table. With several logs, the log's name is put before FILE")
      .value_name("FILE")
      .one_at_a_time();
  verb.option("--figure", &flags->figure, "Signals and beliefs over time").value_name("FILE.png");
  verb.option("--from", &flags->drawn.from, "The figure begins at this time of the log (s)");
  verb.option("--to", &flags->drawn.to, "The figure ends at this time of the log (s)");
  verb.action([flags, &session] { estimate(*flags, session); });
}

}  // namespace touchdown::cli
