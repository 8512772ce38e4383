#include "experiments/phase_study/fit.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/fitting/phase_fitting.hpp"
#include "experiments/phase_study/plan.hpp"

namespace touchdown::experiments {

namespace {

/// What a fit needs of the steps [begin, end).
RunSignals cut(const RunSignals& run, std::size_t begin, std::size_t end) {
  RunSignals piece;
  piece.info = run.info;
  const auto first = static_cast<std::ptrdiff_t>(std::min(begin, run.steps()));
  const auto last = static_cast<std::ptrdiff_t>(std::min(end, run.steps()));
  piece.signals.assign(run.signals.begin() + first, run.signals.begin() + last);
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    piece.contact[w].assign(run.contact[w].begin() + first, run.contact[w].begin() + last);
    piece.normal_force[w].assign(run.normal_force[w].begin() + first,
                                 run.normal_force[w].begin() + last);
  }
  return piece;
}

/// 1.9 s from one of five places between the first drop and the end, turn by turn.
RunSignals window(const RunSignals& run, std::size_t turn) {
  constexpr std::size_t before_first_drop = 2300;
  constexpr std::size_t length = 1900;
  const std::size_t room = run.steps() - std::min(run.steps(), before_first_drop + length);
  const std::size_t begin = before_first_drop + room * (turn % 5) / 4;
  return cut(run, begin, begin + length);
}

std::vector<RunSignals> pieces_of(const PlayedRuns& runs, const std::string& simulator,
                                  int stairs) {
  std::vector<RunSignals> windows;
  std::vector<RunSignals> others;
  for (const auto& [index, run] : runs) {
    if (run.plan.role != RunRole::fit || run.plan.simulator != simulator || run.failed()) continue;
    if (run.plan.scenario.name == "hang") {
      others.push_back(cut(run.signals, 300, 5300));
    } else if (run.plan.scenario.name == "lift") {
      others.push_back(cut(run.signals, 300, 7300));
    } else if (windows.size() < static_cast<std::size_t>(stairs)) {
      windows.push_back(window(run.signals, windows.size()));
    }
  }
  windows.insert(windows.end(), std::make_move_iterator(others.begin()),
                 std::make_move_iterator(others.end()));
  return windows;
}

double seconds(const std::vector<RunSignals>& pieces) {
  double sum = 0.0;
  for (const RunSignals& piece : pieces) sum += 1e-3 * static_cast<double>(piece.steps());
  return sum;
}

}  // namespace

void fit_to_pieces(const Experiment& experiment, const PlayedRuns& runs, const GoingOn& going_on,
                   FittedModels& models) {
  constexpr double most_seconds = 60.0;
  std::vector<int> numbers(learning_curve.begin(), learning_curve.end());
  numbers.push_back(fitted_pieces);
  for (const std::string& simulator : experiment.simulators) {
    for (const int number : numbers) {
      const std::vector<RunSignals> pieces = pieces_of(runs, simulator, number);
      if (number == fitted_pieces && seconds(pieces) > most_seconds) {
        throw Error(
            fmt::format("fitted on {:.1f} s, more than {} s", seconds(pieces), most_seconds));
      }
      std::vector<const RunSignals*> used;
      for (const RunSignals& piece : pieces) used.push_back(&piece);
      const auto or_stop = [&] {
        if (!going_on()) throw Stopped();
      };
      FittedModel model;
      model.phase = std::make_shared<recordings::PhaseModelFile>(
          fit_phases(used, PhaseFitConfig{}, 0.0, or_stop));
      models[simulator + pieces_fit(number)].insert_or_assign("phase", std::move(model));
    }
  }
}

double fitted_seconds(const PlayedRuns& runs, const std::string& simulator, int stairs) {
  return seconds(pieces_of(runs, simulator, stairs));
}

}  // namespace touchdown::experiments
