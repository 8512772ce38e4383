#pragma once

#include <cstdint>
#include <functional>

#include "scoring/labels.hpp"

namespace touchdown::scoring {

/// `contact_labels` of one wheel for forces that come one by one: the same labels, each as soon as
/// no later force can change it, at a memory that does not grow with the run. A stretch that lasts
/// as long as the debounce keeps its state for good, so what lies between two of them is labelled
/// when the second one is. (Chatter that lasts for a minute is labelled in pieces.)
class LabelStream {
 public:
  using Sink = std::function<void(std::uint8_t contact)>;

  /// `period` in seconds; `sink` gets one label per force, in their order.
  LabelStream(double period, const LabelConfig& config, Sink sink);

  /// Normal force of the next step (N).
  void add(double normal_force);
  /// The run is over: labels what is left.
  void finish();

 private:
  void settle();

  std::size_t steps_;
  std::size_t longest_chatter_;
  double threshold_;
  Sink sink_;
  ContactSequence pending_;   ///< first what is labelled and still decides about the rest
  std::size_t labelled_ = 0;  ///< at the beginning of `pending_`
  std::size_t stretch_ = 0;   ///< steps that the last state has lasted
};

}  // namespace touchdown::scoring
