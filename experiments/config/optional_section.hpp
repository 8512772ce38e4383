#pragma once

#include <string>

#include "core/fields.hpp"
#include "experiments/config/experiment.hpp"

namespace touchdown::experiments {

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

}  // namespace touchdown::experiments
