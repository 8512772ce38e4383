#include "experiments/cross_simulator/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiments/estimators/registry.hpp"

namespace touchdown::experiments {

namespace {

std::string words_of(const Verdict& verdict, const VerdictConfig& config, bool is_fitted,
                     double level) {
  const bool keeps = verdict.loss < config.largest_loss;
  const bool gains = verdict.gain > config.smallest_gain;
  const std::string interval = fmt::format("{:.0f} % interval", 100.0 * level);
  const std::string loss =
      is_fitted
          ? fmt::format(
                "fitted in the other engine it loses at most {:.4f} of its success rate (upper end "
                "of the {}; {}, allowed is less than {})",
                verdict.loss, interval, keeps ? "good" : "too much", config.largest_loss)
          : "it has nothing to fit, so there is nothing to lose";
  return fmt::format(
      "{} {}: {}, and it is at least {:.4f} better than always contact (lower end; {}, asked is "
      "more than {}).",
      estimator_entry(verdict.estimator).title, verdict.holds ? "holds" : "FAILS", loss,
      verdict.gain, gains ? "good" : "too little", config.smallest_gain);
}

/// Greater or smaller of two; NaN wins, so that it cannot be overlooked.
double worse(double a, double b, bool greater_is_worse) {
  if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<double>::quiet_NaN();
  return greater_is_worse ? std::max(a, b) : std::min(a, b);
}

}  // namespace

std::vector<Verdict> verdicts(const std::vector<Transfer>& transfers, const VerdictConfig& config,
                              double level) {
  std::vector<Verdict> result;
  std::vector<bool> is_fitted;
  for (const Transfer& transfer : transfers) {
    const Condition& condition = transfer.condition;
    if (condition.estimator == always_contact_name) continue;
    if (condition.fit_simulator == condition.test_simulator) continue;
    auto verdict = std::find_if(result.begin(), result.end(), [&](const Verdict& v) {
      return v.estimator == condition.estimator;
    });
    if (verdict == result.end()) {
      result.push_back({condition.estimator, false, false, -std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::infinity(), ""});
      is_fitted.push_back(transfer.is_fitted);
      verdict = result.end() - 1;
    }
    verdict->loss = worse(verdict->loss, transfer.loss.high, true);
    verdict->gain = worse(verdict->gain, transfer.gain.low, false);
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    Verdict& verdict = result[i];
    verdict.holds = verdict.loss < config.largest_loss && verdict.gain > config.smallest_gain;
    verdict.is_demanded = std::find(config.demanded.begin(), config.demanded.end(),
                                    verdict.estimator) != config.demanded.end();
    verdict.words = words_of(verdict, config, is_fitted[i], level);
  }
  return result;
}

std::vector<std::string> failed_demands(const std::vector<Verdict>& verdicts) {
  std::vector<std::string> names;
  for (const Verdict& verdict : verdicts) {
    if (verdict.is_demanded && !verdict.holds) names.push_back(verdict.estimator);
  }
  return names;
}

}  // namespace touchdown::experiments
