#include "render/pictures/chosen_run.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "recordings/log/recording_file.hpp"

namespace touchdown::render {

const experiments::Rollout& chosen_run(const experiments::ExperimentResult& result,
                                       const std::string& simulator, int run, const char* key) {
  const experiments::Rollout* found = experiments::test_run(result.runs, simulator, run);
  if (found == nullptr || experiments::is_failure(found->report.outcome)) {
    throw InputError(fmt::format("{}.run: run {} in {} is not scored", key, run, simulator));
  }
  return *found;
}

recordings::Recording chosen_recording(const experiments::ExperimentResult& result,
                                       const std::string& simulator, int run, const char* key) {
  const std::string& file = chosen_run(result, simulator, run, key).plan.file;
  return recordings::read_recording(result.directory.file("recordings", file));
}

void draw_if_possible(const std::function<void()>& draw) {
  try {
    draw();
  } catch (const InputError& error) {
    print_message(fmt::format("touchdown: not drawn: {}\n", error.what()));
  }
}

}  // namespace touchdown::render
