#pragma once

#include <filesystem>
#include <vector>

#include "apps/training/trainer.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::training {

struct IterationRecord {
  int iteration = 0;          ///< from 1
  double data_seconds = 0.0;  ///< labelled data used so far (s)
  Loss training;              ///< during its last epoch
  Loss validation;            ///< after it
};

using TrainingHistory = std::vector<IterationRecord>;

/// Index of the record with the smallest validation loss, the first of equals; the history must not
/// be empty.
std::size_t best_iteration(const TrainingHistory& history);

/// Whether the last `patience` iterations brought no better validation loss.
bool stopped_improving(const TrainingHistory& history, int patience);

/// Writes the history as comma-separated values that read back to the same bits.
void write_history(const TrainingHistory& history, const std::filesystem::path& path);

/// Reads a history. Errors: `InputError` for anything that `write_history` cannot have written.
TrainingHistory read_history(const std::filesystem::path& path);

/// Draws training and validation loss by iteration, and marks the chosen one. Returns the figure's
/// PNG; empty if it cannot be drawn.
std::filesystem::path draw_losses(const TrainingHistory& history, const render::FigureFile& file);

}  // namespace touchdown::training
