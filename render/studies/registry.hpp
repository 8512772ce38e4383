#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "logs/recording.hpp"
#include "render/gnuplot/figure.hpp"
#include "render/report/report.hpp"
#include "scoring/labels.hpp"

namespace touchdown::render {

/// Whether an experiment asks for a study by having its section.
template <typename Section>
bool has_section(const experiments::Experiment& experiment) {
  return experiment.studies.has<Section>();
}

/// The pictures of all studies that have some besides figures of their tables, in the order of
/// drawing.
const std::vector<StudyPictures>& study_pictures();

/// Draws all figures of an experiment's result and, if `with_films`, its films, and writes its
/// report. Errors: as `draw_pictures` and `make_report`.
void draw_and_report(experiments::ExperimentResult& result, bool with_films,
                     const std::atomic<bool>* stop);

/// The rankings of estimators, a page about every scene, and films of the worst segments.
StudyPictures benchmark_pictures();

/// The film of one closed-loop run with several contact sources.
StudyPictures closed_loop_pictures();

/// One drop in both engines.
StudyPictures cross_simulator_pictures();

/// The torques beside the real robot's.
StudyPictures moments_pictures();

/// The drop of a run that is drawn, and the definition of flights.
struct DropOverlay {
  int drop = 0;                      ///< of each run, from 0; a drop is a flight of both wheels
  scoring::LabelConfig labels = {};  ///< what counts as contact
  double minimum_flight = 0.05;      ///< shorter flights are no drops (s)
  std::string title;
  std::string caption;  ///< the runs, and what counts as contact
};

/// Draws one drop as simulated in both engines, aligned at takeoff: height of the base, normal
/// force, knee and wheel torque of the left leg, vertical acceleration. Files as `draw_figure`.
/// Errors: `InputError` when a run has no such drop; `Error` as `draw_figure`.
Figure draw_drop_overlay(const logs::Recording& first, const logs::Recording& second,
                         const DropOverlay& what, const FigureFile& target);

/// Draws densities of the simulated |torque| in each engine, with a panel for each joint in each
/// contact state. Above each panel are the means ± standard deviations of the engines and of the
/// real robot, which has no density. `moments` and `densities` are a run's tables of that name
/// (docs/explanation/realism.md); an engine without samples has no curve. Files and errors as
/// `draw_figure`.
Figure draw_moments_figure(const Table& moments, const Table& densities, const FigureFile& target);

}  // namespace touchdown::render
