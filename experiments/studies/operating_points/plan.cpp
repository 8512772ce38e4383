#include "experiments/studies/operating_points/plan.hpp"

#include "scoring/operating_point.hpp"

namespace touchdown::experiments {

Measure operating_points_measure(const OperatingPointsConfig& config) {
  using Scores = std::vector<scoring::OperatingScore>;
  std::vector<scoring::Hysteresis> points = points_of(config);
  const std::size_t most = 1 + points.size();
  return measure_of_predictions<scoring::OperatingScore>(
      std::string(operating_points_name), most,
      [points = std::move(points)](const MeasuredPrediction& made) {
        Scores scores;
        if (!made.condition.is_fitted_in_domain()) return scores;
        const RunSignals& run = made.run.signals;
        const scoring::Prediction& prediction = made.prediction;
        using Decided = std::array<scoring::ContactSequence, models::wheel_count>;
        const auto add = [&](const Decided& decided) {
          scores.push_back(scoring::operating_score(run.contact, decided,
                                                    run.info.control_period_us, made.run.scoring));
        };
        add({prediction[0].contact, prediction[1].contact});
        for (const scoring::Hysteresis& point : points) {
          add({scoring::decisions(prediction[0].p_contact, point),
               scoring::decisions(prediction[1].p_contact, point)});
        }
        return scores;
      });
}

}  // namespace touchdown::experiments
