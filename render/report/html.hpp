#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "render/report/subject.hpp"

namespace touchdown::render {

/// A section of the page and of its list of contents. A section without `html` is left out.
struct ReportSection {
  std::string id;
  std::string title;
  std::string html = {};
};

/// `text` with its markup characters escaped, for use inside and outside of attributes.
std::string escaped(std::string_view text);

/// One of the `facts` in the header of a page.
std::string fact_html(std::string_view name, std::string_view value);

std::string base64(std::string_view bytes);

/// The file's content as a `data:` URI. Errors: `InputError` when the file cannot be read.
std::string data_uri(std::string_view media_type, const std::filesystem::path& path);

/// JSON inside a script element: nothing in it may close the element.
std::string inline_json(const nlohmann::ordered_json& data);

/// The source expression of a Content-Security-Policy for a script or style with this hexadecimal
/// SHA-256 digest.
std::string policy_source(std::string_view sha256);

/// "3.9 MB", "250 kB".
std::string size_text(std::uintmax_t bytes);

/// Writes a page that needs no network: the header, a list of contents, and all sections that are
/// not empty.
void write_page(const ReportSubject& subject, const std::filesystem::path& path,
                const std::string& header_html, std::vector<ReportSection> sections);

}  // namespace touchdown::render
