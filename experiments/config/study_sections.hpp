#pragma once

#include <any>
#include <functional>
#include <map>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown {

class Fields;

namespace experiments {

struct Experiment;

/// Files that an experiment names, or a study in addition to the experiment's own keys.
struct ExperimentFiles {
  std::vector<std::string> scenarios = {};
  std::vector<std::string> robots = {};  ///< of all test scenarios
  std::vector<std::string> sensors = {};
};

/// The section of an experiment file that asks for a study.
struct StudySection {
  std::string key;  ///< in the experiment file
  /// Reads, writes and documents the section, as `describe` functions do.
  std::function<void(Fields&, Experiment&)> describe = {};
  /// The experiment's own key before which it is written; empty: after all own keys. Written files
  /// determine the ids of runs.
  std::string before = {};
  std::function<ExperimentFiles(const Experiment&)> files = {};  ///< none without the section
  std::vector<std::string> file_keys = {};                       ///< dotted keys of their names
  /// Makes the estimators that only an experiment with the section may name; none if empty.
  std::function<std::vector<EstimatorEntry>()> estimators = {};
};

/// The sections that an experiment file may have, in the order of writing: those of all studies. It
/// is defined beside them (experiments/studies/registry.cpp), which the folders below do not know.
std::vector<StudySection> study_sections();

/// The studies' sections of one experiment, at most one of each type. The folders below the studies
/// know no type of a section.
class StudySections {
 public:
  /// The section of this type, or null.
  template <typename Section>
  const Section* find() const {
    const auto found = values_.find(typeid(Section));
    return found == values_.end() ? nullptr : std::any_cast<Section>(&found->second);
  }
  template <typename Section>
  bool has() const {
    return find<Section>() != nullptr;
  }
  /// Errors: `Error` if the experiment lacks the section.
  template <typename Section>
  const Section& at() const {
    const Section* const section = find<Section>();
    if (section == nullptr) throw Error("the experiment lacks a study's section");
    return *section;
  }

  /// Sets the section of this type. The reference is valid until the section is set or removed.
  template <typename Section>
  Section& emplace(Section section = {}) {
    return values_[typeid(Section)].template emplace<Section>(std::move(section));
  }
  template <typename Section>
  void erase() {
    values_.erase(typeid(Section));
  }

 private:
  std::map<std::type_index, std::any> values_;
};

}  // namespace experiments

}  // namespace touchdown
