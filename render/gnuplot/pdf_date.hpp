#pragma once

#include <filesystem>
#include <string>

namespace touchdown::render {

/// A PDF's bytes with 1 January 1970 for the time at which it was drawn: the same figure is the
/// same file, whenever it is drawn. Its length stays, because a PDF counts its bytes.
std::string without_date(std::string pdf);

/// The same for a file. Errors: `InputError` when it cannot be read, `Error` when it cannot be
/// written.
void remove_pdf_date(const std::filesystem::path& path);

}  // namespace touchdown::render
