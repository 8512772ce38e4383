#include "experiments/studies/moments/study.hpp"

#include "experiments/studies/moments/config.hpp"
#include "experiments/studies/moments/tables.hpp"
#include "experiments/studies/section_study.hpp"

namespace touchdown::experiments {

namespace {

class MomentsStudy final : public SectionStudy<MomentsConfig> {
 public:
  std::optional<StudySection> section() const override { return moments_section(); }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const std::vector<EngineTorques> torques = torques_by_engine(evaluation);
    write_tables(torques, directory);
    return {{moments_text(torques, evaluation.request.experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> moments_study() { return std::make_unique<const MomentsStudy>(); }

}  // namespace touchdown::experiments
