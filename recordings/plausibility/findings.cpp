#include "recordings/plausibility/findings.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace touchdown::recordings {

void Findings::add(std::string_view subject, const std::string& finding) {
  auto found = std::find_if(findings_.begin(), findings_.end(),
                            [&](const Finding& one) { return one.text == finding; });
  if (found == findings_.end()) found = findings_.insert(findings_.end(), {finding, {}});
  found->subjects.emplace_back(subject);
}

std::vector<std::string> Findings::lines() const {
  std::vector<std::string> lines;
  for (const Finding& finding : findings_) {
    lines.push_back(fmt::format("{}: {}", fmt::join(finding.subjects, ", "), finding.text));
  }
  return lines;
}

}  // namespace touchdown::recordings
