#include "experiments/studies/closed_loop/study.hpp"

#include <memory>

#include "experiments/studies/closed_loop/config.hpp"
#include "experiments/studies/closed_loop/figures.hpp"
#include "experiments/studies/closed_loop/plan.hpp"
#include "experiments/studies/closed_loop/rollout.hpp"
#include "experiments/studies/closed_loop/tables.hpp"
#include "experiments/studies/section_study.hpp"

namespace touchdown::experiments {

namespace {

constexpr const char* name = "closed_loop";

class ClosedLoopStudy final : public SectionStudy<ClosedLoopConfig> {
 public:
  std::optional<StudySection> section() const override { return closed_loop_section(); }

  void plan(const RunRequest& request, Plan& plan) const override {
    require_closed_loop(request);
    const auto scenes = std::make_shared<scenarios::CompiledScenes>();
    plan.model_tasks.push_back({name, "run", closed_loop_runs(request.experiment),
                                [request, scenes](std::size_t run, const FittedModels& models,
                                                  const ShouldContinue& should_continue) {
                                  return to_bytes(std::vector{measure_closed_loop(
                                      request, run, models, *scenes, should_continue)});
                                }});
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const ModelTasks& runs = evaluation.plan.model_tasks_called(name);
    const std::vector<SurvivalRow> rows =
        survival_rows(evaluation.request, [&](std::size_t run) -> std::optional<ClosedLoopMetrics> {
          const std::optional<std::string> bytes = saved_result(runs, run, evaluation.saved);
          const auto metrics = from_bytes<ClosedLoopMetrics>(bytes.value_or(std::string()));
          return metrics.empty() ? std::nullopt : std::optional(metrics.front());
        });
    write_tables(rows, directory);
    const Experiment& experiment = evaluation.request.experiment;
    return {{survival_text(rows, experiment)},
            {},
            survival_figures(directory.read_table("survival.csv"), experiment)};
  }
};

}  // namespace

std::unique_ptr<const Study> closed_loop_study() {
  return std::make_unique<const ClosedLoopStudy>();
}

}  // namespace touchdown::experiments
