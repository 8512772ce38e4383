#pragma once

#include <string>
#include <vector>

#include "experiments/studies/cross_simulator/check.hpp"
#include "experiments/results/paper.hpp"

namespace touchdown::experiments {

/// The report for people: agreement, transfer, sensitivity, verdicts, one below the other.
std::vector<CaptionedTable> report_tables(const CrossSimulatorResult& result);

/// The same for a terminal, the verdicts written out.
std::string report_text(const CrossSimulatorResult& result);

/// `tables/{agreement,torques,transfer,sensitivity,verdicts}.csv` and `tables/cross_simulator.md`.
void write_tables(const CrossSimulatorResult& result, const RunDirectory& directory);

}  // namespace touchdown::experiments
