#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace touchdown::cli {

/// One line about what is wrong with a command line, with the nearest verb or flag that exists.
std::string complaint(const CLI::App& program, int argc, char** argv, const CLI::ParseError& error);

}  // namespace touchdown::cli
