#pragma once

#include <string>
#include <vector>

#include "cli/verb.hpp"

namespace touchdown::cli {

/// An option or positional argument, as the program declares it.
struct DescribedOption {
  std::vector<std::string> names;  ///< "-o", "--output"; a positional's has no dash
  std::string value;               ///< "DIR"; empty for a flag that takes none
  int count = 0;                   ///< how many values it takes at least
  bool more = false;               ///< more values may follow
  std::string text;                ///< what it does, on one line
  std::string fallback;            ///< its value where it is not given; empty if that is not shown
  std::vector<std::string> choices;  ///< its values, if they are known
  bool positional = false;
  bool required = false;
};

/// What `--help` says of a verb, taken apart.
struct DescribedVerb {
  std::string name;                   ///< "run"; empty for the program itself
  std::vector<std::string> examples;  ///< whole command lines
  std::string text;                   ///< what it does, on one line
  std::vector<DescribedOption> options;
};

/// With blanks for line ends.
std::string on_one_line(std::string text);

/// The program without its verbs, or a verb.
DescribedVerb described(const CLI::App& app);

/// The program's verbs in the order of its help.
std::vector<DescribedVerb> described_verbs(const CLI::App& program);

}  // namespace touchdown::cli
