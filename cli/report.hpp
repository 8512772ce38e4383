#pragma once

#include <filesystem>

#include "cli/verbs.hpp"

namespace touchdown {

/// Writes `report.html` into a run directory, with a small film of the run that the experiment
/// films, both engines beside each other, if it films any and `with_film`. Returns the report.
std::filesystem::path make_report(const std::filesystem::path& run_directory, bool with_film,
                                  const Session& session);

}  // namespace touchdown
