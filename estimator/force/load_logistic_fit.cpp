#include "estimator/force/load_logistic_fit.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace touchdown {

LogisticCurve fit_load_logistic(std::span<const LabelledRun> runs,
                                const LoadLogisticConfig& config) {
  std::vector<double> forces;
  std::vector<std::uint8_t> contact;
  for (const LabelledRun& run : runs) {
    check_labels(run);
    WheelLoadsConfig own = loads_of(config);
    own.sample_rate = run.sample_rate;
    WheelLoads loads(own);
    for (std::size_t k = 0; k < run.signals.size(); ++k) {
      const WheelLoads::Step step = loads.update(run.signals[k]);
      for (std::size_t side = 0; side < 2; ++side) {
        if (k < run.skip || !step.is_measured[side]) continue;
        forces.push_back(loads.force(side));
        contact.push_back(run.contact[side][k]);
      }
    }
  }
  try {
    return fit_logistic(forces, contact);
  } catch (const InputError& error) {
    throw InputError(std::string("load logistic: ") + error.what());
  }
}

}  // namespace touchdown
