#include "experiments/studies/ablation/figures.hpp"

#include <fmt/format.h>

#include "experiments/figures/groups.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/studies/ablation/config.hpp"

namespace touchdown::experiments {

FigureSpec ablation_figure(const Table& ablation, const Experiment& experiment) {
  FigureSpec spec;
  spec.name = "ablation";
  spec.table = "ablation.csv";
  spec.panels = combinations_in(
      ablation, {"torque_noise_nm", "accelerometer_noise_mps2"},
      [](const auto& noise) { return fmt::format("{} N·m, {} m/s²", noise[0], noise[1]); });
  const std::vector<std::string> steps =
      steps_of(experiment.studies.at<AblationConfig>(), experiment.estimators);
  spec.rows.columns = {"estimator"};
  for (std::size_t step = 1; step < steps.size(); ++step) {
    spec.rows.groups.push_back({{steps[step]}, estimator_title(steps[step])});
  }
  spec.measures = {{.column = "gain",
                    .title = "gain of balanced accuracy",
                    .low = "gain_low",
                    .high = "gain_high"}};
  spec.title = "Gain of every step";
  spec.caption = fmt::format(
      "Balanced accuracy of every estimator minus that of the one above it, the first one's minus "
      "that of {}, in the same runs; mean over scenes and engines ({}{}; {}).",
      estimator_title(steps.front()), labels_text(experiment), setup_caption(experiment),
      intervals_text(experiment));
  spec.alt = "Gain of every step." + values_text(spec, ablation);
  return spec;
}

}  // namespace touchdown::experiments
