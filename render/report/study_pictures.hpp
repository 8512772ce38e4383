#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "experiments/results/result.hpp"
#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// What is drawn of a study besides the figures of its tables. A study without such pictures needs
/// none of this; an empty function draws nothing. Each function is called for experiments that ask
/// for the study.
struct StudyPictures {
  std::function<bool(const experiments::Experiment&)> is_requested;
  /// Draws figures into the run directory.
  std::function<void(const experiments::ExperimentResult&)> draw = {};
  /// Films runs. Errors: as `render_video`; `Stopped`.
  std::function<void(const experiments::ExperimentResult&, const std::atomic<bool>* stop)> film =
      {};
  /// The HTML of its films, for the report's section of films.
  std::function<std::string(const ReportSubject&)> film_html = {};
  /// Writes pages beside the report, and returns the report's section about them.
  std::function<ReportSection(const ReportSubject&)> section = {};
};

}  // namespace touchdown::render
