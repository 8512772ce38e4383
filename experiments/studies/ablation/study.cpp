#include "experiments/studies/ablation/study.hpp"

#include "experiments/studies/ablation/config.hpp"
#include "experiments/studies/ablation/figures.hpp"
#include "experiments/studies/ablation/tables.hpp"
#include "experiments/studies/section_study.hpp"

namespace touchdown::experiments {

namespace {

class AblationStudy final : public SectionStudy<AblationConfig> {
 public:
  std::optional<StudySection> section() const override { return ablation_section(); }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const std::vector<AblationRow> rows = ablation_rows(evaluation);
    write_tables(rows, directory);
    const Experiment& experiment = evaluation.request.experiment;
    return {{ablation_text(rows, experiment)},
            {},
            {ablation_figure(directory.read_table("ablation.csv"), experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> ablation_study() { return std::make_unique<const AblationStudy>(); }

}  // namespace touchdown::experiments
