#pragma once

#include <string>
#include <vector>

#include "cli/manual/described_verb.hpp"

namespace touchdown::cli {

/// A page for man(1), section 1, in roff. It describes the program with the list of its verbs, or
/// one verb; `verbs` is then empty. `version` as in "0.1.0".
std::string man_page(const DescribedVerb& subject, const std::vector<DescribedVerb>& verbs,
                     const std::string& version);

}  // namespace touchdown::cli
