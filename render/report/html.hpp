#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown::render {

/// A part of the page with its place in the list of contents; empty where there is nothing to say.
struct ReportSection {
  std::string id;
  std::string title;
  std::string html = {};
};

/// `text` with nothing left in it that HTML takes for markup, inside and outside of attributes.
std::string escaped(std::string_view text);

/// One of the `facts` at the head of a page.
std::string fact_html(std::string_view name, std::string_view value);

/// "a", "a and b", "a, b and c".
std::string in_words(const std::vector<std::string>& things);

std::string base64(std::string_view bytes);

/// The file's content as an address that needs no file. Errors: `InputError` when it cannot be
/// read.
std::string data_uri(std::string_view media_type, const std::filesystem::path& path);

/// A hexadecimal digest as a Content-Security-Policy names the script or style that has it.
std::string policy_source(std::string_view sha256);

/// "3.9 MB", "250 kB".
std::string size_text(std::uintmax_t bytes);

}  // namespace touchdown::render
