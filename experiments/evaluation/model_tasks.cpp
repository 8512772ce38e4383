#include "experiments/evaluation/model_tasks.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "experiments/run_directory/saved_state.hpp"

namespace touchdown::experiments {

namespace {

std::string name_of(const ModelTasks& tasks, std::size_t item) {
  return fmt::format("{}_{:06}", tasks.unit, item);
}

std::string title_of(const ModelTasks& tasks) {
  std::string title = tasks.name;
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

}  // namespace

SavedModelTasks::SavedModelTasks(std::filesystem::path folder, std::string key)
    : folder_(std::move(folder)), key_(std::move(key)) {}

std::filesystem::path SavedModelTasks::file(const ModelTasks& tasks, std::size_t item) const {
  return folder_ / tasks.name / name_of(tasks, item);
}

std::optional<std::string> SavedModelTasks::read(const ModelTasks& tasks, std::size_t item) const {
  return read_state(file(tasks, item),
                    fmt::format("{} {} {}", key_, tasks.name, name_of(tasks, item)));
}

void SavedModelTasks::write(const ModelTasks& tasks, std::size_t item,
                            const std::string& bytes) const {
  write_state(file(tasks, item), fmt::format("{} {} {}", key_, tasks.name, name_of(tasks, item)),
              bytes);
}

TaskRange share_of(const ModelTasks& model_tasks, const TaskRange& tasks, std::size_t all_tasks) {
  return {model_tasks.count * tasks.begin / all_tasks, model_tasks.count * tasks.end / all_tasks};
}

bool has_model_tasks(const Plan& plan, const TaskRange& tasks) {
  return std::any_of(plan.model_tasks.begin(), plan.model_tasks.end(), [&](const ModelTasks& one) {
    return share_of(one, tasks, plan.tasks.size()).size() > 0;
  });
}

void run_model_tasks(const Plan& plan, const TaskRange& tasks, const FittedModels& models,
                     const SavedModelTasks& saved, MissingRun missing,
                     const ShouldContinue& should_continue) {
  for (const ModelTasks& one : plan.model_tasks) {
    const TaskRange items = share_of(one, tasks, plan.tasks.size());
    Progress progress(title_of(one), one.unit + "s", static_cast<std::int64_t>(items.size()));
    tbb::parallel_for(items.begin, items.end, [&](std::size_t item) {
      if (!should_continue()) throw Stopped();
      if (!saved.read(one, item)) {
        if (missing == MissingRun::refuse) {
          throw Error(fmt::format("state/{}/{} is missing", one.name, name_of(one, item)));
        }
        saved.write(one, item, one.compute(item, models, should_continue));
      }
      progress.advance();
    });
  }
}

bool lacks_model_tasks(const Plan& plan, const TaskRange& tasks, const SavedModelTasks& saved) {
  for (const ModelTasks& one : plan.model_tasks) {
    const TaskRange items = share_of(one, tasks, plan.tasks.size());
    for (std::size_t item = items.begin; item < items.end; ++item) {
      if (!saved.read(one, item)) return true;
    }
  }
  return false;
}

}  // namespace touchdown::experiments
