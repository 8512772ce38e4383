#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// Notices that fitted runs lack flights or contact as soon as the last of them is simulated, which
/// is before most test runs are. It cannot be known earlier: whether a robot leaves the ground is a
/// result of the simulation. It checks the fits of phase and measurement models; the fits
/// themselves check more.
class FitRunCheck {
 public:
  /// `needed`: the runs that will be simulated, by their index in the plan.
  FitRunCheck(const Experiment& experiment, const Plan& plan, const std::set<std::size_t>& needed);

  /// Called once for each simulated run, from several threads. Errors: `InputError` with the
  /// estimators that cannot be fitted, what the runs lack, and the scenes; or with the reason of
  /// the first failure if all runs failed.
  void add(const Rollout& run);

 private:
  /// What the runs of a fit contain at any step.
  struct Contents {
    bool contact = false;     ///< of a wheel
    bool no_contact = false;  ///< of a wheel
    bool rolling = false;     ///< both wheels in contact
    bool flight = false;      ///< no wheel in contact
  };
  /// The whole runs of one fit on one engine.
  struct Runs {
    std::size_t left = 0;  ///< not simulated yet
    Contents contents = {};
    bool is_any_usable = false;
    std::set<std::string> scenes = {};
    std::map<std::string, std::string> failures = {};  ///< endings by file
  };

  static void require(bool holds, const std::vector<std::string>& estimators,
                      const std::string& missing, const std::string& simulator, const Runs& runs);

  std::vector<std::string> whole_run_estimators_;  ///< fitted, and not to segments
  std::vector<std::string> phase_estimators_;
  std::vector<std::string> measurement_estimators_;
  std::map<std::pair<std::string, std::string>, Runs> fits_;  ///< by name of the fit and engine
  std::mutex mutex_;
};

}  // namespace touchdown::experiments
