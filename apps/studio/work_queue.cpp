#include "studio/work_queue.h"

#include <algorithm>

namespace ombre::studio {

WorkQueue::WorkQueue(int workers) {
  for (int n = 0; n < workers; ++n) workers_.emplace_back([this] { run(); });
}

WorkQueue::~WorkQueue() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    for (const TaskPtr& task : waiting_) task->stop.request();
    for (const TaskPtr& task : running_) task->stop.request();
    waiting_.clear();
  }
  news_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

bool WorkQueue::add(const void* owner, double id, const std::string& lane, Work work) {
  if (!lane.empty()) cancel_lane(owner, lane);
  const std::lock_guard lock(mutex_);
  if (static_cast<size_t>(std::ranges::count(waiting_, owner, [](const TaskPtr& task) { return task->owner; })) >=
      most_waiting)
    return false;
  waiting_.push_back(std::shared_ptr<Task>(new Task{owner, id, lane, std::move(work)}));
  news_.notify_one();
  return true;
}

template <class Chosen>
void WorkQueue::cancel_if(const Chosen& is_chosen) {
  const std::lock_guard lock(mutex_);
  for (const TaskPtr& task : waiting_)
    if (is_chosen(*task)) task->stop.request();
  for (const TaskPtr& task : running_)
    if (is_chosen(*task)) task->stop.request();
}

void WorkQueue::cancel(const void* owner, double id) {
  cancel_if([&](const Task& task) { return task.owner == owner && task.id == id; });
}

void WorkQueue::cancel_lane(const void* owner, const std::string& lane) {
  cancel_if([&](const Task& task) { return task.owner == owner && task.lane == lane; });
}

void WorkQueue::cancel_all(const void* owner) {
  cancel_if([&](const Task& task) { return task.owner == owner; });
}

void WorkQueue::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    news_.wait(lock, [&] { return is_over_ || !waiting_.empty(); });
    if (is_over_) return;
    const TaskPtr task = waiting_.front();
    waiting_.pop_front();
    const auto place = running_.insert(running_.end(), task);
    lock.unlock();
    task->work(task->stop);
    lock.lock();
    running_.erase(place);
  }
}

}  // namespace ombre::studio
