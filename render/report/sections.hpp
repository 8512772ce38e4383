#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/results/text_tables.hpp"
#include "render/film/primitives.hpp"
#include "render/film/request.hpp"
#include "render/report/html.hpp"

namespace touchdown::render {

/// A summary of each of the experiment's estimators, and its input signals.
ReportSection estimators_section(const ReportSubject& subject);

/// The title, one sentence, and the numbers of engines, runs, flights and noise settings.
PageHeader report_header(const ReportSubject& subject);

/// The results at the highlighted noise settings, in words and as tables of success rates.
ReportSection results_section(const ReportSubject& subject);

/// The paper's tables at the highlighted noise settings, with the paper's numbers beside ours.
ReportSection paper_section(const ReportSubject& subject);

/// The members of `table.html`. The first `text_columns` name the row.
Json table_members(const experiments::CaptionedTable& table, std::size_t text_columns);

/// Every CSV table of the run directory in readable form: columns `x`, `x_low`, `x_high` are
/// merged.
ReportSection more_tables_section(const ReportSubject& subject);

/// The members of `figure.html`: a figure of the run directory with its texts and its files, those
/// of its data in the order of these engines; null for one that is too large. `readouts` are what
/// the cells of a map show.
Json figure_members(const std::filesystem::path& file, const std::vector<std::string>& simulators,
                    const std::string& readouts = {});

/// The drawn maps of the success rate over noise levels, where a cell that the reader points at
/// shows its numbers; the other figures of the run directory, with the texts of their scripts.
struct FigureSections {
  ReportSection maps, others;
};
FigureSections figure_sections(const ReportSubject& subject);

/// Only this much of a longer run is replayed (s), because the page contains it.
inline constexpr double longest_replay = 60.0;

/// Poses per second, and beliefs per second.
inline constexpr double replay_pose_rate = 50.0;
inline constexpr double replay_belief_rate = 100.0;

/// What the report's replay draws of simulated runs, for `replay.js`:
///
/// - `scenes`: robots on their terrains, each once. A scene has `bodies`, of which the first is the
///   terrain; each is a list of `[shape, x, y, z, qw, qx, qy, qz, width, depth, height, r, g, b,
///   mesh]` (m), and `meshes`.
/// - `runs`: each with its flights (takeoff, landing in s, wheel), its scene and poses of all
/// bodies but the terrain: position and quaternion,
///   in 32 bits. `truth` has bit 0 for the left wheel, bit 1 for the right. `beliefs` of each
///   estimator have a byte per step and wheel: twice P(contact) in 127ths, plus its
///   decision (without decisions, whether P(contact) is above ½).
Json replay_data(const std::vector<VideoSource>& runs, const scoring::LabelConfig& labels);

/// The mesh with at most `most_triangles`, if need be by moving its vertices to a coarser and
/// coarser grid and leaving out triangles without area.
TriangleMesh reduced(const TriangleMesh& mesh, std::size_t most_triangles);

/// A replay of simulated runs for the report: a view that the reader can turn, beside the
/// estimators' contact probabilities. `scene3d.js` and `replay.js` (render/report) draw it from the
/// data that it contains.
std::string replay_html(const std::vector<VideoSource>& runs, const scoring::LabelConfig& labels);

}  // namespace touchdown::render
