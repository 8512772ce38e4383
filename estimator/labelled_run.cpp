#include "estimator/labelled_run.hpp"

#include "core/error.hpp"

namespace touchdown {

void check_labels(const LabelledRun& run) {
  for (const std::span<const std::uint8_t>& contact : run.contact) {
    if (contact.size() == run.signals.size()) continue;
    throw InputError("labelled run: one label of each wheel is needed for every step");
  }
}

}  // namespace touchdown
