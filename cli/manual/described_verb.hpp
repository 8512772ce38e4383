#pragma once

#include <string>
#include <vector>

#include "cli/verb.hpp"

namespace touchdown::cli {

/// An option or positional argument as the program declares it.
struct DescribedOption {
  std::vector<std::string> names;    ///< "-o", "--output"; a positional argument has no dash
  std::string value;                 ///< "DIR"; empty for a flag
  int count = 0;                     ///< minimum number of values
  bool more = false;                 ///< whether more values may follow
  std::string text;                  ///< description on one line
  std::string fallback;              ///< default value; empty if the help does not show it
  std::vector<std::string> choices;  ///< possible values, if known
  bool positional = false;
  bool required = false;
};

/// The parts of a verb's `--help` text.
struct DescribedVerb {
  std::string name;                   ///< "run"
  std::vector<std::string> examples;  ///< complete command lines
  std::string text;                   ///< description on one line
  std::vector<DescribedOption> options;
};

/// The program's verbs in the order of its help.
std::vector<DescribedVerb> described_verbs(const CLI::App& program);

}  // namespace touchdown::cli
