#pragma once

#include <string>
#include <vector>

#include "cli/manual/described_verb.hpp"

namespace touchdown::cli {

/// Scripts that complete verbs, options, and values where there are choices; elsewhere a file's
/// name may follow.
std::string bash_completion(const std::vector<DescribedVerb>& verbs);
std::string zsh_completion(const std::vector<DescribedVerb>& verbs);

}  // namespace touchdown::cli
