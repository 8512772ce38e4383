#pragma once

#include <string>
#include <vector>

#include "experiments/results/text_tables.hpp"
#include "experiments/studies/cross_simulator/check.hpp"

namespace touchdown::experiments {

/// The tables of the report: agreement, transfer, sensitivity.
std::vector<CaptionedTable> report_tables(const CrossSimulatorResult& result);

/// The tables and the verdicts as text for the terminal.
std::string report_text(const CrossSimulatorResult& result);

/// Writes `tables/{agreement,torques,transfer,sensitivity,verdicts}.csv` and
/// `tables/cross_simulator.md`.
void write_tables(const CrossSimulatorResult& result, const RunDirectory& directory);

}  // namespace touchdown::experiments
