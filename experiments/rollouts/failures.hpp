#pragma once

#include <map>
#include <string>

namespace touchdown::experiments {

/// Describes runs that all failed by the first of them, for errors: "FILE fell after 0.675 s: pitch
/// beyond 1 rad, and 5 others". The argument holds their endings (`RunReport::ending`) by file.
std::string failures_text(const std::map<std::string, std::string>& ending_by_file);

}  // namespace touchdown::experiments
