#include "cli/show_result.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "cli/pictures.hpp"
#include "cli/report.hpp"
#include "experiments/result_files.hpp"

namespace touchdown {

void show(ExperimentResult& result, const Session& session, bool no_pictures) {
  fmt::print("{}", summary_text(result));
  fmt::print("\nresults   {}\ntables    {}\n", result.directory.path().string(),
             (result.directory.path() / "tables").string());
  std::fflush(stdout);
  if (no_pictures) return;
  for (const auto& picture : draw_pictures(result, session)) {
    fmt::print("{:<9} {}\n", picture.kind, picture.path.string());
  }
  write_manifest(result);
  fmt::print("{:<9} {}\n", "report", make_report(result.directory.path(), true, session).string());
}

}  // namespace touchdown
