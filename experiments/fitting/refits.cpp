#include "experiments/fitting/refits.hpp"

#include "core/random.hpp"

namespace touchdown::experiments {

RunPointers drawn_anew(const RunPointers& runs, std::uint64_t seed, int number) {
  constexpr std::uint64_t stream = 0x7265666974;  // "refit"
  RunPointers drawn;
  for (std::size_t place = 0; place < runs.size(); ++place) {
    const recordings::RecordingInfo& here = runs[place]->info;
    RunPointers alike;
    for (const RunSignals* run : runs) {
      if (run->info.scenario == here.scenario && run->info.simulator == here.simulator) {
        alike.push_back(run);
      }
    }
    const double u = uniform01(seed, stream + static_cast<std::uint64_t>(number), place);
    drawn.push_back(alike[static_cast<std::size_t>(u * static_cast<double>(alike.size()))]);
  }
  return drawn;
}

}  // namespace touchdown::experiments
