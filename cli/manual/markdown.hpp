#pragma once

#include <string>
#include <vector>

#include "cli/manual/described_verb.hpp"

namespace touchdown::cli {

/// The document docs/reference/cli.md: every command with its examples and options.
std::string markdown_manual(const std::vector<DescribedVerb>& verbs);

}  // namespace touchdown::cli
