#pragma once

namespace touchdown::render {

/// A file of `render/report/` as it was when the program was built. The page is a format text whose
/// {names} stand for what is on it.
struct ReportAsset {
  const char* content;
  const char* sha256;  ///< of the content, hexadecimal
};

extern const ReportAsset report_page;
extern const ReportAsset report_style;
extern const ReportAsset report_script;

}  // namespace touchdown::render
