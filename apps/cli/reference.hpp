#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace touchdown::cli {

/// Every key of a kind of YAML file, or of all kinds for "keys", with type, unit, range, default
/// and meaning: for the terminal, or as the document docs/reference/keys.md and its sections.
/// Errors: `InputError` for another kind.
std::string keys_reference(const std::string& kind, bool markdown);

/// The document docs/reference/cli.md: every command with its examples and options.
std::string commands_reference(const CLI::App& program);

}  // namespace touchdown::cli
