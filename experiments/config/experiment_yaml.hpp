#pragma once

#include <string>
#include <vector>

#include "core/key.hpp"
#include "core/yaml.hpp"
#include "experiments/config/experiment.hpp"

namespace touchdown::experiments {

/// Reads an experiment strictly, which may have these studies' sections, and may name these
/// external estimators beside the built-in ones. It checks the names of engines and estimators, but
/// not the scenario files. Errors: `InputError` with file:line:column; also for an external
/// estimator with the name of a built-in one.
Experiment experiment_from_yaml(const YamlDocument& document, std::vector<StudySection> sections,
                                std::vector<EstimatorEntry> external_estimators);

/// The keys of an experiment file with these sections.
std::vector<Key> experiment_keys(std::vector<StudySection> sections);

/// Checks that the files of an experiment exist. Errors: `InputError` with the file:line:column of
/// the first missing one, and the nearest existing file.
void require_files(const YamlDocument& document, const std::vector<StudySection>& sections);

/// The experiment as YAML with all defaults, which reads back to the same experiment. It omits
/// `workers`, which changes no result, and the external estimators.
std::string to_yaml(const Experiment& experiment);

}  // namespace touchdown::experiments
