#include "experiments/evaluation/query.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/studies/registry.hpp"

namespace touchdown::experiments {

static constexpr const char* study_name = "prompt_takeoffs";

struct PromptTakeoffs {
  double within = 0.02;  ///< s
};
static void describe(Fields& fields, PromptTakeoffs& config, const Experiment& /*experiment*/) {
  fields("within", config.within, 0.0, 1.0).doc("s", "Longest delay of a prompt detection.");
}

/// The share of both wheels' flights that are predicted at most `within` after takeoff.
static Share prompt_flights(const MeasuredPrediction& made, double within) {
  const RunSignals& run = made.run.signals;
  const double period = run.period();
  Share share;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    for (const scoring::Flight& flight : scoring::flights(run.contact[wheel])) {
      std::size_t step = flight.takeoff;
      while (step < flight.landing && made.prediction[wheel].contact[step] != 0) ++step;
      const double delay = period * static_cast<double>(step - flight.takeoff);
      share += {step < flight.landing && delay < within + 0.5 * period ? 1 : 0, 1};
    }
  }
  return share;
}

class PromptTakeoffsStudy final : public SectionStudy<PromptTakeoffs> {
  std::optional<StudySection> section() const override {
    return optional_section<PromptTakeoffs>(study_name, "Flights detected soon after takeoff.");
  }
  void plan(const RunRequest& request, Plan& plan) const override {
    const auto measure = [within = section_of(request.experiment).within](const auto& made) {
      return std::vector{prompt_flights(made, within)};
    };
    add_measure(measure_of_predictions<Share>(study_name, measure), plan.groups.front());
  }
  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const Plan& plan = evaluation.plan;
    Query<Share> query;
    query.by = setting_keys<Share>();
    query.statistics.push_back({"prompt_share", &Share::value});
    query.runs = "runs";
    const Table table = directory.write_measured(
        "prompt_takeoffs.csv",
        answer(rows_of<Share>(study_name, plan.runs_in(0), plan, evaluation.saved), query,
               evaluation.request.experiment.intervals.bootstrap)
            .table);
    FigureSpec figure{.name = study_name, .table = "prompt_takeoffs.csv"};
    figure.panels = noise_panels(table);
    figure.series = groups_in(table, "simulator", [](const auto& engine) { return engine; });
    figure.rows = groups_in(table, "estimator", titles_in(evaluation.request.experiment));
    figure.measures = {axis_with_interval("prompt_share", "share of flights")};
    figure.title = "Flights detected soon after takeoff";
    figure.caption = intervals_text(evaluation.request.experiment) + ".";
    figure.alt = "Share of flights." + values_text(figure, table);
    return {.texts = {figure.title + "\n" + to_text(table)}, .figures = {figure}};
  }
};

std::unique_ptr<const Study> prompt_takeoffs_study() {
  return std::make_unique<const PromptTakeoffsStudy>();
}

}  // namespace touchdown::experiments
