#pragma once

#include <string>
#include <vector>

#include "experiments/cross_simulator.hpp"
#include "experiments/paper_tables.hpp"

namespace touchdown {

/// The report for people: agreement, transfer, sensitivity, verdicts, one below the other.
std::vector<CaptionedTable> report_tables(const CrossSimulatorResult& result);

/// The same for a terminal, the verdicts written out.
std::string report_text(const CrossSimulatorResult& result);

/// `tables/{agreement,torques,transfer,sensitivity,verdicts,runs}.csv`, `tables/cross_simulator.md`
/// and `manifest.json`.
void write_files(const CrossSimulatorResult& result);

}  // namespace touchdown
