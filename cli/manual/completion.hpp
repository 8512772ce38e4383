#pragma once

#include <string>
#include <vector>

#include "cli/manual/described_verb.hpp"

namespace touchdown::cli {

/// Completion scripts for verbs, options and values with known choices. All other values complete
/// to file names.
std::string bash_completion(const std::vector<DescribedVerb>& verbs);
std::string zsh_completion(const std::vector<DescribedVerb>& verbs);

}  // namespace touchdown::cli
