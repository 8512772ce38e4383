#include "scoring/label_stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace touchdown::scoring {

LabelStream::LabelStream(double period, const LabelConfig& config, Sink sink)
    : steps_(static_cast<std::size_t>(std::max(std::llround(config.debounce / period), 1LL))),
      longest_chatter_(steps_ + static_cast<std::size_t>(std::llround(60.0 / period))),
      threshold_(config.force_threshold),
      sink_(std::move(sink)) {}

void LabelStream::add(double normal_force) {
  const std::uint8_t contact{normal_force > threshold_};
  stretch_ = !pending_.empty() && pending_.back() == contact ? stretch_ + 1 : 1;
  if (stretch_ > steps_) {  // nothing is pending, and this changes nothing
    sink_(contact);
    return;
  }
  pending_.push_back(contact);
  if (stretch_ >= steps_ || pending_.size() > longest_chatter_) settle();
}

void LabelStream::finish() {
  settle();
  pending_.clear();
  labelled_ = stretch_ = 0;
}

void LabelStream::settle() {
  const ContactSequence labels = debounced(pending_, steps_);
  for (std::size_t k = labelled_; k < labels.size(); ++k) sink_(labels[k]);
  // The last stretch, cut to what makes it long enough to keep its state.
  const std::size_t kept = std::min(labels.size(), steps_);
  pending_.assign(labels.end() - static_cast<std::ptrdiff_t>(kept), labels.end());
  labelled_ = kept;
}

}  // namespace touchdown::scoring
