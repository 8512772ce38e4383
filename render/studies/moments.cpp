#include "experiments/studies/moments.hpp"

#include "render/figures/moments_figure.hpp"
#include "render/studies/registry.hpp"

namespace touchdown::render {

StudyPictures moments_pictures() {
  return {.is_requested =
              [](const experiments::Experiment& experiment) {
                return experiment.studies.has<experiments::MomentsConfig>();
              },
          .draw =
              [](const experiments::ExperimentResult& result) {
                draw_moments_figure(result.directory.read_table("moments.csv"),
                                    result.directory.read_table("torque_densities.csv"),
                                    result.directory.file("figures", "moments"));
              }};
}

}  // namespace touchdown::render
