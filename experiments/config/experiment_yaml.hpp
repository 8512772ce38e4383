#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/fields.hpp"
#include "core/key.hpp"
#include "core/yaml.hpp"
#include "experiments/config/experiment.hpp"

namespace touchdown::experiments {

/// Reads an experiment strictly, which may name these external estimators beside the built-in ones.
/// It checks the names of engines and estimators, but not the scenario files. Errors: `InputError`
/// with file:line:column; also for an external estimator with the name of a built-in one.
Experiment experiment_from_yaml(const YamlDocument& document,
                                std::vector<EstimatorEntry> external_estimators = {});

/// The keys of an experiment file.
std::vector<Key> experiment_keys();

/// Checks that the files of an experiment exist. Errors: `InputError` with the file:line:column of
/// the first missing one, and the nearest existing file.
void require_files(const YamlDocument& document);

/// The experiment as YAML with all defaults, which reads back to the same experiment. It omits
/// `workers` and `figures`, which change no result, and the external estimators.
std::string to_yaml(const Experiment& experiment);

/// A section under `key` that an experiment has if and only if its file has it. Its keys are
/// described by `describe(Fields&, Section&, const Experiment&)`, beside the struct. Earlier keys
/// of the experiment are known there.
template <typename Section>
StudySection optional_section(const std::string& key, const std::string& meaning) {
  return {.key = key, .describe = [key, meaning](Fields& fields, Experiment& experiment) {
            StudySections& sections = experiment.studies;
            if (!fields.present(key, sections.has<Section>())) return;
            Section section = fields.reading() ? Section() : sections.at<Section>();
            fields.section(key, section, experiment).fallback("none").doc(meaning);
            sections.emplace<Section>(std::move(section));
          }};
}

/// Describes a list of different estimators, each one of the experiment's own.
KeyNotes own_estimators(Fields& fields, std::string_view key, const Experiment& experiment,
                        std::vector<std::string>& names);

/// Describes the section `video`: the run that is plotted and filmed.
void describe(Fields& fields, VideoConfig& video, const Experiment& experiment);

/// Describes the section `figures`.
void describe(Fields& fields, PrintConfig& print);

/// Describes the section `detail`: a figure of one drop.
void describe_drop_figures(Fields& fields, Experiment& experiment);

}  // namespace touchdown::experiments
