#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/progress.hpp"

namespace touchdown::render {

/// What a video calls after every frame: moves a bar that lives as long as this, and stops the
/// filming once the user asked for it (`Stopped`).
class FilmProgress {
 public:
  FilmProgress(std::string what, const std::atomic<bool>* stop)
      : what_(std::move(what)), stop_(stop), bar_(std::make_shared<std::optional<Progress>>()) {}

  void operator()(int /*done*/, int frames) const {
    // Only the film knows how many frames it has.
    if (!*bar_) bar_->emplace(what_, "frames", frames);
    (*bar_)->advance();
    if (*stop_) throw Stopped();
  }

 private:
  std::string what_;
  const std::atomic<bool>* stop_;
  std::shared_ptr<std::optional<Progress>>
      bar_;  // a function object must be copyable, a bar is not
};

}  // namespace touchdown::render
