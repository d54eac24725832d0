#include "sim/methods/workers.hpp"

namespace ridgeline::sim {

Workers::Workers(int threads) {
  for (int k = 1; k < threads; ++k) threads_.emplace_back([this] { wait_for_work(); });
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::run(Job job, void* context, int count) {
  {
    const std::lock_guard lock(mutex_);
    job_ = job;
    context_ = context;
    count_ = count;
    next_ = 0;
    busy_ = static_cast<int>(threads_.size());
    ++round_;
  }
  begun_.notify_all();
  take_numbers();
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return busy_ == 0; });
}

void Workers::wait_for_work() {
  std::uint64_t seen = 0;
  while (true) {
    {
      std::unique_lock lock(mutex_);
      begun_.wait(lock, [&] { return closing_ || round_ != seen; });
      if (closing_) return;
      seen = round_;
    }
    take_numbers();
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) ended_.notify_one();
  }
}

void Workers::take_numbers() {
  for (int k = next_++; k < count_; k = next_++) job_(context_, k);
}

}  // namespace ridgeline::sim
