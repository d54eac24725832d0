#pragma once
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace ridgeline::sim {

/// A few threads that wait for frames; a frame allocates nothing. The caller's thread works as
/// well.
class Workers {
 public:
  /// Shares out numbers 0..count-1. Called on many threads at once.
  using Job = void (*)(void* context, int number);

  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Runs job(context, k) once for every k < count; returns when all are done.
  void run(Job job, void* context, int count);
  [[nodiscard]] int threads() const { return static_cast<int>(threads_.size()) + 1; }

 private:
  void wait_for_work();
  void take_numbers();

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable begun_, ended_;
  std::uint64_t round_ = 0;
  int busy_ = 0;
  bool closing_ = false;
  Job job_ = nullptr;
  void* context_ = nullptr;
  int count_ = 0;
  std::atomic<int> next_{0};
};

}  // namespace ridgeline::sim
