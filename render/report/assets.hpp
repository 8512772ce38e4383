#pragma once

namespace touchdown::render {

/// A file of `render/report/` at the time of the build. The page is a format string with {names}
/// for its parts.
struct ReportAsset {
  const char* content;
  const char* sha256;  ///< of the content, hexadecimal
};

extern const ReportAsset report_page;
extern const ReportAsset report_style;
extern const ReportAsset report_script;

}  // namespace touchdown::render
