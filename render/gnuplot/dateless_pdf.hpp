#pragma once

#include <string>

namespace touchdown::render {

/// A PDF without the time at which it was drawn, wherever it keeps it: the same figure is the same
/// file, whenever it is drawn. Errors: `Error` for what is no PDF, with `name` (a file's) before
/// what is wrong with it.
std::string dateless_pdf(const std::string& pdf, const std::string& name);

}  // namespace touchdown::render
