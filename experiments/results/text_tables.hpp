#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// A table with its caption.
struct CaptionedTable {
  std::string caption;
  std::string label;  ///< a word, for the name of its LaTeX file
  TextTable table;
};

/// The accuracy and the false takeoffs per minute of every estimator at one noise setting: two
/// columns for each engine of the experiment, with these names.
TextTable accuracy_table(const Experiment& experiment, const ScoreTables& tables,
                         const noise::NoiseCell& noise, const std::vector<std::string>& engines);

/// Tables I to III of the paper (point-wise classification, transitions, latency), one row per
/// engine and estimator, in one noise setting. If the paper has one of the estimators, the last
/// column has its numbers from the real robot. They are a reference, not a target: another robot,
/// other drops, hand labels.
inline constexpr const char* paper_column = "paper, real robot";  ///< if one of its estimators is
std::vector<CaptionedTable> paper_tables(const Experiment& experiment, const ScoreTables& tables,
                                         const noise::NoiseCell& cell, const std::string& how);

/// Those tables for every highlighted cell of a result, each with its differences. From the second
/// cell on, labels end with its number.
std::vector<CaptionedTable> paper_tables(const ExperimentResult& result);

/// The tables of accuracy of every highlighted cell, labelled alike.
std::vector<CaptionedTable> accuracy_tables(const ExperimentResult& result);

/// The differences of the first estimator from the others, with intervals.
CaptionedTable difference_text_table(const Experiment& experiment, const ScoreTables& tables,
                                     const noise::NoiseCell& cell);

std::string to_text(const CaptionedTable& table);
std::string to_markdown(const CaptionedTable& table);
/// A `tabular` for \input, which needs the package booktabs, with its caption as a comment.
std::string to_latex(const CaptionedTable& table);

/// A result for the terminal: for each engine the highlighted cells and the first estimator's noise
/// grid, then the studies' texts, the scoring conditions, and the runs that were not used.
std::string summary_text(const ExperimentResult& result);

/// One table of the last highlighted cell in all engines, for the end of a long command.
std::string closing_text(const ExperimentResult& result);

}  // namespace touchdown::experiments
