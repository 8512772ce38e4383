#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "core/error.hpp"
#include "experiments/results/result.hpp"
#include "logs/recording.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The test run that the section `key` chooses, in one engine. Errors: `InputError` when it is not
/// scored.
const experiments::FinishedRun& chosen_run(const experiments::ExperimentResult& result,
                                           const std::string& simulator, int run, const char* key);

/// Its recording. Errors: as above, and when the recording is missing or broken.
logs::Recording chosen_recording(const experiments::ExperimentResult& result,
                                 const std::string& simulator, int run, const char* key);

/// The files of a figure of this name in the run directory, printed as the experiment asks.
FigureFile figure_file(const std::filesystem::path& run_directory, const std::string& name,
                       const experiments::PrintConfig& print);
inline FigureFile figure_file(const experiments::ExperimentResult& result,
                              const std::string& name) {
  return figure_file(result.directory.path(), name, result.experiment.figures);
}

/// Draws a figure. If an engine's run lacks what it shows, prints the reason instead of throwing.
void draw_if_possible(const std::function<void()>& draw);

/// Called between two figures or frames. Throws `Stopped` once the user has asked to stop; `stop`
/// may be null.
inline void stop_if_asked(const std::atomic<bool>* stop) {
  if (stop != nullptr && *stop) throw Stopped();
}

}  // namespace touchdown::render
