#pragma once

#include <string>

namespace touchdown::render {

/// The PDF without its creation time, so that the same figure always gives the same file. Errors:
/// `Error` for text that is not a PDF; the message begins with the file's `name`.
std::string dateless_pdf(const std::string& pdf, const std::string& name);

}  // namespace touchdown::render
