#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/report/subject.hpp"

namespace touchdown::render {

/// A section of the page and of its list of contents. A section without `html` is left out.
struct ReportSection {
  std::string id;
  std::string title;
  std::string html = {};
};

using Json = nlohmann::ordered_json;

/// A template of `render/report/templates` (mustache), filled with an object's members: `{{name}}`
/// is a text, whose markup characters are escaped, and `{{{name}}}` is HTML or a `data:` URI. An
/// empty text counts as absent. Templates include each other by their file names. Empty where the
/// template shows nothing.
std::string html_of(std::string_view name, const Json& members);

std::string base64(std::string_view bytes);

/// The file's content as a `data:` URI. Errors: `InputError` when the file cannot be read.
std::string data_uri(std::string_view media_type, const std::filesystem::path& path);

/// JSON inside a script element: nothing in it may close the element.
std::string inline_json(const Json& data);

/// The source expression of a Content-Security-Policy for a script or style with this hexadecimal
/// SHA-256 digest.
std::string policy_source(std::string_view sha256);

/// "3.9 MB", "250 kB".
std::string size_text(std::uintmax_t bytes);

/// The header of a page: its title, one sentence, and numbers with their names.
struct PageHeader {
  std::string heading;
  std::string lead;
  std::vector<std::pair<std::string, std::string>> facts;
  std::string note;
  bool is_benchmark = false;  ///< links the benchmark's tables
};

/// Writes a page that needs no network: the header, a list of contents, and all sections that are
/// not empty.
void write_page(const ReportSubject& subject, const std::filesystem::path& path,
                const PageHeader& header, const std::vector<ReportSection>& sections);

}  // namespace touchdown::render
