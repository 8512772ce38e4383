#pragma once

#include <filesystem>
#include <vector>

#include "training/trainer.hpp"

namespace touchdown::training {

/// How one iteration of training ended.
struct IterationRecord {
  int iteration = 0;          ///< from 1
  double data_seconds = 0.0;  ///< labelled simulation seen so far (s)
  Loss training;              ///< met during its last epoch
  Loss validation;            ///< after it
};

using TrainingHistory = std::vector<IterationRecord>;

/// Index of the record with the smallest validation loss, the first of equals; the history must not
/// be empty.
std::size_t best_iteration(const TrainingHistory& history);

/// Whether the last `patience` iterations brought no better validation loss.
bool stopped_improving(const TrainingHistory& history, int patience);

/// The curves as comma-separated values, every number to the bit.
void write_history(const TrainingHistory& history, const std::filesystem::path& path);

/// Errors: `InputError` for anything that `write_history` would not have written.
TrainingHistory read_history(const std::filesystem::path& path);

/// Draws training and validation loss by iteration from a history's table, the chosen iteration
/// marked. Writes `training.gp` into `folder`, a gnuplot script for anybody who wants another
/// style, and runs it. Returns the figure; empty if gnuplot could not draw it.
std::filesystem::path draw_losses(const std::filesystem::path& history,
                                  const std::filesystem::path& folder, int chosen_iteration);

}  // namespace touchdown::training
