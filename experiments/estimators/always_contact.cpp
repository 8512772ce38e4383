#include "experiments/estimators/always_contact.hpp"

namespace touchdown::experiments {

namespace {

class AlwaysContact : public ContactEstimator {
 public:
  void reset() noexcept override {}
  const Belief& update(const Signals& /*signals*/) noexcept override { return belief_; }

 private:
  const Belief belief_ = {.wheel = {{{1.0, true}, {1.0, true}}},
                          .p_any_wheel = 1.0,
                          .p_both_wheels = 1.0,
                          .status = SignalStatus::good};
};

}  // namespace

EstimatorEntry always_contact_entry() {
  return {.name = std::string(always_contact_name),
          .title = "Always contact",
          .summary = "listens to nothing: the share of contact, which others have to beat",
          .sensors = {},
          .make = [](const EstimatorEntry& /*entry*/, const EstimatorSetup& /*setup*/)
              -> std::unique_ptr<ContactEstimator> { return std::make_unique<AlwaysContact>(); }};
}

}  // namespace touchdown::experiments
