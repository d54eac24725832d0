#include "tests/mutants/active.hpp"

#include <atomic>
#include <map>
#include <string>

#include "tests/mutants/mutant.hpp"

namespace ridgeline::test {
namespace {

std::atomic<int> active = no_mutant;  // the thread that builds blocks asks as well

}  // namespace

void set_active_mutant(int index) {
  active = index;
}

bool mutant_is_on(int index) {
  return active.load(std::memory_order_relaxed) == index;
}

std::string_view mutated_shader(std::string_view source) {
  static std::map<const char*, std::string> texts;
  std::string& text = texts[source.data()];
  text = source;
  if (active < 0) return text;
  const Mutant& mutant = mutants()[static_cast<std::size_t>(active.load())];
  const std::size_t at = text.find(mutant.find);
  if (mutant.file.starts_with("shaders/") && at != std::string::npos) {
    text.replace(at, mutant.find.size(), mutant.put);
  }
  return text;
}

}  // namespace ridgeline::test
