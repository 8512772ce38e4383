#pragma once

#include <cstddef>
#include <string>

#include "cli/keys/kinds.hpp"

namespace touchdown::cli {

/// The keys of a kind of file for a terminal of `columns` characters: each key, and beside it its
/// type, unit, range and default, then its meaning.
std::string reference_text(const FileKind& kind, std::size_t columns);

/// The same as a section of a Markdown document, with one table.
std::string reference_markdown(const FileKind& kind);

/// The document docs/reference/keys.md.
std::string reference_document();

}  // namespace touchdown::cli
