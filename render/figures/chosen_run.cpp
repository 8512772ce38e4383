#include "render/figures/chosen_run.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "logs/log/recording_file.hpp"

namespace touchdown::render {

FigureFile figure_file(const std::filesystem::path& run_directory, const std::string& name,
                       const experiments::PrintConfig& print) {
  const std::filesystem::path folder = "figures";
  return {run_directory / folder / name, print, [=](const std::string& file) {
            (void)experiments::record_file(run_directory, folder / file);
          }};
}

const experiments::FinishedRun& chosen_run(const experiments::ExperimentResult& result,
                                           const std::string& simulator, int run, const char* key) {
  const experiments::FinishedRun* found = experiments::test_run(result.runs, simulator, run);
  if (found == nullptr || experiments::is_failure(found->report.outcome)) {
    throw InputError(fmt::format("{}.run: run {} in {} is not scored", key, run, simulator));
  }
  return *found;
}

logs::Recording chosen_recording(const experiments::ExperimentResult& result,
                                 const std::string& simulator, int run, const char* key) {
  const std::string& file = chosen_run(result, simulator, run, key).plan.file;
  return logs::read_recording(result.directory.file("recordings", file));
}

void draw_if_possible(const std::function<void()>& draw) {
  try {
    draw();
  } catch (const InputError& error) {
    print_message(fmt::format("touchdown: not drawn: {}\n", error.what()));
  }
}

}  // namespace touchdown::render
