#include "experiments/studies/moments/study.hpp"

#include "experiments/studies/moments/tables.hpp"

namespace touchdown::experiments {

bool MomentsStudy::is_requested(const Experiment& experiment) const { return experiment.moments; }

StudyResult MomentsStudy::summarize(const Evaluation& evaluation,
                                    const RunDirectory& directory) const {
  const std::vector<EngineTorques> torques = torques_by_engine(evaluation);
  write_tables(torques, directory);
  return {{moments_text(torques, evaluation.request.experiment)}};
}

}  // namespace touchdown::experiments
